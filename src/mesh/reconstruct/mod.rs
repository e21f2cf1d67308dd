//! Reconstruction of a quad rib mesh (FORMULAS 3.1): fill concave notches and holes, snap to the original surface.

mod acceptance;
mod fill;
mod snap;

use serde::Serialize;

use super::closest::Surface;
use super::hausdorff::{Hausdorff, hausdorff};
use super::{Defects, PolygonMesh, QuadMesh, boundary, quality};

/// How far reconstruction may go.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// How far a new face's centre and vertex may lie off the original surface, and how near an original vertex must be to
    /// be snapped to. `None`: a tenth of the mean edge.
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
    /// The longest move.
    pub largest_move: f64,
    /// χ before and after.
    pub euler_characteristic: [i64; 2],
    /// Boundary loops still there whose outer side lies on the original surface: holes no rule could fill.
    pub unfilled_loops: usize,
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
    #[error("filling made a mesh with defects; please report this with the mesh. {0}")]
    Defects(#[from] Defects),
}

fn spelled(vertices: &[u32]) -> String {
    let words: Vec<String> = vertices.iter().take(20).map(|v| (v + 1).to_string()).collect();
    words.join(" ") + if vertices.len() > 20 { " …" } else { "" }
}

/// Most rounds of filling and snapping; each round starts only if the one before changed something.
const ROUNDS: usize = 10;

/// Fills and snaps until nothing changes, so that doing it twice equals once. The original may be any polygon mesh.
///
/// # Errors
/// An odd hole; a tolerance that is none; an original without faces.
pub fn reconstruct(mesh: QuadMesh, original: &PolygonMesh, options: Options) -> Result<(QuadMesh, Report), ReconstructError> {
    let tolerance = options.tolerance.unwrap_or_else(|| 0.1 * quality::edge_lengths(&mesh).mean);
    if tolerance.is_nan() || tolerance <= 0.0 || tolerance.is_infinite() {
        return Err(ReconstructError::Tolerance(tolerance));
    }
    if original.face_count() == 0 {
        return Err(ReconstructError::NoOriginal);
    }
    let surface = Surface::of_faces(original);
    let acceptance = acceptance::Acceptance { surface: &surface, tolerance };
    let snapper = snap::Snapper::new(original, &surface, tolerance);
    let (before, vertices_before, faces_before) = (euler(&mesh), mesh.vertex_count(), mesh.face_count());
    let (mut mesh, mut actions, mut largest_move) = (mesh, Vec::new(), 0.0f64);
    for _ in 0..ROUNDS {
        let done = actions.len();
        if options.fill {
            mesh = fill::fill(mesh, &acceptance, &mut actions)?;
        }
        if options.snap {
            largest_move = largest_move.max(snapper.snap(&mut mesh, &mut actions));
        }
        if actions[done..].iter().all(|action| matches!(action, Action::Undone { .. })) {
            break;
        }
    }
    // A move that is refused is refused again in every round; it is told once.
    let mut told = std::collections::BTreeSet::new();
    actions.retain(|action| !matches!(action, Action::Undone { vertex, .. } if !told.insert(*vertex)));
    let count = |test: fn(&Action) -> bool| actions.iter().filter(|action| test(action)).count();
    let report = Report {
        tolerance,
        faces_added: mesh.face_count() - faces_before,
        vertices_added: mesh.vertex_count() - vertices_before,
        snapped_to_vertices: count(|action| matches!(action, Action::SnappedToVertex { .. })),
        snapped_to_surface: count(|action| matches!(action, Action::SnappedToSurface { .. })),
        undone: count(|action| matches!(action, Action::Undone { .. })),
        largest_move,
        euler_characteristic: [before, euler(&mesh)],
        unfilled_loops: boundary::loops(&mesh).iter().filter(|ring| acceptance.covers(&mesh, ring)).count(),
        hausdorff: hausdorff(&mesh.to_polygons(), original),
        actions,
    };
    Ok((mesh, report))
}

fn euler(mesh: &QuadMesh) -> i64 {
    let used = (0..mesh.vertex_count() as u32).filter(|&v| mesh.spokes(v).next().is_some()).count();
    used as i64 - mesh.edge_count() as i64 + mesh.face_count() as i64
}

#[cfg(test)]
mod tests;
