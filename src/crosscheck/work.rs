//! Shares of work. What a run may cost is counted in evaluations times what one costs the backend, never in seconds: a slow
//! machine gives the same answer. The deadline of the command is another matter: [`super::clock`].

use super::Answer;

/// Entries of values and derivatives a slow core works off in a second, expressions and factorisations included.
const PER_SECOND: f64 = 1e7;
/// What is left to the others once a global minimum is proved: as much again as the proof took, at least 0.2 s worth.
pub(super) fn cross_check(proof: f64) -> f64 {
    proof.max(0.2 * PER_SECOND)
}

/// What is left to the others once a local minimum is certified: they may know a better one. Twice as much as the proof took, at
/// least 2 s worth.
pub(super) fn after_certified(proof: f64) -> f64 {
    (2.0 * proof).max(2.0 * PER_SECOND)
}

/// What the cheapest backend may spend before it gives way to the next one: ten seconds' worth, and two thousand evaluations at
/// least, which end any interior-point run that converges.
pub(super) fn first_turn(cost: f64) -> f64 {
    (10.0 * PER_SECOND).max(2000.0 * cost)
}

/// What the others may spend at first, while nothing is certified: as much as the cheapest has, at least two seconds' worth.
pub(super) fn later_turn(spent: f64) -> f64 {
    spent.max(2.0 * PER_SECOND)
}

/// One run of the probe at the most.
pub(super) fn probe(first: f64) -> f64 {
    first.clamp(0.2 * PER_SECOND, 2.0 * PER_SECOND)
}

/// A further run of a backend: as much again as its first, at least a second's worth and at most ten.
pub(super) fn further_run(first: f64) -> f64 {
    first.clamp(PER_SECOND, 10.0 * PER_SECOND)
}

/// All solves of the elastic phase together: twice the cheapest first run, and five hundred evaluations at least: five runs of an
/// interior point that converge.
pub(super) fn elastic_phase(first: f64, cost: f64) -> f64 {
    (2.0 * first).clamp(0.5 * PER_SECOND, 10.0 * PER_SECOND).max(500.0 * cost)
}

/// What explains an elastic minimum, each: its scales, the filter of what conflicts, single moves. Half of what finding it may take.
pub(super) fn explanation(first: f64, cost: f64) -> f64 {
    (0.5 * first).clamp(0.5 * PER_SECOND, 3.0 * PER_SECOND).max(250.0 * cost)
}

/// Evaluations below which a run is not worth beginning.
pub(super) const FEWEST_EVALUATIONS: f64 = 20.0;

/// What an answer has cost, all its attempts together.
pub(super) fn of(answer: &Answer, cost: f64) -> f64 {
    answer.solution.evaluations as f64 * cost
}

/// An allowance that several solves share.
#[derive(Debug)]
pub(super) struct Allowance {
    whole: f64,
    left: f64,
}

/// What one solve may take of its phase's work.
const SINGLE: f64 = 0.3;
/// A phase ends when this share of its work is left: nothing ends within less.
const REST: f64 = 0.01;

impl Allowance {
    pub(super) fn new(work: f64) -> Self {
        Allowance { whole: work, left: work }
    }

    /// What one solve may take.
    pub(super) fn single(&self) -> f64 {
        self.left.min(SINGLE * self.whole).max(0.0)
    }

    pub(super) fn spend(&mut self, work: f64) {
        self.left -= work;
    }

    pub(super) fn is_spent(&self) -> bool {
        self.left <= REST * self.whole
    }
}
