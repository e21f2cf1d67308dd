//! Eigenvalues of a symmetric pencil, and what remains of a matrix on the complement of a few directions; dense, by faer.

use faer::linalg::solvers::Solve;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Mat, Par, Side};

use super::FactorizationError;
use super::bunch_kaufman::{self, Pivot};

/// A dense symmetric matrix by rows, both triangles filled.
#[derive(Debug, Clone, PartialEq)]
pub struct Symmetric {
    /// Number of rows.
    pub order: usize,
    /// Values.
    pub values: Vec<f64>,
}

impl Symmetric {
    /// Of zeros.
    pub fn zeros(order: usize) -> Self {
        Symmetric { order, values: vec![0.0; order * order] }
    }

    /// Adds a value at (row, column) and at (column, row), once on the diagonal.
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        self.values[row * self.order + column] += value;
        if row != column {
            self.values[column * self.order + row] += value;
        }
    }

    fn at(&self, row: usize, column: usize) -> f64 {
        self.values[row * self.order + column]
    }

    /// Self times a vector.
    pub fn times(&self, vector: &[f64]) -> Vec<f64> {
        let dot = |row: &[f64]| row.iter().zip(vector).map(|(a, b)| a * b).sum();
        self.values.chunks(self.order.max(1)).map(dot).collect()
    }

    /// Number of negative eigenvalues, by the pivots of one factorisation (Bunch and Kaufman 1977).
    pub fn negative_eigenvalues(&self) -> usize {
        let scales: Vec<f64> = self.scales();
        let scaled = |(at, value): (usize, &f64)| scales[at / self.order] * value * scales[at % self.order];
        let mut matrix: Vec<f64> = self.values.iter().enumerate().map(scaled).collect();
        let mut pivots = vec![Pivot::default(); self.order];
        bunch_kaufman::factor(&mut matrix, &mut pivots).negative
    }

    /// diag^(−1/2); 1 where the diagonal is not positive. Displacements and rotations come in different units.
    fn scales(&self) -> Vec<f64> {
        let scale = |at: usize| if self.at(at, at) > 0.0 { 1.0 / self.at(at, at).sqrt() } else { 1.0 };
        (0..self.order).map(scale).collect()
    }
}

/// The solutions of B φ = μ K φ, the largest μ first.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// μ.
    pub values: Vec<f64>,
    /// φ, with φᵀKφ = 1.
    pub vectors: Vec<Vec<f64>>,
}

/// Solves B φ = μ K φ for K positive definite: the eigenvalues of L⁻¹·B·L⁻ᵀ with K = L·Lᵀ (Golub and Van Loan, *Matrix Computations*, §8.7).
///
/// ```
/// use ribopt::linear_algebra::pencil::{Symmetric, spectrum};
/// let k = Symmetric { order: 2, values: vec![2.0, 0.0, 0.0, 1.0] };
/// let b = Symmetric { order: 2, values: vec![0.0, 1.0, 1.0, 0.0] };
/// let found = spectrum(&k, &b).unwrap();
/// assert!((found.values[0] - 0.5f64.sqrt()).abs() < 1e-15);
/// ```
///
/// # Errors
/// K is not positive definite.
pub fn spectrum(k: &Symmetric, b: &Symmetric) -> Result<Spectrum, FactorizationError> {
    let (order, scales) = (k.order, k.scales());
    let scaled = |matrix: &Symmetric| Mat::from_fn(order, order, |i, j| scales[i] * matrix.at(i, j) * scales[j]);
    let factor = scaled(k).llt(Side::Lower).map_err(|_| FactorizationError::Library("it is not positive definite".into()))?;
    let mut reduced = scaled(b);
    solve_lower_triangular_in_place(factor.L(), reduced.as_mut(), Par::Seq);
    let mut reduced = reduced.transpose().to_owned();
    solve_lower_triangular_in_place(factor.L(), reduced.as_mut(), Par::Seq);
    let failed = |_| FactorizationError::Library("its eigenvalues do not converge".into());
    let found = reduced.self_adjoint_eigen(Side::Lower).map_err(failed)?;
    let mut vectors = found.U().to_owned();
    faer::linalg::triangular_solve::solve_upper_triangular_in_place(factor.L().transpose(), vectors.as_mut(), Par::Seq);
    let ascending = found.S().column_vector();
    let values = (0..order).rev().map(|at| ascending[at]).collect();
    let vector = |at: usize| (0..order).map(|i| scales[i] * vectors[(i, at)]).collect();
    Ok(Spectrum { values, vectors: (0..order).rev().map(vector).collect() })
}

/// The bordered system [S C; Cᵀ 0].
pub struct Bordered {
    factors: faer::linalg::solvers::PartialPivLu<f64>,
    scales: Vec<f64>,
    columns: usize,
}

impl Bordered {
    /// Of a symmetric matrix and the columns of C.
    pub fn new(s: &Symmetric, columns: &[Vec<f64>], scales_of: &Symmetric) -> Self {
        let (order, scales) = (s.order, scales_of.scales());
        let whole = Mat::from_fn(order + columns.len(), order + columns.len(), |i, j| match (i < order, j < order) {
            (true, true) => scales[i] * s.at(i, j) * scales[j],
            (true, false) => scales[i] * columns[j - order][i],
            (false, true) => scales[j] * columns[i - order][j],
            (false, false) => 0.0,
        });
        Bordered { factors: whole.partial_piv_lu(), scales, columns: columns.len() }
    }

    /// The w that makes wᵀSw stationary over Cᵀw = v.
    pub fn stationary(&self, v: &[f64]) -> Vec<f64> {
        let order = self.scales.len();
        let mut right = Mat::from_fn(order + self.columns, 1, |i, _| if i < order { 0.0 } else { v[i - order] });
        self.factors.solve_in_place(right.as_mut());
        (0..order).map(|i| self.scales[i] * right[(i, 0)]).collect()
    }

    /// P·R for columns R, with P the upper left block of the inverse.
    pub fn project(&self, right: &[Vec<f64>]) -> Vec<Vec<f64>> {
        let order = self.scales.len();
        let place = |i: usize, j: usize| if i < order { self.scales[i] * right[j][i] } else { 0.0 };
        let mut all = Mat::from_fn(order + self.columns, right.len(), place);
        self.factors.solve_in_place(all.as_mut());
        (0..right.len()).map(|j| (0..order).map(|i| self.scales[i] * all[(i, j)]).collect()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn vectors_solve_the_pencil_and_are_normal() {
        let k = Symmetric { order: 3, values: vec![4.0, 1.0, 0.0, 1.0, 3.0, 0.5, 0.0, 0.5, 2e6] };
        let b = Symmetric { order: 3, values: vec![1.0, -0.3, 0.2, -0.3, 0.5, 0.1, 0.2, 0.1, -1.0] };
        let found = spectrum(&k, &b).unwrap();
        for (mu, phi) in found.values.iter().zip(&found.vectors) {
            let (left, right) = (b.times(phi), k.times(phi));
            let norm: f64 = phi.iter().zip(&right).map(|(a, b)| a * b).sum();
            assert!((norm - 1.0).abs() < 1e-13);
            assert!(left.iter().zip(&right).all(|(left, right)| (left - mu * right).abs() < 1e-12));
        }
        assert!(found.values.is_sorted_by(|a, b| a >= b));
    }

    /// Of diag(1, 2, 5) the part seen over the first two directions is itself.
    #[test]
    fn bordered_systems_see_the_complement() {
        let s = Symmetric { order: 3, values: vec![1.0, 0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 5.0] };
        let columns = vec![vec![1.0, 0.0, 0.0], vec![0.0, 1.0, 0.0]];
        let bordered = Bordered::new(&s, &columns, &s);
        assert_eq!(bordered.stationary(&[0.6, 0.8]), vec![0.6, 0.8, 0.0]);
        let projected = bordered.project(&[vec![1.0, 1.0, 1.0]]);
        assert!((projected[0][2] - 0.2).abs() < 1e-15 && projected[0][0].abs() < 1e-15);
    }
}
