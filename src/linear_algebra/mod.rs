//! Sparse symmetric factorisation, by libraries (feral for indefinite matrices, faer for quasi-definite ones), behind an interface of
//! our own.
//!
//! A leaf: it knows index slices and values, nothing of models. Patterns are lower triangles compressed by rows,
//! the layout of [`crate::model::Pattern`], so `SymmetricSolver::new(&pattern.offsets, &pattern.columns)` fits one.

pub mod blocks;
pub mod bunch_kaufman;
pub mod cholesky;
pub mod congruence;
mod dense;
mod guarded;
mod ordering;
mod quasi_definite;
mod sparse;
mod symmetric;

pub use symmetric::{FactorizationError, Inertia, SymmetricSolver};
