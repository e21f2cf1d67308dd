//! Whether a new face belongs to the surface: without this test an L-shaped plate would be filled to a rectangle.

use crate::mesh::closest::Surface;
use crate::mesh::half_edge::previous;
use crate::mesh::{QuadMesh, Vector, angle, unit};

/// The original surface and how far off it new faces may be.
pub(super) struct Acceptance<'a> {
    pub surface: &'a Surface,
    pub tolerance: f64,
}

/// The flattest corner a new quad may have; beyond, three vertices of a smooth boundary would make a sliver.
const FLATTEST: f64 = 165.0 * std::f64::consts::PI / 180.0;

impl Acceptance<'_> {
    /// Whether the quad's centre lies on the original surface and, unless it is the last of a hole, no corner is nearly
    /// straight.
    pub fn accepts(&self, quad: [Vector; 4], last_of_hole: bool) -> bool {
        let centre = quad.iter().sum::<Vector>() / 4.0;
        let corner = |k: usize| angle(&(quad[(k + 1) % 4] - quad[k]), &(quad[(k + 3) % 4] - quad[k]));
        let shaped = last_of_hole || (0..4).all(|k| (std::f64::consts::PI - FLATTEST..FLATTEST).contains(&corner(k)));
        shaped && self.is_on_surface(&centre)
    }

    /// Whether a point lies on the original surface.
    pub fn is_on_surface(&self, point: &Vector) -> bool {
        self.surface.distance(point) <= self.tolerance
    }

    /// Whether the outer side of every edge of a boundary loop lies on the original surface: the loop is a hole, not an edge
    /// of the original. Looked at half an edge outwards, in the plane of the edge's face.
    pub fn covers(&self, mesh: &QuadMesh, ring: &[u32]) -> bool {
        ring.iter().all(|&v| self.outside(mesh, v).is_some_and(|point| self.is_on_surface(&point)))
    }

    /// The point half an edge outside the boundary edge that leaves `v`.
    fn outside(&self, mesh: &QuadMesh, v: u32) -> Option<Vector> {
        let h = mesh.spokes(v).next()?;
        debug_assert!(mesh.twin(h).is_none() && mesh.origin(previous(h)) != v);
        let (a, b) = (mesh.positions[v as usize], mesh.positions[mesh.target(h) as usize]);
        let out = unit((b - a).cross(&mesh.vector_area(h / 4)))?;
        Some((a + b) / 2.0 + out * (0.5 * (b - a).norm()))
    }
}
