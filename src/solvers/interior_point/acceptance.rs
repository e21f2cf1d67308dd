//! Which trial points are taken: the filter, the switching condition and Armijo's, Wächter & Biegler (2006), §2.3.

use super::barrier;
use super::filter::{Filter, at_most};
use super::parameters::PARAMETERS;
use super::state::State;
use super::vectors::norm_sum;
use crate::math::dot;
use crate::model::EvaluationError;

/// θ and φ of a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    pub violation: f64,
    pub objective: f64,
}

impl Measure {
    /// At w for the objective and the rows' residuals given.
    fn at(state: &State<'_>, w: &[f64], objective: f64, residual: &[f64]) -> Self {
        let barrier = barrier::value(&state.form, w, state.mu);
        Measure { violation: norm_sum(residual), objective: objective + barrier }
    }

    /// Of the current iterate.
    pub fn of_iterate(state: &State<'_>) -> Self {
        Measure::at(state, &state.iterate.w, state.iterate.objective, &state.iterate.residual)
    }

    /// Of the trial point, evaluated already.
    pub fn of_trial(state: &State<'_>) -> Self {
        Measure::at(state, &state.trial.w, state.trial.objective, &state.trial.residual)
    }

    /// Evaluates objective and rows at `trial.w`; `None` outside the domain.
    pub fn evaluated(state: &mut State<'_>) -> Result<Option<Self>, EvaluationError> {
        let State { form, trial, .. } = state;
        match form.values(&trial.w, &mut trial.rows) {
            Ok(objective) => {
                trial.objective = objective;
                form.residual(&trial.w, &trial.rows, &mut trial.residual);
                let measure = Measure::of_trial(state);
                Ok(measure.objective.is_finite().then_some(measure))
            }
            Err(EvaluationError::Invalid { .. }) => Ok(None),
            Err(stopped) => Err(stopped),
        }
    }
}

/// A point that steps are taken from.
#[derive(Debug, Clone, Copy)]
pub(super) struct Here {
    pub measure: Measure,
    /// ∇φᵀ·step
    slope: f64,
}

impl Here {
    /// The current iterate with the current direction.
    pub fn of(state: &State<'_>) -> Self {
        Here { measure: Measure::of_iterate(state), slope: dot(&state.work.barrier_gradient, &state.direction.w) }
    }
}

/// How a trial point is accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Verdict {
    Rejected,
    /// By a sufficient decrease of φ where the switching condition holds: the filter stays.
    Objective,
    /// By a decrease of either measure: the current point enters the filter.
    Either,
}

/// The filter with the violations its rules depend on.
pub(super) struct Acceptance {
    filter: Filter,
    /// θ_min: only below it a decrease of φ alone is asked for.
    theta_min: f64,
    /// θ_max: no point beyond is accepted.
    theta_max: f64,
}

impl Acceptance {
    /// For a run that begins with the violation θ₀.
    pub fn new(theta_0: f64) -> Self {
        let theta = theta_0.max(1.0);
        let mut acceptance = Acceptance {
            filter: Filter::default(),
            theta_min: PARAMETERS.filter.theta_min * theta,
            theta_max: PARAMETERS.filter.theta_max * theta,
        };
        acceptance.forget();
        acceptance
    }

    /// Empties the filter.
    pub fn forget(&mut self) {
        self.filter.reset(self.theta_max);
    }

    /// Whether the filter lets a point with this measure in.
    pub fn admits(&self, measure: Measure) -> bool {
        self.filter.accepts(measure.violation, measure.objective)
    }

    /// Rejects from now on what does not improve on this point.
    pub fn enter(&mut self, measure: Measure) {
        self.filter.add(measure.violation, measure.objective);
    }

    /// Whether a step of this length from `here` to a trial point is taken. The filter grows where the rules ask for it.
    pub fn takes(&mut self, here: &Here, length: f64, trial: Measure) -> bool {
        let verdict = self.judge(here, length, trial);
        if verdict == Verdict::Either {
            self.enter(here.measure);
        }
        verdict != Verdict::Rejected
    }

    fn judge(&self, here: &Here, length: f64, trial: Measure) -> Verdict {
        if !self.admits(trial) {
            return Verdict::Rejected;
        }
        let p = &PARAMETERS.filter;
        let Measure { violation, objective } = here.measure;
        let switching = here.slope < 0.0
            && violation <= self.theta_min
            && length * (-here.slope).powf(p.s_phi) > p.delta * violation.powf(p.s_theta);
        if switching {
            let armijo = objective + p.eta_phi * length * here.slope;
            return if at_most(trial.objective, armijo) { Verdict::Objective } else { Verdict::Rejected };
        }
        let less_violation = at_most(trial.violation, (1.0 - p.gamma_theta) * violation);
        let less_objective = at_most(trial.objective, objective - p.gamma_phi * violation);
        if less_violation || less_objective { Verdict::Either } else { Verdict::Rejected }
    }

    /// α_min, equation (23).
    pub fn shortest_step(&self, here: &Here) -> f64 {
        let p = &PARAMETERS.filter;
        let violation = here.measure.violation;
        let mut shortest = p.gamma_theta;
        if here.slope < 0.0 {
            shortest = shortest.min(p.gamma_phi * violation / -here.slope);
            if violation <= self.theta_min {
                shortest = shortest.min(p.delta * violation.powf(p.s_theta) / (-here.slope).powf(p.s_phi));
            }
        }
        (p.gamma_alpha * shortest).max(PARAMETERS.shortest_in_domain)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn measure(violation: f64, objective: f64) -> Measure {
        Measure { violation, objective }
    }

    #[test]
    fn at_a_feasible_point_a_descent_direction_must_satisfy_armijo_s_condition_and_the_filter_stays() {
        let mut acceptance = Acceptance::new(0.0);
        let here = Here { measure: measure(0.0, 1.0), slope: -1.0 };
        assert_eq!(acceptance.judge(&here, 1.0, measure(0.0, 1.5)), Verdict::Rejected);
        assert_eq!(acceptance.judge(&here, 1.0, measure(0.0, 0.5)), Verdict::Objective);
        assert!(acceptance.takes(&here, 1.0, measure(0.0, 0.5)));
        assert!(acceptance.admits(here.measure), "the filter has not grown");
    }

    #[test]
    fn far_from_feasible_a_lower_violation_is_enough_and_the_point_enters_the_filter() {
        let mut acceptance = Acceptance::new(1.0);
        let here = Here { measure: measure(1.0, 1.0), slope: -1.0 };
        assert!(acceptance.takes(&here, 1.0, measure(0.5, 2.0)));
        assert!(!acceptance.admits(here.measure), "who was left is not come back to");
        assert!(!acceptance.takes(&here, 1.0, measure(2e4, 0.0)), "beyond θ_max nothing is taken");
    }

    #[test]
    fn the_shortest_step_follows_equation_23() {
        let acceptance = Acceptance::new(1.0);
        let p = &PARAMETERS.filter;
        let uphill = Here { measure: measure(1.0, 0.0), slope: 1.0 };
        assert_eq!(acceptance.shortest_step(&uphill), p.gamma_alpha * p.gamma_theta);
        let downhill = Here { measure: measure(1.0, 0.0), slope: -1.0 };
        assert_eq!(acceptance.shortest_step(&downhill), p.gamma_alpha * p.gamma_phi);
        let feasible = Here { measure: measure(0.0, 0.0), slope: -1.0 };
        assert_eq!(acceptance.shortest_step(&feasible), PARAMETERS.shortest_in_domain);
    }
}
