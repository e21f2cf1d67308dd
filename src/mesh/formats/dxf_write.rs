//! DXF out: R12, which every program reads; a LINE per rib on its line's layer, name and numbers as extended data.

use std::io::{self, Write};

use crate::mesh::Vector;

/// A line of the drawing.
#[derive(Debug, Clone, PartialEq)]
pub struct DxfLine {
    /// The layer.
    pub layer: String,
    /// AutoCAD's colour number.
    pub colour: u8,
    /// Its ends.
    pub ends: [Vector; 2],
    /// Names and numbers that go with it (extended data of the application RIBOPT); a name alone where the number is none.
    pub data: Vec<(String, f64)>,
}

/// Writes the drawing. Coordinates read back bit for bit.
///
/// # Errors
/// Those of the writer.
pub fn write_dxf(out: &mut impl Write, lines: impl Iterator<Item = DxfLine>) -> io::Result<()> {
    writeln!(out, "0\nSECTION\n2\nHEADER\n9\n$ACADVER\n1\nAC1009\n0\nENDSEC")?;
    writeln!(out, "0\nSECTION\n2\nTABLES\n0\nTABLE\n2\nAPPID\n70\n1\n0\nAPPID\n2\nRIBOPT\n70\n0\n0\nENDTAB\n0\nENDSEC")?;
    writeln!(out, "0\nSECTION\n2\nENTITIES")?;
    for line in lines {
        writeln!(out, "0\nLINE\n8\n{}\n62\n{}", line.layer, line.colour)?;
        for (at, p) in line.ends.iter().enumerate() {
            writeln!(out, "{}\n{}\n{}\n{}\n{}\n{}", 10 + at, p.x, 20 + at, p.y, 30 + at, p.z)?;
        }
        if !line.data.is_empty() {
            writeln!(out, "1001\nRIBOPT")?;
        }
        for (name, value) in line.data.iter().filter(|(_, value)| !value.is_infinite()) {
            writeln!(out, "1000\n{name}")?;
            if !value.is_nan() {
                writeln!(out, "1040\n{value}")?;
            }
        }
    }
    writeln!(out, "0\nENDSEC\n0\nEOF")
}
