//! Sparse symmetric matrices put together from entries.

use crate::linear_algebra::blocks::BlockSolver;
use crate::linear_algebra::{FactorizationError, Inertia, SymmetricSolver};
use crate::model::Pattern;

/// A lower triangle whose positions are fixed and whose values change.
pub(super) struct Symmetric {
    places: Vec<usize>,
    values: Vec<f64>,
    solver: Solver,
}

/// Many small blocks by themselves, anything else as a whole.
enum Solver {
    Blocks(BlockSolver),
    Sparse(SymmetricSolver),
}

impl Symmetric {
    /// A matrix of this order with entries at these positions (either triangle, repeats are added up).
    pub(super) fn new(order: usize, positions: &[(u32, u32)]) -> Result<Self, FactorizationError> {
        let lower = |&(i, j): &(u32, u32)| (i.max(j), i.min(j));
        let mut sorted = positions.iter().map(lower).collect();
        let pattern = Pattern::from_positions(order, &mut sorted);
        let place = |(row, column): (u32, u32)| pattern.position(row as usize, column).unwrap_or_default();
        let places = positions.iter().map(lower).map(place).collect();
        let solver = match BlockSolver::new(&pattern.offsets, &pattern.columns) {
            Some(blocks) => Solver::Blocks(blocks),
            None => Solver::Sparse(SymmetricSolver::new(&pattern.offsets, &pattern.columns)?),
        };
        Ok(Symmetric { places, values: vec![0.0; pattern.len()], solver })
    }

    /// Factorises with these values, one per position given.
    pub(super) fn factor(&mut self, entries: impl Iterator<Item = f64>) -> Result<Inertia, FactorizationError> {
        self.values.fill(0.0);
        for (&place, entry) in self.places.iter().zip(entries) {
            self.values[place] += entry;
        }
        match &mut self.solver {
            Solver::Blocks(solver) => solver.factor(&self.values),
            Solver::Sparse(solver) => solver.factor(&self.values),
        }
    }

    /// Solves with the factors found last.
    pub(super) fn solve(&self, right: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let mut x = vec![0.0; right.len()];
        match &self.solver {
            Solver::Blocks(solver) => solver.solve(right, &mut x),
            Solver::Sparse(solver) => solver.solve(right, &mut x)?,
        }
        Ok(x)
    }
}
