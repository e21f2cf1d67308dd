//! Asymptotes that no way outwards has to show: a value that rounding has made level, a bound at which a term has no value.

use super::higher_order::Trial;
use super::point::Point;
use super::residuals::is_far_out;
use super::scales;
use super::second_order::Active;
use crate::certificate::Side;
use crate::certificate::parameters::feasibility::ROUNDINGS;
use crate::certificate::parameters::runaway::{BESIDE, NEARER, ONWARDS};
use crate::model::{EvaluationError, Model};
use crate::recession;

/// Whether the objective is level to the last digit, though not where the variables come from: all about the point or, far out, as far again
/// as it is from there. One that is analytic is then constant for rounding alone: it nears an asymptote, and an underflow (exp(−800)) or 1 (tanh(20)) is all
/// that is left of it.
pub(super) fn is_level(point: &Point<'_>) -> bool {
    let (meta, model, is_far) = (point.meta(), &point.origin.model, is_far_out(point));
    if meta.objective_is_linear || (point.sigma != 0.0 && !is_far) {
        return false;
    }
    let mut at_start = vec![0.0; point.x.len()];
    let is_other = model.gradient(&meta.start, &mut at_start).is_ok_and(|value| value != point.objective);
    let beside = || [BESIDE, -BESIDE].map(|step| scales::moved(meta, point.x, &point.sizes, step)).to_vec();
    let onwards = || {
        let on = |way: f64| point.x.iter().zip(&meta.start).map(|(x, start)| x + way * (x - start)).collect();
        ONWARDS.map(on).to_vec()
    };
    let is_level = |places: Vec<Vec<f64>>| is_level_at(point, places, &at_start);
    is_other && (is_constant_about(point, is_far) || (is_far && (is_level(beside()) || is_level(onwards()))))
}

/// Whether all derivatives are 0 and the value the same beside the point. Far out «beside» may be near: where an exponent's terms cancel one another,
/// the least step has it overflow.
fn is_constant_about(point: &Point<'_>, is_far: bool) -> bool {
    let is_constant = |step: f64| {
        [step, -step].into_iter().all(|step| {
            let (x, mut gradient) = (scales::moved(point.meta(), point.x, &point.sizes, step), vec![0.0; point.x.len()]);
            let value = point.origin.model.gradient(&x, &mut gradient);
            value.is_ok_and(|value| value == point.objective)
                && gradient.iter().enumerate().all(|(j, g)| *g == 0.0 || point.meta().is_fixed(j))
        })
    };
    point.sigma == 0.0 && (is_constant(BESIDE) || (is_far && NEARER.into_iter().any(is_constant)))
}

/// Whether at all of these places slopes are nothing beside those at the start, and values differ from the point's by no more than the last digits of
/// the variables make of them: √(x² + 1) − x is nothing else far out.
fn is_level_at(point: &Point<'_>, places: Vec<Vec<f64>>, at_start: &[f64]) -> bool {
    let (meta, model) = (point.meta(), &point.origin.model);
    let is_flat =
        |gradient: &[f64]| (0..gradient.len()).all(|j| meta.is_fixed(j) || gradient[j].abs() <= ROUNDINGS * at_start[j].abs());
    let height = |x: Vec<f64>| {
        let mut gradient = vec![0.0; at_start.len()];
        let value = model.gradient(&x, &mut gradient).ok().filter(|_| is_flat(&gradient))?;
        let change = |moved: &[f64]| model.objective(moved).ok().map(|there| (there - value).abs());
        Some((value, recession::last_digits(meta, &x, change)))
    };
    let heights = [point.x.to_vec()].into_iter().chain(places).map(height).collect::<Option<Vec<_>>>();
    // What digits make of one value is chance; of several, less so.
    let noise = heights.iter().flatten().map(|(_, noise)| *noise).fold(0.0, f64::max);
    heights.is_some_and(|heights| heights.iter().all(|(value, _)| (value - point.objective).abs() <= noise))
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
        Trial::at(point, &at_share(share)).filter(|trial| trial.is_feasible(point, tolerance)).map(|trial| trial.objective())
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
