//! `mesh ribs --structure`: the ribs as a structure under dead load and snow, to be analysed and sized as a whole: `problem.toml`,
//! `nodes.csv`, `supports.csv`, `sections.csv`, `ribs.csv` and, where there is a surface, `loads.csv`.
//!
//! Nodes are the points where ribs meet; the height of every rib's section follows the surface's normal. A surface's loads act on
//! the nodes by the area each carries; without a surface they act along the ribs.

mod sharing;
mod supports;
mod text;
pub mod tributary;

use std::collections::BTreeSet;

use serde::Serialize;

pub use sharing::Sharing;
pub use supports::Held;
use tributary::Tributary;

use super::{Bounds, Options, RibsError, Unit, positive};
use crate::mesh::PolygonMesh;
use crate::mesh::network::Network;

/// What the structure is to be. Forces are kilonewtons; lengths are in the unit.
#[derive(Debug, Clone, PartialEq)]
pub struct Structure {
    /// What holds it.
    pub held: Held,
    /// Supports hold rotations, too.
    pub fixed: bool,
    /// Weight of what lies on the surface, per area of it; without a surface per length of rib.
    pub dead: f64,
    /// Snow, per area on plan; without a surface per length of rib on plan.
    pub snow: f64,
    /// Weight of the ribs per volume.
    pub density: f64,
    /// Poisson's ratio.
    pub poisson: f64,
    /// What stresses may reach under factored loads.
    pub strength: f64,
    /// Which sections are one.
    pub sharing: Sharing,
}

/// All the files; `loads.csv` only where there is a surface.
pub const FILES: [&str; 6] = ["problem.toml", "nodes.csv", "supports.csv", "sections.csv", "ribs.csv", "loads.csv"];

impl Structure {
    /// The defaults, in this unit: steel S235 stressed to six tenths (a margin for buckling, which the analysis leaves out), glass or panels
    /// of 0.5 kN/m², snow of 1 kN/m².
    pub fn with_unit(unit: Option<Unit>) -> Structure {
        let metres = unit.unwrap_or(Unit::Metre).metres();
        let (area, volume) = (metres * metres, metres * metres * metres);
        Structure {
            held: Held::default(),
            fixed: false,
            dead: 0.5 * area,
            snow: 1.0 * area,
            density: 77.0 * volume,
            poisson: 0.3,
            strength: 141e3 * area,
            sharing: Sharing::default(),
        }
    }
}

/// What was written of the structure.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct StructureReport {
    /// Nodes.
    pub nodes: usize,
    /// Entries of supports.
    pub supports: usize,
    /// Area of the surface; 0 without one.
    pub area: f64,
    /// The same seen from above, without faces that look down.
    pub plan_area: f64,
    /// Dead load besides the ribs' own weight; of lines `None`, it follows their length.
    pub dead: Option<f64>,
    /// Snow.
    pub snow: Option<f64>,
}

/// A table to write.
pub(super) type Files = Vec<(&'static str, Vec<u8>)>;

/// The files, the report, and how many sections there are.
///
/// # Errors
/// Loads or material that make no sense, nothing that holds the structure.
pub(super) fn files(
    network: &Network,
    mesh: &PolygonMesh,
    options: &Options,
    structure: &Structure,
    bounds: &[Bounds],
) -> Result<(Files, StructureReport, usize), RibsError> {
    checked(structure)?;
    let positions = network.positions();
    let supports = supports::held(network, mesh, &structure.held)?;
    let joints: Vec<_> = network.joints.iter().map(|joint| joint.vertex).zip(positions.iter().copied()).collect();
    let has_surface = mesh.face_count() > 0;
    let carried = if has_surface { tributary::of_joints(mesh, &joints) } else { Tributary::default() };
    let sections = sharing::sections(network, structure.sharing);
    let mut known = BTreeSet::new();
    let names: Vec<&String> = sections.iter().flatten().filter(|name| known.insert(name.as_str())).collect();
    let (area, plan_area) = (carried.area.iter().sum::<f64>(), carried.plan.iter().sum::<f64>());
    let report = StructureReport {
        nodes: joints.len(),
        supports: supports.len(),
        area,
        plan_area,
        dead: has_surface.then_some(structure.dead * area),
        snow: has_surface.then_some(structure.snow * plan_area),
    };
    let shape = text::Shape { span: span(network, &positions, &supports), has_surface, snows: !has_surface || plan_area > 0.0 };
    let problem = text::problem(options, structure, &shape);
    let mut files: Files = vec![("problem.toml", problem.into_bytes())];
    let mut table = |name: &'static str, header: &[String], rows: &mut dyn Iterator<Item = Vec<String>>| {
        files.push((name, csv(header, rows)?));
        Ok::<(), RibsError>(())
    };
    let words = |text: &str| text.split(',').map(String::from).collect::<Vec<_>>();
    let nodes = network.joints.iter().zip(&positions);
    let row = |(joint, place): (&crate::mesh::network::Joint, &crate::mesh::Vector)| {
        [joint.name.clone()].into_iter().chain(place.iter().map(f64::to_string)).collect()
    };
    table("nodes.csv", &words("name,x,y,z"), &mut nodes.map(row))?;
    let fix = if structure.fixed { "fixed" } else { "pinned" };
    table("supports.csv", &words("node,fix"), &mut supports.iter().map(|name| vec![name.clone(), fix.into()]))?;
    let (header, cells) = section_columns(bounds);
    let row = |name: &&String| [(*name).clone(), options.kind.name().into()].into_iter().chain(cells.clone()).collect();
    table("sections.csv", &header, &mut names.iter().map(row))?;
    let row = |(rib, [from, to]): (&crate::mesh::network::Rib, &[String; 2])| {
        let geometry = &rib.geometry;
        let [start, end] = geometry.joints.map(|joint| network.joints[joint as usize].name.clone());
        let up = geometry.frame.z.iter().map(f64::to_string);
        let head = [geometry.name.clone(), from.clone(), to.clone(), start, end, options.volume.name().into()];
        head.into_iter().chain(up).chain([geometry.line.clone()]).collect()
    };
    let header = words("name,from,to,start,end,volume,up_x,up_y,up_z,line");
    table("ribs.csv", &header, &mut network.ribs.iter().zip(&sections).map(row))?;
    if has_surface {
        table("loads.csv", &words("case,node,fx,fy,fz"), &mut loads(network, structure, &carried).into_iter())?;
    }
    Ok((files, report, names.len()))
}

/// Header of the sections' table, and the cells of dimensions, which are the same in every row.
fn section_columns(bounds: &[Bounds]) -> (Vec<String>, Vec<String>) {
    let columns = bounds.iter().flat_map(|b| ["lower", "upper", "start"].map(|part| format!("{}.{part}", b.dimension)));
    let header = ["name".into(), "kind".into()].into_iter().chain(columns).collect();
    let cells = bounds.iter().flat_map(|b| [b.lower, b.upper, b.start].map(|value| value.to_string())).collect();
    (header, cells)
}

/// Forces on nodes by what they carry: dead load by area, snow by area in plan.
fn loads(network: &Network, structure: &Structure, carried: &Tributary) -> Vec<Vec<String>> {
    let of = |case: &'static str, pressure: f64, areas: &[f64]| {
        let loaded = network.joints.iter().zip(areas).filter(|(_, area)| **area * pressure != 0.0);
        let row = |name: &str, force: f64| vec![case.into(), name.into(), "0".into(), "0".into(), force.to_string()];
        loaded.map(|(joint, area)| row(&joint.name, -pressure * area)).collect::<Vec<_>>()
    };
    [of("dead", structure.dead, &carried.area), of("snow", structure.snow, &carried.plan)].concat()
}

fn checked(structure: &Structure) -> Result<(), RibsError> {
    positive("the weight per volume", structure.density)?;
    positive("the strength", structure.strength)?;
    for (name, value) in [("the dead load", structure.dead), ("the snow load", structure.snow)] {
        if !(value >= 0.0 && value.is_finite()) {
            return Err(RibsError::Negative { name: name.into(), value });
        }
    }
    match structure.poisson > -1.0 && structure.poisson < 0.5 {
        true => Ok(()),
        false => Err(RibsError::Poisson { value: structure.poisson }),
    }
}

/// The shorter side of what the supports cover on plan, the longer one where they stand in a row; of the whole structure where they
/// stand at one place.
fn span(network: &Network, positions: &[crate::mesh::Vector], supports: &[String]) -> f64 {
    let held: BTreeSet<&str> = supports.iter().map(String::as_str).collect();
    let own = |joint: &crate::mesh::network::Joint| held.contains(joint.name.as_str());
    let sides = |chosen: &dyn Fn(&crate::mesh::network::Joint) -> bool| {
        [0, 1].map(|axis| {
            let at = network.joints.iter().zip(positions).filter(|(joint, _)| chosen(joint)).map(|(_, place)| place[axis]);
            let (low, high) = at.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), v| (low.min(v), high.max(v)));
            if high > low { high - low } else { 0.0 }
        })
    };
    let shorter = |[a, b]: [f64; 2]| if a.min(b) > 1e-6 * a.max(b) { a.min(b) } else { a.max(b) };
    let own = shorter(sides(&own));
    if own > 0.0 { own } else { shorter(sides(&|_| true)) }
}

fn csv(header: &[String], rows: &mut dyn Iterator<Item = Vec<String>>) -> Result<Vec<u8>, RibsError> {
    let failed = |cause: csv::Error| RibsError::Write(super::FormatError::Content(cause.to_string()));
    let mut table = csv::Writer::from_writer(Vec::new());
    table.write_record(header).map_err(failed)?;
    for row in rows {
        table.write_record(row).map_err(failed)?;
    }
    table.flush().map_err(|cause| failed(cause.into()))?;
    table.into_inner().map_err(|error| RibsError::Write(super::FormatError::Content(error.to_string())))
}

#[cfg(test)]
mod tests;
