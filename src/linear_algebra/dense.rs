//! The dense factorisation of small symmetric matrices (Bunch–Kaufman).

use feral::{BunchKaufmanParams, CscMatrix, Factors, FeralError, SymmetricMatrix, ZeroPivotAction};

use super::{FactorizationError, Inertia};

/// Up to this order dense is faster than sparse, whatever the pattern.
pub(super) const LARGEST_ORDER: usize = 24;

/// A small matrix and its factors.
pub(super) struct DenseSolver {
    matrix: SymmetricMatrix,
    factors: Option<Factors>,
    parameters: BunchKaufmanParams,
}

impl DenseSolver {
    /// Room for a matrix of this order.
    pub fn new(order: usize) -> Self {
        // A zero pivot is counted, not refused: the caller wants the inertia.
        let parameters = BunchKaufmanParams { on_zero_pivot: ZeroPivotAction::ForceAccept, ..BunchKaufmanParams::default() };
        DenseSolver { matrix: SymmetricMatrix::zeros(order), factors: None, parameters }
    }

    /// Factorises.
    pub fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        self.matrix.data.fill(0.0);
        for column in 0..matrix.n {
            for at in matrix.col_ptr[column]..matrix.col_ptr[column + 1] {
                self.matrix.set(matrix.row_idx[at], column, matrix.values[at]);
            }
        }
        self.factors = None;
        let (factors, inertia) = feral::factor(&self.matrix, &self.parameters).map_err(failed)?;
        self.factors = Some(factors);
        Ok(Inertia::of(&inertia))
    }

    /// Solves, with refinement.
    pub fn solve(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        let factors = self.factors.as_ref().ok_or(FactorizationError::Singular)?;
        let solution = feral::solve_refined(&self.matrix, factors, right).map_err(failed)?;
        x.copy_from_slice(&solution);
        Ok(())
    }
}

fn failed(error: FeralError) -> FactorizationError {
    FactorizationError::Library(error.to_string())
}
