//! The backtracking line search with a filter and second-order corrections: Wächter & Biegler (2006), §2.3 and §2.4.

use super::barrier;
use super::engine::Engine;
use super::filter::at_most;
use super::kkt::Sides;
use super::parameters::PARAMETERS;
use super::vectors::{dot, moved, norm_sum};
use crate::model::EvaluationError;

/// θ and φ of a point.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measure {
    pub violation: f64,
    pub objective: f64,
}

/// How a trial point was accepted.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Verdict {
    Rejected,
    /// By a sufficient decrease of φ where the switching condition holds: the filter stays.
    Objective,
    /// By a decrease of either measure: the current point enters the filter.
    Either,
}

/// What the line search came to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Search {
    /// A step of this length was taken (the trial point is in `engine.trial`).
    Step(f64),
    /// The step is below rounding; it was taken in full.
    Tiny(f64),
    /// No length is acceptable.
    Failed,
}

/// The current point, seen from the line search.
#[derive(Debug, Clone, Copy)]
pub(super) struct Here {
    measure: Measure,
    /// ∇φᵀ·step
    slope: f64,
}

impl Engine<'_> {
    /// θ and φ at w for the rows' residuals and the objective given.
    pub(super) fn measure(&self, w: &[f64], objective: f64, residual: &[f64]) -> Measure {
        let barrier = barrier::value(&self.form, w, self.mu);
        Measure { violation: norm_sum(residual), objective: objective + barrier }
    }

    /// θ and φ at the current iterate.
    pub(super) fn current_measure(&self) -> Measure {
        self.measure(&self.iterate.w, self.iterate.objective, &self.iterate.residual)
    }

    pub(super) fn move_trial(&mut self, length: f64) {
        moved(&self.iterate.w, length, &self.direction.w, &mut self.trial.w);
        self.form.keep_inside(&mut self.trial.w);
    }

    /// Evaluates at `trial.w`; `None` outside the domain.
    pub(super) fn trial_measure(&mut self) -> Result<Option<Measure>, EvaluationError> {
        match self.form.values(&self.trial.w, &mut self.trial.rows) {
            Ok(objective) => {
                self.trial.objective = objective;
                self.form.residual(&self.trial.w, &self.trial.rows, &mut self.trial.residual);
                let measure = self.measure(&self.trial.w, objective, &self.trial.residual);
                Ok(measure.objective.is_finite().then_some(measure))
            }
            Err(EvaluationError::Invalid { .. }) => Ok(None),
            Err(stopped) => Err(stopped),
        }
    }

    /// Finds a length along `direction` that the filter accepts.
    pub(super) fn line_search(&mut self, cap: f64) -> Result<Search, EvaluationError> {
        let longest = barrier::longest_step(&self.form, &self.iterate.w, &self.direction.w, self.tau()).min(cap);
        let here = Here { measure: self.current_measure(), slope: dot(&self.barrier_gradient, &self.direction.w) };
        if self.is_tiny() {
            self.move_trial(longest);
            return Ok(if self.trial_measure()?.is_some() { Search::Tiny(longest) } else { Search::Failed });
        }
        let shortest = self.shortest_step(&here);
        let (mut length, mut first, mut in_domain) = (longest, true, false);
        while length > shortest || (!in_domain && length > PARAMETERS.shortest_in_domain) {
            self.move_trial(length);
            if let Some(measure) = self.trial_measure()? {
                in_domain = true;
                let verdict = self.judge(&here, length, measure);
                if self.accept(&here, verdict) {
                    self.shortened_steps = if first { 0 } else { self.shortened_steps + 1 };
                    self.watch(here);
                    return Ok(Search::Step(length));
                }
                if first
                    && measure.violation >= here.measure.violation
                    && let Some(corrected) = self.second_order_correction(&here, longest, measure)?
                {
                    return Ok(Search::Step(corrected));
                }
            }
            first = false;
            length *= 0.5;
        }
        Ok(Search::Failed)
    }

    /// Whether the step is below the rounding of every variable at a (nearly) feasible point.
    fn is_tiny(&self) -> bool {
        let (w, step) = (&self.iterate.w, &self.direction.w);
        self.iterate.violation() < 1e-4
            && w.iter().zip(step).all(|(w, step)| step.abs() <= PARAMETERS.tiny_step * (1.0 + w.abs()))
    }

    /// α_min, equation (23).
    fn shortest_step(&self, here: &Here) -> f64 {
        let Measure { violation, .. } = here.measure;
        let mut shortest = PARAMETERS.gamma_theta;
        if here.slope < 0.0 {
            shortest = shortest.min(PARAMETERS.gamma_phi * violation / -here.slope);
            if violation <= self.smallest_violation {
                shortest =
                    shortest.min(PARAMETERS.delta * violation.powf(PARAMETERS.s_theta) / (-here.slope).powf(PARAMETERS.s_phi));
            }
        }
        (PARAMETERS.gamma_alpha * shortest).max(PARAMETERS.shortest_in_domain)
    }

    pub(super) fn judge(&self, here: &Here, length: f64, trial: Measure) -> Verdict {
        if !self.filter.accepts(trial.violation, trial.objective) {
            return Verdict::Rejected;
        }
        let Measure { violation, objective } = here.measure;
        let switching = here.slope < 0.0
            && violation <= self.smallest_violation
            && length * (-here.slope).powf(PARAMETERS.s_phi) > PARAMETERS.delta * violation.powf(PARAMETERS.s_theta);
        if switching {
            let armijo = objective + PARAMETERS.eta_phi * length * here.slope;
            return if at_most(trial.objective, armijo) { Verdict::Objective } else { Verdict::Rejected };
        }
        let less_violation = at_most(trial.violation, (1.0 - PARAMETERS.gamma_theta) * violation);
        let less_objective = at_most(trial.objective, objective - PARAMETERS.gamma_phi * violation);
        if less_violation || less_objective { Verdict::Either } else { Verdict::Rejected }
    }

    /// Enters the current point into the filter where the verdict asks for it.
    pub(super) fn accept(&mut self, here: &Here, verdict: Verdict) -> bool {
        if verdict == Verdict::Either {
            self.filter.add(here.measure.violation, here.measure.objective);
        }
        verdict != Verdict::Rejected
    }

    /// Steps that also cancel the residual met at the full step. On success the direction is the corrected one.
    fn second_order_correction(&mut self, here: &Here, longest: f64, first: Measure) -> Result<Option<f64>, EvaluationError> {
        let mut accumulated: Vec<f64> =
            self.trial.residual.iter().zip(&self.iterate.residual).map(|(trial, now)| trial + longest * now).collect();
        let mut before = first.violation;
        let (mut w_step, mut y_step) = (self.direction.w.clone(), self.direction.y.clone());
        for _ in 0..PARAMETERS.p_max {
            let rows: Vec<f64> = accumulated.iter().map(|value| -value).collect();
            if self.kkt.solve(Sides { w: &self.right, rows: &rows }, &mut w_step, &mut y_step).is_err() {
                return Ok(None);
            }
            let corrected = barrier::longest_step(&self.form, &self.iterate.w, &w_step, self.tau());
            moved(&self.iterate.w, corrected, &w_step, &mut self.trial.w);
            self.form.keep_inside(&mut self.trial.w);
            let Some(measure) = self.trial_measure()? else { return Ok(None) };
            let verdict = self.judge(here, longest, measure);
            if self.accept(here, verdict) {
                self.direction.w.copy_from_slice(&w_step);
                self.direction.y.copy_from_slice(&y_step);
                return Ok(Some(corrected));
            }
            if measure.violation > PARAMETERS.kappa_soc * before {
                return Ok(None);
            }
            before = measure.violation;
            for (sum, residual) in accumulated.iter_mut().zip(&self.trial.residual) {
                *sum = corrected * *sum + residual;
            }
        }
        Ok(None)
    }
}
