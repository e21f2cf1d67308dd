//! A model without its rows: the note's bound-convergence test (§4.1.2).

use crate::model::{EvaluationError, Meta, Model, Pattern};

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

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.model.objective(x)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.model.gradient(x, gradient)
    }

    fn constraints(&self, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn jacobian(&self, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, _: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.model.hessian(x, weight, &vec![0.0; self.rows], values)
    }
}
