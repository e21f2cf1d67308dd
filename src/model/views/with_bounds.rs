//! The same model inside other bounds, and with other limits of some rows.

use crate::model::{Evaluation, EvaluationError, Meta, Model};

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

    /// The model within `reach(j)` of where variable j starts, and its own bounds.
    pub fn about_start(model: &'a dyn Model, reach: impl Fn(usize) -> f64) -> Self {
        let meta = model.meta();
        let starts = || meta.start.iter().enumerate();
        let lower = starts().map(|(j, start)| meta.lower[j].max(start - reach(j))).collect();
        let upper = starts().map(|(j, start)| meta.upper[j].min(start + reach(j))).collect();
        WithBounds::new(model, lower, upper)
    }

    /// With another upper limit of row `i`.
    pub fn limit(&mut self, i: usize, upper: f64) {
        self.meta.row_upper[i] = upper;
    }
}

impl Model for WithBounds<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        self.model.at(x)
    }
}
