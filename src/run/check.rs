//! `check`: class, sizes and derivatives of a problem; solves nothing.

use super::Subject;
use crate::math::within;
use crate::model::EvaluationError;
use crate::model::derivative_check::{DerivativeCheck, derivative_check};

/// Compares all exact derivatives with an independent method, a little off the start: there, terms that vanish at a round
/// number or meet at a kink do not hide anything. Large structures are looked at with their states beside the design.
///
/// # Errors
/// Where the model has no value near the start.
pub fn check(subject: &Subject) -> Result<DerivativeCheck, EvaluationError> {
    let model = subject.shown_with_states();
    let meta = model.meta();
    let nudged = |j: usize| {
        let (lower, upper, start) = (meta.lower[j], meta.upper[j], meta.start[j]);
        // Irrational and unequal from variable to variable.
        let share = 0.01 + 0.02 * (j as f64 * 0.618_033_988_749_895).fract();
        let room = if lower.is_finite() && upper.is_finite() { upper - lower } else { start.abs().max(1.0) };
        let towards = if upper - start >= start - lower { start + share * room } else { start - share * room };
        within(towards, lower, upper)
    };
    let mut x: Vec<f64> = (0..meta.variables()).map(nudged).collect();
    if meta.states.is_some() {
        model.complete(&mut x);
    }
    derivative_check(model, &x).or_else(|_| derivative_check(model, &meta.start))
}
