//! How good the faces are: planarity, corner angles, edge lengths.

use serde::Serialize;

use super::{QuadMesh, Vector, angle};

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

/// Area of all faces: of their bilinear patches.
pub fn area(mesh: &QuadMesh) -> f64 {
    mesh.faces().iter().map(|face| patch_area(&face.map(|v| mesh.positions[v as usize]))).sum()
}

/// The area of the bilinear patch over four corners, ∫‖T_u × T_v‖ by three Gauss points each way. The integrand is constant along
/// a planar parallelogram, and a polynomial where a quad is planar, so that these are exact; warped quads to about 1e−4 where a corner
/// lies an edge above the others.
///
/// ```
/// use ribopt::mesh::{Vector, quality::patch_area};
/// let saddle = [0.0, 1.0, 0.0, 1.0].into_iter().zip([[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]]);
/// let corners: Vec<Vector> = saddle.map(|(z, [x, y])| Vector::new(x, y, z)).collect();
/// // The vector area is 1; the patch z = u + v − 2uv has 1.2808.
/// assert!((patch_area(&[corners[0], corners[1], corners[2], corners[3]]) - 1.280789).abs() < 1e-3);
/// ```
pub fn patch_area([a, b, c, d]: &[Vector; 4]) -> f64 {
    const POINTS: [(f64, f64); 3] =
        [(0.112_701_665_379_258_3, 5.0 / 18.0), (0.5, 8.0 / 18.0), (0.887_298_334_620_741_7, 5.0 / 18.0)];
    let at = |(u, wu): (f64, f64), (v, wv): (f64, f64)| {
        let along_u = (b - a) * (1.0 - v) + (c - d) * v;
        let along_v = (d - a) * (1.0 - u) + (c - b) * u;
        wu * wv * along_u.cross(&along_v).norm()
    };
    POINTS.iter().flat_map(|&u| POINTS.iter().map(move |&v| at(u, v))).sum()
}
