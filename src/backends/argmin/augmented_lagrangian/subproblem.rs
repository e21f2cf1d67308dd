//! Minimises a bounds-only model: argmin's trust region (Steihaug's conjugate gradients, exact Hessian) on one face of
//! the box after another.

use argmin::core::{Error, Executor, IterState, KV, Problem, Solver, State, TerminationReason, TerminationStatus};
use argmin::solver::trustregion::TrustRegion;

use super::face::{Face, FaceHessian, stationarity};
use super::steihaug::Steihaug;
use crate::model::{EvaluationError, Model};

/// Faces visited at the most.
const FACES: u32 = 60;
/// Iterations on one face at the most.
const ITERATIONS: u64 = 100;
/// Growth of the point at which the model falls without end.
const ESCAPE: f64 = 1e6;
/// Rejected steps in a row after which rounding has ended the progress: each divides the radius by four.
const REJECTIONS: u32 = 25;

/// argmin's state on a face.
pub(super) type FaceState = IterState<Vec<f64>, Vec<f64>, (), FaceHessian, (), f64>;
type Inner = TrustRegion<Steihaug, f64>;

/// Where a minimisation ended.
pub(super) struct Minimum {
    /// The point, inside the box.
    pub x: Vec<f64>,
    /// ‖projected gradient‖∞ there.
    pub stationarity: f64,
    /// The model falls without end: the point ran away.
    pub escaped: bool,
}

/// Minimises `model` from `x` until the projected gradient is below `tolerance` or rounding ends the progress.
///
/// # Errors
/// Stops of the budget, and values that are no number at points that were accepted.
pub(super) fn minimise(model: &dyn Model, x: &[f64], tolerance: f64) -> Result<Minimum, EvaluationError> {
    let mut gradient = vec![0.0; x.len()];
    let mut value = model.gradient(x, &mut gradient)?;
    let mut minimum = Minimum { stationarity: stationarity(model, x, &gradient), x: x.to_vec(), escaped: false };
    let (mut idle, far) = (0, ESCAPE * length(x));
    for _ in 0..FACES {
        if minimum.stationarity <= tolerance || minimum.escaped || idle > 2 {
            break;
        }
        let face = Face::through(model, &minimum.x, &gradient);
        let next = face.complete(&explore(&face, tolerance)?);
        let next_value = model.gradient(&next, &mut gradient)?;
        idle = if next == minimum.x {
            FACES
        } else if next_value < value {
            0
        } else {
            idle + 1
        };
        value = next_value;
        minimum = Minimum { stationarity: stationarity(model, &next, &gradient), escaped: length(&next) > far, x: next };
    }
    Ok(minimum)
}

/// argmin's trust region on one face; returns the free variables where it ended.
fn explore(face: &Face<'_>, tolerance: f64) -> Result<Vec<f64>, EvaluationError> {
    let origin = face.origin();
    let length = length(&origin);
    let inner = TrustRegion::new(Steihaug::new())
        .with_radius(0.5 * length)
        .and_then(|region| region.with_max_radius(1e3 * length))
        .and_then(|region| region.with_eta(1e-4));
    let solver = Guarded { inner: inner.map_err(foreign)?, face: face.clone(), tolerance, far: ESCAPE * length, rejections: 0 };
    let executor = Executor::new(face.clone(), solver).ctrlc(false).timer(false);
    let run = executor.configure(|state| state.param(origin.clone()).max_iters(ITERATIONS)).run();
    let result = run.map_err(foreign)?;
    Ok(result.state.get_param().cloned().unwrap_or(origin))
}

/// ‖x‖₂, or 1 where that is less.
fn length(x: &[f64]) -> f64 {
    x.iter().map(|value| value * value).sum::<f64>().sqrt().max(1.0)
}

/// An evaluation error that went through argmin, or argmin's own words.
fn foreign(error: Error) -> EvaluationError {
    error
        .downcast::<EvaluationError>()
        .unwrap_or_else(|error| EvaluationError::Invalid { term: "argmin".into(), cause: error.to_string() })
}

/// argmin's trust region, which has no end of its own, with one: stationary, out of the box, or no progress.
struct Guarded<'a> {
    inner: Inner,
    face: Face<'a>,
    tolerance: f64,
    far: f64,
    rejections: u32,
}

impl<'a> Solver<Face<'a>, FaceState> for Guarded<'a> {
    fn name(&self) -> &str {
        "trust region on a face"
    }

    fn init(&mut self, problem: &mut Problem<Face<'a>>, state: FaceState) -> Result<(FaceState, Option<KV>), Error> {
        self.inner.init(problem, state)
    }

    fn next_iter(&mut self, problem: &mut Problem<Face<'a>>, state: FaceState) -> Result<(FaceState, Option<KV>), Error> {
        let before = state.get_cost();
        let (state, kv) = self.inner.next_iter(problem, state)?;
        // A step that is taken lowers φ.
        self.rejections = if state.get_cost() < before { 0 } else { self.rejections + 1 };
        Ok((state, kv))
    }

    fn terminate(&mut self, state: &FaceState) -> TerminationStatus {
        let gradient =
            state.get_gradient().map_or(0.0, |gradient| gradient.iter().fold(0.0_f64, |largest, g| largest.max(g.abs())));
        let is_left = state.get_param().is_some_and(|w| self.face.is_left(w) || length(w) > self.far);
        if gradient <= self.tolerance || is_left || self.rejections > REJECTIONS {
            return TerminationStatus::Terminated(TerminationReason::SolverConverged);
        }
        TerminationStatus::NotTerminated
    }
}
