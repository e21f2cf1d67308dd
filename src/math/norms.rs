//! Vector and matrix norms, note 1.1 and 1.2, for real and complex entries (`f64` or `Complex<f64>`).
//!
//! All of them scale by the largest modulus first, so that entries near 1e±200 neither overflow nor vanish.
//! A NaN entry makes the norm NaN; otherwise an infinite one makes it infinite. An empty vector or matrix has norm 0.

use nalgebra::{ComplexField, DMatrix, DVector};

use super::quadrature::{Integral, QuadratureError, integrate};

/// Entries of a vector or matrix: `f64` or `Complex<f64>`.
pub trait Entry: ComplexField<RealField = f64> {}

impl<T: ComplexField<RealField = f64>> Entry for T {}

/// The ℓ² norm √Σ|x_k|² of a real or complex vector, note (1.1.2) and (1.1.3).
///
/// ```
/// use nalgebra::Complex;
/// use ribopt::math::norms::l2;
/// assert_eq!(l2(&[2.0, 3.0, 6.0]), 7.0);
/// assert_eq!(l2(&[Complex::new(3.0, 4.0), Complex::new(0.0, 12.0)]), 13.0);
/// assert!((l2(&[3e200, 4e200]) / 5e200 - 1.0).abs() < 1e-15);
/// ```
pub fn l2<T: Entry>(x: &[T]) -> f64 {
    scaled(x, |x| DVector::from_column_slice(x).norm())
}

/// The L² norm √∫|φ|² dx of a function on the interval from a to b, note (1.1.4) (which leaves the interval out), with an
/// estimate of its error. `tolerance` is relative to the norm squared.
///
/// ```
/// use ribopt::math::norms::l2_of_function;
/// let norm = l2_of_function(f64::sin, 0.0, std::f64::consts::PI, 1e-12)?;
/// assert!((norm.value - (std::f64::consts::PI / 2.0).sqrt()).abs() <= 1e-12);
/// assert!(norm.error <= 1e-12);
/// # Ok::<(), ribopt::math::quadrature::QuadratureError>(())
/// ```
///
/// # Errors
/// As [`integrate`]; an interval with a > b is refused.
pub fn l2_of_function<T: Entry>(phi: impl Fn(f64) -> T, a: f64, b: f64, tolerance: f64) -> Result<Integral, QuadratureError> {
    if a > b {
        return Err(QuadratureError::Interval { a, b });
    }
    // A first guess of the size, so that |φ|² stays in range.
    let middle = |k: u32| a + (b - a) * (f64::from(k) + 0.5) / 16.0;
    let size = (0..16).map(|k| phi(middle(k)).modulus()).filter(|size| size.is_finite()).fold(0.0, f64::max);
    let size = if size > 0.0 { size } else { 1.0 };
    let square = integrate(|x| (phi(x).modulus() / size).powi(2), a, b, tolerance)?;
    let value = square.value.max(0.0).sqrt();
    // √(I + e) − √I without cancellation.
    let error = square.error / ((square.value + square.error).max(f64::MIN_POSITIVE).sqrt() + value);
    Ok(Integral { value: size * value, error: size * error, evaluations: square.evaluations + 16 })
}

/// The largest absolute column sum of an m×n matrix, note (1.2.1).
///
/// ```
/// assert_eq!(ribopt::math::norms::one(&nalgebra::dmatrix![1.0, -2.0; 3.0, 4.0]), 6.0);
/// ```
pub fn one<T: Entry>(a: &DMatrix<T>) -> f64 {
    largest(a.column_iter().map(|column| column.iter().map(|entry| entry.clone().modulus()).sum()))
}

/// The largest absolute row sum of an m×n matrix, note (1.2.2).
///
/// ```
/// assert_eq!(ribopt::math::norms::infinity(&nalgebra::dmatrix![1.0, -2.0; 3.0, 4.0]), 7.0);
/// ```
pub fn infinity<T: Entry>(a: &DMatrix<T>) -> f64 {
    largest(a.row_iter().map(|row| row.iter().map(|entry| entry.clone().modulus()).sum()))
}

/// The spectral norm of an m×n matrix, the square root of the largest eigenvalue of AᴴA (1.2.3): its largest singular value.
///
/// ‖A‖₂ ≤ ‖A‖_F, with equality exactly where A has rank one or is zero (the note's sentence at 1.2.4 has lost its left side).
///
/// ```
/// let a = nalgebra::dmatrix![3.0, 0.0; 4.0, 5.0];
/// assert!((ribopt::math::norms::spectral(&a) - 45f64.sqrt()).abs() < 1e-14);
/// ```
pub fn spectral<T: Entry>(a: &DMatrix<T>) -> f64 {
    let (rows, columns) = a.shape();
    let of_finite = |entries: &[T]| {
        let a = DMatrix::from_column_slice(rows, columns, entries);
        a.try_svd(false, false, f64::EPSILON, 0).map_or(f64::NAN, |svd| svd.singular_values.max())
    };
    scaled(a.as_slice(), of_finite)
}

/// The Frobenius norm √ΣΣ|a_ij|² of an m×n matrix, note (1.2.5).
///
/// ```
/// assert_eq!(ribopt::math::norms::frobenius(&nalgebra::dmatrix![1.0, 2.0; 2.0, 4.0]), 5.0);
/// ```
pub fn frobenius<T: Entry>(a: &DMatrix<T>) -> f64 {
    l2(a.as_slice())
}

/// The Frobenius norm by the trace, √tr(A·Aᴴ), note (1.2.6). Forms the m×m product: [`frobenius`] is the one to use.
///
/// ```
/// assert_eq!(ribopt::math::norms::frobenius_by_trace(&nalgebra::dmatrix![1.0, 2.0; 2.0, 4.0]), 5.0);
/// ```
pub fn frobenius_by_trace<T: Entry>(a: &DMatrix<T>) -> f64 {
    let (rows, columns) = a.shape();
    let of_finite = |entries: &[T]| {
        let a = DMatrix::from_column_slice(rows, columns, entries);
        (&a * a.adjoint()).trace().modulus().sqrt()
    };
    scaled(a.as_slice(), of_finite)
}

/// `norm` of the entries divided by their largest modulus, multiplied back.
fn scaled<T: Entry>(entries: &[T], norm: impl Fn(&[T]) -> f64) -> f64 {
    let size = largest(entries.iter().map(|entry| entry.clone().modulus()));
    if size == 0.0 || !size.is_finite() {
        return size;
    }
    // A power of two: dividing by it costs no digit. The clamp keeps it a normal number.
    let exponent = size.log2().floor().clamp(-1000.0, 1000.0);
    let size = exponent.exp2();
    let entries: Vec<T> = entries.iter().map(|entry| entry.clone().unscale(size)).collect();
    norm(&entries) * size
}

/// The largest of some moduli: 0 of none, NaN if any is.
fn largest(moduli: impl Iterator<Item = f64>) -> f64 {
    moduli.fold(0.0, |largest, next| if next.is_nan() || largest.is_nan() { f64::NAN } else { next.max(largest) })
}

#[cfg(test)]
#[path = "norms_tests.rs"]
mod tests;
