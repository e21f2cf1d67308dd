//! Whether the slope found at a point holds to the limits it rests on. Complementarity measures multipliers times distances by the
//! objective's slope; beside a slope without end (√(1 − x) at 1) that makes any gap small, although all that is left of the
//! objective lies in it.

use super::feasibility::step_back;
use super::multipliers::Multipliers;
use super::point::Point;
use crate::certificate::parameters::gap::{HONEST, ROUNDED, ROUNDINGS};
use crate::model::Model;

/// What moving on to the limits gains, over the objective's own magnitude, where the slope at the point does not hold on the way;
/// `None` where it does, or nothing is to be gained.
pub(super) fn beyond_the_slope(point: &Point<'_>, multipliers: &Multipliers) -> Option<f64> {
    // On the way a linear objective falls by what the multipliers say: −∇f = Jᵀy + z.
    if point.meta().objective_is_linear {
        return None;
    }
    let rows = multipliers.rows.iter().enumerate().filter(|(_, y)| **y != 0.0);
    let in_rows: f64 = rows.map(|(i, &y)| y.abs() * distance(point.rows[i], point.row_limit(i, y), point.row_term(i))).sum();
    let bounds = multipliers.bounds.iter().enumerate().filter(|(_, z)| **z != 0.0);
    let last_digits = last_digits(point, multipliers);
    let in_bounds: f64 = bounds.map(|(j, &z)| z.abs() * distance(point.x[j], point.bound(j, z), last_digits[j])).sum();
    let gap = in_rows + in_bounds;
    if !(gap > ROUNDINGS * point.objective.abs() && gap.is_finite()) {
        return None;
    }
    let mut limits = step_back(point, &|_, i| multipliers.rows[i] != 0.0)?;
    for (j, &z) in multipliers.bounds.iter().enumerate().filter(|(_, z)| **z != 0.0) {
        limits[j] = point.bound(j, z);
    }
    let half: Vec<f64> = point.x.iter().zip(&limits).map(|(x, limit)| 0.5 * (x + limit)).collect();
    let there = point.origin.model.objective(&half).ok()?;
    let gain = point.objective - there;
    let magnitude = point.objective.abs().max(there.abs());
    (gain > HONEST * 0.5 * gap + ROUNDINGS * magnitude).then(|| 2.0 * gain / magnitude)
}

/// Variable by variable the magnitude whose rounding it takes over from the rows that hold it: the terms of a row over its slope.
/// t ≥ 1 + x at x = −1 leaves t at the last digits of 1, not at 0.
fn last_digits(point: &Point<'_>, multipliers: &Multipliers) -> Vec<f64> {
    let (pattern, mut digits) = (&point.meta().jacobian, vec![0.0f64; point.x.len()]);
    for (i, &y) in multipliers.rows.iter().enumerate().filter(|(_, y)| **y != 0.0) {
        let magnitude = point.row_limit(i, y).abs().max(point.row_term(i));
        for at in pattern.range(i).filter(|&at| point.jacobian[at] != 0.0) {
            let j = pattern.columns[at] as usize;
            digits[j] = digits[j].max(magnitude / point.jacobian[at].abs());
        }
    }
    digits
}

/// The distance from a limit beyond what rounding makes of it: an objective that is 0 at its minimum is no measure of that.
fn distance(value: f64, limit: f64, term: f64) -> f64 {
    ((value - limit).abs() - ROUNDED * limit.abs().max(term)).max(0.0)
}
