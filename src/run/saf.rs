//! `solve --saf`: the sized structure in the Structural Analysis Format (SAF 2, <https://www.saf.guide>), a workbook that other programs
//! read: materials, sections, nodes, members, tapers, supports, hinges, load cases, loads and combinations.

mod converter;
mod loads;
mod sections;
mod weight;

use std::path::Path;

use super::courses::placed;
use super::solve::Solved;
use super::{RunError, Subject};
use crate::files::whole;
use crate::problem::structure::{Hinges, Structure};
use crate::report::sheets::{self, Cell, Sheet};
use crate::report::structure::Courses;
use converter::Converter;
use sections::Shapes;

/// The version of the format.
const VERSION: &str = "2.2.0";

/// Writes the structure at the reported point.
///
/// # Errors
/// No structure, no units, something that the format has no word for; a file that cannot be written.
pub fn saf(subject: &Subject, solved: &Solved, out: &Path) -> Result<(), RunError> {
    let subject = solved.judged(subject);
    let (problem, x) = (subject.problem(), solved.outcome.x.as_slice());
    let (Some(structure), Some(statics)) = (problem.structure.as_deref(), problem.statics.as_deref()) else {
        return Err(RunError::Choice("no SAF file: there is no structure".into()));
    };
    let units = Converter(&solved.about.shown.system);
    let placed = placed(problem, structure, statics, x);
    let shapes = Shapes::of(subject, x, structure)?;
    let name = |member: u32| placed.members[member as usize].name.clone();
    let [sections, outlines] = shapes.sheets(structure, &units)?;
    let mut sheets = vec![project(&solved.about.title), model(&solved.about.title), materials(structure, &units)?, sections];
    sheets.extend(Some(outlines).filter(|sheet| !sheet.rows.is_empty()));
    sheets.extend([
        nodes(&placed, &units)?,
        members(subject, structure, &placed, &shapes, &units)?,
        tapers(subject, structure, &shapes),
        supports(structure, &units)?,
        hinges(structure, &placed),
    ]);
    sheets.extend(loads::sheets(structure, &name, &shapes, &units)?);
    let unwritable = |cause| RunError::Choice(format!("cannot write {}: {cause}", out.display()));
    whole::write(out, |file| sheets::write(&solved.about.title, &sheets, file)).map_err(unwritable)
}

/// Properties line by line: name and value.
fn lines(name: &str, lines: &[(&str, &str)]) -> Sheet {
    Sheet { rows: lines.iter().map(|(key, value)| vec![(*key).into(), (*value).into()]).collect(), ..Sheet::new(name, &[]) }
}

fn project(title: &str) -> Sheet {
    lines("Project", &[("Name", title)])
}

fn model(title: &str) -> Sheet {
    let source = format!("ribopt {}", env!("CARGO_PKG_VERSION"));
    lines(
        "Model",
        &[
            ("Name", title),
            ("SAF Version", VERSION),
            ("Source application", &source),
            ("Global coordinate system", "Z vertical"),
            ("LCS of cross-section", "ZYX"),
            ("System of units", "Metric"),
            ("National code", "EC-Standard-EN"),
        ],
    )
}

fn materials(structure: &Structure, units: &Converter<'_>) -> Result<Sheet, RunError> {
    let header = [
        "Name",
        "Type",
        "Quality",
        "Unit mass [kg/m3]",
        "E modulus [MPa]",
        "G modulus [MPa]",
        "Poisson Coefficient",
        "Thermal expansion [1/K]",
    ];
    let mut sheet = Sheet::new("StructuralMaterial", &header);
    for (number, material) in structure.materials.iter().enumerate() {
        let known = |name: &str| structure.material_number(number as u32, name).unwrap_or(f64::NAN);
        let [young, shear] = [units.to(known("E"), "MPa")?, units.to(known("G"), "MPa")?];
        let name = material.name.to_string();
        // What it is made of the file does not say.
        sheet.rows.push(vec![
            name.clone().into(),
            "Other".into(),
            name.into(),
            weight::unit_mass(known("density"), structure, units)?.into(),
            young.into(),
            shear.into(),
            known("nu").into(),
            known("alpha").into(),
        ]);
    }
    Ok(sheet)
}

fn nodes(placed: &Courses, units: &Converter<'_>) -> Result<Sheet, RunError> {
    let header = ["Name", "Coordinate X [m]", "Coordinate Y [m]", "Coordinate Z [m]"];
    let mut sheet = Sheet::new("StructuralPointConnection", &header);
    for node in &placed.nodes {
        let mut row = vec![Cell::from(node.name.as_str())];
        for coordinate in node.position {
            row.push(units.to(coordinate, "m")?.into());
        }
        sheet.rows.push(row);
    }
    Ok(sheet)
}

const MEMBER: [&str; 18] = [
    "Name",
    "Type",
    "Cross section",
    "Arbitrary definition",
    "Nodes",
    "Segments",
    "Length [m]",
    "LCS",
    "LCS Rotation [deg]",
    "Coordinate X [m]",
    "Coordinate Y [m]",
    "Coordinate Z [m]",
    "System line",
    "Analysis Y Eccentricity of Beg Node [mm]",
    "Analysis Z Eccentricity of Beg Node [mm]",
    "Analysis Y Eccentricity of End Node [mm]",
    "Analysis Z Eccentricity of End Node [mm]",
    "Behaviour in analysis",
];

fn members(
    subject: &Subject,
    structure: &Structure,
    placed: &Courses,
    shapes: &Shapes<'_>,
    units: &Converter<'_>,
) -> Result<Sheet, RunError> {
    let mut sheet = Sheet::new("StructuralCurveMember", &MEMBER);
    let dot = |a: [f64; 3], b: [f64; 3]| (0..3).map(|axis| a[axis] * b[axis]).sum::<f64>();
    for (member, place) in structure.members.iter().zip(&placed.members) {
        let (rib, ends) = (member.rib as usize, [member.start, member.end].map(|node| &placed.nodes[node as usize]));
        let (from, to) = (subject.problem().ribs.from[rib], subject.problem().ribs.to[rib]);
        let mut arms = Vec::new();
        for (end, node) in place.ends.iter().zip(ends) {
            let arm: [f64; 3] = std::array::from_fn(|axis| end[axis] - node.position[axis]);
            let [along, across, up] = place.axes.map(|axis| dot(arm, axis));
            if along.abs() > 1e-9 * dot(arm, arm).sqrt() {
                let message = format!(
                    "no SAF file: rib `{}` has an arm along itself, for which the format has no word; give it a node where it ends, \
                     joined to the other by a stiff rib",
                    place.name
                );
                return Err(RunError::Choice(message));
            }
            arms.extend([units.to(across, "mm")?, units.to(up, "mm")?]);
        }
        let along: [f64; 3] = std::array::from_fn(|axis| place.ends[1][axis] - place.ends[0][axis]);
        let mut row: Vec<Cell> = vec![place.name.as_str().into(), "General".into(), shapes.name(from, member.material).into()];
        row.push(if from == to { "" } else { place.name.as_str() }.into());
        row.extend([
            format!("{}; {}", ends[0].name, ends[1].name).into(),
            Cell::from("Line"),
            units.to(dot(along, along).sqrt(), "m")?.into(),
        ]);
        row.extend(["z by vector".into(), Cell::from(0.0)]);
        row.extend(place.axes[2].map(Cell::from));
        row.push("Centre".into());
        row.extend(arms.into_iter().map(Cell::from));
        row.push(if place.pinned { "Axial force only" } else { "Standard" }.into());
        sheet.rows.push(row);
    }
    Ok(sheet)
}

/// One taper per rib between two sections: it is linear, as ours is.
fn tapers(subject: &Subject, structure: &Structure, shapes: &Shapes<'_>) -> Sheet {
    let mut sheet = Sheet::new("StructuralCurveMemberVarying", &["Name", "Cross sections 1", "Span 1", "Alignment 1"]);
    let problem = subject.problem();
    for member in &structure.members {
        let rib = member.rib as usize;
        let [from, to] = [problem.ribs.from[rib], problem.ribs.to[rib]];
        if from != to {
            let [from, to] = [from, to].map(|section| shapes.name(section, member.material));
            let pair = format!("{from}, {to}");
            sheet.rows.push(vec![problem.ribs.names[rib].to_string().into(), pair.into(), 1.0.into(), "Centre".into()]);
        }
    }
    sheet
}

/// What the support of a node is called.
fn support_name(node: &str) -> String {
    format!("S {node}")
}

fn supports(structure: &Structure, units: &Converter<'_>) -> Result<Sheet, RunError> {
    let free = ["ux", "uy", "uz", "fix", "fiy", "fiz"];
    let stiff = ["X [MN/m]", "Y [MN/m]", "Z [MN/m]", "Fix [MNm/rad]", "Fiy [MNm/rad]", "Fiz [MNm/rad]"];
    let mut sheet = Sheet::new("StructuralPointSupport", &["Name", "Type", "Boundary condition", "Node"]);
    sheet.header.extend(free.map(String::from).into_iter().chain(stiff.map(|unit| format!("Stiffness {unit}"))));
    for support in &structure.supports {
        let node = structure.nodes.names[support.node as usize].to_string();
        let mut row: Vec<Cell> = vec![support_name(&node).into(), "Custom".into(), "In node".into(), node.into()];
        for (at, there) in structure.plane.directions().into_iter().enumerate() {
            // What a plane structure cannot do is held where it stands in space.
            let word = match (support.fixed[at] || !there, support.springs[at] > 0.0) {
                (true, _) => "Rigid",
                (false, true) => "Flexible",
                (false, false) => "Free",
            };
            row.push(word.into());
        }
        for (at, spring) in support.springs.iter().enumerate() {
            let symbol = if at < 3 { "MN/m" } else { "MN*m" };
            row.push(if *spring > 0.0 { units.to(*spring, symbol)? } else { f64::NAN }.into());
        }
        sheet.rows.push(row);
    }
    Ok(sheet)
}

fn hinges(structure: &Structure, placed: &Courses) -> Sheet {
    let header = ["Name", "Member", "Position", "ux", "uy", "uz", "fix", "fiy", "fiz"];
    let mut sheet = Sheet::new("RelConnectsStructuralMember", &header);
    for (member, place) in structure.members.iter().zip(&placed.members) {
        for (hinge, position) in member.hinges.iter().zip(["Begin", "End"]) {
            if *hinge == Hinges::default() {
                continue;
            }
            let word = |released: bool| Cell::from(if released { "Free" } else { "Rigid" });
            let mut row: Vec<Cell> =
                vec![format!("H {} {position}", place.name).into(), place.name.as_str().into(), position.into()];
            row.extend([false, false, false, hinge.torque, hinge.my, hinge.mz].map(word));
            sheet.rows.push(row);
        }
    }
    sheet
}
