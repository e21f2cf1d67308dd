//! Chapter 1 of the note: norms, determinants, Kronecker product, polynomials, rotations.
//!
//! Where nalgebra has the thing, the function here is a named door to it; vectors and matrices are nalgebra's.

pub mod banded;
pub mod determinant;
pub mod kronecker;
pub mod norms;
pub mod parameters;
pub mod polynomial;
pub mod quadrature;
pub mod rotation;
pub mod special;
pub mod split_mix;

pub use determinant::{determinant, inverse, signed_area, signed_volume};
pub use kronecker::kronecker;
pub use polynomial::Polynomial;
pub use quadrature::integrate;

/// aᵀb
///
/// ```
/// assert_eq!(ribopt::math::dot(&[1.0, 2.0], &[3.0, 4.0]), 11.0);
/// ```
pub fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

/// The value nearest to `value` between two limits, infinite where open: the one way a point is moved inside.
///
/// ```
/// use ribopt::math::within;
/// assert_eq!([within(3.0, 0.0, 2.0), within(-1.0, 0.0, f64::INFINITY), within(1.0, 0.0, 2.0)], [2.0, 0.0, 1.0]);
/// ```
pub fn within(value: f64, lower: f64, upper: f64) -> f64 {
    value.max(lower).min(upper)
}
