//! All solutions at once, by dense factors of faer.

use faer::linalg::triangular_solve::{solve_lower_triangular_in_place, solve_upper_triangular_in_place};
use faer::{Mat, Par, Side};

use super::{Matrix, NEGLIGIBLE, Spectrum, not_converging};
use crate::linear_algebra::FactorizationError;

/// The eigenvalues of L⁻¹·B·L⁻ᵀ with K = L·Lᵀ (Golub and Van Loan, *Matrix Computations*, §8.7).
pub(super) fn spectrum(k: &Matrix, b: &Matrix) -> Result<Spectrum, FactorizationError> {
    let (order, scales) = (k.order(), k.scales());
    let factor = dense(k, &scales).llt(Side::Lower).map_err(|_| FactorizationError::Singular)?;
    let mut reduced = dense(b, &scales);
    solve_lower_triangular_in_place(factor.L(), reduced.as_mut(), Par::Seq);
    let mut reduced = reduced.transpose().to_owned();
    solve_lower_triangular_in_place(factor.L(), reduced.as_mut(), Par::Seq);
    let found = reduced.self_adjoint_eigen(Side::Lower).map_err(|_| not_converging())?;
    let mut vectors = found.U().to_owned();
    solve_upper_triangular_in_place(factor.L().transpose(), vectors.as_mut(), Par::Seq);
    let ascending = found.S().column_vector();
    let largest = ascending.iter().fold(0.0f64, |largest, mu| largest.max(mu.abs()));
    let first = (0..order).find(|&at| ascending[at] > NEGLIGIBLE * largest).unwrap_or(order);
    let values = (first..order).rev().map(|at| ascending[at]).collect();
    let vector = |at: usize| (0..order).map(|i| scales[i] * vectors[(i, at)]).collect();
    Ok(Spectrum { values, vectors: (first..order).rev().map(vector).collect() })
}

fn dense(matrix: &Matrix, scales: &[f64]) -> Mat<f64> {
    let mut full = Mat::zeros(matrix.order(), matrix.order());
    for ((i, j), value) in matrix.pattern.iter().zip(matrix.scaled(scales)) {
        full[(i, j)] = value;
        full[(j, i)] = value;
    }
    full
}
