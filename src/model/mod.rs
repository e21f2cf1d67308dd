//! The one form every backend and the certificate work on: minimise f(x) subject to l ≤ x ≤ u and c_l ≤ c(x) ≤ c_u.
//!
//! [`Model`] gives values and exact derivatives over plain slices, with sparsity patterns fixed once. Wrappers
//! ([`evaluator::Evaluator`], scaled, logarithmic, bounds-only) are models themselves.

mod assemble;
mod assembled;
mod chunked_evaluation;
pub mod class;
pub mod components;
pub mod derivative_check;
pub mod domain;
mod elements;
pub mod evaluator;
#[cfg(test)]
pub(crate) mod sample;
pub mod views;

use thiserror::Error;

pub use crate::linear_algebra::Pattern;
pub use assemble::{AssemblyError, Classification, assemble, classify, volumes};
pub use assembled::{RibModel, RowOrigin};
pub use class::Class;
pub use components::Components;
pub use evaluator::{Budget, Evaluator};
pub use views::{Elastic, Freed, Limit, Substitution, WithBounds};

/// What is known of a model before any evaluation.
#[derive(Debug, Clone, Default)]
pub struct Meta {
    /// Lower bounds of the variables, −∞ where open. Their number is n.
    pub lower: Vec<f64>,
    /// Upper bounds of the variables, +∞ where open.
    pub upper: Vec<f64>,
    /// Starting point, inside the bounds.
    pub start: Vec<f64>,
    /// The magnitude of each variable that its user gave by a start, 0 where none was given; empty where nothing is known. What a
    /// program fills in for a start that was left out is no size.
    pub typical: Vec<f64>,
    /// Lower limits of the rows, −∞ where open. Their number is m. An equality has both limits equal.
    pub row_lower: Vec<f64>,
    /// Upper limits of the rows, +∞ where open.
    pub row_upper: Vec<f64>,
    /// Which rows are affine in x.
    pub row_is_linear: Vec<bool>,
    /// True where the objective is affine in x.
    pub objective_is_linear: bool,
    /// Where ∂c_i/∂x_j can be non-zero: m rows, columns below n.
    pub jacobian: Pattern,
    /// Where the Hessian of the Lagrangian can be non-zero: n rows, lower triangle (column ≤ row).
    pub hessian: Pattern,
}

/// How many variables and rows are the user's own; what follows them is auxiliary and no business of a report.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Own {
    /// Variables.
    pub variables: usize,
    /// Rows.
    pub rows: usize,
}

impl Meta {
    /// Number of variables n.
    pub fn variables(&self) -> usize {
        self.lower.len()
    }

    /// Number of rows m.
    pub fn rows(&self) -> usize {
        self.row_lower.len()
    }

    /// Whether row i is known to be affine in x.
    pub fn is_row_linear(&self, i: usize) -> bool {
        self.row_is_linear.get(i).copied().unwrap_or(false)
    }

    /// Moves x inside the bounds, length n.
    pub fn clamp(&self, x: &mut [f64]) {
        for (x, (lower, upper)) in x.iter_mut().zip(self.lower.iter().zip(&self.upper)) {
            *x = x.max(*lower).min(*upper);
        }
    }
}

/// Values and exact derivatives. Slices have the lengths [`Model::meta`] states; x need not be inside the bounds.
///
/// Every method returns finite numbers or an error that names the term: a NaN or an infinity never passes for a value.
pub trait Model: Sync {
    /// Sizes, bounds, limits, patterns.
    fn meta(&self) -> &Meta;

    /// f(x)
    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError>;

    /// ∇f(x), dense, length n, overwritten. Returns f(x).
    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError>;

    /// c(x), length m, overwritten.
    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError>;

    /// The Jacobian's values along [`Meta::jacobian`], overwritten.
    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError>;

    /// The values of `weight·∇²f + Σ y_i ∇²c_i` along [`Meta::hessian`], overwritten.
    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError>;

    /// How many variables and rows are the user's own.
    fn own(&self) -> Own {
        Own { variables: self.meta().variables(), rows: self.meta().rows() }
    }

    /// Gives auxiliary variables the values that follow from the user's own, so that the objective and the rows are what the
    /// user's expressions are at this point.
    fn complete(&self, _x: &mut [f64]) {}

    /// The model seen as independent small ones, where it falls apart and can be evaluated piece by piece.
    fn components(&self) -> Option<Box<dyn Components + '_>> {
        None
    }

    /// The name of variable j, for messages.
    fn variable_name(&self, j: usize) -> String {
        format!("x[{}]", j + 1)
    }

    /// The name of row i, for messages.
    fn row_name(&self, i: usize) -> String {
        format!("c{}", i + 1)
    }

    /// Where row i is declared, ready to print (`file.toml:12`), where that is known.
    fn row_place(&self, _i: usize) -> Option<String> {
        None
    }
}

/// Why a model gave no value.
#[derive(Debug, Clone, PartialEq, Error)]
pub enum EvaluationError {
    /// A term left its domain or overflowed.
    #[error("{term}: {cause}")]
    Invalid {
        /// The rib, row or objective term: `volume of rib haunch`, `row stress[3]`.
        term: String,
        /// `square root of -0.2`, `division by zero`, `the value overflows`.
        cause: String,
    },
    /// A budget, deadline or interrupt ended the run (from [`Evaluator`]).
    #[error("{0}")]
    Stopped(Stop),
}

/// Why a run was told to stop.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Error)]
pub enum Stop {
    /// max_evaluations
    #[error("the limit on evaluations is reached")]
    Evaluations,
    /// max_seconds
    #[error("the time limit is reached")]
    Time,
    /// Ctrl-C
    #[error("interrupted")]
    Interrupted,
}
