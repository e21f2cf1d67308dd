//! A model at one point.

use super::{EvaluationError, Model, Pattern};

/// Values and derivatives at one point: what is computed once there (states, factors, logarithms) is computed once. Slices are
/// those of [`Model`]'s methods.
pub trait Evaluation {
    /// f(x)
    ///
    /// # Errors
    /// It has no value there, or the run must stop; likewise below.
    fn objective(&mut self) -> Result<f64, EvaluationError>;

    /// ∇f(x), overwritten. Returns f(x).
    ///
    /// # Errors
    /// As [`Evaluation::objective`].
    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError>;

    /// c(x), overwritten.
    ///
    /// # Errors
    /// As [`Evaluation::objective`].
    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError>;

    /// The Jacobian's values, overwritten.
    ///
    /// # Errors
    /// As [`Evaluation::objective`].
    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError>;

    /// The values of `weight·∇²f + Σ y_i ∇²c_i`, overwritten.
    ///
    /// # Errors
    /// As [`Evaluation::objective`].
    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError>;

    /// (weight·∇²f + Σ y_i ∇²c_i)·direction, overwritten.
    ///
    /// # Errors
    /// As [`Evaluation::objective`].
    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError>;
}

/// A model without anything to keep at a point.
pub(super) struct AtPoint<'m, M: ?Sized> {
    pub model: &'m M,
    pub x: Vec<f64>,
}

impl<M: Model + ?Sized> Evaluation for AtPoint<'_, M> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.model.objective(&self.x)
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.model.gradient(&self.x, gradient)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.constraints(&self.x, values)
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.jacobian(&self.x, values)
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.hessian(&self.x, weight, y, values)
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let pattern = &self.model.meta().hessian;
        product_by_entries(self, pattern, (weight, y), direction, product)
    }
}

/// (weight·∇²f + Σ y_i ∇²c_i)·direction from the entries, where these are all there is.
pub(super) fn product_by_entries(
    at: &mut dyn Evaluation,
    pattern: &Pattern,
    (weight, y): (f64, &[f64]),
    direction: &[f64],
    product: &mut [f64],
) -> Result<(), EvaluationError> {
    let mut values = vec![0.0; pattern.len()];
    at.hessian(weight, y, &mut values)?;
    pattern.multiply_symmetric(&values, direction, product);
    Ok(())
}
