//! The argmin state of a constrained solver: constraint values and multipliers beside x, and a best point that is
//! feasible before it is cheap. (argmin's own `IterState` keeps the lowest cost, however infeasible.)

use std::collections::HashMap;
use std::time::Duration;

use argmin::argmin_error;
use argmin::core::observers::Observe;
use argmin::core::{Error, KV, Problem, State, TerminationReason, TerminationStatus};

use super::Finished;
use crate::backends::{Iteration, Termination};
use crate::model::{EvaluationError, Evaluator, Stop};

/// A point with what decides its rank, and what is shown of it.
#[derive(Debug, Clone)]
pub(super) struct Point {
    /// The model's x.
    pub x: Vec<f64>,
    /// f(x)
    pub objective: f64,
    /// Largest violation relative to the rows' scales: what decides the rank.
    pub relative_violation: f64,
    /// Largest absolute violation: what is shown.
    pub feasibility: f64,
    /// First-order optimality measure.
    pub optimality: f64,
    /// Row multipliers in the model's units.
    pub multipliers: Option<Vec<f64>>,
}

/// How a solver ended by itself.
#[derive(Debug, Clone)]
pub(super) struct Conclusion {
    pub termination: Termination,
    pub message: String,
    /// The evaluation error that ended the run.
    pub invalid: Option<String>,
}

impl Conclusion {
    /// What an evaluation error means for a run.
    pub fn of(error: &EvaluationError) -> Self {
        let (termination, invalid) = match error {
            EvaluationError::Stopped(Stop::Interrupted) => (Termination::Interrupted, None),
            EvaluationError::Stopped(_) => (Termination::LimitReached, None),
            EvaluationError::Invalid { .. } => (Termination::Failed, Some(error.to_string())),
        };
        Conclusion { termination, message: error.to_string(), invalid }
    }
}

/// What the executor carries from iteration to iteration.
pub(super) struct NlpState<'a> {
    current: Option<Point>,
    best: Option<Point>,
    start: Vec<f64>,
    step_norm: f64,
    evaluations: u64,
    conclusion: Option<Conclusion>,
    /// The point to hand back, where it is not the best one by rank.
    answer: Option<Point>,
    tolerance: f64,
    report: Option<&'a dyn Fn(&Iteration<'_>)>,
    iteration: u64,
    last_best: u64,
    max_iterations: u64,
    counts: HashMap<String, u64>,
    time: Option<Duration>,
    status: TerminationStatus,
}

impl<'a> NlpState<'a> {
    /// Where to fall back to when not even the start can be evaluated.
    pub fn start(mut self, x: &[f64]) -> Self {
        self.start = x.to_vec();
        self
    }

    /// Iterations at the most.
    pub fn max_iterations(mut self, iterations: u64) -> Self {
        self.max_iterations = iterations;
        self
    }

    /// Relative violation up to which a point counts as feasible.
    pub fn tolerance(mut self, tolerance: f64) -> Self {
        self.tolerance = tolerance;
        self
    }

    /// Where iterations are shown.
    pub fn report_to(mut self, report: &'a dyn Fn(&Iteration<'_>)) -> Self {
        self.report = Some(report);
        self
    }

    /// The new current point, after so many evaluations.
    pub fn at(mut self, point: Point, step_norm: f64, evaluations: u64) -> Self {
        (self.current, self.step_norm, self.evaluations) = (Some(point), step_norm, evaluations);
        self
    }

    /// Ends the run; the answer is `answer`, or the best point by rank.
    pub fn conclude(mut self, conclusion: Conclusion, answer: Option<Point>) -> Self {
        let reason = TerminationReason::SolverExit(conclusion.message.clone());
        (self.conclusion, self.answer) = (Some(conclusion), answer);
        self.terminate_with(reason)
    }

    /// Whether a point ranks above the best one.
    fn improves(&self, point: &Point) -> bool {
        let Some(best) = &self.best else { return true };
        match (point.relative_violation <= self.tolerance, best.relative_violation <= self.tolerance) {
            (true, true) => point.objective < best.objective,
            (feasible, other) if feasible != other => feasible,
            _ => point.relative_violation < best.relative_violation,
        }
    }

    /// The run's result.
    pub fn finish(self) -> Finished {
        let conclusion = self.conclusion.unwrap_or(Conclusion {
            termination: Termination::LimitReached,
            message: format!("the limit on iterations, {}, is reached", self.max_iterations),
            invalid: None,
        });
        let point = self.answer.or(self.best);
        let (x, multipliers) = point.map_or((self.start, None), |point| (point.x, point.multipliers));
        let Conclusion { termination, message, invalid } = conclusion;
        Finished { termination, message, invalid, x, multipliers, iterations: self.iteration }
    }
}

impl State for NlpState<'_> {
    type Param = Vec<f64>;
    type Float = f64;

    fn new() -> Self {
        NlpState {
            current: None,
            best: None,
            start: Vec::new(),
            step_norm: 0.0,
            evaluations: 0,
            conclusion: None,
            answer: None,
            tolerance: 0.0,
            report: None,
            iteration: 0,
            last_best: 0,
            max_iterations: u64::MAX,
            counts: HashMap::new(),
            time: None,
            status: TerminationStatus::NotTerminated,
        }
    }

    fn update(&mut self) {
        if self.current.as_ref().is_some_and(|point| self.improves(point)) {
            self.best.clone_from(&self.current);
            self.last_best = self.iteration;
        }
    }

    fn get_param(&self) -> Option<&Vec<f64>> {
        self.current.as_ref().map(|point| &point.x)
    }

    fn get_best_param(&self) -> Option<&Vec<f64>> {
        self.best.as_ref().map(|point| &point.x)
    }

    fn get_max_iters(&self) -> u64 {
        self.max_iterations
    }

    fn increment_iter(&mut self) {
        self.iteration += 1;
    }

    fn get_iter(&self) -> u64 {
        self.iteration
    }

    fn get_cost(&self) -> f64 {
        self.current.as_ref().map_or(f64::INFINITY, |point| point.objective)
    }

    fn get_best_cost(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |point| point.objective)
    }

    fn get_target_cost(&self) -> f64 {
        f64::NEG_INFINITY
    }

    fn func_counts<O>(&mut self, problem: &Problem<O>) {
        for (name, count) in &problem.counts {
            self.counts.insert((*name).to_owned(), *count);
        }
    }

    fn get_func_counts(&self) -> &HashMap<String, u64> {
        &self.counts
    }

    fn time(&mut self, time: Option<Duration>) -> &mut Self {
        self.time = time;
        self
    }

    fn get_time(&self) -> Option<Duration> {
        self.time
    }

    fn get_last_best_iter(&self) -> u64 {
        self.last_best
    }

    fn is_best(&self) -> bool {
        self.last_best == self.iteration
    }

    fn terminate_with(mut self, reason: TerminationReason) -> Self {
        self.status = TerminationStatus::Terminated(reason);
        self
    }

    fn get_termination_status(&self) -> &TerminationStatus {
        &self.status
    }

    fn get_termination_reason(&self) -> Option<&TerminationReason> {
        match &self.status {
            TerminationStatus::Terminated(reason) => Some(reason),
            TerminationStatus::NotTerminated => None,
        }
    }
}

/// Shows every iteration to the job's observer.
pub(super) struct Watch;

impl Watch {
    fn show(state: &NlpState<'_>, iteration: u64) {
        if let (Some(report), Some(point)) = (state.report, &state.current) {
            report(&Iteration {
                iteration,
                evaluations: state.evaluations,
                objective: point.objective,
                feasibility: point.feasibility,
                optimality: point.optimality,
                step_norm: state.step_norm,
                x: &point.x,
            });
        }
    }
}

impl<'a> Observe<NlpState<'a>> for Watch {
    fn observe_init(&mut self, _name: &str, state: &NlpState<'a>, _kv: &KV) -> Result<(), Error> {
        Self::show(state, 0);
        Ok(())
    }

    fn observe_iter(&mut self, state: &NlpState<'a>, _kv: &KV) -> Result<(), Error> {
        Self::show(state, state.iteration + 1);
        Ok(())
    }
}

/// The model argmin was started with.
pub(super) fn given<'a>(problem: &Problem<&'a Evaluator<'a>>) -> Result<&'a Evaluator<'a>, Error> {
    problem.problem.ok_or_else(|| argmin_error!(NotInitialized, "no model was given"))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(objective: f64, relative_violation: f64) -> Point {
        let x = vec![objective];
        Point { x, objective, relative_violation, feasibility: relative_violation, optimality: 1.0, multipliers: None }
    }

    #[test]
    fn a_feasible_point_beats_a_cheaper_infeasible_one() {
        let mut state = NlpState::new().tolerance(1e-8);
        for (objective, violation, best) in [(5.0, 1.0, 5.0), (9.0, 0.5, 9.0), (7.0, 0.0, 7.0), (1.0, 0.1, 7.0), (6.0, 1e-9, 6.0)]
        {
            state = state.at(point(objective, violation), 0.0, 1);
            state.update();
            assert_eq!(state.get_best_cost(), best);
        }
    }
}
