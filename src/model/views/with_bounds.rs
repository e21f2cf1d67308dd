//! The same model inside other bounds.

use crate::model::{EvaluationError, Meta, Model};

/// A model with its bounds replaced.
pub struct WithBounds<'a> {
    model: &'a dyn Model,
    meta: Meta,
}

impl<'a> WithBounds<'a> {
    /// `model` within `lower ≤ x ≤ upper`; its start is moved inside.
    pub fn new(model: &'a dyn Model, lower: Vec<f64>, upper: Vec<f64>) -> Self {
        let mut meta = model.meta().clone();
        (meta.lower, meta.upper) = (lower, upper);
        let mut start = std::mem::take(&mut meta.start);
        meta.clamp(&mut start);
        meta.start = start;
        WithBounds { model, meta }
    }
}

impl Model for WithBounds<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.model.objective(x)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.model.gradient(x, gradient)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.constraints(x, values)
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.jacobian(x, values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.hessian(x, weight, y, values)
    }

    fn variable_name(&self, j: usize) -> String {
        self.model.variable_name(j)
    }

    fn row_name(&self, i: usize) -> String {
        self.model.row_name(i)
    }
}
