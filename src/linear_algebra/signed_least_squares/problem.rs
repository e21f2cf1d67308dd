//! What is to be minimised, column by column.

use crate::linear_algebra::FactorizationError;

/// The proximal weight ε², relative to columns of size one: below the squares of the distances that decide.
pub(super) const PROXIMAL: f64 = 1e-13;

/// One column of B with its sign and weight.
pub struct Column<'a> {
    /// (position in g, value)
    pub entries: &'a [(u32, f64)],
    /// +1: y ≥ 0; −1: y ≤ 0; 0: free.
    pub sign: f64,
    /// The column's entry of T.
    pub weight: f64,
    /// Whether y starts out as free to move.
    pub basic: bool,
}

impl Column<'_> {
    /// bᵀr
    pub fn dot(&self, residual: &[f64]) -> f64 {
        self.entries.iter().map(|&(row, value)| value * residual[row as usize]).sum()
    }
}

/// g + By
pub fn residual(g: &[f64], columns: &[Column<'_>], y: &[f64]) -> Vec<f64> {
    let mut residual = g.to_vec();
    for (column, &y) in columns.iter().zip(y) {
        for &(row, value) in column.entries {
            residual[row as usize] += value * y;
        }
    }
    residual
}

/// Least squares over some of the columns, whatever their signs.
pub(super) trait Stationary {
    /// The minimiser y over the `basic` columns, zero elsewhere, with the proximal term around `centre`. `is_new`: the columns
    /// are others than the last time.
    fn stationary(&mut self, basic: &[bool], is_new: bool, centre: &[f64]) -> Result<Vec<f64>, FactorizationError>;
}
