//! The one form every backend and the certificate work on: minimise f(x) subject to l ≤ x ≤ u and c_l ≤ c(x) ≤ c_u.
//!
//! [`Model`] gives values and exact derivatives over plain slices, with sparsity patterns fixed once. Wrappers
//! ([`evaluator::Evaluator`], scaled, logarithmic, bounds-only) are models themselves.

use crate::math::within;
mod affine;
mod around;
mod assemble;
mod assembled;
mod auxiliaries;
mod chunked_evaluation;
pub mod class;
pub mod closures;
pub mod components;
pub mod derivative_check;
pub mod domain;
mod element_model;
mod elements;
mod evaluation;
pub mod evaluator;
mod excerpt;
mod formulate;
pub mod lifted;
mod names;
pub mod relaxation;
pub mod remainder;
#[cfg(test)]
pub(crate) mod sample;
pub mod stated;
pub mod states;
pub mod stiffness;
pub mod structural;
pub mod views;
pub mod with_states;

use thiserror::Error;

pub use crate::linear_algebra::Pattern;
pub use around::Around;
pub use assemble::{AssemblyError, Classification, assemble, classify, volumes};
pub use assembled::{RibModel, RowOrigin};
pub use class::Class;
pub use components::Components;
pub use evaluation::Evaluation;
pub use evaluator::{Budget, Evaluator};
pub use formulate::{Formulation, formulate};
pub use lifted::Lifted;
pub use names::{NameTable, Names};
pub use states::States;
pub use structural::{Assembled, assemble_any};
pub use views::reduced::Reduced;
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
    /// The term of each row that no variable can move, fixed ones at their values, where it is known; empty where none is. `3 - x >= 0` is
    /// `-x >= -3`: what a row's limit tells is told by its distance from this.
    pub row_constants: Vec<f64>,
    /// Which rows are affine in x.
    pub row_is_linear: Vec<bool>,
    /// True where the objective is affine in x.
    pub objective_is_linear: bool,
    /// Where ∂c_i/∂x_j can be non-zero: m rows, columns below n.
    pub jacobian: Pattern,
    /// Which variables are states, given by the design through as many equations; none in most models.
    pub states: Option<States>,
    /// Where the Hessian of the Lagrangian can be non-zero: n rows, lower triangle (column ≤ row).
    pub hessian: Pattern,
    /// How second derivatives can be had.
    pub curvature: Curvature,
    /// What one evaluation costs besides the entries it fills in, in the same unit: 0 where it is a pass over the entries, the work of
    /// a factorisation where states are solved for.
    pub extra_work: f64,
    /// What variables and rows are called.
    pub names: NameTable,
}

/// How a model gives second derivatives.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Curvature {
    /// Exactly, as entries along [`Meta::hessian`].
    #[default]
    Exact,
    /// Exactly, as products with vectors only ([`Model::hessian_product`]); [`Meta::hessian`] is empty.
    Product,
    /// Not at all.
    None,
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

    /// Entries touched by one look at values, gradient, Jacobian and Hessian, and what the model adds to them: an estimate of its
    /// cost that is the same on every machine.
    pub fn work(&self) -> f64 {
        (1 + self.variables() + self.rows() + self.jacobian.len() + self.hessian.len()) as f64 + self.extra_work
    }

    /// Whether row i is known to be affine in x.
    pub fn is_row_linear(&self, i: usize) -> bool {
        self.row_is_linear.get(i).copied().unwrap_or(false)
    }

    /// Whether variable j has one value only.
    pub fn is_fixed(&self, j: usize) -> bool {
        self.lower[j] == self.upper[j]
    }

    /// Moves x inside the bounds, length n.
    pub fn clamp(&self, x: &mut [f64]) {
        for (x, (lower, upper)) in x.iter_mut().zip(self.lower.iter().zip(&self.upper)) {
            *x = within(*x, *lower, *upper);
        }
    }
}

/// Values and exact derivatives. Slices have the lengths [`Model::meta`] states; x need not be inside the bounds. A model may be
/// asked from several threads at once, at different points.
///
/// A model is written in one of two ways. One that has nothing to keep at a point gives `objective`, `gradient`, `constraints`,
/// `jacobian` and `hessian`; one that solves for states or keeps factors gives [`Model::at`]. Each way follows from the other.
///
/// Every method returns finite numbers or an error that names the term: a NaN or an infinity never passes for a value.
pub trait Model: Sync {
    /// Sizes, bounds, limits, patterns, names.
    fn meta(&self) -> &Meta;

    /// The model at x: what is to be computed once there is computed once.
    ///
    /// # Errors
    /// What is computed once has no value there.
    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(evaluation::AtPoint { model: self, x: x.to_vec() }))
    }

    /// Whether a run may go on: what takes long between two evaluations asks. Only a guarded model ever says no.
    ///
    /// # Errors
    /// The limit met, or Ctrl-C.
    fn may_go_on(&self) -> Result<(), EvaluationError> {
        Ok(())
    }

    /// f(x)
    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.at(x)?.objective()
    }

    /// ∇f(x), dense, length n, overwritten. Returns f(x).
    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.at(x)?.gradient(gradient)
    }

    /// c(x), length m, overwritten.
    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.at(x)?.constraints(values)
    }

    /// The Jacobian's values along [`Meta::jacobian`], overwritten.
    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.at(x)?.jacobian(values)
    }

    /// The values of `weight·∇²f + Σ y_i ∇²c_i` along [`Meta::hessian`], overwritten; y has an entry for every row, affine ones too.
    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.at(x)?.hessian(weight, y, values)
    }

    /// (weight·∇²f + Σ y_i ∇²c_i)·direction, length n, overwritten.
    fn hessian_product(
        &self,
        x: &[f64],
        weight: f64,
        y: &[f64],
        direction: &[f64],
        product: &mut [f64],
    ) -> Result<(), EvaluationError> {
        self.at(x)?.hessian_product(weight, y, direction, product)
    }

    /// How many variables and rows are the user's own.
    fn own(&self) -> Own {
        Own { variables: self.meta().variables(), rows: self.meta().rows() }
    }

    /// Gives auxiliary variables the values that follow from the user's own, so that the objective and the rows are what the
    /// user's expressions are at this point.
    fn complete(&self, _x: &mut [f64]) {}

    /// The terms that hold one of these variables, where the model can be taken apart.
    fn around(&self, _variables: &[u32]) -> Option<Around<'_>> {
        None
    }

    /// The model seen as independent small ones, where it decomposes and can be evaluated component by component.
    fn components(&self) -> Option<Box<dyn Components + '_>> {
        None
    }
}

impl<'a> dyn Model + 'a {
    /// The name of variable j, for messages.
    pub fn variable_name(&self, j: usize) -> String {
        self.meta().names.variable(j)
    }

    /// The name of row i, for messages.
    pub fn row_name(&self, i: usize) -> String {
        self.meta().names.row(i)
    }

    /// Where row i is declared, ready to print, where that is known.
    pub fn row_place(&self, i: usize) -> Option<String> {
        self.meta().names.row_place(i)
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

/// Looked at in blocks without a way out, so that the compiler uses vector instructions.
fn all_finite(values: &[f64]) -> bool {
    values.chunks(64).all(|block| block.iter().fold(true, |finite, value| finite & value.is_finite()))
}
