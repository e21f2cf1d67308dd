//! Bounds that follow from the rows and from an objective level, for convex models: each convex row lies above its tangent, so
//! that every tangent is a linear row all feasible points meet; bounds are tightened over those rows, variable by variable
//! (feasibility-based bound tightening), and rounded outwards.

use super::point::Point;
use super::row_range::{End, range};
use crate::certificate::parameters::infeasibility::{BOX_SWEEPS, SLACK};

/// A linear row lower ≤ Σ coefficient·v ≤ upper in v = x − x̂.
struct Line {
    entries: Vec<(usize, f64)>,
    lower: f64,
    upper: f64,
    magnitude: f64,
}

/// Bounds (lower, upper) of v = x − x̂ for every feasible x with f(x) ≤ f(x̂). The model must be convex.
pub(super) fn around(point: &Point<'_>) -> (Vec<f64>, Vec<f64>) {
    let meta = point.meta();
    let difference = |bounds: &[f64]| bounds.iter().zip(point.x).map(|(bound, x)| bound - x).collect::<Vec<_>>();
    let (mut lower, mut upper) = (difference(&meta.lower), difference(&meta.upper));
    let lines = lines(point);
    for _ in 0..BOX_SWEEPS {
        let mut changed = false;
        for line in &lines {
            changed |= tighten(line, &mut lower, &mut upper);
        }
        if !changed {
            break;
        }
    }
    (lower, upper)
}

fn lines(point: &Point<'_>) -> Vec<Line> {
    let meta = point.meta();
    let row = |i: usize| {
        let entries = meta.jacobian.range(i).map(|at| (meta.jacobian.columns[at] as usize, point.jacobian[at]));
        let value = point.rows[i];
        let limits = [meta.row_lower[i], meta.row_upper[i]].into_iter().filter(|limit| limit.is_finite());
        let magnitude = limits.fold(value.abs(), |most: f64, limit| most.max(limit.abs())) + point.slopes[i];
        Line {
            entries: entries.filter(|entry| entry.1 != 0.0).collect(),
            lower: meta.row_lower[i] - value,
            upper: meta.row_upper[i] - value,
            magnitude,
        }
    };
    let gradient = point.gradient.iter().copied().enumerate().filter(|entry| entry.1 != 0.0).collect();
    let magnitude = point.objective.abs() + point.scale();
    let objective = Line { entries: gradient, lower: f64::NEG_INFINITY, upper: 0.0, magnitude };
    (0..meta.rows()).map(row).chain([objective]).filter(|line| line.magnitude.is_finite()).collect()
}

/// Tightens open bounds only: those that are closed are the user's, and exact. True where one was closed.
fn tighten(line: &Line, lower: &mut [f64], upper: &mut [f64]) -> bool {
    let (mut least, mut most) = (End::default(), End::default());
    for &(j, coefficient) in &line.entries {
        let (low, high) = range(coefficient, lower[j], upper[j]);
        least.add(low);
        most.add(high);
    }
    let slack = SLACK * (line.magnitude + least.magnitude + most.magnitude);
    let mut changed = false;
    for &(j, coefficient) in &line.entries {
        let (low, high) = range(coefficient, lower[j], upper[j]);
        let at_most = least.without(low).map(|rest| line.upper - rest + slack).filter(|end| end.is_finite());
        let at_least = most.without(high).map(|rest| line.lower - rest - slack).filter(|end| end.is_finite());
        let (new_lower, new_upper) = if coefficient > 0.0 { (at_least, at_most) } else { (at_most, at_least) };
        if let Some(end) = new_upper.map(|end| outward(end / coefficient, 1.0)).filter(|_| upper[j] == f64::INFINITY) {
            (upper[j], changed) = (end.max(0.0), true);
        }
        if let Some(end) = new_lower.map(|end| outward(end / coefficient, -1.0)).filter(|_| lower[j] == f64::NEG_INFINITY) {
            (lower[j], changed) = (end.min(0.0), true);
        }
        if changed {
            // Sums have changed: the next sweep goes on.
            return true;
        }
    }
    changed
}

fn outward(value: f64, sign: f64) -> f64 {
    value + sign * SLACK * value.abs()
}
