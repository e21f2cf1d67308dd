//! The numbers of a mesh that stages must keep or may be checked by.

use serde::Serialize;

use super::quality::{self, Range};
use super::{QuadMesh, boundary};

mod polygons;

pub use polygons::measure_any;

/// Counts, topology and quality of a mesh.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Invariants {
    /// Vertices that have faces.
    pub vertices: usize,
    /// Vertices without faces; they count nowhere else.
    pub unused_vertices: usize,
    /// Edges.
    pub edges: usize,
    /// Edges that carry ribs: the flagged ones, or all.
    pub rib_edges: usize,
    /// Faces.
    pub faces: usize,
    /// Faces of three, of four and of more corners.
    pub triangles: usize,
    /// See `triangles`.
    pub quads: usize,
    /// See `triangles`.
    pub larger: usize,
    /// Connected pieces.
    pub components: usize,
    /// χ = V − E + F.
    pub euler_characteristic: i64,
    /// Vertices of each boundary loop.
    pub boundary_loops: Vec<usize>,
    /// Interior vertices of valence other than 4, as [number from 1, valence].
    pub irregular_interior: Vec<[u32; 2]>,
    /// Boundary vertices of valence other than 3, corners among them, as [number from 1, valence].
    pub irregular_boundary: Vec<[u32; 2]>,
    /// Σ interior (4 − valence) + Σ boundary (3 − valence).
    pub valence_sum: i64,
    /// Σ faces (corners − 4): 0 for quads.
    pub corner_sum: i64,
    /// Whether the valences' sum is 4χ + `corner_sum`, as it must be.
    pub valence_identity: bool,
    /// Distance of diagonals over their length, per face; 0 is planar.
    pub planarity: Range,
    /// Corner angles in degrees.
    pub angles: Range,
    /// Edge lengths.
    pub edge_lengths: Range,
    /// Area: of quads that of their bilinear patches.
    pub area: f64,
}

/// Measures a mesh.
///
/// ```
/// use ribopt::mesh::{QuadMesh, generate, invariants};
/// let report = invariants::measure(&QuadMesh::new(generate::cube(3))?);
/// assert_eq!((report.euler_characteristic, report.valence_sum), (2, 8));
/// assert_eq!(report.irregular_interior.len(), 8);
/// # Ok::<(), ribopt::mesh::Defects>(())
/// ```
pub fn measure(mesh: &QuadMesh) -> Invariants {
    let mut valences = Valences::default();
    for v in 0..mesh.vertex_count() as u32 {
        valences.add(mesh, v);
    }
    let vertices = mesh.vertex_count() - valences.unused;
    let euler = vertices as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64;
    let faces = 0..mesh.face_count() as u32;
    Invariants {
        vertices,
        unused_vertices: valences.unused,
        edges: mesh.edge_count(),
        rib_edges: (0..mesh.edge_count() as u32).filter(|&e| mesh.is_rib(e)).count(),
        faces: mesh.face_count(),
        triangles: 0,
        quads: mesh.face_count(),
        larger: 0,
        corner_sum: 0,
        components: components(mesh),
        euler_characteristic: euler,
        boundary_loops: boundary::loops(mesh).iter().map(Vec::len).collect(),
        valence_identity: valences.sum == 4 * euler,
        valence_sum: valences.sum,
        irregular_interior: valences.interior,
        irregular_boundary: valences.boundary,
        planarity: Range::of(faces.clone().map(|f| quality::planarity(mesh, f))),
        angles: Range::of((0..4 * faces.end).map(|h| quality::corner_angle(mesh, h).to_degrees())),
        edge_lengths: quality::edge_lengths(mesh),
        area: quality::area(mesh),
    }
}

#[derive(Default)]
struct Valences {
    unused: usize,
    sum: i64,
    interior: Vec<[u32; 2]>,
    boundary: Vec<[u32; 2]>,
}

impl Valences {
    fn add(&mut self, mesh: &QuadMesh, v: u32) {
        let valence = mesh.edges_at(v).count() as u32;
        if valence == 0 {
            self.unused += 1;
            return;
        }
        let (regular, irregular) = if mesh.is_boundary(v) { (3, &mut self.boundary) } else { (4, &mut self.interior) };
        self.sum += regular - i64::from(valence);
        if i64::from(valence) != regular {
            irregular.push([v + 1, valence]);
        }
    }
}

/// Number of pieces connected through edges.
fn components(mesh: &QuadMesh) -> usize {
    let mut seen = vec![false; mesh.face_count()];
    let mut pieces = 0;
    let mut stack = Vec::new();
    for start in 0..mesh.face_count() as u32 {
        if seen[start as usize] {
            continue;
        }
        pieces += 1;
        seen[start as usize] = true;
        stack.push(start);
        while let Some(f) = stack.pop() {
            for other in (4 * f..4 * f + 4).filter_map(|h| mesh.twin(h)).map(|h| h / 4) {
                if !std::mem::replace(&mut seen[other as usize], true) {
                    stack.push(other);
                }
            }
        }
    }
    pieces
}
