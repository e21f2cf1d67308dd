//! A model without its rows: the note's bound-convergence test (§4.1.2).

use crate::model::{Evaluation, EvaluationError, Meta, Model, Pattern};

/// The same objective and bounds, no rows.
pub struct BoundsOnly<'a> {
    model: &'a dyn Model,
    meta: Meta,
    rows: usize,
}

impl<'a> BoundsOnly<'a> {
    /// Drops the rows of `model`.
    pub fn new(model: &'a dyn Model) -> Self {
        let meta = Meta {
            row_lower: Vec::new(),
            row_upper: Vec::new(),
            row_is_linear: Vec::new(),
            jacobian: Pattern::default(),
            ..model.meta().clone()
        };
        BoundsOnly { model, meta, rows: model.meta().rows() }
    }
}

impl Model for BoundsOnly<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(WithoutRows { inner: self.model.at(x)?, rows: self.rows }))
    }
}

/// One point without its rows.
struct WithoutRows<'m> {
    inner: Box<dyn Evaluation + 'm>,
    rows: usize,
}

impl Evaluation for WithoutRows<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.inner.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.inner.gradient(gradient)
    }

    fn constraints(&mut self, _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn jacobian(&mut self, _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn hessian(&mut self, weight: f64, _: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.hessian(weight, &vec![0.0; self.rows], values)
    }

    fn hessian_product(&mut self, weight: f64, _: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.hessian_product(weight, &vec![0.0; self.rows], direction, product)
    }
}
