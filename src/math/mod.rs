//! Chapter 1 of the note: norms, determinants, Kronecker product, polynomials, rotations.
//!
//! Where nalgebra has the thing, the function here is a named door to it; vectors and matrices are nalgebra's.

pub mod banded;
pub mod determinant;
pub mod kronecker;
pub mod norms;
pub mod polynomial;
pub mod quadrature;
pub mod rotation;
pub mod special;
pub mod split_mix;

pub use determinant::{determinant, inverse, signed_area, signed_volume};
pub use kronecker::kronecker;
pub use polynomial::Polynomial;
pub use quadrature::integrate;
