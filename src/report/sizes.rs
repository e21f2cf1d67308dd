//! `sizes.csv`: every dimension and property of every section, linked and fixed ones too; `volumes.csv`: what each rib takes.

use std::io::{self, Write};

use super::number::exact;
use super::text::cell;

/// How the table of sizes begins.
pub const HEADER: &str = "section,kind,name,value,given";

/// How the table of volumes begins.
pub const VOLUMES_HEADER: &str = "rib,from,to,length,law,volume,density,mass";

/// One number of a section.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Size<'a> {
    /// The section.
    pub section: &'a str,
    /// Its kind.
    pub kind: &'static str,
    /// Dimension or property.
    pub name: &'static str,
    /// Its value; NaN where it has none.
    pub value: f64,
    /// `variable`, `linked`, `fixed` or `derived`.
    pub given: &'static str,
}

/// One rib's volume.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RibVolume<'a> {
    /// The rib.
    pub rib: &'a str,
    /// Sections at its ends.
    pub ends: [&'a str; 2],
    /// Its length.
    pub length: f64,
    /// Its volume law.
    pub law: &'static str,
    /// Its volume.
    pub volume: f64,
    /// Its density, where one is known.
    pub density: Option<f64>,
}

impl RibVolume<'_> {
    /// Density times volume.
    pub fn mass(&self) -> Option<f64> {
        self.density.map(|density| density * self.volume)
    }
}

/// Writes [`HEADER`] and a line per number.
///
/// # Errors
/// Whatever the writer says.
pub fn write<'a>(sizes: impl Iterator<Item = Size<'a>>, out: &mut dyn Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(HEADER.split(','))?;
    for Size { section, kind, name, value, given } in sizes {
        table.write_record([&*cell(section), kind, name, &exact(value), given])?;
    }
    table.flush()
}

/// Writes [`VOLUMES_HEADER`] and a line per rib.
///
/// # Errors
/// Whatever the writer says.
pub fn write_volumes<'a>(volumes: impl Iterator<Item = RibVolume<'a>>, out: &mut dyn Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(VOLUMES_HEADER.split(','))?;
    for one in volumes {
        let [from, to] = one.ends.map(cell);
        let known = |value: Option<f64>| value.map_or(String::new(), exact);
        let numbers = [exact(one.volume), known(one.density), known(one.mass())];
        let [volume, density, mass] = &numbers;
        table.write_record([&*cell(one.rib), &*from, &*to, &exact(one.length), one.law, volume, density, mass])?;
    }
    table.flush()
}
