//! The sparse factorisation of larger symmetric matrices (multifrontal Bunch–Kaufman, or pivots as they come).

use feral::numeric::solver::FactorStatus;
use feral::scaling::ScalingStrategy;
use feral::symbolic::OrderingMethod;
use feral::{CscMatrix, FeralError, RefineOptions, Solver};

use super::ordering::fill_reducing;
use super::{FactorizationError, Inertia};

/// Up to this order the library's own choice of an order is cheap and good.
const LARGEST_AUTOMATIC: usize = 10_000;

/// How pivots are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pivoting {
    /// By size.
    Threshold,
    /// Not at all, as long as that goes well: a quasi-definite matrix needs no choice (Vanderbei, SIAM J. Optim. 5, 1995).
    Static,
}

/// A factorisation analysed at the first call.
pub(super) struct SparseSolver {
    pivoting: Pivoting,
    solver: Option<Box<Solver>>,
}

impl SparseSolver {
    /// Nothing is done yet.
    pub fn new(pivoting: Pivoting) -> Self {
        SparseSolver { pivoting, solver: None }
    }

    /// Factorises; analyses the pattern before that the first time. Every matrix must have the same pattern.
    pub fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        let solver = self.solver.get_or_insert_with(|| Box::new(prepared(matrix, self.pivoting)));
        let status = solver.factor(matrix, None);
        if self.pivoting == Pivoting::Static && matches!(status, FactorStatus::FatalError(FeralError::SqdContractViolated { .. }))
        {
            *self = SparseSolver::new(Pivoting::Threshold);
            return self.factor(matrix);
        }
        match status {
            FactorStatus::Success | FactorStatus::WrongInertia { .. } => {
                solver.inertia().map(Inertia::of).ok_or(FactorizationError::Singular)
            }
            FactorStatus::Singular => Err(FactorizationError::Singular),
            FactorStatus::FatalError(error) => Err(failed(error)),
        }
    }

    /// Solves, with refinement.
    pub fn solve(&self, matrix: &CscMatrix, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        self.factorised()?.solve_refined_into(matrix, right, x, RefineOptions::default()).map_err(failed)
    }

    /// Solves without refinement.
    pub fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        self.factorised()?.solve_into(right, x).map_err(failed)
    }

    fn factorised(&self) -> Result<&Solver, FactorizationError> {
        self.solver.as_deref().ok_or(FactorizationError::Singular)
    }

    #[cfg(test)]
    pub fn analyses(&self) -> usize {
        self.solver.as_ref().map_or(0, |solver| solver.symbolic_call_count())
    }
}

fn prepared(matrix: &CscMatrix, pivoting: Pivoting) -> Solver {
    let mut solver = Solver::new();
    if matrix.n > LARGEST_AUTOMATIC {
        // Minimum degree copes better with rows that reach far than dissection (half of the fill and less on grids with a row per
        // line, no worse on plain grids, chains and trees).
        solver = solver.with_ordering(fill_reducing(matrix).map_or(OrderingMethod::Amd, OrderingMethod::External));
    }
    match pivoting {
        Pivoting::Threshold => solver,
        Pivoting::Static => solver.with_sqd_mode(true).with_scaling(ScalingStrategy::Identity),
    }
}

fn failed(error: FeralError) -> FactorizationError {
    FactorizationError::Library(error.to_string())
}
