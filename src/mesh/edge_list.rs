//! Which faces use which edges, of any polygon mesh.

use super::PolygonMesh;

/// One side of one face.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct EdgeUse {
    /// The edge: smaller vertex number, larger one.
    pub edge: [u32; 2],
    /// The side's number when all sides of all faces are counted in sequence; of a quad mesh, its half-edge.
    pub side: u32,
    /// The face.
    pub face: u32,
    /// Whether the face runs from the smaller to the larger number.
    pub forward: bool,
}

/// All sides, sorted by edge, then by side.
pub fn edge_uses(mesh: &PolygonMesh) -> Vec<EdgeUse> {
    let mut uses = Vec::new();
    let mut side = 0;
    for (f, face) in mesh.faces().enumerate() {
        for (k, &from) in face.iter().enumerate() {
            let to = face[(k + 1) % face.len()];
            uses.push(EdgeUse { edge: [from.min(to), from.max(to)], side, face: f as u32, forward: from < to });
            side += 1;
        }
    }
    uses.sort_unstable();
    uses
}

/// The sides edge by edge.
pub fn by_edge(uses: &[EdgeUse]) -> impl Iterator<Item = &[EdgeUse]> {
    uses.chunk_by(|a, b| a.edge == b.edge)
}

/// The edges that keep a mesh from being a closed, consistently oriented surface: those not used exactly once in each
/// direction.
///
/// ```
/// use ribopt::mesh::{edge_list::open_edges, generate};
/// assert!(open_edges(&generate::cube(2)).is_empty());
/// assert_eq!(open_edges(&generate::grid(1, 1, 1.0)).len(), 4);
/// ```
pub fn open_edges(mesh: &PolygonMesh) -> Vec<[u32; 2]> {
    let uses = edge_uses(mesh);
    let is_open = |uses: &&[EdgeUse]| uses.len() != 2 || uses[0].forward == uses[1].forward;
    by_edge(&uses).filter(is_open).map(|uses| uses[0].edge).collect()
}
