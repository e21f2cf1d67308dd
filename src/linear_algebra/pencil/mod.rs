//! Eigenvalues of a symmetric pencil, and what remains of a matrix on the complement of a few directions.

mod complement;
mod full;
mod lanczos;
mod matrix;
#[cfg(test)]
mod tests;

pub use complement::Complement;
pub use matrix::Matrix;

use super::FactorizationError;

/// Up to this order all solutions are found at once by dense factors: faster than the few that are asked for by sparse ones.
const SMALL: usize = 200;

/// μ below this share of the largest |μ| are zero but for rounding.
const NEGLIGIBLE: f64 = 1e-12;

/// Solutions of B φ = μ K φ, the largest μ first.
#[derive(Debug, Clone, PartialEq)]
pub struct Spectrum {
    /// μ.
    pub values: Vec<f64>,
    /// φ, with φᵀKφ = 1.
    pub vectors: Vec<Vec<f64>>,
}

/// The solutions of B φ = μ K φ with the largest positive μ, at least `count` of them where there are as many: μ within rounding of zero
/// are none. K is positive definite.
///
/// ```
/// use ribopt::linear_algebra::pencil::{Matrix, spectrum};
/// let k = Matrix::of(2, &[(0, 0, 2.0), (1, 1, 1.0)]);
/// let b = Matrix::of(2, &[(1, 0, 1.0)]);
/// let found = spectrum(&k, &b, 1).unwrap();
/// assert!((found.values[0] - 0.5f64.sqrt()).abs() < 1e-15);
/// ```
///
/// # Errors
/// [`FactorizationError::Singular`] where K is not positive definite; else the iteration does not converge.
pub fn spectrum(k: &Matrix, b: &Matrix, count: usize) -> Result<Spectrum, FactorizationError> {
    if k.order() <= SMALL { full::spectrum(k, b) } else { lanczos::spectrum(k, b, count) }
}

fn not_converging() -> FactorizationError {
    FactorizationError::Library("its eigenvalues do not converge".into())
}

/// aᵀb, in eight sums beside one another: one sum waits for itself at every term.
fn dot(a: &[f64], b: &[f64]) -> f64 {
    let mut sums = [0.0; 8];
    let (a, b) = (a.chunks_exact(8), b.chunks_exact(8));
    let rest: f64 = a.remainder().iter().zip(b.remainder()).map(|(a, b)| a * b).sum();
    for (a, b) in a.zip(b) {
        (0..8).for_each(|at| sums[at] += a[at] * b[at]);
    }
    sums.iter().sum::<f64>() + rest
}
