//! Factors without pivoting where they will do, with pivoting where not.

use feral::CscMatrix;

use super::quasi_definite::QuasiDefiniteSolver;
use super::sparse::SparseSolver;
use super::{FactorizationError, Inertia};

/// Failures after which every matrix is factorised with pivoting at once.
const MOST_FAILURES: usize = 3;

/// Both solvers, each analysed when it is first needed.
#[derive(Default)]
pub(super) struct GuardedSolver {
    unpivoted: Option<Box<QuasiDefiniteSolver>>,
    pivoted: SparseSolver,
    /// Whether the factors found last are pivoted.
    is_pivoted: bool,
    failures: usize,
}

impl GuardedSolver {
    /// Factorises. Every matrix must have the same pattern.
    pub fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        if self.failures < MOST_FAILURES {
            if let Ok(inertia) = self.factor_unpivoted(matrix) {
                self.is_pivoted = false;
                return Ok(inertia);
            }
            self.failures += 1;
        }
        self.is_pivoted = true;
        self.pivoted.factor(matrix)
    }

    fn factor_unpivoted(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        let solver = match &mut self.unpivoted {
            Some(solver) => solver,
            None => self.unpivoted.insert(Box::new(QuasiDefiniteSolver::new(matrix)?)),
        };
        solver.factor(matrix)
    }

    /// x = A⁻¹·right for the matrix factorised last, without refinement.
    pub fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        match &self.unpivoted {
            Some(solver) if !self.is_pivoted => solver.solve_once(right, x),
            _ => self.pivoted.solve_once(right, x),
        }
    }
}
