//! The way back to the limits, and points that meet them only because they are far away: SPEC §4 measures a violation by the
//! variables' own sizes, which grow with them, so that even x + y = 1 and x + y = 1.000001 are both met once x and −y are large
//! enough; and by a row's slope, which grows without end where a root ends. Such a point counts as feasible only where one that
//! meets the rows in the start's own measure lies beside it.

use super::point::Point;
use super::second_order::Kkt;

/// A variable this many times its size at the start is far away.
const FAR: f64 = 10.0;
/// A row this many times as steep as at the start measures nothing.
const STEEP: f64 = 1e3;
/// Newton steps, and how often one is computed anew without variables that bounds hold.
const STEPS: usize = 6;
const PASSES: usize = 4;
/// How far, relative to the variables' sizes, a point beside it may lie.
const BESIDE: f64 = 1e-3;
/// Roundings in a row's value.
const ROUNDINGS: f64 = 64.0 * f64::EPSILON;

/// The worst relative violation of a row in the measure of the start, where that is more than `tolerance` and cannot be taken
/// off nearby; else `None`. The point meets all rows in its own measure.
pub(super) fn out_of_reach(point: &Point<'_>, tolerance: f64) -> Option<f64> {
    if (0..point.rows.len()).all(|i| point.row_violation(i) == 0.0) {
        return None;
    }
    let near = near_scales(point);
    let worst = worst(point, &near);
    if worst <= tolerance {
        return None;
    }
    let violated = |point: &Point<'_>, i: usize| point.row_violation(i) > 0.0;
    let beside = |x: &[f64]| x.iter().zip(point.x).zip(&point.d).all(|((a, b), d)| (a - b).abs() <= BESIDE * d);
    let mut x = point.x.to_vec();
    for _ in 0..STEPS {
        let Some(next) = Point::new(point.origin, &x).ok().and_then(|at| step_back(&at, &violated)) else { return Some(worst) };
        x = next;
        let Ok(moved) = Point::new(point.origin, &x) else { return Some(worst) };
        if !beside(&x) {
            return Some(worst);
        }
        if self::worst(&moved, &near) <= tolerance {
            return None;
        }
    }
    Some(worst)
}

/// The variables' sizes with those far away held back.
fn near_scales(point: &Point<'_>) -> Vec<f64> {
    let size = |start: f64| if start == 0.0 { 1.0 } else { start.abs() };
    point.d.iter().zip(&point.meta().start).map(|(d, &start)| d.min(FAR * size(start))).collect()
}

/// max violation_i / max(|limit|, ‖diag(near)∇c_i‖∞), slopes held back too, less what rounding explains.
fn worst(point: &Point<'_>, near: &[f64]) -> f64 {
    let meta = point.meta();
    let one = |i: usize| {
        let (lower, upper, value) = (meta.row_lower[i], meta.row_upper[i], point.rows[i]);
        let (violation, limit) = if value < lower { (lower - value, lower) } else { (value - upper, upper) };
        if violation <= 0.0 {
            return 0.0;
        }
        let (mut slope, mut terms) = (0.0f64, limit.abs());
        for at in meta.jacobian.range(i) {
            let j = meta.jacobian.columns[at] as usize;
            slope = slope.max((point.jacobian[at] * near[j]).abs());
            terms += (point.jacobian[at] * point.x[j]).abs();
        }
        let steepest = point.origin.slopes.as_ref().map_or(f64::INFINITY, |slopes| STEEP * slopes[i]);
        let slope = if steepest > 0.0 { slope.min(steepest) } else { slope };
        (violation - ROUNDINGS * terms).max(0.0) / limit.abs().max(slope).max(f64::MIN_POSITIVE)
    };
    (0..point.rows.len()).map(one).fold(0.0, f64::max)
}

/// One Newton step, the shortest in the variables' sizes, to the limits of the rows wanted; variables that it would take past a
/// bound stay where they are.
pub(super) fn step_back(point: &Point<'_>, wanted: &dyn Fn(&Point<'_>, usize) -> bool) -> Option<Vec<f64>> {
    let meta = point.meta();
    let mut free: Vec<usize> = (0..point.x.len()).filter(|&j| meta.lower[j] < meta.upper[j]).collect();
    let is_held = |&i: &usize| point.slopes[i] > 0.0 && (meta.row_lower[i] == meta.row_upper[i] || wanted(point, i));
    let held: Vec<usize> = (0..meta.rows()).filter(is_held).collect();
    for _ in 0..PASSES {
        let step = shortest(point, &free, &held)?;
        let stays_inside = |j: usize| step[j] >= meta.lower[j] && step[j] <= meta.upper[j];
        if free.iter().all(|&j| stays_inside(j)) {
            return Some(step);
        }
        free.retain(|&j| stays_inside(j));
    }
    None
}

/// The point a Newton step with these variables alone leads to.
fn shortest(point: &Point<'_>, free: &[usize], held: &[usize]) -> Option<Vec<f64>> {
    let mut kkt = Kkt::without_hessian(point, free, held).ok()?;
    kkt.factor_projection().ok()?;
    let lack = |(k, &i): (usize, &usize)| (nearest_limit(point, i) - point.rows[i]) / kkt.slope(k);
    let right: Vec<f64> = std::iter::repeat_n(0.0, free.len()).chain(held.iter().enumerate().map(lack)).collect();
    let step = kkt.solve(&right).ok()?;
    let mut x = point.x.to_vec();
    for (&j, step) in free.iter().zip(step) {
        x[j] += step * point.sizes[j];
    }
    Some(x)
}

fn nearest_limit(point: &Point<'_>, i: usize) -> f64 {
    let (lower, upper, value) = (point.meta().row_lower[i], point.meta().row_upper[i], point.rows[i]);
    if (value - lower).abs() <= (value - upper).abs() { lower } else { upper }
}
