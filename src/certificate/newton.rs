//! Newton's own steps as a test of stationarity, where a slope is small only in a measure that may deceive: curvature, or the size
//! of a variable that nothing tells.
//!
//! From a point that is stationary they lead nowhere: they vanish, or (at a minimum that is flat to second order) shrink. In a tail
//! they stay as long as they are, or grow, and the objective falls at each; in wrong units they lead to another point.

use super::feasibility::worst_violation;
use super::point::Point;
use super::residuals::last_digits;
use super::runaway::held_rows;
use super::scales;
use super::second_order::{Active, Choice};
use crate::certificate::parameters::higher_order::STRETCH;
use crate::certificate::parameters::newton::{LENGTH, LOWER, MOVED, NEARLY_ALL, NOISE, SHORTENING, SOON, SOON_SHORTENING, STEPS};
use crate::certificate::parameters::runaway::LARGEST;
use crate::model::Model;
use crate::recession::{self, Site};

/// What Newton's steps say of a point.
pub(super) enum Newton {
    /// They stay, or the measure needs no such test.
    Stays,
    /// To another point, ten times the way to it.
    LeadsTo(Vec<f64>),
    /// Without end: the objective falls with these variables.
    Falls(Vec<usize>),
}

/// Takes the steps where the slope is small only in the measure of curvature or of an invented size. Only where they end at a
/// feasible point that is lower do they say anything.
pub(super) fn steps(point: &Point<'_>, active: &Active<'_>, tolerance: f64) -> Newton {
    let invented = scales::invented(point.meta(), point.x, &point.jacobian);
    if !point.relies_on_curvature && !invented.contains(&true) {
        return Newton::Stays;
    }
    let choice = Choice::all(point, active);
    let (free, held) = (choice.loose_variables(), held_rows(point, choice.strict_rows()));
    if free.is_empty() || free.len() + held.len() > LARGEST {
        return Newton::Stays;
    }
    let by = |sizes: &[f64]| in_sizes(point, active, (&free, &held), (&invented, sizes), tolerance);
    match by(point.plain_sizes()) {
        // An invented size may be too large as well: what is seen of the variable is the least it can be.
        Newton::Stays => seen_sizes(point, &invented).map_or(Newton::Stays, |sizes| by(&sizes)),
        leads_on => leads_on,
    }
}

/// The sizes with |x_j| in the place of those that are invented; `None` where that changes nothing.
fn seen_sizes(point: &Point<'_>, invented: &[bool]) -> Option<Vec<f64>> {
    let is_seen = |j: usize| invented[j] && point.x[j] != 0.0;
    let size = |(j, &size): (usize, &f64)| if is_seen(j) { point.x[j].abs() } else { size };
    (0..invented.len()).any(is_seen).then(|| point.plain_sizes().iter().enumerate().map(size).collect())
}

/// The steps, damped in these sizes.
fn in_sizes(
    point: &Point<'_>,
    active: &Active<'_>,
    (free, held): (&[usize], &[(usize, f64)]),
    (invented, sizes): (&[bool], &[f64]),
    tolerance: f64,
) -> Newton {
    let site = Site {
        model: &point.origin.model,
        x: point.x,
        sizes,
        known: sizes,
        free,
        held,
        multipliers: &active.multipliers.rows,
        is_feasible: &|_| true,
    };
    let Some((x, lengths)) = recession::newton(&site, STEPS) else { return Newton::Stays };
    let fallen = fallen(point, &x, tolerance);
    if fallen <= LOWER {
        return Newton::Stays;
    }
    let stretched = |x: &[f64]| x.iter().zip(point.x).map(|(to, from)| STRETCH * (to - from)).collect();
    let share = |&j: &usize| (x[j] - point.x[j]).abs() / sizes[j];
    if fallen < NEARLY_ALL || free.iter().any(|j| !invented[*j] && share(j) > MOVED) {
        return Newton::LeadsTo(stretched(&x));
    }
    // ln of how much shorter each of the first steps has become on average
    let shortening = |steps: usize| (lengths[0] / lengths[steps].max(f64::EPSILON * lengths[0])).ln() / steps as f64;
    let (soon, on_the_whole) = (shortening(SOON), shortening(STEPS - 1));
    if lengths[0] <= LENGTH || fallen < 0.5 || soon > SOON_SHORTENING {
        return Newton::Stays;
    }
    if on_the_whole > SHORTENING {
        // Those that lead to another point are as long as they may be until they come near it.
        return if soon > 0.5 * on_the_whole { Newton::Stays } else { Newton::LeadsTo(stretched(&x)) };
    }
    let most = free.iter().map(share).fold(0.0, f64::max);
    Newton::Falls(free.iter().copied().filter(|j| share(j) > 1e-3 * most).collect())
}

/// By which share of itself the objective has fallen on the way to x, where that is feasible.
fn fallen(point: &Point<'_>, x: &[f64], tolerance: f64) -> f64 {
    let is_feasible = Point::new(point.origin, x).is_ok_and(|there| worst_violation(&there).1 <= tolerance);
    match point.origin.model.objective(x) {
        Ok(there) if is_feasible && there < point.objective - NOISE * last_digits(point) => {
            (point.objective - there) / point.objective.abs()
        }
        _ => 0.0,
    }
}
