//! Sees every evaluated point: keeps the best, reports it, and asks the certificate whether to stop.

use crate::backends::{Iteration, Job};

/// A point worth keeping.
#[derive(Debug, Clone)]
pub(super) struct Candidate {
    /// The point, in the model's units.
    pub x: Vec<f64>,
    /// f(x)
    pub objective: f64,
    /// f(x) in units of its scale.
    pub scaled_objective: f64,
    /// Largest scaled violation of a row.
    pub violation: f64,
    /// Largest violation of a row in its own units.
    pub feasibility: f64,
}

impl Candidate {
    /// Less violation first, then the lower objective; violations up to `accepted` count as none.
    fn is_better(&self, other: &Candidate, accepted: f64) -> bool {
        match (self.violation <= accepted, other.violation <= accepted) {
            (true, true) => self.objective < other.objective,
            (false, false) => self.violation < other.violation,
            (feasible, _) => feasible,
        }
    }
}

/// An objective this far below zero, in units of its own scale, at a feasible point: it falls without end.
const UNBOUNDED: f64 = -1e20;
/// Violations count as none up to this share of the tolerance: f is cheaper where rows are cheated.
const ACCEPTED: f64 = 1e-3;
/// Evaluations that may follow a certified point, so that the answer is better than just accepted.
const EXTRA_ITERATIONS_AFTER_PASS: u64 = 40;
/// The longest wait between two stop tests, in evaluations.
const LONGEST_GAP: u64 = 2_000;

/// The watch over one solve, through all its attempts.
pub(super) struct Watch<'w, 'j> {
    job: &'w mut Job<'j>,
    accepted: f64,
    best: Option<Candidate>,
    proved: Option<Candidate>,
    iterations: u64,
    gap: u64,
    next_test: u64,
    /// Where an attempt that has proved a point ends.
    ends_at: u64,
    is_unbounded: bool,
    /// The objective's scale at the start: later attempts begin far from the start, where it says nothing.
    unit: Option<f64>,
}

impl<'w, 'j> Watch<'w, 'j> {
    /// A watch that reports to the job's observer.
    pub fn new(job: &'w mut Job<'j>) -> Self {
        let accepted = ACCEPTED * job.constraint_tolerance;
        Watch {
            job,
            accepted,
            best: None,
            proved: None,
            iterations: 0,
            gap: 1,
            next_test: 0,
            ends_at: u64::MAX,
            is_unbounded: false,
            unit: None,
        }
    }

    /// The job.
    pub fn job(&self) -> &Job<'j> {
        self.job
    }

    /// The best point so far, with the merit of `is_better`.
    pub fn best(&self) -> Option<&Candidate> {
        self.best.as_ref()
    }

    /// The best point that passed the stop test.
    pub fn proved(&self) -> Option<&Candidate> {
        self.proved.as_ref()
    }

    /// Improving evaluations so far.
    pub fn iterations(&self) -> u64 {
        self.iterations
    }

    /// Whether the best point violates rows by more than is accepted.
    pub fn is_infeasible(&self) -> bool {
        self.best.as_ref().is_some_and(|best| best.violation > self.job.constraint_tolerance)
    }

    /// Whether the objective fell without end.
    pub fn is_unbounded(&self) -> bool {
        self.is_unbounded
    }

    /// A new attempt begins: it is not ended by what an earlier one proved.
    pub fn begin(&mut self) {
        (self.gap, self.next_test, self.ends_at) = (1, 0, u64::MAX);
    }

    /// Judges the best point's violation anew: another attempt scales rows differently.
    pub fn measure(&mut self, violation: impl FnOnce(&[f64]) -> Option<f64>) {
        if let Some(best) = &mut self.best
            && let Some(measured) = violation(&best.x)
        {
            best.violation = measured;
        }
    }

    /// Takes note of a point. True where the run may end: the certificate passed a while ago, iterations ran out, or the
    /// objective falls without end.
    pub fn see(&mut self, candidate: Candidate, evaluations: u64) -> bool {
        let improves = self.best.as_ref().is_none_or(|best| candidate.is_better(best, self.accepted));
        if improves {
            let settled = self.best.as_ref().is_some_and(|best| is_small_change(best, &candidate));
            self.report(&candidate, evaluations);
            self.best = Some(candidate.clone());
            self.is_unbounded = candidate.violation <= self.accepted && candidate.objective < UNBOUNDED * self.unit(&candidate);
            if evaluations >= self.next_test && settled {
                self.test(candidate, evaluations);
            }
        }
        self.is_unbounded || evaluations >= self.ends_at || self.iterations >= self.job.max_iterations
    }

    fn unit(&mut self, candidate: &Candidate) -> f64 {
        let ratio = (candidate.objective / candidate.scaled_objective).abs();
        *self.unit.get_or_insert(if ratio > 0.0 && ratio.is_finite() { ratio } else { 1.0 })
    }

    fn report(&mut self, candidate: &Candidate, evaluations: u64) {
        let step_norm = self.best.as_ref().map_or(0.0, |best| distance(&best.x, &candidate.x));
        (self.job.observer)(&Iteration {
            iteration: self.iterations,
            evaluations,
            objective: candidate.objective,
            feasibility: candidate.feasibility,
            optimality: f64::NAN,
            step_norm,
            x: &candidate.x,
        });
        self.iterations += 1;
    }

    /// Asks the certificate; after every refusal it waits longer before it asks again.
    fn test(&mut self, candidate: Candidate, evaluations: u64) {
        if self.passes(&candidate) {
            self.keep(candidate, evaluations);
            self.next_test = evaluations + 1;
        } else {
            self.gap = (2 * self.gap).min(LONGEST_GAP);
            self.next_test = evaluations + self.gap;
        }
    }

    fn passes(&self, candidate: &Candidate) -> bool {
        self.job.stop_test.is_some_and(|test| test(&candidate.x))
    }

    fn keep(&mut self, candidate: Candidate, evaluations: u64) {
        self.ends_at = self.ends_at.min(evaluations + EXTRA_ITERATIONS_AFTER_PASS);
        self.proved = Some(candidate);
    }

    /// Asks the certificate about NLopt's own answer and about the best point, at the end of an attempt.
    pub fn test_at_end(&mut self, own: Option<Candidate>, evaluations: u64) -> bool {
        for candidate in [self.best.clone(), own].into_iter().flatten() {
            let is_news = self.proved.as_ref().is_none_or(|proved| candidate.is_better(proved, self.accepted));
            if is_news && self.passes(&candidate) {
                self.keep(candidate, evaluations);
            }
        }
        self.proved.is_some()
    }
}

fn is_small_change(old: &Candidate, new: &Candidate) -> bool {
    let objective = (old.objective - new.objective).abs() <= 1e-4 * old.objective.abs().max(new.objective.abs()).max(1e-300);
    objective || distance(&old.x, &new.x) <= 1e-4 * norm(&new.x)
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|value| value * value).sum::<f64>().sqrt()
}

fn distance(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| (x - y) * (x - y)).sum::<f64>().sqrt()
}
