//! The sparse factorisation of larger symmetric matrices (multifrontal Bunch–Kaufman).

use feral::numeric::solver::FactorStatus;
use feral::symbolic::{OrderingMethod, SupernodeParams};
use feral::{CscMatrix, FeralError, NumericParams, RefineOptions, Solver};

use super::ordering::fill_reducing;
use super::{FactorizationError, Inertia};

/// Up to this order the library's own choice of an order, by the values of the first matrix, costs half of a factor's time and pairs unknowns
/// without a pivot of their own: what is solved with these factors is more exact.
const LARGEST_AUTOMATIC: usize = 10_000;

/// The least pivot, as a share of its column, where L must not grow: by no more than its inverse (Duff & Reid, ACM Trans. Math. Softw. 9,
/// 1983). The library's own choice is 1e-8, which is faster.
const FIRM: f64 = 0.1;

/// A factorisation analysed at the first call.
#[derive(Default)]
pub(super) struct SparseSolver {
    solver: Option<Box<Solver>>,
    /// Whether pivots are sought that are not small beside their columns.
    is_firm: bool,
    /// Whether the order is by the pattern alone.
    is_by_pattern: bool,
}

impl SparseSolver {
    /// In an order by the pattern alone, for few factors of each pattern.
    pub fn by_pattern() -> Self {
        SparseSolver { is_by_pattern: true, ..SparseSolver::default() }
    }

    /// Factorises; analyses the pattern before that the first time. Every matrix must have the same pattern.
    pub fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        let solver = self.solver.get_or_insert_with(|| Box::new(prepared(matrix, self.is_firm, self.is_by_pattern)));
        match solver.factor(matrix, None) {
            FactorStatus::Success | FactorStatus::WrongInertia { .. } => {
                solver.inertia().map(Inertia::of).ok_or(FactorizationError::Singular)
            }
            FactorStatus::Singular => Err(FactorizationError::Singular),
            FactorStatus::FatalError(error) => Err(failed(error)),
        }
    }

    /// Seeks larger pivots from now on. `false`: it did already.
    pub fn make_firm(&mut self) -> bool {
        self.solver = None;
        !std::mem::replace(&mut self.is_firm, true)
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

fn prepared(matrix: &CscMatrix, is_firm: bool, is_by_pattern: bool) -> Solver {
    let mut pivots = NumericParams::default();
    if is_firm {
        pivots.bk.pivot_threshold = FIRM;
    }
    let solver = Solver::with_params(pivots, SupernodeParams::default());
    if !is_by_pattern && matrix.n <= LARGEST_AUTOMATIC {
        return solver;
    }
    solver.with_ordering(fill_reducing(matrix).map_or(OrderingMethod::Amd, OrderingMethod::External))
}

fn failed(error: FeralError) -> FactorizationError {
    FactorizationError::Library(error.to_string())
}
