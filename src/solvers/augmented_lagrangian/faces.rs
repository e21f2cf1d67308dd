//! Minimises a bounds-only model: a trust region (Steihaug's conjugate gradients, exact Hessian) on one face of the box after
//! another.

use super::face::{Face, stationarity};
use super::trust_region::TrustRegion;
use crate::model::{EvaluationError, Model};

/// Faces visited at the most.
const FACES: u32 = 60;
/// Iterations on one face at the most.
const ITERATIONS: u32 = 100;
/// Growth of the point at which the model falls without end.
const ESCAPE: f64 = 1e6;
/// Rejected steps in a row after which rounding has ended the progress: each divides the radius by four.
const REJECTIONS: u32 = 25;

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

/// The trust region on one face, until φ is stationary, the box is left, or rounding ends the progress; returns the free
/// variables where it ended.
fn explore(face: &Face<'_>, tolerance: f64) -> Result<Vec<f64>, EvaluationError> {
    let origin = face.origin();
    let size = length(&origin);
    let mut region = TrustRegion::new(face, origin, 0.5 * size, 1e3 * size)?;
    let mut rejections = 0;
    for _ in 0..ITERATIONS {
        let slope = region.gradient.iter().fold(0.0_f64, |largest, g| largest.max(g.abs()));
        let is_left = face.is_left(&region.w) || length(&region.w) > ESCAPE * size;
        if slope <= tolerance || is_left || rejections > REJECTIONS {
            break;
        }
        // A step that is taken lowers φ.
        rejections = if region.advance()? { 0 } else { rejections + 1 };
    }
    Ok(region.w)
}

/// ‖x‖₂, or 1 where that is less.
fn length(x: &[f64]) -> f64 {
    x.iter().map(|value| value * value).sum::<f64>().sqrt().max(1.0)
}
