//! The feasibility restoration: Wächter & Biegler (2006), §3.3. The violation is minimised (by the same iterations, on the
//! elastic problem) until the filter accepts a point again, or a local minimum of the violation shows that there is none nearby.

use super::elastic::LeastViolation;
use super::ending::Ending;
use super::parameters::PARAMETERS;
use super::slack_form::Source;
use super::start;
use super::state::State;
use super::vectors::norm_max;
use crate::model::EvaluationError;

/// What a restoration began from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Origin {
    /// θ there.
    pub violation: f64,
    /// ζ, the weight of the distance from there.
    pub zeta: f64,
}

impl Origin {
    /// A first restoration from the iterate.
    pub fn of(state: &State<'_>) -> Self {
        Origin { violation: state.iterate.violation(), zeta: PARAMETERS.restoration.proximity * state.mu.sqrt() }
    }

    /// A last one, the distance no longer counting but for a trace.
    pub fn last_word(state: &State<'_>) -> Self {
        Origin { violation: state.iterate.violation(), zeta: PARAMETERS.restoration.last_proximity }
    }

    fn is_last_word(&self) -> bool {
        self.zeta <= PARAMETERS.restoration.last_proximity
    }
}

/// Whether the iterate's violation is more than rounding.
pub(super) fn is_called_for(state: &State<'_>) -> bool {
    norm_max(&state.iterate.residual) > PARAMETERS.restoration.smallest_violation
}

/// The elastic problem at the iterate with its first barrier parameter; `None` where the run is a restoration itself.
pub(super) fn elastic<'a>(state: &mut State<'a>, zeta: f64) -> Result<Option<(LeastViolation<'a>, f64)>, EvaluationError> {
    let Source::Given(model) = state.form.model else { return Ok(None) };
    let x = state.form.x(&state.iterate.w).to_vec();
    let rows: Vec<(usize, f64)> = state.form.rows.iter().copied().zip(state.form.row_scale.iter().copied()).collect();
    let mu = state.mu.max(norm_max(&state.iterate.residual).min(PARAMETERS.restoration.largest_mu));
    Ok(Some((LeastViolation::new(model, &x, rows, zeta, mu)?, mu)))
}

/// Puts the trial point at the restoration's x, slacks at the rows' values. `false`: outside the domain.
pub(super) fn adopt(state: &mut State<'_>, restored: &mut State<'_>) -> Result<bool, EvaluationError> {
    let x = restored.form.x(&restored.iterate.w);
    for (at, &j) in state.form.free.iter().enumerate() {
        state.trial.w[at] = x[j] / state.form.variable_scale[at];
    }
    let push = state.mu.clamp(PARAMETERS.kappa_1_warm * 1e-4, PARAMETERS.kappa_1);
    state.form.keep_inside(&mut state.trial.w);
    let inside = state.evaluate_trial()?;
    if inside {
        start::place_slacks(&state.form, &mut state.trial, push);
    }
    Ok(inside)
}

/// What is to be done after an iteration of the restoration.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Next {
    /// Go on with the original problem from the trial point; `open`: with an empty filter.
    Resume { open: bool },
    /// Another iteration.
    Iterate,
    /// The violation is at a local minimum: once more without a pull towards the origin.
    LastWord,
    /// The violation is at a local minimum, and that was the last word.
    Infeasible,
    /// Neither minimised nor made acceptable.
    Failed,
}

/// How the trial point (a restoration's, evaluated in the original problem) looks from there.
#[derive(Debug, Clone, Copy)]
pub(super) struct Restored {
    /// Whether it is in the domain.
    pub inside: bool,
    /// θ
    pub violation: f64,
    /// The largest violation of a row, relative to its limit where that is large.
    pub largest: f64,
    /// Whether the filter lets it in.
    pub admitted: bool,
}

/// Decides after an iteration that came to `ending`.
pub(super) fn next(origin: Origin, ending: Option<&Ending>, trial: Restored) -> Next {
    let enough = PARAMETERS.restoration.kappa_resto * origin.violation;
    match ending {
        _ if trial.inside && trial.violation <= enough && trial.admitted => Next::Resume { open: false },
        None => Next::Iterate,
        Some(Ending::Optimal | Ending::Acceptable) if trial.inside => match trial.largest {
            largest if largest <= PARAMETERS.restoration.smallest_violation => Next::Resume { open: true },
            _ if origin.is_last_word() => Next::Infeasible,
            _ => Next::LastWord,
        },
        Some(_) if trial.inside && trial.violation < enough => Next::Resume { open: true },
        Some(_) => Next::Failed,
    }
}

/// Fresh multipliers at the iterate.
pub(super) fn refresh_multipliers(state: &mut State<'_>) {
    let largest = PARAMETERS.restoration.largest_multiplier;
    start::central_bound_multipliers(&state.form, &mut state.iterate, state.mu, largest);
    start::least_squares_multipliers(&state.form, &mut state.kkt, &mut state.iterate);
    state.assess();
}

#[cfg(test)]
mod tests {
    use super::*;

    const ORIGIN: Origin = Origin { violation: 1.0, zeta: 1e-3 };
    const BETTER: Restored = Restored { inside: true, violation: 0.5, largest: 0.5, admitted: true };

    #[test]
    fn the_iterations_go_on_where_the_filter_accepts_a_point_that_is_less_infeasible() {
        assert_eq!(next(ORIGIN, None, BETTER), Next::Resume { open: false });
        assert_eq!(next(ORIGIN, None, Restored { admitted: false, ..BETTER }), Next::Iterate);
        assert_eq!(next(ORIGIN, None, Restored { violation: 0.95, ..BETTER }), Next::Iterate);
        assert_eq!(next(ORIGIN, None, Restored { inside: false, ..BETTER }), Next::Iterate);
    }

    #[test]
    fn a_local_minimum_of_the_violation_is_infeasible_only_when_the_origin_no_longer_pulls() {
        let stuck = Restored { admitted: false, violation: 1.0, ..BETTER };
        assert_eq!(next(ORIGIN, Some(&Ending::Optimal), stuck), Next::LastWord);
        let last = Origin { zeta: PARAMETERS.restoration.last_proximity, ..ORIGIN };
        assert_eq!(next(last, Some(&Ending::Optimal), stuck), Next::Infeasible);
        let feasible = Restored { largest: 0.0, ..stuck };
        assert_eq!(next(last, Some(&Ending::Optimal), feasible), Next::Resume { open: true });
    }

    #[test]
    fn a_restoration_that_gets_stuck_is_worth_something_only_if_it_lowered_the_violation() {
        let stuck = Ending::Stuck(String::new());
        let rejected = Restored { admitted: false, ..BETTER };
        assert_eq!(next(ORIGIN, Some(&stuck), rejected), Next::Resume { open: true });
        assert_eq!(next(ORIGIN, Some(&stuck), Restored { violation: 2.0, ..rejected }), Next::Failed);
        assert_eq!(next(ORIGIN, Some(&stuck), Restored { inside: false, ..rejected }), Next::Failed);
    }
}
