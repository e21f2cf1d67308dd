//! VTU, the XML form of VTK's unstructured grids (ParaView), as text.

use std::io::{self, Write};

use crate::mesh::PolygonMesh;

/// Numbers that go with the faces.
#[derive(Debug, Clone, PartialEq)]
pub struct CellData {
    /// The name ParaView shows.
    pub name: String,
    /// One number per face; NaN where a face has none.
    pub values: Vec<f64>,
}

/// Writes points, faces and their numbers; flagged edges become line cells (with NaN for every number). Faces with as many
/// corners stand together, lines first: readers make a block of every run of one kind.
///
/// # Errors
/// Those of the writer.
pub fn write_vtu(out: &mut impl Write, mesh: &PolygonMesh, data: &[CellData]) -> io::Result<()> {
    let cells = ordered(mesh);
    begin(out, mesh.vertices.len(), cells.len())?;
    writeln!(out, "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">")?;
    for v in &mesh.vertices {
        writeln!(out, "{} {} {}", v.x, v.y, v.z)?;
    }
    writeln!(out, "</DataArray></Points>\n<Cells>")?;
    let corners: Vec<&[u32]> = cells.iter().map(|(_, corners)| *corners).collect();
    cells_of(out, &corners)?;
    writeln!(out, "</Cells>\n<CellData>")?;
    for column in data {
        array(out, "Float64", &column.name, 1)?;
        for (face, _) in &cells {
            match column.values.get(*face).filter(|value| value.is_finite()) {
                Some(value) => writeln!(out, "{value}")?,
                None => writeln!(out, "nan")?,
            }
        }
        writeln!(out, "</DataArray>")?;
    }
    writeln!(out, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// Faces and flagged edges by number of corners, each with its number; edges are numbered past the last face.
fn ordered(mesh: &PolygonMesh) -> Vec<(usize, &[u32])> {
    let cells = mesh.faces().chain(mesh.ribs.iter().map(|rib| rib.as_slice()));
    let mut cells: Vec<(usize, &[u32])> = cells.enumerate().collect();
    cells.sort_by_key(|(_, corners)| corners.len());
    cells
}

/// Up to the points.
pub(super) fn begin(out: &mut impl Write, points: usize, cells: usize) -> io::Result<()> {
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(out, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>")?;
    writeln!(out, "<Piece NumberOfPoints=\"{points}\" NumberOfCells=\"{cells}\">")
}

/// Cells by their corners.
pub(super) fn cells_of(out: &mut impl Write, cells: &[impl AsRef<[u32]>]) -> io::Result<()> {
    array(out, "Int64", "connectivity", 1)?;
    for cell in cells {
        let words: Vec<String> = cell.as_ref().iter().map(u32::to_string).collect();
        writeln!(out, "{}", words.join(" "))?;
    }
    writeln!(out, "</DataArray>")?;
    array(out, "Int64", "offsets", 1)?;
    let mut end = 0;
    for cell in cells {
        end += cell.as_ref().len();
        writeln!(out, "{end}")?;
    }
    writeln!(out, "</DataArray>")?;
    array(out, "UInt8", "types", 1)?;
    for cell in cells {
        writeln!(out, "{}", cell_type(cell.as_ref().len()))?;
    }
    writeln!(out, "</DataArray>")
}

/// VTK's numbers: line, triangle, quad, polygon.
fn cell_type(corners: usize) -> u8 {
    match corners {
        2 => 3,
        3 => 5,
        4 => 9,
        _ => 7,
    }
}

/// The beginning of an array of so many numbers per point or cell.
pub(super) fn array(out: &mut impl Write, kind: &str, name: &str, components: usize) -> io::Result<()> {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
    let components = if components == 1 { String::new() } else { format!(" NumberOfComponents=\"{components}\"") };
    writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\"{components} format=\"ascii\">")
}
