//! Whether a point meets its limits: its own violation, the nearest point that meets them to the last digit, and points that
//! meet them only because they are far away.

use super::known_sizes;
use super::point::{Origin, Point};
use super::residuals::{Place, Worst, worse};
use super::second_order::Kkt;
use crate::certificate::parameters::feasibility::{BESIDE, GONE, LARGEST, PASSES, ROUNDINGS, STEPS, TOLD, WORTH_A_LOOK};
use crate::model::Model;

/// How well a point meets rows and bounds.
pub(super) struct Feasibility {
    /// The worst relative violation, or the relative distance to a point that has none worth the name.
    pub(super) infeasibility: f64,
    /// The rows are met only beside variables that have grown large.
    pub(super) only_far_away: bool,
}

/// Judges a point. A violation beyond the tolerance of the row's own terms is none where a point without one lies within the
/// tolerance of the variables' sizes: x·y = 0 is met at (1e−20, 1e−20), where the terms themselves are nothing.
pub(super) fn of(point: &Point<'_>, tolerance: f64) -> Feasibility {
    let worst = worst_violation(point).1;
    if worst > tolerance {
        let infeasibility = distance_to_feasible(point, tolerance).unwrap_or(worst);
        return Feasibility { infeasibility, only_far_away: false };
    }
    match out_of_reach(point, tolerance) {
        Some(infeasibility) => Feasibility { infeasibility, only_far_away: true },
        None => Feasibility { infeasibility: worst, only_far_away: false },
    }
}

/// The point itself where it meets every limit, else one that does within `reach` of the variables' sizes at the point.
pub(super) fn nearest(origin: &Origin<'_>, x: &[f64], reach: f64, tolerance: f64) -> Option<Vec<f64>> {
    let point = Point::new(origin, x).ok()?;
    let meets = |at: &Point<'_>| of(at, tolerance).infeasibility <= tolerance;
    if meets(&point) {
        return Some(x.to_vec());
    }
    if x.len() + point.rows.len() > LARGEST {
        return None;
    }
    let back = way_back(&point, x.to_vec(), reach, &|at| worst_violation(at).1 <= tolerance)?;
    let is_met = Point::new(origin, &back).is_ok_and(|at| meets(&at));
    is_met.then_some(back)
}

/// A point within `reach` of the variables' sizes that meets every row to this tolerance of its own terms, however large the model.
pub(super) fn met_beside(origin: &Origin<'_>, x: &[f64], reach: f64, tolerance: f64) -> Option<Vec<f64>> {
    let point = Point::new(origin, x).ok()?;
    way_back(&point, x.to_vec(), reach, &|at| worst_violation(at).1 <= tolerance)
}

/// The worst relative violation and where.
pub(super) fn worst_violation(point: &Point<'_>) -> Worst {
    let rows = (0..point.rows.len()).map(|i| (Place::Row(i), point.row_violation(i)));
    let bounds = (0..point.x.len()).map(|j| (Place::Variable(j), point.bound_violation(j)));
    rows.chain(bounds).fold((None, 0.0), worse)
}

/// How far a point x̃ that meets every row in the measure of its own terms is away, where that is at most `tolerance`: what is zero
/// but for rounding is set to zero, then Newton steps lead back to the rows. |x̃_j − x_j| counts over |x_j|, of variables that
/// were zero over d_j: a size that was given, and is too large, hides nothing.
fn distance_to_feasible(point: &Point<'_>, tolerance: f64) -> Option<f64> {
    let is_near = |i: usize| {
        let (violation, limit) = point.row_excess(i);
        violation <= WORTH_A_LOOK * tolerance * limit.abs().max(point.slopes[i])
    };
    let bounds_are_met = (0..point.x.len()).all(|j| point.bound_violation(j) <= tolerance);
    if !bounds_are_met || !(0..point.rows.len()).all(is_near) {
        return None;
    }
    let without_rounding = |(&x, d): (&f64, &f64)| if x.abs() <= tolerance * d { 0.0 } else { x };
    let mut x: Vec<f64> = point.x.iter().zip(&point.sizes).map(without_rounding).collect();
    point.meta().clamp(&mut x);
    let x = way_back(point, x, tolerance, &|at| worst_violation(at).1 <= tolerance)?;
    let unit = |x: f64, d: f64| if x.abs() <= tolerance * d { d } else { x.abs() };
    let moves = x.iter().zip(point.x).zip(&point.sizes).map(|((there, &here), &d)| (there - here).abs() / unit(here, d));
    Some(moves.fold(0.0, f64::max)).filter(|farthest| *farthest <= tolerance)
}

/// max_j |x_j − point_j|/d_j
fn distance(point: &Point<'_>, x: &[f64]) -> f64 {
    x.iter().zip(point.x).zip(&point.sizes).fold(0.0, |most: f64, ((a, b), d)| most.max((a - b).abs() / d))
}

/// Newton steps from x back to the rows it violates, or violated on the way, to the first place that has `arrived`; `None` where that is no place within
/// `reach` of the point.
fn way_back(point: &Point<'_>, mut x: Vec<f64>, reach: f64, arrived: &dyn Fn(&Point<'_>) -> bool) -> Option<Vec<f64>> {
    // A row left again by a step towards others would be lost and won by turns.
    let mut is_violated = vec![false; point.rows.len()];
    for _ in 0..=STEPS {
        if distance(point, &x) > reach || point.is_over() {
            return None;
        }
        let at = Point::new(point.origin, &x).ok()?;
        if arrived(&at) {
            return Some(x);
        }
        if needs_more(point, &at, reach + distance(point, &x)) {
            return None;
        }
        is_violated.iter_mut().enumerate().for_each(|(i, is_violated)| *is_violated |= at.row_violation(i) > 0.0);
        x = step_back(&at, &|_, i| is_violated[i])?;
    }
    None
}

/// Whether no Newton step from `at` within `reach` of the variables' sizes at the point takes off a row's violation: Σ a_j·Δ_j is at most
/// max_j |Δ_j|/d_j times Σ |a_j|·d_j.
fn needs_more(point: &Point<'_>, at: &Point<'_>, reach: f64) -> bool {
    let meta = point.meta();
    let most = |i: usize| {
        let places = meta.jacobian.range(i).map(|place| (place, meta.jacobian.columns[place] as usize));
        places.filter(|&(_, j)| !meta.is_fixed(j)).map(|(place, j)| (at.jacobian[place] * point.sizes[j]).abs()).sum::<f64>()
            * reach
    };
    (0..meta.rows()).any(|i| at.row_violation(i) > 0.0 && at.slopes[i] > 0.0 && at.row_excess(i).0 > most(i))
}

/// The worst relative violation of a row beside the variables' known sizes, where that is more than `tolerance` and cannot be
/// taken off nearby; else `None`. The point meets all rows in its own measure, which grows with the variables, so that even
/// x + y = 1 and x + y = 1.000001 are both met once x and −y are large enough. It counts as feasible only where one that
/// meets the rows beside the known sizes lies near.
fn out_of_reach(point: &Point<'_>, tolerance: f64) -> Option<f64> {
    if (0..point.rows.len()).all(|i| point.row_violation(i) == 0.0) {
        return None;
    }
    let near = known_sizes::near_sizes(point);
    let worst = worst(point, &near);
    if worst <= tolerance {
        return None;
    }
    if (0..point.rows.len()).any(|i| is_lost(point, i, &near)) {
        return Some(worst);
    }
    match way_back(point, point.x.to_vec(), BESIDE, &|at| self::worst(at, &near) <= tolerance) {
        Some(_) => None,
        None => Some(worst),
    }
}

/// Whether row i misses a share of its own limit beside a variable that has left all that is known of its size behind: of (x − 1)·y ≥ 1e−6 at
/// x = 1 and y = 1e18 nothing is left but y.
fn is_lost(point: &Point<'_>, i: usize, near: &[f64]) -> bool {
    let (violation, limit) = point.row_excess(i);
    let has_left = |(j, slope): (usize, f64)| slope != 0.0 && !point.meta().is_fixed(j) && point.x[j].abs() > GONE * near[j];
    violation > TOLD * limit.abs() && limit != 0.0 && point.row_in_sizes(i).any(has_left)
}

/// max violation_i / max(|limit|, ‖diag(near)∇c_i‖∞), the slopes being those where no variable is farther away than that, less what
/// rounding explains: of a row whose rounding is more than a share of that measure nothing is known, and a violation is one.
fn worst(point: &Point<'_>, near: &[f64]) -> f64 {
    let (meta, slopes) = (point.meta(), held_back(point, near));
    let one = |i: usize| {
        let (violation, limit) = point.row_excess(i);
        if violation <= 0.0 {
            return 0.0;
        }
        let (mut slope, mut terms) = (0.0f64, limit.abs());
        for at in meta.jacobian.range(i) {
            let j = meta.jacobian.columns[at] as usize;
            slope = slope.max((slopes[at] * near[j]).abs());
            terms += (point.jacobian[at] * point.x[j]).abs();
        }
        let measure = limit.abs().max(slope).max(f64::MIN_POSITIVE);
        (violation - (ROUNDINGS * terms).min(TOLD * measure)).max(0.0) / measure
    };
    (0..point.rows.len()).map(one).fold(0.0, f64::max)
}

/// The Jacobian where variables far away are held back; that at the point where the model has none there.
fn held_back(point: &Point<'_>, near: &[f64]) -> Vec<f64> {
    let x: Vec<f64> = point.x.iter().zip(near).map(|(x, near)| x.clamp(-near, *near)).collect();
    let mut jacobian = vec![0.0; point.jacobian.len()];
    let is_there = x == point.x || point.origin.model.jacobian(&x, &mut jacobian).is_err();
    if is_there { point.jacobian.clone() } else { jacobian }
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
    let lack = |(k, &i): (usize, &usize)| (point.nearest_limit(i) - point.rows[i]) / kkt.slope(k);
    let right: Vec<f64> = std::iter::repeat_n(0.0, free.len()).chain(held.iter().enumerate().map(lack)).collect();
    let step = kkt.solve(&right).ok()?;
    let mut x = point.x.to_vec();
    for (&j, step) in free.iter().zip(step) {
        x[j] += step * point.sizes[j];
    }
    Some(x)
}
