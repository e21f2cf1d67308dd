//! Cross-sections by the format's parametric shapes.

use std::collections::HashMap;

use super::super::sizes::all_sizes;
use super::super::{RunError, Subject};
use super::converter::Converter;
use crate::problem::structure::Structure;
use crate::report::sheets::{Cell, Sheet};

/// A section's numbers by name.
type Numbers<'a> = HashMap<&'a str, f64>;

/// A shape of the format, with what its parameters are by our names.
fn shape(kind: &str, numbers: &Numbers<'_>) -> Option<(&'static str, &'static [&'static str])> {
    let rounded = numbers.get("r").is_some_and(|r| *r > 0.0);
    Some(match kind {
        "rectangle" => ("Rectangle", &["h", "b"]),
        "h-beam" if rounded => ("I rolled", &["h", "b", "tf", "tw", "r"]),
        "h-beam" => ("I Section", &["h", "b", "b", "tf", "tf", "tw"]),
        "tee" => ("T Section", &["h", "b", "tf", "tw"]),
        "circle" => ("Circle", &["d"]),
        "tube" => ("Pipe", &["d", "t"]),
        _ => return None,
    })
}

/// The sheet of sections that members use.
pub(super) fn sections(subject: &Subject, x: &[f64], structure: &Structure, units: &Converter<'_>) -> Result<Sheet, RunError> {
    let header = ["Name", "Material", "Cross-section type", "Shape", "Parameters [mm]", "A [m2]", "Iy [m4]", "Iz [m4]"];
    let mut sheet = Sheet::new("StructuralCrossSection", &header);
    let problem = subject.problem();
    let mut known: HashMap<&str, (&str, Numbers<'_>)> = HashMap::new();
    for size in all_sizes(problem, x) {
        known.entry(size.section).or_insert_with(|| (size.kind, HashMap::new())).1.insert(size.name, size.value);
    }
    let mut materials: HashMap<u32, u32> = HashMap::new();
    for member in &structure.members {
        for section in [problem.ribs.from[member.rib as usize], problem.ribs.to[member.rib as usize]] {
            materials.entry(section).or_insert(member.material);
        }
    }
    for s in 0..problem.sections.names.len() as u32 {
        let Some(material) = materials.get(&s) else { continue };
        let name = &problem.sections.names[s as usize];
        let (kind, numbers) = known.get(name).ok_or_else(|| refused(name, "has too many companions to be listed"))?;
        let (word, parameters) = match (shape(kind, numbers), numbers.get("A")) {
            (Some((word, names)), _) => (word, names.iter().map(|name| numbers.get(name).copied().unwrap_or(f64::NAN)).collect()),
            // Numbers alone: a round bar of the same area, as pictures draw it.
            (None, Some(area)) if *kind == "general" => ("Circle", vec![(4.0 * area / std::f64::consts::PI).sqrt()]),
            _ => return Err(refused(name, &format!("is of kind {kind}, for which ribopt knows no shape of the format"))),
        };
        let mut millimetres = Vec::new();
        for parameter in parameters {
            millimetres.push(format!("{}", (units.to(parameter, "mm")? * 1e6).round() / 1e6));
        }
        let property = |name: &str, symbol: &str| units.to(numbers.get(name).copied().unwrap_or(f64::NAN), symbol);
        let material = structure.materials[*material as usize].name.to_string();
        sheet.rows.push(vec![
            Cell::from(name.to_string()),
            material.into(),
            "Parametric".into(),
            word.into(),
            millimetres.join("; ").into(),
            property("A", "m^2")?.into(),
            property("Ix", "m^4")?.into(),
            property("Iy", "m^4")?.into(),
        ]);
    }
    Ok(sheet)
}

fn refused(section: &str, cause: &str) -> RunError {
    RunError::Choice(format!("no SAF file: section `{section}` {cause}"))
}
