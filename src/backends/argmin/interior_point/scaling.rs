//! Scales: variables by the magnitude of the start, rows and objective by their gradients there.
//!
//! Wächter & Biegler (2006), §3.8, scale down only; here small gradients are scaled up too, so that rows in any unit
//! weigh alike. All scales are powers of two: no rounding on the way there and back.

use super::form::Form;
use super::vectors::power_of_two;

/// Gradients larger than this are scaled down to it.
const LARGEST_GRADIENT: f64 = 100.0;
/// Gradients smaller than this are scaled up to it.
const SMALLEST_GRADIENT: f64 = 1e-2;
/// No scale goes beyond this or below its inverse.
const EXTREME: f64 = 1e12;

/// The scale of a variable: 1 where its start or its bounds are of ordinary size.
pub(super) fn variable_scale(start: f64, lower: f64, upper: f64) -> f64 {
    let magnitude = match start.abs() {
        size if size > 0.0 => size,
        _ if (upper - lower).is_finite() => upper - lower,
        _ => 1.0,
    };
    if (1e-2..=1e2).contains(&magnitude) { 1.0 } else { power_of_two(magnitude.clamp(1.0 / EXTREME, EXTREME)) }
}

/// The scale that brings a gradient of this size into the ordinary range.
fn gradient_scale(size: f64) -> f64 {
    let wanted = match size {
        size if size > LARGEST_GRADIENT => LARGEST_GRADIENT / size,
        size if size > 0.0 && size < SMALLEST_GRADIENT => SMALLEST_GRADIENT / size,
        _ => 1.0,
    };
    power_of_two(wanted.clamp(1.0 / EXTREME, EXTREME))
}

/// Scales of the objective and of every row, from the gradients of the form as it is (unscaled but for variables).
pub(super) fn gradient_scales(form: &Form<'_>, gradient: &[f64], jacobian: &[f64]) -> (f64, Vec<f64>) {
    let largest = |values: &[f64]| values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let limit = |i: usize| {
        let meta = form.model.meta();
        let row = form.rows[i];
        [meta.row_lower[row], meta.row_upper[row]].into_iter().filter(|limit| limit.is_finite()).map(f64::abs).fold(0.0, f64::max)
    };
    let rows = (0..form.rows.len())
        .map(|i| {
            let size = largest(&jacobian[form.jacobian.range(i)]);
            // A flat start says nothing of the row's size; its limit does.
            gradient_scale(if size < SMALLEST_GRADIENT { size.max(limit(i)).min(SMALLEST_GRADIENT) } else { size })
        })
        .collect();
    (gradient_scale(largest(gradient)), rows)
}
