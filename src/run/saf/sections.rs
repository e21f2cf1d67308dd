//! Cross-sections: by the format's parametric shapes, by their outlines, or by a shape with the same numbers.

use std::collections::BTreeMap;

use super::super::{RunError, Subject};
use super::converter::Converter;
use crate::problem::Problem;
use crate::problem::structure::{Member, Plane, Structure};
use crate::report::cross_section::CrossSection;
use crate::report::sheets::{Cell, Sheet};

/// Characters that a cell of a workbook holds.
const LONGEST_CELL: usize = 32_767;

/// The sections that members use, in numbers. A section of the format's is of one material.
pub(super) struct Shapes<'a> {
    problem: &'a Problem,
    /// By section and material: its numbers, and whether bars alone use it.
    used: BTreeMap<(u32, u32), (CrossSection, bool)>,
}

/// A shape of the format, with what its parameters are by our names.
fn parametric(section: &CrossSection) -> Option<(&'static str, &'static [&'static str])> {
    let rounded = section.value("r").is_some_and(|r| r > 0.0);
    Some(match section.kind {
        "rectangle" => ("Rectangle", &["h", "b"]),
        "h-beam" if rounded => ("I rolled", &["h", "b", "tf", "tw", "r"]),
        "h-beam" => ("I Section", &["h", "b", "b", "tf", "tf", "tw"]),
        "tee" => ("T Section", &["h", "b", "tf", "tw"]),
        "circle" => ("Circle", &["d"]),
        "tube" => ("Pipe", &["d", "t"]),
        _ => return None,
    })
}

impl<'a> Shapes<'a> {
    /// # Errors
    /// A section without numbers.
    pub fn of(subject: &'a Subject, x: &[f64], structure: &Structure) -> Result<Shapes<'a>, RunError> {
        let problem = subject.problem();
        let mut used: BTreeMap<(u32, u32), (CrossSection, bool)> = BTreeMap::new();
        for member in &structure.members {
            let rib = member.rib as usize;
            for s in [problem.ribs.from[rib], problem.ribs.to[rib]] {
                if let Some((_, bars)) = used.get_mut(&(s, member.material)) {
                    *bars &= member.pinned;
                    continue;
                }
                let name = &problem.sections.names[s as usize];
                let section = CrossSection::of(problem, s, x).ok_or_else(|| refused(name, "has a dimension without a value"))?;
                used.insert((s, member.material), (section, member.pinned));
            }
        }
        let mut shapes = Shapes { problem, used };
        let names: Vec<((u32, u32), String)> = shapes.used.keys().map(|key| (*key, shapes.name_of(*key, structure))).collect();
        for (key, name) in names {
            shapes.used.entry(key).and_modify(|(section, _)| section.name = name);
        }
        Ok(shapes)
    }

    /// A section's name; with its material behind it where the section has several.
    fn name_of(&self, (s, material): (u32, u32), structure: &Structure) -> String {
        let name = &self.problem.sections.names[s as usize];
        let several = self.used.range((s, 0)..=(s, u32::MAX)).nth(1).is_some();
        if several { format!("{name} of {}", structure.materials[material as usize].name) } else { name.to_string() }
    }

    /// What a member's section is called.
    pub fn name(&self, section: u32, material: u32) -> &str {
        self.used.get(&(section, material)).map_or("", |(section, _)| &section.name)
    }

    /// The area of a member that has one section all along.
    pub fn area_throughout(&self, member: &Member) -> Option<f64> {
        let [from, to] = [&self.problem.ribs.from, &self.problem.ribs.to].map(|ends| ends[member.rib as usize]);
        self.used.get(&(from, member.material)).filter(|_| from == to)?.0.value("A")
    }

    /// Sections, and the outlines of those that have no shape by name.
    ///
    /// # Errors
    /// Numbers that no shape has; a base unit that is not given.
    pub fn sheets(&self, structure: &Structure, units: &Converter<'_>) -> Result<[Sheet; 2], RunError> {
        let header = [
            "Name",
            "Material",
            "Cross-section type",
            "Shape",
            "Parameters [mm]",
            "Profile",
            "A [m2]",
            "Iy [m4]",
            "Iz [m4]",
            "It [m4]",
        ];
        let mut sections = Sheet::new("StructuralCrossSection", &header);
        let mut outlines = Sheet::new("CompositeShapeDef", &["Name"]);
        for ((_, material), (section, bars)) in &self.used {
            let material = &structure.materials[*material as usize].name;
            let mut row: Vec<Cell> = vec![section.name.as_str().into(), Cell::from(&**material)];
            match drawn(section, *bars, structure.plane)? {
                Drawn::Shape(word, parameters) => {
                    let parameters = parameters.iter().map(|value| millimetres(*value, units)).collect::<Result<Vec<_>, _>>()?;
                    row.extend(["Parametric", word, &parameters.join("; "), ""].map(Cell::from));
                }
                Drawn::Outline => {
                    row.extend(["General", "", "", &section.name].map(Cell::from));
                    contour(section, material, units, &mut outlines)?;
                }
            }
            for (name, symbol) in [("A", "m^2"), ("Ix", "m^4"), ("Iy", "m^4"), ("J", "m^4")] {
                row.push(units.to(section.value(name).unwrap_or(f64::NAN), symbol)?.into());
            }
            sections.rows.push(row);
        }
        Ok([sections, outlines])
    }
}

enum Drawn {
    Shape(&'static str, Vec<f64>),
    Outline,
}

fn drawn(section: &CrossSection, bars: bool, plane: Plane) -> Result<Drawn, RunError> {
    if let Some((word, names)) = parametric(section) {
        return Ok(Drawn::Shape(word, names.iter().map(|name| section.value(name).unwrap_or(f64::NAN)).collect()));
    }
    if section.kind != "general" {
        return Ok(Drawn::Outline);
    }
    // Numbers alone: what counts of a bar is its area, of a rib in a plane its area and Ix.
    match (section.value("A"), section.value("Ix")) {
        (Some(area), _) if bars => Ok(Drawn::Shape("Circle", vec![(4.0 * area / std::f64::consts::PI).sqrt()])),
        (Some(area), Some(inertia)) if plane != Plane::Space => {
            let height = (12.0 * inertia / area).sqrt();
            Ok(Drawn::Shape("Rectangle", vec![height, area / height]))
        }
        _ => Err(refused(
            &section.name,
            "is known by numbers alone, and no shape of the format has them all; give it a kind with dimensions (`ribopt section --kind …`)",
        )),
    }
}

fn millimetres(value: f64, units: &Converter<'_>) -> Result<String, RunError> {
    Ok(format!("{}", (units.to(value, "mm")? * 1e6).round() / 1e6))
}

/// The rings about the centroid as contours: material anticlockwise seen from the front, openings clockwise and without material.
fn contour(section: &CrossSection, material: &str, units: &Converter<'_>, sheet: &mut Sheet) -> Result<(), RunError> {
    let rings = section.rings();
    if rings.is_empty() {
        let defect = section.defect.as_deref().unwrap_or("it has no outline");
        return Err(refused(&section.name, &format!("cannot be drawn at this answer: {defect}")));
    }
    let mut row: Vec<Cell> = vec![section.name.as_str().into()];
    for (at, ring) in rings.iter().enumerate() {
        if sheet.header.len() < 2 * (at + 1) + 1 {
            sheet.header.extend(["Polygon contour", "Material name"].map(|title| format!("{title} {}", at + 1)));
        }
        let mut points = Vec::new();
        for [x, y] in ring.iter().copied() {
            points.push(format!("{}; {}", millimetres(x, units)?, millimetres(y, units)?));
        }
        let points = points.join("| ");
        if points.len() > LONGEST_CELL {
            return Err(refused(&section.name, "has an outline of more points than a cell holds; give it fewer"));
        }
        row.extend([points, if at == 0 { material.to_owned() } else { String::new() }].map(Cell::from));
    }
    sheet.rows.push(row);
    Ok(())
}

fn refused(section: &str, cause: &str) -> RunError {
    RunError::Choice(format!("no SAF file: section `{section}` {cause}"))
}
