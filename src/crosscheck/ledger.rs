//! Who has run how often and what it cost; every run whose answer can win is observed.

use super::session::{Session, Solver, refused};
use super::{Answer, ObserverFactory, work};
use crate::backends::Iteration;

/// All runs of one cross-check.
pub(super) struct Ledger<'r, 'o> {
    pub(super) session: &'r Session<'r>,
    pub(super) solvers: &'r [Solver<'r>],
    observers: &'r mut ObserverFactory<'o>,
    attempts: Vec<usize>,
    /// Work of each backend's first run.
    first: Vec<f64>,
    /// Attempts whose further runs ended where the ones before did.
    settled: Vec<bool>,
}

impl<'r, 'o> Ledger<'r, 'o> {
    pub(super) fn new(session: &'r Session<'r>, solvers: &'r [Solver<'r>], observers: &'r mut ObserverFactory<'o>) -> Self {
        let count = solvers.len();
        Ledger { session, solvers, observers, attempts: vec![0; count], first: vec![0.0; count], settled: vec![false; count] }
    }

    /// Backends in the order they run: as given, but those that cost many times what the cheapest does come last.
    pub(super) fn order(&self) -> Vec<usize> {
        order(&self.solvers.iter().map(|&solver| self.session.cost(solver)).collect::<Vec<_>>())
    }

    /// Solves with backend k from `start` (user's variables), with so much work.
    pub(super) fn run(&mut self, k: usize, start: &[f64], allowed: f64) -> Answer {
        let (session, solver) = (self.session, self.solvers[k]);
        let multipliers = if self.attempts[k] == 0 { session.task.start_multipliers } else { None };
        let budget = session.budget(solver, session.task.model_for(solver.backend), allowed);
        self.attempts[k] += 1;
        let mut observer: Box<dyn FnMut(&Iteration<'_>) + '_> = (self.observers)(k, solver.algorithm);
        let mut answer = session.attempt(solver, start, multipliers, budget, &mut observer);
        answer.attempt = if answer.attempt == 0 { 0 } else { self.attempts[k] };
        if self.attempts[k] == 1 {
            self.first[k] = work::of(&answer, session.cost(solver));
        }
        answer
    }

    /// An answer of a backend that is not run, and why.
    pub(super) fn not_run(&self, k: usize, why: String) -> Answer {
        let (session, solver) = (self.session, self.solvers[k]);
        Answer::unjudged(solver.backend.name(), refused(solver.algorithm, session.task.start, why))
    }

    /// What the first run of backend k cost.
    pub(super) fn first_work(&self, k: usize) -> f64 {
        self.first[k]
    }

    /// What the cheapest first run cost.
    pub(super) fn least_first_work(&self) -> f64 {
        self.first.iter().copied().filter(|&work| work > 0.0).reduce(f64::min).unwrap_or(0.0)
    }

    /// Whether further runs of backend k end where it is.
    pub(super) fn is_settled(&self, k: usize) -> bool {
        self.settled[k]
    }

    pub(super) fn settle(&mut self, k: usize) {
        self.settled[k] = true;
    }
}

/// How many times the cheapest backend's cost makes a backend wait for the others.
const DEAR: f64 = 3.0;

fn order(costs: &[f64]) -> Vec<usize> {
    let cheapest = costs.iter().copied().fold(f64::INFINITY, f64::min);
    let (cheap, dear): (Vec<usize>, Vec<usize>) = (0..costs.len()).partition(|&k| costs[k] <= DEAR * cheapest);
    cheap.into_iter().chain(dear).collect()
}

#[cfg(test)]
mod tests {
    use super::order;

    #[test]
    fn backends_run_as_given_unless_one_is_dear() {
        assert_eq!(order(&[3.0, 1.0, 2.0]), [0, 1, 2]);
        assert_eq!(order(&[30.0, 1.0, 2.0]), [1, 2, 0]);
    }
}
