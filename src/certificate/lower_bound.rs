//! A rigorous lower bound of a convex problem's minimum.

use super::implied_box;
use super::point::{Origin, Point};
use crate::model::{EvaluationError, Model};

/// A rigorous lower bound of a convex model's minimum over its box and rows, from the row multipliers `y` at `x`.
///
/// For signs as at a minimum, f ≥ L = f + yᵀ(c − limit) on the feasible set, and L, being convex, lies above its tangent at x:
/// f ≥ L(x) + Σ min over the box of (∂L/∂x_j)·(v − x_j). Rounded outwards by the summed magnitudes of all terms. Multipliers
/// whose side is open are left out. Where a bound is open, what follows from the rows and from f ≤ f(x) takes its place; `None`
/// where that is open, too. The model must be convex.
///
/// # Errors
/// The model has no value or derivative at `x`.
pub fn lower_bound(model: &dyn Model, x: &[f64], y: &[f64]) -> Result<Option<f64>, EvaluationError> {
    let origin = Origin::new(model);
    let meta = model.meta();
    let mut inside = x.to_vec();
    meta.clamp(&mut inside);
    let point = Point::new(&origin, &inside)?;
    let usable = |(i, &y): (usize, &f64)| if y != 0.0 && point.row_limit(i, y).is_finite() { y } else { 0.0 };
    let y: Vec<f64> = y.iter().enumerate().map(usable).collect();
    let mut bound = Outward::default();
    bound.add(point.objective);
    for (i, &y) in y.iter().enumerate().filter(|(_, y)| **y != 0.0) {
        bound.add(y * point.rows[i]);
        bound.add(-y * point.row_limit(i, y));
    }
    let slopes = point.row_gradient(&y);
    let (down, up) = implied_box::around(&point);
    for (j, error) in slope_errors(&point, &y).into_iter().enumerate() {
        match lowest(slopes[j] - error, slopes[j] + error, down[j], up[j]) {
            Some(term) => bound.add(term),
            None => return Ok(None),
        }
    }
    // Outside the implied box the objective is above f(x).
    let level = point.objective - 16.0 * f64::EPSILON * point.objective.abs();
    Ok(bound.below().map(|below| below.min(level)))
}

/// The least of s·v over s in [least, most], v in [down, up]; `None` where it is −∞.
fn lowest(least: f64, most: f64, down: f64, up: f64) -> Option<f64> {
    // A slope that is exactly zero needs no bound, and a width that is zero no slope.
    let product = |slope: f64, width: f64| if slope == 0.0 || width == 0.0 { 0.0 } else { slope * width };
    let term = product(most.max(0.0), down).min(product(least.min(0.0), up));
    term.is_finite().then_some(term)
}

/// What rounding may have done to each ∂L/∂x_j.
pub(super) fn slope_errors(point: &Point<'_>, y: &[f64]) -> Vec<f64> {
    let mut total: Vec<f64> = point.gradient.iter().map(|g| g.abs()).collect();
    let magnitudes: Vec<f64> = point.jacobian.iter().map(|a| a.abs()).collect();
    let weights: Vec<f64> = y.iter().map(|y| y.abs()).collect();
    point.meta().jacobian.add_transposed(&magnitudes, &weights, &mut total);
    total.into_iter().map(|sum| 16.0 * f64::EPSILON * sum).collect()
}

/// A sum with the magnitudes of its terms.
#[derive(Default)]
struct Outward {
    sum: f64,
    magnitude: f64,
    terms: f64,
}

impl Outward {
    fn add(&mut self, term: f64) {
        self.sum += term;
        self.magnitude += term.abs();
        self.terms += 1.0;
    }

    /// Below the exact sum, however the terms were rounded.
    fn below(&self) -> Option<f64> {
        let bound = self.sum - (self.terms + 16.0) * f64::EPSILON * self.magnitude;
        bound.is_finite().then_some(bound)
    }
}
