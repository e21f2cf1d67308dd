//! Scales: variables by the magnitude of the start, rows and objective by their gradients there.
//!
//! Wächter & Biegler (2006), §3.8, scale down only; here small gradients are scaled up too, so that rows in any unit
//! weigh alike. All scales are powers of two: no rounding on the way there and back.

use super::parameters::PARAMETERS;
use super::vectors::power_of_two;
use crate::linear_algebra::Pattern;

/// The scale of a variable: 1 where its start or its bounds are of ordinary size.
pub(super) fn variable_scale(start: f64, lower: f64, upper: f64) -> f64 {
    let magnitude = match start.abs() {
        size if size > 0.0 => size,
        _ if (upper - lower).is_finite() => upper - lower,
        _ => 1.0,
    };
    let (least, most) = PARAMETERS.scaling.ordinary;
    let extreme = PARAMETERS.scaling.extreme;
    if (least..=most).contains(&magnitude) { 1.0 } else { power_of_two(magnitude.clamp(1.0 / extreme, extreme)) }
}

/// The scale that brings a gradient of this size into the ordinary range. `value`, the size of the function itself,
/// tells a gradient that is small because of the units from one that is small because the start is flat.
pub(super) fn gradient_scale(size: f64, value: f64) -> f64 {
    let p = &PARAMETERS.scaling;
    let wanted = match size {
        size if size > p.largest_gradient => p.largest_gradient / size,
        size if size > 0.0 && size < p.smallest_gradient => p.smallest_gradient / size,
        _ => 1.0,
    };
    let largest = if value > 0.0 && size > p.flat * value { p.any_unit } else { p.extreme };
    power_of_two(wanted.clamp(1.0 / p.any_unit, largest))
}

/// Scales of the objective and of every row, from the gradients of the form as it is (unscaled but for variables).
/// `limits` are the sizes of the rows' limits.
pub(super) fn gradient_scales(
    (objective, gradient): (f64, &[f64]),
    (pattern, jacobian): (&Pattern, &[f64]),
    limits: &[f64],
) -> (f64, Vec<f64>) {
    let largest = |values: &[f64]| values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()));
    let rows = limits
        .iter()
        .enumerate()
        .map(|(i, &limit)| {
            let size = largest(&jacobian[pattern.range(i)]);
            // A flat start says nothing of the row's size; its limit does.
            gradient_scale(if size < PARAMETERS.scaling.flat * limit { limit } else { size }, limit)
        })
        .collect();
    (gradient_scale(largest(gradient), objective.abs()), rows)
}
