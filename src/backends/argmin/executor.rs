//! Our solvers under argmin's executor: its state carries our iterates, they are shown as they come, and its best point is feasible
//! before it is cheap. (argmin's own `IterState` keeps the lowest cost, however infeasible.)

use std::collections::HashMap;
use std::time::Duration;

use argmin::core::{Error, Executor, KV, Problem, Solver, State, TerminationReason, TerminationStatus};

use crate::backends::{Iteration, Job, Solution, Termination};
use crate::model::Evaluator;
use crate::solvers::{self, Conclusion, Progress, RankedPoint, Reached, Why};

/// Runs a solver to its end or to the limit on iterations, showing every iteration to the job's observer.
pub(super) fn run(solver: impl solvers::Solver, evaluator: &Evaluator<'_>, job: &mut Job<'_>) -> Solution {
    let (max_iterations, tolerance) = (job.max_iterations, job.constraint_tolerance);
    let executor = Executor::new(evaluator, Driven { solver, observer: &mut *job.observer })
        .configure(|state: NlpState| NlpState { max_iterations, tolerance, ..state })
        // The process has one handler, and the command line owns it.
        .ctrlc(false);
    match executor.run() {
        Ok(result) => result.state.solution(job),
        Err(error) => Solution::at_start(job, Termination::Failed, error.to_string()),
    }
}

/// A run that ended like this at a point, or where it began.
pub(super) fn concluded(conclusion: Conclusion, point: Option<RankedPoint>, job: &Job<'_>) -> Solution {
    let termination = match conclusion.why {
        Why::Converged => Termination::Converged,
        Why::LimitReached => Termination::LimitReached,
        Why::Interrupted => Termination::Interrupted,
        Why::Failed => Termination::Failed,
    };
    let blank = Solution { invalid: conclusion.invalid, ..Solution::at_start(job, termination, conclusion.message) };
    match point {
        Some(RankedPoint { x, multipliers, .. }) => Solution { x, multipliers, ..blank },
        None => blank,
    }
}

/// One of our solvers as one of argmin's.
struct Driven<'o, S> {
    solver: S,
    observer: &'o mut dyn FnMut(&Iteration<'_>),
}

type Advanced = Result<(NlpState, Option<KV>), Error>;

impl<'a, S: solvers::Solver> Solver<&'a Evaluator<'a>, NlpState> for Driven<'_, S> {
    fn name(&self) -> &str {
        self.solver.name()
    }

    fn init(&mut self, _problem: &mut Problem<&'a Evaluator<'a>>, state: NlpState) -> Advanced {
        let progress = self.solver.begin();
        let state = state.take(progress);
        state.show(0, self.observer);
        Ok((state, None))
    }

    fn next_iter(&mut self, _problem: &mut Problem<&'a Evaluator<'a>>, state: NlpState) -> Advanced {
        let progress = self.solver.step(state.iteration + 1 >= state.max_iterations);
        let state = state.take(progress);
        state.show(state.iteration + 1, self.observer);
        Ok((state, None))
    }
}

/// What the executor carries from iteration to iteration.
#[derive(Default)]
struct NlpState {
    current: Option<Reached>,
    best: Option<RankedPoint>,
    conclusion: Option<Conclusion>,
    /// The point to hand back, where it is not the best one by rank.
    answer: Option<RankedPoint>,
    tolerance: f64,
    iteration: u64,
    last_best: u64,
    max_iterations: u64,
    counts: HashMap<String, u64>,
    time: Option<Duration>,
    status: TerminationStatus,
}

impl NlpState {
    /// Takes over what an iteration came to.
    fn take(mut self, progress: Progress) -> Self {
        self.current = progress.at.or(self.current);
        let Some((conclusion, answer)) = progress.ending else { return self };
        let reason = TerminationReason::SolverExit(conclusion.message.clone());
        (self.conclusion, self.answer) = (Some(conclusion), answer);
        self.terminate_with(reason)
    }

    fn show(&self, iteration: u64, observer: &mut dyn FnMut(&Iteration<'_>)) {
        if let Some(Reached { point, step_norm, evaluations }) = &self.current {
            observer(&Iteration {
                iteration,
                evaluations: *evaluations,
                objective: point.objective,
                feasibility: point.feasibility,
                optimality: point.optimality,
                step_norm: *step_norm,
                x: &point.x,
            });
        }
    }

    /// The run's result: the solver's answer, or the best point by rank.
    fn solution(self, job: &Job<'_>) -> Solution {
        let limit = || format!("the limit on iterations, {}, is reached", self.max_iterations);
        let conclusion = self.conclusion.unwrap_or_else(|| Conclusion::new(Why::LimitReached, limit()));
        Solution { iterations: Some(self.iteration), ..concluded(conclusion, self.answer.or(self.best), job) }
    }
}

impl State for NlpState {
    type Param = Vec<f64>;
    type Float = f64;

    fn new() -> Self {
        NlpState { max_iterations: u64::MAX, ..NlpState::default() }
    }

    fn update(&mut self) {
        let Some(Reached { point, .. }) = &self.current else { return };
        if self.best.as_ref().is_none_or(|best| point.ranks_above(best, self.tolerance)) {
            self.best = Some(point.clone());
            self.last_best = self.iteration;
        }
    }

    fn get_param(&self) -> Option<&Vec<f64>> {
        self.current.as_ref().map(|reached| &reached.point.x)
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
        self.current.as_ref().map_or(f64::INFINITY, |reached| reached.point.objective)
    }

    fn get_best_cost(&self) -> f64 {
        self.best.as_ref().map_or(f64::INFINITY, |point| point.objective)
    }

    fn get_target_cost(&self) -> f64 {
        f64::NEG_INFINITY
    }

    /// Evaluations are counted by [`Evaluator`].
    fn func_counts<O>(&mut self, _problem: &Problem<O>) {}

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
