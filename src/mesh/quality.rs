//! How good the faces are: planarity, corner angles, edge lengths.

use serde::Serialize;

use super::{QuadMesh, angle};

/// Smallest, mean and largest of a number.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
#[allow(missing_docs)]
pub struct Range {
    pub least: f64,
    pub mean: f64,
    pub most: f64,
}

impl Range {
    /// The range of some values; zeros where there are none.
    pub fn of(values: impl Iterator<Item = f64>) -> Range {
        let (mut least, mut most, mut sum, mut count) = (f64::INFINITY, f64::NEG_INFINITY, 0.0, 0.0);
        for value in values {
            least = least.min(value);
            most = most.max(value);
            sum += value;
            count += 1.0;
        }
        if count == 0.0 { Range { least: 0.0, mean: 0.0, most: 0.0 } } else { Range { least, mean: sum / count, most } }
    }
}

/// The distance between the diagonals of face `f`, over the mean of their lengths: 0 for a planar quad.
pub fn planarity(mesh: &QuadMesh, f: u32) -> f64 {
    let [a, b, c, d] = mesh.faces()[f as usize].map(|v| mesh.positions[v as usize]);
    let (u, v) = (c - a, d - b);
    let normal = u.cross(&v);
    let distance = (b - a).dot(&normal).abs() / normal.norm();
    if distance.is_finite() { distance / (0.5 * (u.norm() + v.norm())) } else { 1.0 }
}

/// The interior angle of the corner half-edge `h` starts at, in (0, 2π): above π at a reflex corner of the face.
pub fn corner_angle(mesh: &QuadMesh, h: u32) -> f64 {
    let at = |h: u32| mesh.positions[mesh.origin(h) as usize];
    let (u, v) = (at(super::half_edge::next(h)) - at(h), at(super::half_edge::previous(h)) - at(h));
    let between = angle(&u, &v);
    if u.cross(&v).dot(&mesh.vector_area(h / 4)) < 0.0 { std::f64::consts::TAU - between } else { between }
}

/// Lengths of all edges.
pub fn edge_lengths(mesh: &QuadMesh) -> Range {
    Range::of((0..mesh.edge_count() as u32).map(|e| mesh.edge_length(e)))
}

/// Area of all faces (vector areas).
pub fn area(mesh: &QuadMesh) -> f64 {
    (0..mesh.face_count() as u32).map(|f| mesh.vector_area(f).norm()).sum()
}
