//! Sized ribs as closed solids: straight, lofted between the rings at their ends, butted with parallel ends.

mod caps;
mod loft;
mod overlap;

use serde::Serialize;

pub use loft::{area, loft, prismatoid_volume};
pub use overlap::JointOverlap;

use super::edge_list::open_edges;
use super::formats::CellData;
use super::network::RibGeometry;
use super::{NONE, PolygonMesh};

/// A closed curve of a section's boundary: x across the rib, y out of the surface, about the section's origin. Outer rings
/// run counter-clockwise, holes clockwise.
pub type Ring = crate::geometry::polygon::Ring;

/// One sized rib.
#[derive(Debug, Clone, PartialEq)]
pub struct SizedRib {
    /// Where it lies.
    pub geometry: RibGeometry,
    /// The rings at its two ends; as many rings and points at both.
    pub rings: [Vec<Ring>; 2],
    /// Numbers to tag it with, in the order of the names given to [`build`]; NaN where there is none.
    pub tags: Vec<f64>,
    /// How far its limits are used, 1 being fully; `None` where it has no limits.
    pub utilisation: Option<f64>,
    /// The volume a model gives it, to hold the solid against; `None` where there is no model.
    pub model_volume: Option<f64>,
}

impl SizedRib {
    /// The mean of its ends' areas.
    pub fn mean_area(&self) -> f64 {
        (area(&self.rings[0]) + area(&self.rings[1])) / 2.0
    }
}

/// All solids in one mesh, with their numbers per face.
#[derive(Debug, Clone, PartialEq)]
pub struct Solids {
    /// The mesh: one group per rib, its class of utilisation as a second group name.
    pub mesh: PolygonMesh,
    /// Per face: utilisation, mean area of the ends, the rib's number from 1, the tags.
    pub data: Vec<CellData>,
    /// What was built.
    pub report: Report,
}

/// What was built.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Solids.
    pub solids: usize,
    /// Volume of all solids, overlaps counted as often as they are covered.
    pub volume: f64,
    /// The same by the prismatoid formula.
    pub prismatoid_volume: f64,
    /// The largest relative difference of the two for one rib.
    pub largest_difference: f64,
    /// The volumes the model gives the ribs, together; `None` where a rib has none.
    pub model_volume: Option<f64>,
    /// The largest relative difference of a solid's volume to its rib's in the model.
    pub largest_model_difference: Option<f64>,
    /// Joints where solids reach into one another.
    pub overlapping_joints: usize,
    /// Estimate of the volume that is counted more than once.
    pub overlap_volume: f64,
    /// Estimate joint by joint.
    pub joints: Vec<JointOverlap>,
}

/// Why there is no solid.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum SolidError {
    #[error("{rib}: its ends have different outlines ({from} and {to} points per ring); only ends of one kind can be lofted")]
    Outlines { rib: String, from: String, to: String },
    #[error("{rib}: a ring of its section crosses or touches itself, or has fewer than three points")]
    Ring { rib: String },
    #[error("{rib}: the solid is not closed at the edge of vertices {edge:?}")]
    Open { rib: String, edge: [u32; 2] },
    #[error("{rib}: its volume {volume} is not positive")]
    Volume { rib: String, volume: f64 },
}

/// Builds all solids and checks each: closed, outward, its volume that of the prismatoid.
///
/// # Errors
/// Rings that do not go together or cross themselves.
pub fn build(ribs: &[SizedRib], tag_names: &[String]) -> Result<Solids, SolidError> {
    let mut solids = Builder::new(tag_names);
    for rib in ribs {
        let solid = loft(rib)?;
        check(&rib.geometry.name, &solid)?;
        solids.add(rib, &solid);
    }
    let joints = overlap::joints(ribs);
    let report = &mut solids.report;
    report.overlapping_joints = joints.len();
    report.overlap_volume = joints.iter().map(|joint| joint.volume).sum();
    report.joints = joints;
    Ok(Solids { mesh: solids.mesh, data: solids.data, report: solids.report })
}

fn check(rib: &str, solid: &PolygonMesh) -> Result<(), SolidError> {
    if let Some(&edge) = open_edges(solid).first() {
        return Err(SolidError::Open { rib: rib.into(), edge });
    }
    let volume = solid.volume();
    if volume > 0.0 { Ok(()) } else { Err(SolidError::Volume { rib: rib.into(), volume }) }
}

struct Builder {
    mesh: PolygonMesh,
    data: Vec<CellData>,
    report: Report,
}

impl Builder {
    fn new(tag_names: &[String]) -> Self {
        let own = ["utilisation", "area", "rib_number"].map(String::from);
        let names = own.into_iter().chain(tag_names.iter().cloned());
        let report = Report {
            solids: 0,
            volume: 0.0,
            prismatoid_volume: 0.0,
            largest_difference: 0.0,
            model_volume: Some(0.0),
            largest_model_difference: Some(0.0),
            overlapping_joints: 0,
            overlap_volume: 0.0,
            joints: Vec::new(),
        };
        let data = names.map(|name| CellData { name, values: Vec::new() }).collect();
        Builder { mesh: PolygonMesh::default(), data, report }
    }

    fn add(&mut self, rib: &SizedRib, solid: &PolygonMesh) {
        let first = self.mesh.vertices.len() as u32;
        self.mesh.vertices.extend_from_slice(&solid.vertices);
        self.mesh.groups.push(format!("{} {}", rib.geometry.name, utilisation_class(rib.utilisation)));
        let group = self.mesh.groups.len() as u32 - 1;
        let mean_area = rib.mean_area();
        for face in solid.faces() {
            let face: Vec<u32> = face.iter().map(|v| v + first).collect();
            self.mesh.push_face(&face);
            self.mesh.group_of.push(group);
            let own = [rib.utilisation.unwrap_or(f64::NAN), mean_area, f64::from(group + 1)];
            let values = own.into_iter().chain(rib.tags.iter().copied()).chain(std::iter::repeat(f64::NAN));
            self.data.iter_mut().zip(values).for_each(|(column, value)| column.values.push(value));
        }
        let (volume, expected) = (solid.volume(), prismatoid_volume(&rib.rings, rib.geometry.length()));
        let (report, model) = (&mut self.report, rib.model_volume);
        report.solids += 1;
        report.volume += volume;
        report.prismatoid_volume += expected;
        report.largest_difference = report.largest_difference.max((volume / expected - 1.0).abs());
        report.model_volume = report.model_volume.zip(model).map(|(sum, own)| sum + own);
        let most = report.largest_model_difference.zip(model);
        report.largest_model_difference = most.map(|(most, own)| most.max((volume / own - 1.0).abs()));
    }
}

/// The group name of a utilisation: `utilisation_080_090`, in tenths.
fn utilisation_class(utilisation: Option<f64>) -> String {
    match utilisation {
        Some(u) if u.is_finite() && u > 1.0 + 1e-6 => "utilisation_above_100".into(),
        Some(u) if u.is_finite() => {
            let tenth = (u * 10.0).clamp(0.0, 9.0).floor() * 10.0;
            format!("utilisation_{tenth:03}_{:03}", tenth + 10.0)
        }
        _ => "utilisation_unknown".into(),
    }
}

/// The numbers of a rib's faces as a table: rib, then every column; for formats that hold none.
///
/// # Errors
/// Those of the writer.
pub fn write_tags(out: impl std::io::Write, solids: &Solids) -> Result<(), csv::Error> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(std::iter::once("rib").chain(solids.data.iter().map(|column| column.name.as_str())))?;
    let mut last = NONE;
    for (face, &group) in solids.mesh.group_of.iter().enumerate() {
        if std::mem::replace(&mut last, group) == group {
            continue;
        }
        let name = solids.mesh.groups.get(group as usize).map_or("", |name| name.split(' ').next().unwrap_or(name));
        let cell = |column: &CellData| column.values.get(face).filter(|v| v.is_finite()).map_or(String::new(), f64::to_string);
        table.write_record(std::iter::once(name.to_string()).chain(solids.data.iter().map(cell)))?;
    }
    Ok(table.flush()?)
}

#[cfg(test)]
mod tests;
