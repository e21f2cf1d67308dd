//! What every factorisation tells: the inertia, or why there is none.

use thiserror::Error;

/// How many eigenvalues of a symmetric matrix are positive, negative and (numerically) zero.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Inertia {
    /// n₊
    pub positive: usize,
    /// n₋
    pub negative: usize,
    /// n₀
    pub zero: usize,
}

impl Inertia {
    pub(super) fn of(inertia: &feral::Inertia) -> Self {
        Inertia { positive: inertia.positive, negative: inertia.negative, zero: inertia.zero }
    }
}

/// Why there is no factorisation or no solution.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
pub enum FactorizationError {
    /// Offsets, columns or slices do not fit together.
    #[error("the pattern is no lower triangle by rows: {0}")]
    Pattern(String),
    /// The matrix is singular so badly that no factors exist.
    #[error("the matrix is singular")]
    Singular,
    /// The library refused, most often because a value was no number.
    #[error("the factorisation failed: {0}")]
    Library(String),
    /// The factors do not tell the signs of all eigenvalues.
    #[error("eigenvalues are as small as what rounding has made of them")]
    Uncertain,
    /// The time for it was over before it began.
    #[error("the time limit is reached")]
    Late,
}

/// What a factorisation may cost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Effort {
    /// Whatever it takes.
    Any,
    /// No more than quick factors, which fail where pivots would have to be sought far; unless they have been given up.
    Quick,
}
