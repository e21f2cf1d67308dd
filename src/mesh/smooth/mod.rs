//! Smoothing (note 3.3).
//!
//! The note's step (3.3.1) moves every vertex to the mean of its neighbours, all at once. On a quad grid the checkerboard
//! mode is an eigenvector of that step with eigenvalue −1: it never dies out. With a relaxation λ < 1 the eigenvalue is
//! 1 − 2λ, and Gauss–Seidel order breaks the symmetry too. All of these shrink the surface; Taubin's pair of steps λ|μ
//! (Taubin 1995, "A signal processing approach to fair surface design") mostly does not.

mod constraints;

use serde::Serialize;

use super::closest::Surface;
use super::features::FeatureOptions;
use super::{PolygonMesh, QuadMesh, Vector, quality};
use constraints::Constraints;

/// How vertices are moved.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Method {
    /// All at once, from the old positions.
    Laplacian,
    /// One after the other, from the newest positions.
    GaussSeidel,
    /// A smoothing step λ (the relaxation), then a growing step μ < −λ.
    Taubin {
        /// The growing step, negative.
        mu: f64,
    },
}

impl Method {
    /// Taubin's, with the growing step that goes with this relaxation where none is given.
    pub fn taubin(relaxation: f64, mu: Option<f64>) -> Method {
        Method::Taubin { mu: mu.unwrap_or(-1.06 * relaxation) }
    }
}

/// What becomes of vertices on boundaries and creases. Corners never move.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Curves {
    /// They stay.
    Keep,
    /// They move along their curve.
    Slide,
}

/// Options of [`smooth`].
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Options {
    /// The method.
    pub method: Method,
    /// λ in (0, 1]; 1 is the note's step.
    pub relaxation: f64,
    /// Number of iterations; one of Taubin's is a pair of steps.
    pub iterations: usize,
    /// Boundaries and creases.
    pub curves: Curves,
    /// What counts as a crease and a corner.
    pub features: FeatureOptions,
}

impl Default for Options {
    fn default() -> Self {
        Options {
            method: Method::Laplacian,
            relaxation: 0.5,
            iterations: 10,
            curves: Curves::Keep,
            features: FeatureOptions::default(),
        }
    }
}

/// What smoothing did.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Report {
    /// Vertices free to move, sliding along curves, fixed.
    pub free: usize,
    /// See `free`.
    pub sliding: usize,
    /// See `free`.
    pub fixed: usize,
    /// The longest way of a vertex.
    pub largest_move: f64,
    /// Area before and after: the shrinkage.
    pub area: [f64; 2],
    /// Volume before and after, for closed meshes.
    pub volume: Option<[f64; 2]>,
    /// Root mean square of the distances to the neighbours' mean, before and after, over vertices that may move.
    pub roughness: [f64; 2],
    /// Faces whose normal turned by more than a right angle, from 1.
    pub flipped: Vec<u32>,
}

/// Why options cannot be used.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
#[allow(missing_docs)]
pub enum SmoothError {
    #[error("the relaxation must lie in (0, 1], not {0}")]
    Relaxation(f64),
    #[error("Taubin's μ must be below −λ = {below}, not {mu}; 0.5 goes with −0.53")]
    Mu { mu: f64, below: f64 },
    #[error("vertex {0} was moved out of the numbers; use less relaxation")]
    Diverged(u32),
}

/// Smooths in place; with `project` every iteration ends on that surface.
///
/// # Errors
/// A relaxation outside (0, 1], a μ that does not outweigh λ; positions that are no numbers (the mesh is left as it was).
///
/// ```
/// use ribopt::mesh::{QuadMesh, generate, smooth};
/// let mut mesh = QuadMesh::new(generate::shell(4, 6))?;
/// let report = smooth::smooth(&mut mesh, smooth::Options::default(), None)?;
/// assert!(report.roughness[1] < report.roughness[0] && report.flipped.is_empty());
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn smooth(mesh: &mut QuadMesh, options: Options, project: Option<&Surface>) -> Result<Report, SmoothError> {
    check(&options)?;
    let before = mesh.to_polygons();
    let constraints = Constraints::new(&before, mesh, &options);
    let mut roughness = [constraints.roughness(&mesh.positions), 0.0];
    for _ in 0..options.iterations {
        iterate(mesh, &options, &constraints);
        if let Some(surface) = project {
            constraints.project(&mut mesh.positions, surface);
        }
        if let Some(v) = mesh.positions.iter().position(|p| !p.iter().all(|c| c.is_finite())) {
            mesh.positions = before.vertices;
            return Err(SmoothError::Diverged(v as u32 + 1));
        }
    }
    roughness[1] = constraints.roughness(&mesh.positions);
    Ok(report(mesh, &before, &constraints, roughness))
}

fn check(options: &Options) -> Result<(), SmoothError> {
    let relaxation = options.relaxation;
    if !(relaxation > 0.0 && relaxation <= 1.0) {
        return Err(SmoothError::Relaxation(relaxation));
    }
    match options.method {
        Method::Taubin { mu } if mu.is_nan() || mu >= -relaxation => Err(SmoothError::Mu { mu, below: -relaxation }),
        _ => Ok(()),
    }
}

fn iterate(mesh: &mut QuadMesh, options: &Options, constraints: &Constraints) {
    let positions = &mut mesh.positions;
    match options.method {
        Method::Laplacian => step(positions, constraints, options.relaxation),
        Method::Taubin { mu } => {
            step(positions, constraints, options.relaxation);
            step(positions, constraints, mu);
        }
        Method::GaussSeidel => {
            for v in 0..positions.len() {
                if let Some(moved) = constraints.moved(positions, v, options.relaxation) {
                    positions[v] = moved;
                }
            }
        }
    }
}

fn step(positions: &mut Vec<Vector>, constraints: &Constraints, factor: f64) {
    let moved = |v: usize| constraints.moved(positions, v, factor).unwrap_or(positions[v]);
    *positions = (0..positions.len()).map(moved).collect();
}

fn report(mesh: &QuadMesh, before: &PolygonMesh, constraints: &Constraints, roughness: [f64; 2]) -> Report {
    let after = mesh.to_polygons();
    let area = |mesh: &PolygonMesh| (0..mesh.face_count()).map(|f| mesh.vector_area(f).norm()).sum();
    let turned = |&f: &u32| before.vector_area(f as usize).dot(&after.vector_area(f as usize)) <= 0.0;
    let is_closed = (0..4 * mesh.face_count() as u32).all(|h| mesh.twin(h).is_some());
    let moves = before.vertices.iter().zip(&mesh.positions).map(|(a, b)| (a - b).norm());
    let [free, sliding, fixed] = constraints.counts();
    Report {
        free,
        sliding,
        fixed,
        largest_move: moves.fold(0.0, f64::max),
        area: [area(before), quality::area(mesh)],
        volume: is_closed.then(|| [before.volume(), after.volume()]),
        roughness,
        flipped: (0..mesh.face_count() as u32).filter(turned).map(|f| f + 1).collect(),
    }
}

#[cfg(test)]
mod tests;
