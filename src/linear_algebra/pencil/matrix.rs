//! A sparse symmetric matrix.

use std::sync::Arc;

use crate::linear_algebra::{Effort, FactorizationError, Pattern, SymmetricSolver};

/// A sparse symmetric matrix: the values along its lower triangle by rows.
#[derive(Debug, Clone)]
pub struct Matrix {
    /// Where entries stand; matrices of one pencil share it.
    pub pattern: Arc<Pattern>,
    /// Values along the pattern.
    pub values: Vec<f64>,
}

impl Matrix {
    /// Of zeros.
    pub fn zeros(pattern: Arc<Pattern>) -> Self {
        Matrix { values: vec![0.0; pattern.len()], pattern }
    }

    /// From entries (row, column, value) of either triangle; repeats are added up.
    pub fn of(order: usize, entries: &[(u32, u32, f64)]) -> Self {
        let lower = |&(i, j, _): &(u32, u32, f64)| (i.max(j), i.min(j));
        let pattern = Arc::new(Pattern::from_positions(order, &mut entries.iter().map(lower).collect()));
        let mut matrix = Matrix::zeros(pattern);
        for entry in entries {
            let (row, column) = lower(entry);
            // Every position was announced above.
            let place = matrix.pattern.position(row as usize, column).unwrap_or_default();
            matrix.values[place] += entry.2;
        }
        matrix
    }

    /// Number of rows.
    pub fn order(&self) -> usize {
        self.pattern.rows()
    }

    /// Self times a vector.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; vector.len()];
        self.pattern.multiply_symmetric(&self.values, vector, &mut product);
        product
    }

    /// Number of negative eigenvalues, by the pivots of one factorisation (Sylvester's law of inertia).
    ///
    /// # Errors
    /// A value is no number, or a pivot is zero.
    pub fn negative_eigenvalues(&self) -> Result<usize, FactorizationError> {
        let mut solver = SymmetricSolver::new(&self.pattern.offsets, &self.pattern.columns)?;
        Ok(solver.certain_inertia(&self.scaled(&self.scales()), Effort::Any)?.negative)
    }

    /// Self + share·other, of one pattern.
    pub fn plus(&self, share: f64, other: &Matrix) -> Matrix {
        let values = self.values.iter().zip(&other.values).map(|(a, b)| a + share * b).collect();
        Matrix { pattern: Arc::clone(&self.pattern), values }
    }

    /// diag^(−1/2); 1 where the diagonal is not positive. Displacements and rotations come in different units.
    pub(super) fn scales(&self) -> Vec<f64> {
        let diagonal = |at: usize| self.pattern.position(at, at as u32).map_or(0.0, |place| self.values[place]);
        let scale = |at: usize| if diagonal(at) > 0.0 { 1.0 / diagonal(at).sqrt() } else { 1.0 };
        (0..self.order()).map(scale).collect()
    }

    /// Values of diag(scales)·self·diag(scales).
    pub(super) fn scaled(&self, scales: &[f64]) -> Vec<f64> {
        self.pattern.iter().zip(&self.values).map(|((i, j), value)| scales[i] * value * scales[j]).collect()
    }
}
