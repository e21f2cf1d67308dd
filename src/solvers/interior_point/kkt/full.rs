//! The KKT matrix factorised as it is.

use super::system::System;
use crate::linear_algebra::{FactorizationError, Inertia, SymmetricSolver};
use crate::model::Pattern;

/// Factors, and where the system's values stand in the matrix.
pub(super) struct Full {
    solver: SymmetricSolver,
    values: Vec<f64>,
    hessian_places: Vec<usize>,
    jacobian_places: Vec<usize>,
    diagonal_places: Vec<usize>,
}

impl Full {
    /// Analyses the pattern.
    pub fn new(system: &System) -> Result<Self, FactorizationError> {
        let n = system.primal.len();
        let mut pattern = Pattern::default();
        let (mut hessian_places, mut jacobian_places, mut diagonal_places) = (Vec::new(), Vec::new(), Vec::new());
        for row in 0..n {
            for &column in system.hessian.row(row).iter().filter(|&&column| (column as usize) < row) {
                hessian_places.push(pattern.columns.len());
                pattern.columns.push(column);
            }
            if system.hessian.row(row).last() == Some(&(row as u32)) {
                hessian_places.push(pattern.columns.len());
            }
            diagonal_places.push(pattern.columns.len());
            pattern.columns.push(row as u32);
            pattern.offsets.push(pattern.columns.len());
        }
        for row in 0..system.dual.len() {
            for &column in system.jacobian.row(row) {
                jacobian_places.push(pattern.columns.len());
                pattern.columns.push(column);
            }
            diagonal_places.push(pattern.columns.len());
            pattern.columns.push((n + row) as u32);
            pattern.offsets.push(pattern.columns.len());
        }
        let solver = SymmetricSolver::new(&pattern.offsets, &pattern.columns)?;
        Ok(Full { solver, values: vec![0.0; pattern.len()], hessian_places, jacobian_places, diagonal_places })
    }

    /// Factorises the system's values.
    pub fn factor(&mut self, system: &System) -> Result<Inertia, FactorizationError> {
        self.values.fill(0.0);
        for (&place, value) in self.hessian_places.iter().zip(&system.hessian_values) {
            self.values[place] += value;
        }
        for (&place, value) in self.jacobian_places.iter().zip(&system.jacobian_values) {
            self.values[place] = *value;
        }
        let diagonal = system.primal.iter().copied().chain(system.dual.iter().map(|dual| -dual));
        for (&place, value) in self.diagonal_places.iter().zip(diagonal) {
            self.values[place] += value;
        }
        self.solver.factor(&self.values)
    }

    /// Solves with the factors found last.
    pub fn solve(&self, right: &[f64], solution: &mut [f64]) -> Result<(), FactorizationError> {
        self.solver.solve(right, solution)
    }
}
