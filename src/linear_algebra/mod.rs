//! Sparse symmetric factorisation, by libraries (faer, and feral where pivots must be sought far), behind an interface of
//! our own.
//!
//! A leaf: it knows index slices and values, nothing of models. Patterns are lower triangles compressed by rows,
//! the layout of [`Pattern`], so `SymmetricSolver::new(&pattern.offsets, &pattern.columns)` fits one.

pub mod blocks;
pub mod bordered;
pub mod bunch_kaufman;
mod certainty;
pub mod cholesky;
pub mod congruence;
pub mod copositive;
mod dense;
pub mod entries;
mod guarded;
pub mod near_null_space;
pub mod null_space;
mod ordering;
mod outcome;
pub mod partition;
pub mod pattern;
pub mod pencil;
pub mod saddle_point;
pub mod signed_least_squares;
mod sparse;
mod supernodal;
mod symmetric;

pub use outcome::{Effort, FactorizationError, Inertia};
pub use partition::Partition;
pub use pattern::Pattern;
pub use symmetric::SymmetricSolver;
