//! `check --units`: what the numbers of a file measure.

use std::io::{self, Write};

use ribopt::input::{Dimensions, Measured};
use ribopt::report::number::short;
use ribopt::report::text::TextTable;

/// Writes what was inferred, and what does not agree.
pub fn write(dimensions: &Dimensions, out: &mut dyn Write) -> io::Result<()> {
    let mut table = TextTable::new(2, &["name", "measures", "value"]);
    for measured in &dimensions.measured {
        table.add(row(measured, dimensions));
    }
    write!(out, "{table}")?;
    if !dimensions.quantities {
        writeln!(out, "no number of the file has a unit: what does not agree is told here, and is no mistake")?;
    }
    dimensions.doubts.iter().try_for_each(|doubt| writeln!(out, "  {doubt}"))
}

fn row(measured: &Measured, dimensions: &Dimensions) -> Vec<String> {
    let Some(dimension) = measured.dimension else {
        let value = measured.value.map(short).unwrap_or_default();
        return vec![measured.name.clone(), "not known".into(), value];
    };
    let value = measured.value.map(|value| match dimensions.units.spoken(value, dimension) {
        Some((value, unit)) if !dimension.is_none() => format!("{} {unit}", short(value)),
        _ => short(value),
    });
    vec![measured.name.clone(), dimension.to_string(), value.unwrap_or_default()]
}
