//! The backtracking line search with second-order corrections: Wächter & Biegler (2006), §2.3 and §2.4.

use super::acceptance::{Acceptance, Here, Measure};
use super::barrier;
use super::kkt::RightHandSide;
use super::parameters::PARAMETERS;
use super::state::State;
use super::vectors::moved;
use crate::model::EvaluationError;

/// What the line search came to. The trial point is at the length found.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Search {
    /// The longest step the bounds allow was accepted.
    Full(f64),
    /// A shorter one was.
    Shortened(f64),
    /// A step with second-order corrections was.
    Corrected(f64),
    /// The step is below rounding; it was taken in full.
    Tiny(f64),
    /// No length is acceptable.
    Failed,
}

/// Finds a length along the direction, at most `cap`, that is accepted.
pub(super) fn line_search(
    state: &mut State<'_>,
    acceptance: &mut Acceptance,
    here: &Here,
    cap: f64,
) -> Result<Search, EvaluationError> {
    let longest = state.longest_step().min(cap);
    if is_tiny(state) {
        state.move_trial(longest);
        return Ok(if Measure::evaluated(state)?.is_some() { Search::Tiny(longest) } else { Search::Failed });
    }
    let shortest = acceptance.shortest_step(here);
    let (mut length, mut first, mut in_domain) = (longest, true, false);
    while length > shortest || (!in_domain && length > PARAMETERS.shortest_in_domain) {
        state.move_trial(length);
        if let Some(measure) = Measure::evaluated(state)? {
            in_domain = true;
            if acceptance.takes(here, length, measure) {
                return Ok(if first { Search::Full(length) } else { Search::Shortened(length) });
            }
            if first
                && measure.violation >= here.measure.violation
                && let Some(corrected) = second_order_correction(state, acceptance, here, longest, measure)?
            {
                return Ok(Search::Corrected(corrected));
            }
        }
        first = false;
        length *= 0.5;
    }
    Ok(Search::Failed)
}

/// Whether the step is below the rounding of every variable at a (nearly) feasible point (§3.9).
fn is_tiny(state: &State<'_>) -> bool {
    let (w, step) = (&state.iterate.w, &state.direction.w);
    state.iterate.violation() < PARAMETERS.tiny_violation
        && w.iter().zip(step).all(|(w, step)| step.abs() <= PARAMETERS.tiny_step * (1.0 + w.abs()))
}

/// Steps that also cancel the residual met at the full step. On success the direction is the corrected one.
fn second_order_correction(
    state: &mut State<'_>,
    acceptance: &mut Acceptance,
    here: &Here,
    longest: f64,
    first: Measure,
) -> Result<Option<f64>, EvaluationError> {
    let residuals = state.trial.residual.iter().zip(&state.iterate.residual);
    let mut accumulated: Vec<f64> = residuals.map(|(trial, now)| trial + longest * now).collect();
    let mut before = first.violation;
    let (mut w_step, mut y_step) = (state.direction.w.clone(), state.direction.y.clone());
    for _ in 0..PARAMETERS.filter.p_max {
        let rows: Vec<f64> = accumulated.iter().map(|value| -value).collect();
        if state.kkt.solve(RightHandSide { w: &state.work.right, rows: &rows }, &mut w_step, &mut y_step).is_err() {
            return Ok(None);
        }
        let corrected = barrier::longest_step(&state.form, &state.iterate.w, &w_step, state.tau());
        moved(&state.iterate.w, corrected, &w_step, &mut state.trial.w);
        state.form.keep_inside(&mut state.trial.w);
        let Some(measure) = Measure::evaluated(state)? else { return Ok(None) };
        if acceptance.takes(here, longest, measure) {
            state.direction.w.copy_from_slice(&w_step);
            state.direction.y.copy_from_slice(&y_step);
            return Ok(Some(corrected));
        }
        if measure.violation > PARAMETERS.filter.kappa_soc * before {
            return Ok(None);
        }
        before = measure.violation;
        for (sum, residual) in accumulated.iter_mut().zip(&state.trial.residual) {
            *sum = corrected * *sum + residual;
        }
    }
    Ok(None)
}
