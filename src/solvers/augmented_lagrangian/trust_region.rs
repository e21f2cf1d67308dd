//! Minimises a function without bounds by a trust region (Nocedal & Wright, *Numerical Optimization*, 2nd ed., algorithm 4.1), the
//! step in it by conjugate gradients.

use super::face::{Face, FaceHessian};
use super::steihaug;
use crate::math::dot;
use crate::model::EvaluationError;

/// η: a step is taken where the reduction is more than this share of the predicted one.
const ACCEPTED_RATIO: f64 = 1e-4;
/// Below the first ratio the region shrinks to a quarter of the step, above the second it is doubled.
const POOR_RATIO: f64 = 0.25;
const GOOD_RATIO: f64 = 0.75;
/// A step whose length differs from the radius by no more than this ends on the region's boundary.
const ON_BOUNDARY: f64 = 10.0 * f64::EPSILON;

/// The state of a minimisation on one face.
pub(super) struct TrustRegion<'f, 'a> {
    face: &'f Face<'a>,
    radius: f64,
    largest_radius: f64,
    /// The current point, φ there and its derivatives.
    pub w: Vec<f64>,
    pub value: f64,
    pub gradient: Vec<f64>,
    hessian: FaceHessian,
}

impl<'f, 'a> TrustRegion<'f, 'a> {
    /// At `w`.
    ///
    /// # Errors
    /// Derivatives that are no numbers there, or a stop of the budget.
    pub fn new(face: &'f Face<'a>, w: Vec<f64>, radius: f64, largest_radius: f64) -> Result<Self, EvaluationError> {
        let (gradient, hessian) = (face.gradient(&w)?, face.hessian(&w)?);
        let value = face.value(&w)?;
        Ok(TrustRegion { face, radius, largest_radius, w, value, gradient, hessian })
    }

    /// One step on trial. `true`: it lowered φ and was taken.
    ///
    /// # Errors
    /// As for [`TrustRegion::new`].
    pub fn advance(&mut self) -> Result<bool, EvaluationError> {
        let step = steihaug::step(&self.gradient, &self.hessian, self.radius);
        let trial: Vec<f64> = step.iter().zip(&self.w).map(|(p, w)| p + w).collect();
        let value = self.face.value(&trial)?;
        let predicted = self.value + dot(&step, &self.gradient) + 0.5 * dot(&step, &self.hessian.times(&step));
        let ratio = (self.value - value) / (self.value - predicted);
        let length = step.iter().map(|p| p.powi(2)).sum::<f64>().sqrt();
        if ratio < POOR_RATIO {
            self.radius = 0.25 * length;
        } else if ratio > GOOD_RATIO && (length - self.radius).abs() <= ON_BOUNDARY {
            self.radius = self.largest_radius.min(2.0 * self.radius);
        }
        if ratio.is_nan() || ratio <= ACCEPTED_RATIO {
            return Ok(false);
        }
        let falls = value < self.value;
        self.gradient = self.face.gradient(&trial)?;
        self.hessian = self.face.hessian(&trial)?;
        (self.w, self.value) = (trial, value);
        Ok(falls)
    }
}
