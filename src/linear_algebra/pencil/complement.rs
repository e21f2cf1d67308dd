//! What remains of a matrix on the complement of a few directions.

use super::Matrix;
use crate::linear_algebra::{FactorizationError, Pattern, SymmetricSolver};

/// The system [S C; Cᵀ 0] for a symmetric S, singular or not, and a few columns C.
pub struct Complement {
    solver: SymmetricSolver,
    scales: Vec<f64>,
    columns: usize,
}

impl Complement {
    /// Of S and the columns of C; `scales_of` has S's units on its diagonal.
    ///
    /// # Errors
    /// A value is no number, or the columns leave the system singular.
    pub fn new(s: &Matrix, columns: &[Vec<f64>], scales_of: &Matrix) -> Result<Self, FactorizationError> {
        let (order, scales) = (s.order(), scales_of.scales());
        let mut positions: Vec<(u32, u32)> = s.pattern.iter().map(|(i, j)| (i as u32, j as u32)).collect();
        let mut values = s.scaled(&scales);
        for (at, column) in columns.iter().enumerate() {
            positions.extend((0..order).map(|i| ((order + at) as u32, i as u32)));
            values.extend(column.iter().zip(&scales).map(|(value, scale)| value * scale));
        }
        // Rows stand in order already: those of S as in its pattern, those of C after them.
        let pattern = Pattern::from_positions(order + columns.len(), &mut positions);
        let mut solver = SymmetricSolver::new(&pattern.offsets, &pattern.columns)?;
        solver.factor(&values)?;
        Ok(Complement { solver, scales, columns: columns.len() })
    }

    /// The order of S.
    pub fn order(&self) -> usize {
        self.scales.len()
    }

    /// The w that makes wᵀSw stationary over Cᵀw = v.
    ///
    /// # Errors
    /// The system is singular.
    pub fn stationary(&self, v: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let mut right = vec![0.0; self.scales.len()];
        right.extend(v);
        self.solved(&right)
    }

    /// P·r, with P the upper left block of the inverse.
    ///
    /// # Errors
    /// The system is singular.
    pub fn project(&self, r: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let mut right: Vec<f64> = r.iter().zip(&self.scales).map(|(value, scale)| value * scale).collect();
        right.resize(self.scales.len() + self.columns, 0.0);
        self.solved(&right)
    }

    fn solved(&self, right: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        let mut x = vec![0.0; right.len()];
        self.solver.solve(right, &mut x)?;
        Ok(x.iter().zip(&self.scales).map(|(value, scale)| value * scale).collect())
    }
}
