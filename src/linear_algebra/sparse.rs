//! The sparse factorisation of larger symmetric matrices (multifrontal Bunch–Kaufman).

use feral::numeric::solver::FactorStatus;
use feral::symbolic::OrderingMethod;
use feral::{CscMatrix, FeralError, RefineOptions, Solver};

use super::ordering::fill_reducing;
use super::{FactorizationError, Inertia};

/// Up to this order the library's own choice of an order is cheap and good.
const LARGEST_AUTOMATIC: usize = 10_000;

/// A factorisation analysed at the first call.
#[derive(Default)]
pub(super) struct SparseSolver {
    solver: Option<Box<Solver>>,
}

impl SparseSolver {
    /// Factorises; analyses the pattern before that the first time. Every matrix must have the same pattern.
    pub fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        let solver = self.solver.get_or_insert_with(|| Box::new(prepared(matrix)));
        match solver.factor(matrix, None) {
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

fn prepared(matrix: &CscMatrix) -> Solver {
    if matrix.n <= LARGEST_AUTOMATIC {
        return Solver::new();
    }
    Solver::new().with_ordering(fill_reducing(matrix).map_or(OrderingMethod::Amd, OrderingMethod::External))
}

fn failed(error: FeralError) -> FactorizationError {
    FactorizationError::Library(error.to_string())
}
