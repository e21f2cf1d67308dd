//! Our solvers under argmin's executor: its state carries our iterates, its observer shows them, and its best point is feasible
//! before it is cheap. (argmin's own `IterState` keeps the lowest cost, however infeasible.)

use std::collections::HashMap;
use std::time::Duration;

use argmin::core::observers::{Observe, ObserverMode};
use argmin::core::{Error, Executor, KV, Problem, Solver, State, TerminationReason, TerminationStatus};

use crate::backends::{Iteration, Job};
use crate::model::Evaluator;
use crate::solvers::{self, Conclusion, Point, Progress, Reached, Why};

/// What a run leaves behind.
pub(super) struct Finished {
    pub conclusion: Conclusion,
    pub x: Vec<f64>,
    pub multipliers: Option<Vec<f64>>,
    pub iterations: u64,
}

impl Finished {
    /// Nothing came of it.
    pub fn at_start(start: &[f64], conclusion: Conclusion) -> Self {
        Finished { conclusion, x: start.to_vec(), multipliers: None, iterations: 0 }
    }
}

/// Runs a solver to its end or to the limit on iterations, showing every iteration to the job's observer.
pub(super) fn run(solver: impl solvers::Solver, evaluator: &Evaluator<'_>, job: &mut Job<'_>) -> Finished {
    let observer = std::cell::RefCell::new(&mut *job.observer);
    let report = |iteration: &Iteration<'_>| (observer.borrow_mut())(iteration);
    let executor = Executor::new(evaluator, Driven(solver))
        .configure(|state: NlpState<'_>| NlpState {
            start: job.start.to_vec(),
            max_iterations: job.max_iterations,
            tolerance: job.constraint_tolerance,
            report: Some(&report),
            ..state
        })
        .add_observer(Watch, ObserverMode::Always)
        // The process has one handler, and the command line owns it.
        .ctrlc(false);
    match executor.run() {
        Ok(result) => result.state.finish(),
        Err(error) => Finished::at_start(job.start, Conclusion::new(Why::Failed, error.to_string())),
    }
}

/// One of our solvers as one of argmin's.
struct Driven<S>(S);

impl<'a, 's, S: solvers::Solver> Solver<&'a Evaluator<'a>, NlpState<'s>> for Driven<S> {
    fn name(&self) -> &str {
        self.0.name()
    }

    fn init(
        &mut self,
        _problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let progress = self.0.begin();
        Ok((state.take(progress), None))
    }

    fn next_iter(
        &mut self,
        _problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let progress = self.0.step(state.iteration + 1 >= state.max_iterations);
        Ok((state.take(progress), None))
    }
}

/// What the executor carries from iteration to iteration.
struct NlpState<'a> {
    current: Option<Reached>,
    best: Option<Point>,
    start: Vec<f64>,
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

impl NlpState<'_> {
    /// Takes over what an iteration came to.
    fn take(mut self, progress: Progress) -> Self {
        self.current = progress.at.or(self.current);
        let Some((conclusion, answer)) = progress.ending else { return self };
        let reason = TerminationReason::SolverExit(conclusion.message.clone());
        (self.conclusion, self.answer) = (Some(conclusion), answer);
        self.terminate_with(reason)
    }

    /// The run's result: the solver's answer, or the best point by rank.
    fn finish(self) -> Finished {
        let limit = || format!("the limit on iterations, {}, is reached", self.max_iterations);
        let conclusion = self.conclusion.unwrap_or_else(|| Conclusion::new(Why::LimitReached, limit()));
        let (x, multipliers) = self.answer.or(self.best).map_or((self.start, None), |point| (point.x, point.multipliers));
        Finished { conclusion, x, multipliers, iterations: self.iteration }
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
struct Watch;

impl Watch {
    fn show(state: &NlpState<'_>, iteration: u64) {
        if let (Some(report), Some(Reached { point, step_norm, evaluations })) = (state.report, &state.current) {
            report(&Iteration {
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
