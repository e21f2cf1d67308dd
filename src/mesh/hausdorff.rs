//! How far two surfaces lie apart.

use std::collections::HashSet;

use rayon::prelude::*;
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
    let (triangles, others) = (triangles(first), triangles(second));
    let (from_first, from_second) = (one_way(&triangles, &others, second), one_way(&others, &triangles, first));
    Hausdorff { from_first, from_second, distance: from_first.max(from_second) }
}

type Triangle = [Vector; 3];

fn triangles(mesh: &PolygonMesh) -> Vec<Triangle> {
    mesh.fans().map(|(_, triangle)| triangle.map(|v| mesh.vertices[v as usize])).collect()
}

/// Triangles both surfaces have are no distance apart; of the others the samples are looked up.
fn one_way(from: &[Triangle], to: &[Triangle], surface: &PolygonMesh) -> f64 {
    let common: HashSet<[[u64; 3]; 3]> = to.iter().map(key).collect();
    let own: Vec<&Triangle> = from.iter().filter(|triangle| !common.contains(&key(triangle))).collect();
    if own.is_empty() {
        return 0.0;
    }
    let surface = Surface::of_faces(surface);
    let farthest = |triangle: &&Triangle| samples(triangle).map(|point| surface.distance(&point)).into_iter().fold(0.0, f64::max);
    own.par_iter().map(farthest).reduce(|| 0.0, f64::max)
}

/// The corners' bits, whichever comes first.
fn key(triangle: &Triangle) -> [[u64; 3]; 3] {
    let mut corners = triangle.map(|corner| [corner.x, corner.y, corner.z].map(|c| (c + 0.0).to_bits()));
    corners.sort_unstable();
    corners
}

fn samples([a, b, c]: &Triangle) -> [Vector; 7] {
    [*a, *b, *c, (a + b) / 2.0, (b + c) / 2.0, (c + a) / 2.0, (a + b + c) / 3.0]
}
