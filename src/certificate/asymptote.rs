//! Asymptotes that no way outwards has to show: a value that rounding has made level, a bound at which a term has no value.

use super::higher_order::Trial;
use super::point::Point;
use super::residuals::is_far_out;
use super::scales;
use super::second_order::Active;
use crate::certificate::Side;
use crate::certificate::parameters::feasibility::ROUNDINGS;
use crate::certificate::parameters::runaway::{BESIDE, ONWARDS};
use crate::model::{EvaluationError, Model};
use crate::recession;

/// Whether the objective is level to the last digit, though not where the variables come from: all about the point or, far out, all the way on
/// to twice as far (about it the terms of an exponent that cancel one another may overflow at the least step). One that is analytic is then
/// constant for rounding alone: it nears an asymptote, and an underflow (exp(−800)) or 1 (tanh(20)) is all that is left of it.
pub(super) fn is_level(point: &Point<'_>) -> bool {
    let (meta, model, is_far) = (point.meta(), &point.origin.model, is_far_out(point));
    if meta.objective_is_linear || (point.sigma != 0.0 && !is_far) {
        return false;
    }
    let mut at_start = vec![0.0; point.x.len()];
    let is_other = model.gradient(&meta.start, &mut at_start).is_ok_and(|value| value != point.objective);
    if !is_other {
        return false;
    }
    let is_as_here = |x: &[f64]| {
        let mut gradient = vec![0.0; x.len()];
        let Ok(value) = model.gradient(x, &mut gradient) else { return false };
        // Slopes up to so much of those at the start are none, and what the variables' last digits make of a value is no change: √(x² + 1) − x
        // is nothing else far out.
        let is_flat = |j: usize| gradient[j].abs() <= if is_far { ROUNDINGS * at_start[j].abs() } else { 0.0 };
        let change = |moved: &[f64]| model.objective(moved).ok().map(|there| (there - value).abs());
        (0..x.len()).filter(|&j| !meta.is_fixed(j)).all(is_flat)
            && (value == point.objective
                || (is_far && (value - point.objective).abs() <= recession::last_digits(meta, x, change)))
    };
    if is_far {
        let on = |way: f64| -> Vec<f64> { point.x.iter().zip(&meta.start).map(|(x, start)| x + way * (x - start)).collect() };
        return ONWARDS.into_iter().all(|way| is_as_here(&on(way)));
    }
    [BESIDE, -BESIDE].into_iter().all(|step| is_as_here(&scales::moved(meta, point.x, &point.sizes, step)))
}

/// The variables that have moved most from where they come from.
pub(super) fn moved_most(point: &Point<'_>) -> Vec<usize> {
    let start = &point.meta().start;
    let share = |j: usize| ((point.x[j] - start[j]) / recession::size(start[j])).abs();
    let most = (0..point.x.len()).map(share).fold(0.0, f64::max);
    (0..point.x.len()).filter(|&j| share(j) > 1e-3 * most).collect()
}

/// The variables on their way to bounds where a term has no value: nothing rises as they come nearer, and the bound itself is out
/// of reach.
pub(super) fn towards_bounds(point: &Point<'_>, active: &Active<'_>, tolerance: f64) -> Vec<usize> {
    let meta = point.meta();
    let near = |j: usize| {
        let x = point.x[j];
        let bound = if x - meta.lower[j] <= meta.upper[j] - x { meta.lower[j] } else { meta.upper[j] };
        let size = bound.abs().max(point.sizes[j]);
        let rests = active.bounds[j] != Side::None && active.bounds[j] != Side::Equal;
        (x != bound && (rests || (x - bound).abs() <= 1e-8 * size)).then_some((j, bound))
    };
    let near: Vec<(usize, f64)> = (0..point.x.len()).filter_map(near).collect();
    let at_share = |share: f64| {
        let mut x = point.x.to_vec();
        near.iter().for_each(|&(j, bound)| x[j] = bound + share * (x[j] - bound));
        x
    };
    let value = |share: f64| {
        Trial::at(point, &at_share(share)).filter(|trial| trial.is_feasible(point, tolerance)).map(|trial| trial.objective)
    };
    let on_bounds = || {
        let x = at_share(0.0);
        point.origin.model.objective(&x).and_then(|_| point.origin.model.constraints(&x, &mut vec![0.0; meta.rows()]))
    };
    if near.is_empty() || !matches!(on_bounds(), Err(EvaluationError::Invalid { .. })) {
        return Vec::new();
    }
    let level = 64.0 * f64::EPSILON * point.objective.abs();
    // So near that no number lies between: as near as the bound itself.
    let has_arrived = |share: f64| near.iter().all(|&(j, bound)| bound + share * (point.x[j] - bound) == bound);
    let stays = |share: f64| has_arrived(share) || value(share).is_some_and(|f| f <= point.objective + level);
    let never_rises = [0.1, 0.01, 1e-3].into_iter().all(stays);
    if never_rises { near.into_iter().map(|(j, _)| j).collect() } else { Vec::new() }
}
