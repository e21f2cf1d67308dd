//! Factors with pivots where the order puts them where they will do, with pivots sought by size where not.

use feral::CscMatrix;

use super::sparse::SparseSolver;
use super::{Effort, FactorizationError, Inertia};

/// Quick factors are given up where failures outnumber successes by this: a failure costs less than a success saves, so that in all no
/// more is lost than these few failures.
const MOST_LOST: isize = 3;

/// Factors of matrices of one pattern.
pub(super) trait Factors {
    /// Factorises a matrix of finite numbers. [`FactorizationError::Singular`] where pivots are lost in rounding.
    fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError>;

    /// x = A⁻¹·right for the matrix factorised last, without refinement.
    fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError>;
}

/// Analyses a matrix for factors of one kind.
type Analysis = fn(&CscMatrix) -> Result<Box<dyn Factors + Send + Sync>, FactorizationError>;

/// Both solvers, each analysed when it is first needed.
pub(super) struct GuardedSolver {
    analyse: Analysis,
    quick: Option<Box<dyn Factors + Send + Sync>>,
    pivoted: SparseSolver,
    /// Whether the factors found last are pivoted by size.
    is_pivoted: bool,
    /// Failures beyond successes.
    lost: isize,
}

impl GuardedSolver {
    /// Quick factors by this analysis.
    pub fn new(analyse: Analysis) -> Self {
        GuardedSolver { analyse, quick: None, pivoted: SparseSolver::default(), is_pivoted: false, lost: 0 }
    }

    /// Factorises. Every matrix must have the same pattern.
    pub fn factor(&mut self, matrix: &CscMatrix, effort: Effort) -> Result<Inertia, FactorizationError> {
        if self.lost < MOST_LOST {
            let quick = self.factor_quickly(matrix);
            self.lost += if quick.is_ok() { -1 } else { 1 };
            if quick.is_ok() || effort == Effort::Quick {
                self.is_pivoted = false;
                return quick;
            }
        }
        self.is_pivoted = true;
        self.pivoted.factor(matrix)
    }

    fn factor_quickly(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        if !matrix.values.iter().all(|value| value.is_finite()) {
            return Err(FactorizationError::Library("a value is no number".into()));
        }
        let solver = match &mut self.quick {
            Some(solver) => solver,
            None => self.quick.insert((self.analyse)(matrix)?),
        };
        solver.factor(matrix)
    }

    /// x = A⁻¹·right for the matrix factorised last, without refinement.
    pub fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        match &self.quick {
            Some(solver) if !self.is_pivoted => solver.solve_once(right, x),
            _ => self.pivoted.solve_once(right, x),
        }
    }
}
