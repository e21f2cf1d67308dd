//! What the original says about a new face: where it goes on, where it ends.

use crate::mesh::closest::Surface;
use crate::mesh::features::{self, FeatureOptions};
use crate::mesh::half_edge::next;
use crate::mesh::{PolygonMesh, QuadMesh, Vector, unit};

/// The original surface and its boundary, and how far off them a mesh may be.
pub(super) struct Original {
    pub surface: Surface,
    pub boundary: Surface,
    pub tolerance: f64,
}

/// A face or an edge is held to the original by at most this part of its own shortest edge, however large the tolerance:
/// at a quarter, two opposite edges cannot be taken for one another.
pub(super) const OWN_SCALE: f64 = 0.25;

/// Parts into which an edge, and either side of a face, is divided for samples.
const PARTS: u32 = 4;

impl Original {
    pub fn new(original: &PolygonMesh, tolerance: f64) -> Self {
        let features = features::find(original, FeatureOptions::default());
        let boundary = Surface::of_segments(features::segments(original, &features));
        Original { surface: Surface::of_faces(original), boundary, tolerance }
    }

    /// The tolerance on the scale of something whose shortest edge is this long.
    pub fn reach(&self, edge: f64) -> f64 {
        self.tolerance.min(OWN_SCALE * edge)
    }

    /// Whether the original ends along this edge: the ends and three points between lie on its boundary. What the original
    /// leaves open stays open: no face is attached to such an edge, so that a mesh held against itself stays as it is.
    pub fn ends_along(&self, a: &Vector, b: &Vector) -> bool {
        let reach = self.reach((b - a).norm());
        (0..=PARTS).all(|k| self.boundary.distance(&a.lerp(b, f64::from(k) / f64::from(PARTS))) <= reach)
    }

    /// Whether the whole face lies on the original: its corners and a grid of points between them.
    pub fn carries(&self, quad: &[Vector; 4], reach: f64) -> bool {
        let at = |k: u32| f64::from(k) / f64::from(PARTS);
        (0..=PARTS).all(|i| (0..=PARTS).all(|j| self.surface.distance(&bilinear(quad, at(i), at(j))) <= reach))
    }

    /// Whether the boundary half-edge `h` of a mesh is open: the original goes on beyond it. Looked at a quarter of its length
    /// outwards, in the plane of its face.
    pub fn is_open(&self, mesh: &QuadMesh, h: u32) -> bool {
        let (a, b) = (mesh.positions[mesh.origin(h) as usize], mesh.positions[mesh.origin(next(h)) as usize]);
        let along = b - a;
        let Some(out) = unit(along.cross(&mesh.vector_area(h / 4))) else { return false };
        let outside = (a + b) / 2.0 + out * (0.25 * along.norm());
        self.surface.distance(&outside) <= self.reach(along.norm()) && !self.ends_along(&a, &b)
    }
}

/// The bilinear patch over four corners.
pub(super) fn bilinear([a, b, c, d]: &[Vector; 4], u: f64, v: f64) -> Vector {
    a.lerp(b, u).lerp(&d.lerp(c, u), v)
}
