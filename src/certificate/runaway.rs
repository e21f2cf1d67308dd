//! Variables that have run away: the point passes only because the objective flattens out far from the start, and would go on
//! falling for ever (exp(x) towards −∞). Such an infimum is not attained.

use super::point::Point;
use crate::model::{EvaluationError, Model};

/// Single variables tried at the most.
const TRIED: usize = 32;

/// Nothing of a size of one belongs this far away.
const BEYOND: f64 = 1e30;

/// The variables along whose way from the start the objective still falls, however far one goes; empty at a true minimum.
pub(super) fn variables(point: &Point<'_>, tolerance: f64) -> Vec<usize> {
    let mut far: Vec<(f64, usize)> = (0..point.x.len()).filter_map(|j| travelled(point, j).map(|way| (way, j))).collect();
    far.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let all: Vec<usize> = far.iter().map(|&(_, j)| j).collect();
    let mut found: Vec<usize> =
        far.iter().take(TRIED).filter(|&&(way, j)| falls_for_ever(point, &[j], way, tolerance)).map(|f| f.1).collect();
    let way = far.first().map_or(0.0, |f| f.0);
    if found.is_empty() && all.len() > 1 && falls_for_ever(point, &all, way, tolerance) {
        found = all;
    }
    if found.is_empty() {
        found = towards_bounds(point, tolerance);
    }
    found.sort_unstable();
    found
}

/// The variables on their way to bounds where a term has no value: nothing rises as they come nearer, and the bound itself is out
/// of reach.
fn towards_bounds(point: &Point<'_>, tolerance: f64) -> Vec<usize> {
    let meta = point.meta();
    let near = |j: usize| {
        let x = point.x[j];
        let bound = if x - meta.lower[j] <= meta.upper[j] - x { meta.lower[j] } else { meta.upper[j] };
        let size = bound.abs().max(meta.start[j].abs());
        let size = if size > 0.0 { size } else { 1.0 };
        (x != bound && (x - bound).abs() <= 1e-8 * size).then_some((j, bound))
    };
    let near: Vec<(usize, f64)> = (0..point.x.len()).filter_map(near).collect();
    let value = |share: f64| {
        let mut x = point.x.to_vec();
        near.iter().for_each(|&(j, bound)| x[j] = bound + share * (x[j] - bound));
        feasible_objective(point, &x, tolerance)
    };
    let on_bounds = || {
        let mut x = point.x.to_vec();
        near.iter().for_each(|&(j, bound)| x[j] = bound);
        point.origin.model.objective(&x).and_then(|_| point.origin.model.constraints(&x, &mut vec![0.0; meta.rows()]))
    };
    if near.is_empty() || !matches!(on_bounds(), Err(EvaluationError::Invalid { .. })) {
        return Vec::new();
    }
    let level = 64.0 * f64::EPSILON * point.objective.abs();
    let never_rises = [0.1, 0.01, 1e-3].into_iter().all(|share| value(share).is_some_and(|f| f <= point.objective + level));
    if never_rises { near.into_iter().map(|(j, _)| j).collect() } else { Vec::new() }
}

/// How many times its own size variable j has moved towards an open bound; `None` where it has not gone far.
fn travelled(point: &Point<'_>, j: usize) -> Option<f64> {
    let (meta, x) = (point.meta(), point.x[j]);
    let moved = x - meta.start[j];
    let open = if moved > 0.0 { meta.upper[j] == f64::INFINITY } else { meta.lower[j] == f64::NEG_INFINITY };
    let size = if meta.start[j] == 0.0 { 1.0 } else { meta.start[j].abs() };
    (open && moved.abs() > 2.0 * size).then_some(moved.abs() / size)
}

/// Moves the variables on, away from the start, 10 % to 100 times as far again: the objective must never rise and fall on the
/// whole, beyond rounding; or be level to the last digit, far away, at less than what it was on the way.
fn falls_for_ever(point: &Point<'_>, variables: &[usize], way: f64, tolerance: f64) -> bool {
    let value = |factor: f64| {
        let mut x = point.x.to_vec();
        for &j in variables {
            x[j] += factor * (point.x[j] - point.meta().start[j]);
        }
        feasible_objective(point, &x, tolerance)
    };
    if way > BEYOND {
        return true;
    }
    let mut last = point.objective;
    for factor in [0.1, 1.0, 10.0, 100.0] {
        match value(factor) {
            Some(next) if next <= last => last = next,
            _ => return false,
        }
    }
    let fall = point.objective - last;
    let far_and_level = fall <= 64.0 * f64::EPSILON * point.objective.abs() && way > 100.0;
    fall > 64.0 * f64::EPSILON * point.objective.abs()
        || (far_and_level && value(-0.5).is_some_and(|f| f > point.objective))
        || (far_and_level && slopes_down(point, variables) && rises_behind(point, way, value))
}

/// Whether the objective's exact slope still points onwards, however small it has become: no valley that is level throughout.
fn slopes_down(point: &Point<'_>, variables: &[usize]) -> bool {
    variables.iter().all(|&j| point.gradient[j] * (point.x[j] - point.meta().start[j]) < 0.0)
}

/// Whether the objective, going back decade by decade, never falls and rises in the end.
fn rises_behind(point: &Point<'_>, way: f64, value: impl Fn(f64) -> Option<f64>) -> bool {
    let mut last = point.objective;
    for decade in 1..=(way.log10() as i32) {
        match value(10f64.powi(-decade) - 1.0) {
            Some(next) if next >= last => last = next,
            Some(_) => return false,
            None => break,
        }
    }
    last > point.objective
}

/// f(x) where x meets every row as well as the judged point may.
fn feasible_objective(point: &Point<'_>, x: &[f64], tolerance: f64) -> Option<f64> {
    let (meta, model) = (point.meta(), &point.origin.model);
    let mut rows = vec![0.0; meta.rows()];
    model.constraints(x, &mut rows).ok()?;
    let scale = |i: usize, limit: f64| tolerance * limit.abs().max(point.slopes[i]);
    let meets = |i: usize| {
        let (lower, upper) = (meta.row_lower[i], meta.row_upper[i]);
        (lower.is_infinite() || rows[i] >= lower - scale(i, lower)) && (upper.is_infinite() || rows[i] <= upper + scale(i, upper))
    };
    if (0..rows.len()).all(meets) { model.objective(x).ok() } else { None }
}
