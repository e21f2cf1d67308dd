//! Variables that run away: the point passes only because the objective flattens out, and would go on falling for ever (exp(x)
//! towards −∞), or because a term has no value at the bound it falls towards. Such an infimum is not attained.

use super::feasibility::worst_violation;
use super::higher_order::Trial;
use super::point::Point;
use super::second_order::{Active, Choice, Hessian, Kkt};
use super::{Class, Tolerances};
use crate::model::{EvaluationError, Model};
use crate::recession::{Site, Valley};

/// Directions that bend by less than this, in units of σ, are looked at.
const FLAT: f64 = 1e-3;
const DIRECTIONS: usize = 12;
/// Variables followed at the most.
const FOLLOWED: usize = 12;
/// Above this order (variables and rows) the other variables stay where they are while one is followed: a Newton step on dense
/// matrices of order N takes N³ operations, and some thousand steps are taken.
pub(super) const LARGEST: usize = 120;
/// Above this order, flat directions are those of single variables.
const LARGEST_FOR_DIRECTIONS: usize = 2_000;

/// The variables along whose way the objective falls, however far one goes; empty at a true minimum. A linear problem that has a
/// bound attains it (fundamental theorem of linear programming).
pub(super) fn variables(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    class: Class,
    tolerances: &Tolerances,
) -> Vec<usize> {
    if class == Class::Linear {
        return Vec::new();
    }
    let choice = Choice::all(point, active);
    let directions = directions(point, hessian, &choice);
    let follows = choice.free.len() + choice.held.len() <= LARGEST;
    let is_feasible = |x: &[f64]| {
        !point.is_over() && Point::new(point.origin, x).is_ok_and(|there| worst_violation(&there).1 <= tolerances.constraint)
    };
    let held = |rows: Vec<usize>| held_rows(point, rows);
    let runs_off = |free: &[usize], held: &[(usize, f64)]| {
        let site = Site {
            model: &point.origin.model,
            x: point.x,
            sizes: point.plain_sizes(),
            free,
            held,
            multipliers: &active.multipliers.rows,
            is_feasible: &is_feasible,
        };
        let valley = Valley::new(site);
        let both = directions
            .iter()
            .flat_map(|direction| [1.0, -1.0].map(|way| direction.iter().map(|v| way * v).collect::<Vec<f64>>()));
        both.into_iter().find(|direction| valley.runs_off(direction))
    };
    let found = if follows {
        // Far from the start, multipliers may be too small to tell which rows push.
        let (free, strict, all) = (choice.loose_variables(), held(choice.strict_rows()), held(choice.held.clone()));
        runs_off(&free, &strict).or_else(|| if all.len() > strict.len() { runs_off(&free, &all) } else { None })
    } else {
        runs_off(&[], &[])
    };
    match found {
        Some(direction) => moving(point, &direction),
        None => towards_bounds(point, tolerances.constraint),
    }
}

/// Rows with the limits they are held to.
pub(super) fn held_rows(point: &Point<'_>, rows: Vec<usize>) -> Vec<(usize, f64)> {
    rows.into_iter().map(|i| (i, point.nearest_limit(i))).filter(|held| held.1.is_finite()).collect()
}

/// The variables that take part in a direction.
fn moving(point: &Point<'_>, direction: &[f64]) -> Vec<usize> {
    let share = |j: usize| (direction[j] / point.plain_sizes()[j]).abs();
    let most = (0..direction.len()).map(share).fold(0.0, f64::max);
    (0..direction.len()).filter(|&j| share(j) > 1e-3 * most).collect()
}

/// Flat directions, each as it is and its variables that move most one by one; then the ways that have led here, from the start
/// and from zero.
fn directions(point: &Point<'_>, hessian: &Hessian, choice: &Choice) -> Vec<Vec<f64>> {
    let meta = point.meta();
    let is_open = |&j: &usize| meta.lower[j] == f64::NEG_INFINITY || meta.upper[j] == f64::INFINITY;
    let (mut found, mut axes) = (Vec::new(), Vec::new());
    if choice.free.len() + choice.held.len() <= LARGEST_FOR_DIRECTIONS {
        let (free, held) = (choice.loose_variables(), choice.strict_rows());
        let flat = Kkt::new(point, hessian, &free, &held)
            .and_then(|mut kkt| if kkt.is_flat(FLAT)? { kkt.flat_directions(DIRECTIONS, FLAT) } else { Ok(Vec::new()) });
        for direction in flat.unwrap_or_default() {
            let share = |j: &usize| (direction[*j] / point.sizes[*j]).abs();
            let mut open: Vec<usize> = free.iter().copied().filter(is_open).filter(|j| share(j) >= 0.1).collect();
            open.sort_by(|a, b| share(b).total_cmp(&share(a)));
            axes.extend(open.into_iter().take(2));
            found.push(direction);
        }
        if !found.is_empty() || point.relies_on_curvature {
            found.push(point.x.iter().zip(&meta.start).map(|(x, start)| x - start).collect());
            found.push(point.x.to_vec());
        }
    } else {
        let mut flat: Vec<usize> = choice.free.iter().copied().filter(is_open).filter(|&j| hessian.size[j] <= FLAT).collect();
        flat.sort_by(|&a, &b| hessian.size[a].total_cmp(&hessian.size[b]));
        axes.extend(flat);
    }
    let mut seen = std::collections::HashSet::new();
    axes.retain(|j| seen.insert(*j));
    found.extend(axes.into_iter().take(FOLLOWED).map(|j| {
        let mut axis = vec![0.0; meta.variables()];
        axis[j] = point.plain_sizes()[j];
        axis
    }));
    found
}

/// The variables on their way to bounds where a term has no value: nothing rises as they come nearer, and the bound itself is out
/// of reach.
fn towards_bounds(point: &Point<'_>, tolerance: f64) -> Vec<usize> {
    let meta = point.meta();
    let near = |j: usize| {
        let x = point.x[j];
        let bound = if x - meta.lower[j] <= meta.upper[j] - x { meta.lower[j] } else { meta.upper[j] };
        let size = bound.abs().max(point.sizes[j]);
        (x != bound && (x - bound).abs() <= 1e-8 * size).then_some((j, bound))
    };
    let near: Vec<(usize, f64)> = (0..point.x.len()).filter_map(near).collect();
    let value = |share: f64| {
        let mut x = point.x.to_vec();
        near.iter().for_each(|&(j, bound)| x[j] = bound + share * (x[j] - bound));
        Trial::at(point, &x).filter(|trial| trial.is_feasible(point, tolerance)).map(|trial| trial.objective)
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
    // So near that no number lies between: as near as the bound itself.
    let has_arrived = |share: f64| near.iter().all(|&(j, bound)| bound + share * (point.x[j] - bound) == bound);
    let stays = |share: f64| has_arrived(share) || value(share).is_some_and(|f| f <= point.objective + level);
    let never_rises = [0.1, 0.01, 1e-3].into_iter().all(stays);
    if never_rises { near.into_iter().map(|(j, _)| j).collect() } else { Vec::new() }
}
