//! Reconstruction of a quad rib mesh (note 3.1): fill concave notches and holes, snap to the original surface.
//!
//! What holds, whatever the mesh: no vertex ends farther from where it began than the tolerance, and one that lies on an
//! original vertex stays; no face is attached where the original ends; nothing comes out that `QuadMesh` would not take; a
//! second run changes nothing. docs/meshes.md says why.

mod acceptance;
mod fill;
mod original;
mod snap;

use serde::Serialize;

use super::edge_list::{by_edge, edge_uses};
use super::hausdorff::{Hausdorff, hausdorff};
use super::{PolygonMesh, QuadMesh, Vector, boundary, quality};
use original::Original;

/// How far reconstruction may go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// How far a new face may lie off the original surface, and how far a vertex may be moved. `None`: a tenth of the mean
    /// edge of the original, or of the mesh where the original's is less than half or more than twice as long. The original's
    /// does not change, so that a second run has the same.
    pub tolerance: Option<f64>,
    /// Fill notches and holes.
    pub fill: bool,
    /// Snap to the original.
    pub snap: bool,
}

impl Default for Options {
    fn default() -> Self {
        Options { tolerance: None, fill: true, snap: true }
    }
}

/// One thing that was done. Vertices and faces are counted from 1, vertices of the original too.
#[derive(Debug, Clone, PartialEq, Serialize)]
#[serde(tag = "did", rename_all = "kebab-case")]
#[allow(missing_docs)]
pub enum Action {
    /// A face was added by a rule.
    Filled { rule: Rule, face: u32, vertices: [u32; 4] },
    /// A vertex was moved onto an original vertex.
    SnappedToVertex { vertex: u32, original: u32, distance: f64 },
    /// A vertex was moved to the nearest point of the original surface or its boundary.
    SnappedToSurface { vertex: u32, distance: f64 },
    /// A move was taken back because it would have turned these faces over or made them vanish.
    Undone { vertex: u32, faces: Vec<u32> },
}

/// The rules, in their order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "kebab-case")]
pub enum Rule {
    /// A loop of four became a quad.
    LoopOfFour,
    /// Two consecutive concave vertices and their neighbours.
    TwoConcave,
    /// One concave vertex v with neighbours a, c, and the new vertex a + c − v.
    OneConcave,
}

/// What reconstruction did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// The tolerance used.
    pub tolerance: f64,
    /// Faces added.
    pub faces_added: usize,
    /// Vertices added.
    pub vertices_added: usize,
    /// Vertices moved onto original vertices.
    pub snapped_to_vertices: usize,
    /// Vertices moved to points of the original surface.
    pub snapped_to_surface: usize,
    /// Moves taken back.
    pub undone: usize,
    /// The longest way of a vertex from where it began.
    pub largest_move: f64,
    /// χ before and after.
    pub euler_characteristic: [i64; 2],
    /// Boundary loops still there beyond all whose edges the original goes on: holes no rule could fill.
    pub unfilled_loops: usize,
    /// Runs of boundary edges beyond which the original goes on, as vertices from 1: those holes and notches. Empty: the mesh
    /// ends where the original does.
    pub open: Vec<Vec<u32>>,
    /// Distance to the original.
    pub hausdorff: Hausdorff,
    /// Everything that was done, in order.
    pub actions: Vec<Action>,
}

/// Why nothing was reconstructed.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum ReconstructError {
    #[error("the tolerance must be a positive number, not {0}")]
    Tolerance(f64),
    #[error("the original surface has no faces")]
    NoOriginal,
    #[error(
        "the hole with boundary loop {} has {} edges, and an odd loop cannot be filled with quads; split one of its edges",
        spelled(.0), .0.len()
    )]
    OddLoop(Vec<u32>),
}

fn spelled(vertices: &[u32]) -> String {
    let words: Vec<String> = vertices.iter().take(20).map(|v| (v + 1).to_string()).collect();
    words.join(" ") + if vertices.len() > 20 { " …" } else { "" }
}

/// Most rounds of filling and snapping; each starts only if the one before changed something. Two do in all tests: a vertex
/// moves once, unless filling makes an inner one of it.
const ROUNDS: usize = 50;

/// Fills and snaps until nothing changes, so that doing it twice equals once. The original may be any polygon mesh.
///
/// # Errors
/// An odd hole; a tolerance that is none; an original without faces.
pub fn reconstruct(mesh: QuadMesh, original: &PolygonMesh, options: Options) -> Result<(QuadMesh, Report), ReconstructError> {
    let tolerance = options.tolerance.unwrap_or_else(|| default_tolerance(&mesh, original));
    if tolerance.is_nan() || tolerance <= 0.0 || tolerance.is_infinite() {
        return Err(ReconstructError::Tolerance(tolerance));
    }
    if original.face_count() == 0 {
        return Err(ReconstructError::NoOriginal);
    }
    let surface = Original::new(original, tolerance);
    let (snapper, vertices) = (snap::Snapper::new(original, &surface), fill::corners(original));
    let (before, vertices_before, faces_before) = (euler(&mesh), mesh.vertex_count(), mesh.face_count());
    let (mut mesh, mut actions, mut began) = (mesh.clone(), Vec::new(), mesh.positions);
    for _ in 0..ROUNDS {
        let mut changed = false;
        if options.fill
            && let Some(filled) = fill::fill(&mesh, &surface, &vertices, &mut actions)?
        {
            began.extend_from_slice(&filled.positions[began.len()..]);
            (mesh, changed) = (filled, true);
        }
        if options.snap {
            changed |= snapper.snap(&mut mesh, &began, &mut actions);
        }
        if !changed {
            break;
        }
    }
    // A move that is refused is refused again in every round; it is told once.
    let mut told = std::collections::BTreeSet::new();
    actions.retain(|action| !matches!(action, Action::Undone { vertex, .. } if !told.insert(*vertex)));
    let count = |test: fn(&Action) -> bool| actions.iter().filter(|action| test(action)).count();
    let (unfilled_loops, open) = open_edges(&mesh, &surface);
    let report = Report {
        tolerance,
        faces_added: mesh.face_count() - faces_before,
        vertices_added: mesh.vertex_count() - vertices_before,
        snapped_to_vertices: count(|action| matches!(action, Action::SnappedToVertex { .. })),
        snapped_to_surface: count(|action| matches!(action, Action::SnappedToSurface { .. })),
        undone: count(|action| matches!(action, Action::Undone { .. })),
        largest_move: largest_move(&began, &mesh.positions),
        euler_characteristic: [before, euler(&mesh)],
        unfilled_loops,
        open,
        hausdorff: hausdorff(&mesh.to_polygons(), original),
        actions,
    };
    Ok((mesh, report))
}

fn default_tolerance(mesh: &QuadMesh, original: &PolygonMesh) -> f64 {
    let uses = edge_uses(original);
    let length = |[a, b]: [u32; 2]| (original.vertices[b as usize] - original.vertices[a as usize]).norm();
    let theirs = quality::Range::of(by_edge(&uses).map(|uses| length(uses[0].edge))).mean;
    let own = quality::edge_lengths(mesh).mean;
    0.1 * if (0.5 * own..=2.0 * own).contains(&theirs) { theirs } else { own }
}

fn largest_move(began: &[Vector], ended: &[Vector]) -> f64 {
    began.iter().zip(ended).map(|(a, b)| (a - b).norm()).fold(0.0, f64::max)
}

/// How many whole loops are open, and all runs of open edges as vertices from 1; a whole loop ends with its first.
fn open_edges(mesh: &QuadMesh, original: &Original) -> (usize, Vec<Vec<u32>>) {
    let (mut holes, mut runs) = (0, Vec::new());
    for ring in boundary::loops(mesh) {
        let open: Vec<bool> = ring.iter().map(|&v| mesh.spokes(v).next().is_some_and(|h| original.is_open(mesh, h))).collect();
        let Some(closed) = open.iter().position(|open| !open) else {
            holes += 1;
            runs.push(ring.iter().chain(ring.first()).map(|v| v + 1).collect());
            continue;
        };
        // From an edge that is not open, once around.
        let mut run: Vec<u32> = Vec::new();
        for k in (closed..closed + ring.len()).map(|k| k % ring.len()) {
            match (open[k], run.is_empty()) {
                (true, true) => run = vec![ring[k] + 1, ring[(k + 1) % ring.len()] + 1],
                (true, false) => run.push(ring[(k + 1) % ring.len()] + 1),
                (false, false) => runs.push(std::mem::take(&mut run)),
                (false, true) => {}
            }
        }
        if !run.is_empty() {
            runs.push(run);
        }
    }
    (holes, runs)
}

fn euler(mesh: &QuadMesh) -> i64 {
    let used = (0..mesh.vertex_count() as u32).filter(|&v| mesh.spokes(v).next().is_some()).count();
    used as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

#[cfg(test)]
mod tests;
