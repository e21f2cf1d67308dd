//! The task with what is needed to run backends and to judge what they bring.

use super::clock::Clock;
use super::merit;
use super::pool;
use super::{Answer, Task};
use crate::backends::{Backend, Iteration, Job, PartTest, Solution, StopTest, Termination};
use crate::certificate::{Certifier, Tolerances};
use crate::model::{Budget, Class, Model};

/// A solver may stop where the certificate holds with this much to spare: answers are usually far better than what is accepted.
const SPARE: f64 = 1e-3;
/// Likewise for parts of a model: that much is left for their sum.
const PART_SPARE: f64 = 0.5;

/// A violation above this, relative, is more than solvers leave where rows can be met.
pub(super) const LAST_DIGITS: f64 = 1e-10;
/// How far a point that meets rows to the last digit may be, in sizes of the variables: as far as the accepted violation can be.
pub(super) const BESIDE: f64 = 1e-4;

/// What one run begins with, and when it may end.
struct Start<'r> {
    x: &'r [f64],
    multipliers: Option<&'r [f64]>,
    budget: Budget<'r>,
    stop: StopTest<'r>,
    part: Option<PartTest<'r>>,
}

/// A backend with its algorithm.
#[derive(Clone, Copy)]
pub(super) struct Solver<'a> {
    pub(super) backend: &'a dyn Backend,
    pub(super) algorithm: &'a str,
}

/// The task with everything needed to run and to judge.
pub(super) struct Session<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) judge: Certifier<'a>,
    pub(super) tolerances: Tolerances,
    pub(super) clock: Clock<'a>,
    strict: Certifier<'a>,
}

impl<'a> Session<'a> {
    pub(super) fn new(task: &'a Task<'a>) -> Self {
        let settings = task.settings;
        let tolerances = Tolerances { optimality: settings.optimality_tolerance, constraint: settings.constraint_tolerance };
        let clock = Clock::new(settings.max_seconds, settings.max_evaluations, task.interrupt);
        let judge = |tolerances| Certifier::new(task.model, task.class, tolerances).with_deadline(clock.judging_ends());
        let strict = judge(strict(tolerances, SPARE));
        Session { task, judge: judge(tolerances), strict, tolerances, clock }
    }

    /// Work one evaluation of the model it works on costs a backend.
    pub(super) fn cost(&self, solver: Solver<'_>) -> f64 {
        solver.backend.work_per_evaluation(self.task.model_for(solver.backend)).max(1.0)
    }

    /// A budget of so much work on `model`, and most of the time that is left.
    pub(super) fn budget(&self, solver: Solver<'_>, model: &dyn Model, allowed: f64) -> Budget<'a> {
        let whole = self.clock.share(0.9);
        let evaluations = allowed / solver.backend.work_per_evaluation(model).max(1.0);
        // Saturates: an infinite allowance is u64::MAX.
        Budget { max_evaluations: whole.max_evaluations.min(evaluations as u64), ..whole }
    }

    /// Solves from `start` (user's variables) and judges the answer.
    pub(super) fn attempt(
        &self,
        solver: Solver<'_>,
        start: &[f64],
        multipliers: Option<&[f64]>,
        budget: Budget<'_>,
        observer: &mut dyn FnMut(&Iteration<'_>),
    ) -> Answer {
        let mut start = start.to_vec();
        self.task.model.complete(&mut start);
        let start = start.as_slice();
        let Some(other) = self.task.substitution_for(solver.backend) else {
            let stop = |x: &[f64]| self.is_enough(x);
            let part = |model: &dyn Model, x: &[f64]| self.accepts_part(model, x);
            let start = Start { x: start, multipliers, budget, stop: &stop, part: Some(&part) };
            let solution = self.solve(solver, self.task.model, &start, observer);
            return self.judged(solver, solution);
        };
        let stop = |z: &[f64]| self.is_enough(&self.outward(z));
        let mut translated = |iteration: &Iteration<'_>| {
            let objective = other.outward_objective(iteration.objective);
            observer(&Iteration { objective, x: &self.outward(iteration.x), ..*iteration });
        };
        let inward = other.inward(start);
        // Multipliers known are those of the user's rows: no guess for rows in other variables.
        let start = Start { x: &inward, multipliers: None, budget, stop: &stop, part: None };
        let mut solution = self.solve(solver, other.model(), &start, &mut translated);
        let z = &solution.x;
        solution.multipliers = solution.multipliers.and_then(|y| other.outward_multipliers(self.task.model, z, &y));
        solution.x = self.outward(&solution.x);
        self.judged(solver, solution)
    }

    /// Whether a solver may stop at x: it passes with something to spare, and the gap that leaves is nothing beside the objective, however
    /// steep that is elsewhere.
    fn is_enough(&self, x: &[f64]) -> bool {
        self.strict.passed(x).is_some_and(|certificate| !merit::is_coarse(&certificate))
    }

    /// x(z), inside the bounds to the last digit.
    fn outward(&self, z: &[f64]) -> Vec<f64> {
        let mut x = self.task.substitution.map_or_else(|| z.to_vec(), |other| other.outward(z));
        self.task.model.meta().clamp(&mut x);
        x
    }

    /// Runs a backend on any model with the task's settings.
    fn solve(
        &self,
        solver: Solver<'_>,
        model: &dyn Model,
        start: &Start<'_>,
        observer: &mut dyn FnMut(&Iteration<'_>),
    ) -> Solution {
        if let Some(reason) = solver.backend.refusal(solver.algorithm, model) {
            return refused(solver.algorithm, start.x, reason);
        }
        pool::with_observer(observer, |observer| self.run(solver, model, start, observer))
    }

    fn run(
        &self,
        solver: Solver<'_>,
        model: &dyn Model,
        start: &Start<'_>,
        observer: &mut dyn FnMut(&Iteration<'_>),
    ) -> Solution {
        let settings = self.task.settings;
        let mut job = Job {
            algorithm: solver.algorithm,
            start: start.x,
            start_multipliers: start.multipliers,
            optimality_tolerance: settings.optimality_tolerance,
            step_tolerance: settings.step_tolerance,
            constraint_tolerance: settings.constraint_tolerance,
            max_iterations: settings.max_iterations,
            budget: start.budget,
            stop_test: Some(start.stop),
            part_test: start.part,
            observer,
        };
        solver.backend.solve(model, &mut job)
    }

    /// Solves a helper model (elastic, boxed) that nobody watches, with a stop test of its own.
    pub(super) fn solve_aside(&self, solver: Solver<'_>, model: &dyn Model, start: &[f64], budget: Budget<'_>) -> Solution {
        let own =
            Certifier::new(model, Class::Nonlinear, strict(self.tolerances, SPARE)).with_deadline(self.clock.judging_ends());
        let stop = |x: &[f64]| own.accepts(x);
        self.solve(solver, model, &Start { x: start, multipliers: None, budget, stop: &stop, part: None }, &mut |_| {})
    }

    /// Whether a point of a part of the model passes by itself.
    fn accepts_part(&self, part: &dyn Model, x: &[f64]) -> bool {
        let judge = Certifier::new(part, Class::Nonlinear, strict(self.tolerances, PART_SPARE));
        judge.with_deadline(self.clock.judging_ends()).accepts(x)
    }

    fn judged(&self, solver: Solver<'_>, mut solution: Solution) -> Answer {
        self.task.model.complete(&mut solution.x);
        let gave_way = solution.termination == Termination::LimitReached && !self.is_at_users_limit(&solution);
        if gave_way {
            solution.message = format!("its share of the work ended before it did ({} evaluations)", solution.evaluations);
        }
        let attempt = usize::from(solution.termination != Termination::Refused);
        let mut answer = Answer { attempt, gave_way, ..Answer::unjudged(solver.backend.name(), solution) };
        self.judge_again(&mut answer);
        self.lead_back(&mut answer);
        answer
    }

    /// Where the answer misses rows that may contradict one another, or misses them by more than is accepted: the point beside it that meets them,
    /// if that stands better.
    fn lead_back(&self, answer: &mut Answer) {
        let Some(certificate) = answer.certificate.as_ref() else { return };
        let is_inexact =
            certificate.primal_infeasibility > LAST_DIGITS && (!answer.feasible || certificate.multipliers_not_unique);
        let Some(x) = is_inexact.then(|| self.judge.met_beside(&answer.solution.x, BESIDE, LAST_DIGITS)).flatten() else {
            return;
        };
        let mut beside = answer.clone();
        beside.solution.x = x;
        self.judge_again(&mut beside);
        let standing = |answer: &Answer| (answer.is_certified(), answer.feasible);
        if standing(&beside) >= standing(answer) {
            *answer = beside;
        }
    }

    /// Judges the answer's point anew: whatever moves a point calls this.
    pub(super) fn judge_again(&self, answer: &mut Answer) {
        let x = &answer.solution.x;
        let certificate = match self.judge.certify(x, answer.solution.multipliers.as_deref()) {
            Ok(certificate) => Some(certificate),
            Err(error) => {
                answer.remarks.push(format!("the point cannot be judged: {error}"));
                None
            }
        };
        answer.objective = match &certificate {
            Some(certificate) => Some(certificate.objective),
            None => self.task.model.objective(x).ok().filter(|value| value.is_finite()),
        };
        answer.feasible = match &certificate {
            Some(certificate) => certificate.is_feasible(&self.tolerances),
            None => answer.objective.is_some() && self.meets_limits(x),
        };
        answer.certificate = certificate;
    }

    /// Whether values alone show that `x` meets every limit: for points without derivatives, and so without the rows' scales.
    fn meets_limits(&self, x: &[f64]) -> bool {
        let (meta, accepted) = (self.task.model.meta(), self.tolerances.constraint);
        let mut rows = vec![0.0; meta.rows()];
        let meets = |value: f64, lower: f64, upper: f64| {
            let slack = |limit: f64| if limit.is_finite() { accepted * limit.abs() } else { 0.0 };
            value >= lower - slack(lower) && value <= upper + slack(upper)
        };
        self.task.model.constraints(x, &mut rows).is_ok()
            && (0..rows.len()).all(|i| meets(rows[i], meta.row_lower[i], meta.row_upper[i]))
            && (0..x.len()).all(|j| meets(x[j], meta.lower[j], meta.upper[j]))
    }

    /// Whether a limit of the user's ended the run.
    fn is_at_users_limit(&self, solution: &Solution) -> bool {
        let settings = self.task.settings;
        self.clock.is_over()
            || solution.evaluations >= settings.max_evaluations
            || solution.iterations.is_some_and(|iterations| iterations >= settings.max_iterations)
    }

    /// Certified before feasible before anything else; then the lower objective, or the smaller violation.
    pub(super) fn is_better(&self, a: &Answer, b: &Answer) -> bool {
        let rank = |answer: &Answer| match &answer.certificate {
            Some(certificate) if certificate.certified => (0, certificate.objective),
            _ if answer.feasible => (1, answer.objective.unwrap_or(f64::INFINITY)),
            Some(certificate) => (2, certificate.primal_infeasibility),
            None => (3, 0.0),
        };
        let (a, b) = (rank(a), rank(b));
        a.0 < b.0 || (a.0 == b.0 && a.1 < b.1)
    }
}

fn strict(tolerances: Tolerances, spare: f64) -> Tolerances {
    Tolerances { optimality: tolerances.optimality * spare, constraint: tolerances.constraint * SPARE.sqrt() }
}

pub(super) fn refused(algorithm: &str, start: &[f64], message: String) -> Solution {
    Solution {
        algorithm: algorithm.to_string(),
        termination: Termination::Refused,
        message,
        x: start.to_vec(),
        multipliers: None,
        iterations: None,
        evaluations: 0,
        seconds: 0.0,
        invalid: None,
    }
}
