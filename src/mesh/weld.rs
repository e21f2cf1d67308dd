//! Joining vertices that lie within a tolerance of one another; only done when asked.

use rstar::RTree;
use rstar::primitives::GeomWithData;
use serde::Serialize;

use super::{PolygonMesh, Vector};

/// What a weld did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct WeldReport {
    /// Vertices joined to an earlier one.
    pub joined: usize,
    /// The longest way a vertex was moved.
    pub largest_move: f64,
}

/// Joins every vertex to the first earlier one kept within `tolerance` (chains do not creep: only kept vertices attract),
/// and drops the joined ones, and ribs whose ends are joined. Faces that lose corners stay, with these corners repeated.
///
/// ```
/// use ribopt::mesh::{formats::read_obj, weld::weld};
/// let two = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 0 1e-9\nv 2 0 0\nv 2 1 0\nv 1 1 0\nf 1 2 3 4\nf 5 6 7 8\n";
/// let (mesh, report) = weld(read_obj(two.as_bytes())?, 1e-6);
/// assert_eq!((mesh.vertices.len(), report.joined), (6, 2));
/// # Ok::<(), ribopt::mesh::formats::FormatError>(())
/// ```
pub fn weld(mesh: PolygonMesh, tolerance: f64) -> (PolygonMesh, WeldReport) {
    let mut kept: RTree<GeomWithData<[f64; 3], u32>> = RTree::new();
    let mut vertices: Vec<Vector> = Vec::new();
    let mut number = Vec::with_capacity(mesh.vertices.len());
    let mut report = WeldReport { joined: 0, largest_move: 0.0 };
    for &position in &mesh.vertices {
        let near = kept.locate_within_distance(position.into(), tolerance * tolerance).map(|near| near.data).min();
        number.push(near.unwrap_or(vertices.len() as u32));
        match near {
            Some(near) => {
                report.joined += 1;
                report.largest_move = report.largest_move.max((vertices[near as usize] - position).norm());
            }
            None => {
                kept.insert(GeomWithData::new(position.into(), vertices.len() as u32));
                vertices.push(position);
            }
        }
    }
    let mut welded = PolygonMesh::default();
    welded.vertices = vertices;
    for face in mesh.faces() {
        let face: Vec<u32> = face.iter().map(|&v| number[v as usize]).collect();
        welded.push_face(&face);
    }
    (welded.groups, welded.group_of, welded.notes) = (mesh.groups.clone(), mesh.group_of.clone(), mesh.notes.clone());
    welded.set_ribs(&mesh, |v| number[v as usize]);
    (welded, report)
}
