//! Rib meshes and networks: read, check, reconstruct, smooth, trace, slice; from rib lines to a problem folder and on to solids
//! (chapter 3 of the note, as docs/meshes.md reads it).
//!
//! In reading order: [`PolygonMesh`] is what a file holds; [`QuadMesh`] is that, proved to be a quad mesh free of defects;
//! [`graph::Graph`] the rib edges of any other; the stages take one or another. Every stage is deterministic and reports its invariants as a serialisable value.
//! In messages, tables and reports faces and vertices are counted from 1, as OBJ counts them; in the code from 0.

pub mod boundary;
pub mod closest;
pub mod commands;
pub mod defects;
pub mod edge_list;
pub mod features;
pub mod formats;
pub mod generate;
pub mod graph;
mod half_edge;
pub mod hausdorff;
pub mod invariants;
pub mod network;
mod polygon_mesh;
pub mod quality;
pub mod reconstruct;
pub mod ribs;
pub mod section;
pub mod shade;
pub mod smooth;
pub mod solids;
pub mod stations;
pub mod trace;
pub mod weld;

pub use defects::{Defect, Defects};
pub use half_edge::QuadMesh;
pub use polygon_mesh::PolygonMesh;

/// A point or a direction in space.
pub type Vector = nalgebra::Vector3<f64>;

/// "No half-edge", "no group": the largest number, which no mesh reaches.
pub const NONE: u32 = u32::MAX;

/// The unit vector along `v`, or `None` where `v` is zero or not finite.
pub(crate) fn unit(v: Vector) -> Option<Vector> {
    let norm = v.norm();
    (norm.is_finite() && norm > 0.0).then(|| v / norm)
}

/// To six significant digits, which the shortest text of the number then has.
pub(crate) fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// The angle between two vectors, in [0, π]; accurate for small angles too (Kahan). Zero vectors give 0.
pub(crate) fn angle(u: &Vector, v: &Vector) -> f64 {
    u.cross(v).norm().atan2(u.dot(v))
}
