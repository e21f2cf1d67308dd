//! Boundary loops.

use super::QuadMesh;
use super::half_edge::previous;

/// Every boundary loop as its vertices, the mesh on the left; each begins at its smallest half-edge.
///
/// ```
/// use ribopt::mesh::{QuadMesh, boundary, generate};
/// let mesh = QuadMesh::new(generate::grid(4, 3, 1.0))?;
/// assert_eq!(boundary::loops(&mesh).iter().map(Vec::len).collect::<Vec<_>>(), [14]);
/// # Ok::<(), ribopt::mesh::Defects>(())
/// ```
pub fn loops(mesh: &QuadMesh) -> Vec<Vec<u32>> {
    let mut seen = vec![false; 4 * mesh.face_count()];
    let mut loops = Vec::new();
    for start in 0..seen.len() as u32 {
        if seen[start as usize] || mesh.twin(start).is_some() {
            continue;
        }
        let mut vertices = Vec::new();
        let mut at = start;
        while !seen[at as usize] {
            seen[at as usize] = true;
            vertices.push(mesh.origin(at));
            at = next_on_boundary(mesh, at);
        }
        loops.push(vertices);
    }
    loops
}

/// The boundary half-edge that goes on where `h` ends: the first spoke of that vertex.
fn next_on_boundary(mesh: &QuadMesh, h: u32) -> u32 {
    let mut spoke = super::half_edge::next(h);
    // Turn clockwise until there is no face; a fan is finite and this one has an end, h itself being the other.
    while let Some(twin) = mesh.twin(spoke) {
        spoke = super::half_edge::next(twin);
    }
    spoke
}

/// The boundary neighbours of boundary vertex `v`: before and after it, the mesh on the left.
pub fn neighbours(mesh: &QuadMesh, v: u32) -> Option<[u32; 2]> {
    if !mesh.is_boundary(v) {
        return None;
    }
    let after = mesh.spokes(v).next()?;
    let before = mesh.spokes(v).last().map(previous)?;
    Some([mesh.origin(before), mesh.target(after)])
}
