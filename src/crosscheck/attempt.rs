//! One run of one backend, judged.

use super::clock::Clock;
use super::{Answer, Task};
use crate::backends::{Backend, Iteration, Job, PartTest, Solution, StopTest, Termination};
use crate::certificate::{Certifier, Tolerances};
use crate::model::{Budget, Class, Model};

/// A solver may stop where the certificate holds with this much to spare: answers are usually far better than what is accepted.
const SPARE: f64 = 1e-3;
/// Likewise for parts of a model: that much is left for their sum.
const PART_SPARE: f64 = 0.5;

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
pub(super) struct Contestant<'a> {
    pub(super) backend: &'a dyn Backend,
    pub(super) algorithm: &'a str,
}

/// The task with everything needed to run and to judge.
pub(super) struct Referee<'a> {
    pub(super) task: &'a Task<'a>,
    pub(super) judge: Certifier<'a>,
    pub(super) tolerances: Tolerances,
    pub(super) clock: Clock<'a>,
    strict: Certifier<'a>,
}

impl<'a> Referee<'a> {
    pub(super) fn new(task: &'a Task<'a>) -> Self {
        let settings = task.settings;
        let tolerances = Tolerances { optimality: settings.optimality_tolerance, constraint: settings.constraint_tolerance };
        let strict = strict(tolerances, SPARE);
        Referee {
            task,
            judge: Certifier::new(task.model, task.class, tolerances),
            strict: Certifier::new(task.model, task.class, strict),
            tolerances,
            clock: Clock::new(settings.max_seconds, settings.max_evaluations, task.interrupt),
        }
    }

    /// Solves from `start` (user's variables) and judges the answer.
    pub(super) fn attempt(
        &self,
        contestant: Contestant<'_>,
        start: &[f64],
        multipliers: Option<&[f64]>,
        budget: Budget<'_>,
        observer: &mut dyn FnMut(&Iteration<'_>),
    ) -> Answer {
        let mut start = start.to_vec();
        self.task.model.complete(&mut start);
        let start = start.as_slice();
        let Some(other) = self.task.substitution else {
            let stop = |x: &[f64]| self.strict.accepts(x);
            let part = |model: &dyn Model, x: &[f64]| self.accepts_part(model, x);
            let start = Start { x: start, multipliers, budget, stop: &stop, part: Some(&part) };
            let solution = self.solve(contestant, self.task.model, &start, observer);
            return self.judged(contestant, solution);
        };
        let stop = |z: &[f64]| self.strict.accepts(&self.outward(z));
        let mut translated = |iteration: &Iteration<'_>| {
            let objective = other.outward_objective(iteration.objective);
            observer(&Iteration { objective, x: &self.outward(iteration.x), ..*iteration });
        };
        let inward = other.inward(start);
        // Multipliers known are those of the user's rows: no guess for rows in other variables.
        let start = Start { x: &inward, multipliers: None, budget, stop: &stop, part: None };
        let mut solution = self.solve(contestant, other.model(), &start, &mut translated);
        solution.multipliers = None;
        solution.x = self.outward(&solution.x);
        self.judged(contestant, solution)
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
        contestant: Contestant<'_>,
        model: &dyn Model,
        start: &Start<'_>,
        observer: &mut dyn FnMut(&Iteration<'_>),
    ) -> Solution {
        if let Some(reason) = contestant.backend.refusal(contestant.algorithm, model) {
            return refused(contestant.algorithm, start.x, reason);
        }
        let settings = self.task.settings;
        let mut job = Job {
            algorithm: contestant.algorithm,
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
        contestant.backend.solve(model, &mut job)
    }

    /// Solves a helper model (elastic, boxed) that nobody watches, with a stop test of its own.
    pub(super) fn solve_aside(
        &self,
        contestant: Contestant<'_>,
        model: &dyn Model,
        start: &[f64],
        budget: Budget<'_>,
    ) -> Solution {
        let own = Certifier::new(model, Class::Nonlinear, strict(self.tolerances, SPARE));
        let stop = |x: &[f64]| own.accepts(x);
        self.solve(contestant, model, &Start { x: start, multipliers: None, budget, stop: &stop, part: None }, &mut |_| {})
    }

    /// Whether a point of a part of the model passes by itself.
    fn accepts_part(&self, part: &dyn Model, x: &[f64]) -> bool {
        Certifier::new(part, Class::Nonlinear, strict(self.tolerances, PART_SPARE)).accepts(x)
    }

    fn judged(&self, contestant: Contestant<'_>, mut solution: Solution) -> Answer {
        self.task.model.complete(&mut solution.x);
        let judged = self.judge.certify(&solution.x, solution.multipliers.as_deref());
        let mut remarks = Vec::new();
        if let Err(error) = &judged {
            remarks.push(format!("the point cannot be judged: {error}"));
        }
        let certificate = judged.ok();
        let objective = certificate.as_ref().map(|certificate| certificate.objective);
        Answer { backend: contestant.backend.name(), solution, objective, certificate, remarks }
    }

    /// Whether an answer meets all rows and bounds.
    pub(super) fn is_feasible(&self, answer: &Answer) -> bool {
        answer.certificate.as_ref().is_some_and(|certificate| certificate.is_feasible(&self.tolerances))
    }

    /// Certified before feasible before anything else; then the lower objective, or the smaller violation.
    pub(super) fn is_better(&self, a: &Answer, b: &Answer) -> bool {
        let rank = |answer: &Answer| match &answer.certificate {
            Some(certificate) if certificate.certified => (0, certificate.objective),
            Some(certificate) if self.is_feasible(answer) => (1, certificate.objective),
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

fn refused(algorithm: &str, start: &[f64], message: String) -> Solution {
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
