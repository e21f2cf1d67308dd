//! Variables that run away: the point passes only because the objective flattens out, and would go on falling for ever (exp(x)
//! towards −∞), or because a term has no value at the bound it falls towards. Such an infimum is not attained.

use super::asymptote;
use super::bounded;
use super::feasibility::{self, worst_violation};
use super::known_sizes;
use super::point::Point;
use super::second_order::{Active, Choice, Hessian, Kkt};
use super::{Class, Tolerances};
use crate::certificate::parameters::runaway::{
    DIRECTIONS, FAR, FLAT, FOLLOWED, LARGEST, LARGEST_FOR_DIRECTIONS, OUTWARDS, PARALLEL,
};
use crate::recession::{self, Fall, Ray, Site, Valley};

/// Variables along whose way the objective falls, however far one goes; none at a true minimum.
#[derive(Debug, Default)]
pub(super) struct Runaway {
    pub(super) variables: Vec<usize>,
    /// It falls no less the farther one goes.
    pub(super) is_endless: bool,
}

impl Runaway {
    pub(super) fn settling(variables: Vec<usize>) -> Self {
        Runaway { variables, is_endless: false }
    }
}

/// Looks for a way along which the objective falls for ever. A linear problem that has a bound attains it (fundamental theorem of
/// linear programming). `dependent`: the active limits depend on one another.
pub(super) fn find(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    (class, dependent): (Class, bool),
    tolerances: &Tolerances,
) -> Runaway {
    if class == Class::Linear {
        return Runaway::default();
    }
    let open = bounded::open(point);
    // A continuous objective attains its infimum on a compact set (Weierstrass).
    let found = if open.is_empty() { None } else { way_outwards(point, active, hessian, (&open, dependent), tolerances) };
    match found {
        Some((direction, fall)) => {
            Runaway { variables: moving(point, &direction), is_endless: fall == Fall::Endless && may_be_endless(point, class) }
        }
        None if asymptote::is_level(point) => Runaway::settling(asymptote::moved_most(point)),
        None => Runaway::settling(asymptote::towards_bounds(point, active, tolerances.constraint)),
    }
}

/// A way along which the objective falls for ever, outwards in one of the variables that are open.
fn way_outwards(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    (open, dependent): (&[usize], bool),
    tolerances: &Tolerances,
) -> Option<(Vec<f64>, Fall)> {
    let choice = Choice::all(point, active);
    let mut directions = directions(point, hessian, &choice, (open, dependent));
    directions.retain(|direction| {
        recession::moves_most(direction, point.plain_sizes()).is_some_and(|j| open.binary_search(&j).is_ok())
    });
    if choice.free.len() + choice.held.len() > LARGEST {
        return follow(point, active, &directions, (&[], &[]), tolerances);
    }
    // Far out, multipliers may be too small to tell which rows push; and of limits that depend on one another a row may need a
    // variable that seems to rest on its bound.
    let held = |rows: Vec<usize>| held_rows(point, rows);
    let (free, strict, all) = (choice.loose_variables(), held(choice.strict_rows()), held(choice.held.clone()));
    let movable = || (0..point.x.len()).filter(|&j| !point.meta().is_fixed(j)).collect::<Vec<usize>>();
    follow(point, active, &directions, (&free, &strict), tolerances)
        .or_else(|| (all.len() > strict.len()).then(|| follow(point, active, &directions, (&free, &all), tolerances))?)
        .or_else(|| (dependent && !all.is_empty()).then(|| follow(point, active, &directions, (&movable(), &all), tolerances))?)
        .or_else(|| one_released(point, active, (&free, &all), (open, dependent), tolerances))
}

/// Outwards in a variable that is far from its start, with one of those that seem to rest on bounds led back to the rows, the others (slacks
/// among them) staying where they are.
fn one_released(
    point: &Point<'_>,
    active: &Active<'_>,
    (free, held): (&[usize], &[(usize, f64)]),
    (open, dependent): (&[usize], bool),
    tolerances: &Tolerances,
) -> Option<(Vec<f64>, Fall)> {
    if !dependent || held.is_empty() {
        return None;
    }
    let axes: Vec<Vec<f64>> = far_out(point, free, open).take(OUTWARDS).map(|j| axis(point, j)).collect();
    let resting = (0..point.x.len()).filter(|j| !point.meta().is_fixed(*j) && !free.contains(j));
    let mut tried = resting.take(if axes.is_empty() { 0 } else { FOLLOWED });
    tried.find_map(|j| follow(point, active, &axes, (&[j], held), tolerances))
}

/// Open variables that are far from where they come from.
fn far_out<'a>(point: &'a Point<'_>, free: &'a [usize], open: &'a [usize]) -> impl Iterator<Item = usize> + 'a {
    let is_far = |&j: &usize| recession::is_farther(point.x[j], point.meta().start[j], FAR);
    free.iter().copied().filter(|j| open.binary_search(j).is_ok()).filter(is_far)
}

/// One size of variable j.
fn axis(point: &Point<'_>, j: usize) -> Vec<f64> {
    let mut axis = vec![0.0; point.x.len()];
    axis[j] = point.plain_sizes()[j];
    axis
}

/// Whether the class leaves it open: a posynomial that is minimised, not the inverse of one that is maximised, stays positive.
fn may_be_endless(point: &Point<'_>, class: Class) -> bool {
    class != Class::GeometricProgram || point.objective < 0.0
}

/// The same from a feasible point that need not be stationary: outwards on the way that has led there from the start, and along the
/// variables that have moved most on it.
pub(super) fn beyond(point: &Point<'_>, active: &Active<'_>, class: Class, tolerances: &Tolerances) -> Option<Ray> {
    let choice = Choice::all(point, active);
    let (free, held) = (choice.loose_variables(), held_rows(point, choice.held.clone()));
    if class == Class::Linear || free.len() + held.len() > LARGEST {
        return None;
    }
    let way: Vec<f64> = point.x.iter().zip(&point.meta().start).map(|(x, start)| x - start).collect();
    let mut farthest: Vec<usize> = free.iter().copied().filter(|&j| way[j] != 0.0).collect();
    let moved = |j: usize| (way[j] / recession::size(point.meta().start[j])).abs();
    farthest.sort_by(|&a, &b| moved(b).total_cmp(&moved(a)));
    let axis = |j: usize| {
        let mut axis = vec![0.0; way.len()];
        axis[j] = way[j];
        axis
    };
    let axes = farthest.into_iter().take(OUTWARDS).map(axis);
    let directions: Vec<Vec<f64>> = axes.chain([way.clone()]).collect();
    let (direction, fall) = follow(point, active, &directions, (&free, &held), tolerances)?;
    let fall = if may_be_endless(point, class) { fall } else { Fall::Settling };
    Some(Ray { fall, direction, from: point.x.to_vec() })
}

/// The first of the directions, each both ways, that runs off.
fn follow(
    point: &Point<'_>,
    active: &Active<'_>,
    directions: &[Vec<f64>],
    (free, held): (&[usize], &[(usize, f64)]),
    tolerances: &Tolerances,
) -> Option<(Vec<f64>, Fall)> {
    let is_feasible = |x: &[f64]| {
        let meets = |there: Point<'_>| {
            worst_violation(&there).1 <= tolerances.constraint
                || feasibility::of(&there, tolerances.constraint).infeasibility <= tolerances.constraint
        };
        !point.is_over() && Point::new(point.origin, x).is_ok_and(meets)
    };
    let known = known_sizes::told_sizes(point.origin, point.x, &point.jacobian);
    let site = Site {
        model: &point.origin.model,
        x: point.x,
        sizes: point.plain_sizes(),
        known: &known,
        free,
        held,
        multipliers: &active.multipliers.rows,
        is_feasible: &is_feasible,
    };
    let valley = Valley::new(site);
    let both =
        directions.iter().flat_map(|direction| [1.0, -1.0].map(|way| direction.iter().map(|v| way * v).collect::<Vec<f64>>()));
    let mut within_time = both.into_iter().take_while(|_| !point.is_over());
    within_time.find_map(|direction| valley.runs_off(&direction).map(|fall| (direction, fall)))
}

/// Rows with the limits they are held to: of several whose gradients point the same way the one that is missed most, or the equality.
/// The others follow from it, and held to their own limits contradict it.
pub(super) fn held_rows(point: &Point<'_>, rows: Vec<usize>) -> Vec<(usize, f64)> {
    let with_limit = rows.into_iter().map(|i| (i, point.nearest_limit(i))).filter(|held| held.1.is_finite());
    let mut kept: Vec<(usize, f64)> = Vec::new();
    for row in with_limit {
        match kept.iter_mut().find(|other| is_alike(point, other.0, row.0)) {
            Some(other) if missed(point, row) > missed(point, *other) => *other = row,
            Some(_) => {}
            None => kept.push(row),
        }
    }
    kept.sort_unstable_by_key(|held| held.0);
    kept
}

/// By how much a row misses its limit, outwards, in units of its slope; an equality more than any other.
fn missed(point: &Point<'_>, (i, limit): (usize, f64)) -> f64 {
    let meta = point.meta();
    if meta.row_lower[i] == meta.row_upper[i] {
        return f64::INFINITY;
    }
    let outwards = if limit == meta.row_lower[i] { limit - point.rows[i] } else { point.rows[i] - limit };
    outwards / point.slopes[i].max(f64::MIN_POSITIVE)
}

/// Whether two rows push the same way: gradients that are parallel, towards limits on the same side.
fn is_alike(point: &Point<'_>, i: usize, k: usize) -> bool {
    let outwards = |i: usize| {
        let way = if point.nearest_limit(i) == point.meta().row_lower[i] { -1.0 } else { 1.0 };
        let moves = |entry: &(usize, f64)| entry.1 != 0.0 && !point.meta().is_fixed(entry.0);
        point.row_in_sizes(i).filter(moves).map(move |(j, entry)| (j, way * entry))
    };
    let is_equality = |i: usize| point.meta().row_lower[i] == point.meta().row_upper[i];
    let (mut same, mut opposite) = (true, is_equality(i) || is_equality(k));
    let (mut one, mut other) = (outwards(i), outwards(k));
    loop {
        match (one.next(), other.next()) {
            (None, None) => return same || opposite,
            (Some((j, a)), Some((l, b))) if j == l => {
                same &= (a - b).abs() <= PARALLEL;
                opposite &= (a + b).abs() <= PARALLEL;
            }
            _ => return false,
        }
        if !same && !opposite {
            return false;
        }
    }
}

/// The variables that take part in a direction.
fn moving(point: &Point<'_>, direction: &[f64]) -> Vec<usize> {
    let share = |j: usize| (direction[j] / point.plain_sizes()[j]).abs();
    let most = (0..direction.len()).map(share).fold(0.0, f64::max);
    (0..direction.len()).filter(|&j| share(j) > 1e-3 * most).collect()
}

/// Flat directions, each as it is and its variables that move most one by one; then the ways that have led here, from the start
/// and from zero.
fn directions(point: &Point<'_>, hessian: &Hessian, choice: &Choice, (open, dependent): (&[usize], bool)) -> Vec<Vec<f64>> {
    let meta = point.meta();
    let is_open = |j: &usize| open.binary_search(j).is_ok();
    let (mut found, mut axes) = (Vec::new(), Vec::new());
    if choice.free.len() + choice.held.len() <= LARGEST_FOR_DIRECTIONS {
        let (free, held) = (choice.loose_variables(), choice.strict_rows());
        let flat = Kkt::new(point, hessian, &free, &held)
            .and_then(|mut kkt| if kkt.is_flat(FLAT)? { kkt.flat_directions(DIRECTIONS, FLAT) } else { Ok(Vec::new()) });
        for direction in flat.unwrap_or_default() {
            let share = |j: &usize| (direction[*j] / point.sizes[*j]).abs();
            let mut most: Vec<usize> = free.iter().copied().filter(is_open).filter(|j| share(j) >= 0.1).collect();
            most.sort_by(|a, b| share(b).total_cmp(&share(a)));
            axes.extend(most.into_iter().take(2));
            found.push(direction);
        }
        if !found.is_empty() || point.relies_on_curvature {
            found.push(point.x.iter().zip(&meta.start).map(|(x, start)| x - start).collect());
            found.push(point.x.to_vec());
        }
        // Of limits that depend on one another, a row may only seem to hold a variable far from where it comes from.
        axes.extend(far_out(point, &free, open).take(if dependent { OUTWARDS } else { 0 }));
    } else {
        let mut flat: Vec<usize> = choice.free.iter().copied().filter(is_open).filter(|&j| hessian.size[j] <= FLAT).collect();
        flat.sort_by(|&a, &b| hessian.size[a].total_cmp(&hessian.size[b]));
        axes.extend(flat);
    }
    let mut seen = std::collections::HashSet::new();
    axes.retain(|j| seen.insert(*j));
    found.extend(axes.into_iter().take(FOLLOWED).map(|j| axis(point, j)));
    found
}
