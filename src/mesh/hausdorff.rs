//! How far two surfaces lie apart.

use serde::Serialize;

use super::closest::Surface;
use super::{PolygonMesh, Vector};

/// Two-sided Hausdorff distance, from samples: corners, midpoints of sides and centres of the faces' triangles. The true distance is at
/// least this much.
#[derive(Debug, Clone, Copy, PartialEq, Serialize)]
pub struct Hausdorff {
    /// The farthest a sample of the first surface lies from the second.
    pub from_first: f64,
    /// The farthest a sample of the second lies from the first.
    pub from_second: f64,
    /// The larger of the two.
    pub distance: f64,
}

/// Measures both ways.
///
/// ```
/// use ribopt::mesh::{generate::grid, hausdorff::hausdorff};
/// let apart = hausdorff(&grid(3, 1, 1.0), &grid(2, 1, 1.0));
/// assert!(apart.distance == 1.0 && apart.from_first == 1.0 && apart.from_second < 1e-15);
/// ```
pub fn hausdorff(first: &PolygonMesh, second: &PolygonMesh) -> Hausdorff {
    let one_way = |from: &PolygonMesh, to: &PolygonMesh| {
        let surface = Surface::of_faces(to);
        samples(from).map(|point| surface.distance(&point)).fold(0.0, f64::max)
    };
    let (from_first, from_second) = (one_way(first, second), one_way(second, first));
    Hausdorff { from_first, from_second, distance: from_first.max(from_second) }
}

fn samples(mesh: &PolygonMesh) -> impl Iterator<Item = Vector> {
    mesh.fans().flat_map(|(_, triangle)| {
        let [a, b, c] = triangle.map(|v| mesh.vertices[v as usize]);
        [a, b, c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0]
    })
}
