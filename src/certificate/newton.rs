//! Newton's own steps as a test of stationarity, where a slope is small only in a measure that may deceive: curvature, or the size
//! of a variable that nothing tells.
//!
//! From a point that is stationary they lead nowhere: they vanish, or (at a minimum that is flat to second order) shrink. In a tail
//! they stay as long as they are, or grow, and the objective falls at each; in wrong units they lead to another point.

use super::feasibility::worst_violation;
use super::point::Point;
use super::residuals::last_digits;
use super::runaway::{LARGEST, held_rows};
use super::scales;
use super::second_order::{Active, Choice};
use crate::model::Model;
use crate::recession::{self, Site};

/// Steps taken, and those by which they must have shrunk to less than SHRUNK times the first where they lead nowhere: towards
/// x^p = 0 they shrink by 1 − 1/(p − 1) each, towards the infimum of exp(−x) not at all.
const STEPS: usize = 40;
const SOON: usize = 8;
const SHRUNK: f64 = 0.8;
/// Steps below this, in sizes, are what the accepted slope and rounding make.
const LENGTH: f64 = 1e-14;
/// A variable that is seen at the point has moved where it has changed by more than this: the accepted slope of 1e−6 leaves a
/// point 1e−4 away where the Lagrangian bends by a hundredth of σ.
const MOVED: f64 = 1e-3;
/// Directions are stretched by this: further runs start at a tenth of them.
const STRETCH: f64 = 10.0;
/// The objective is lower where it has fallen by more than this share of itself, and by so many times what the last digits of the
/// point make of it. Where it has fallen by nearly all of itself its minimum may be 0, and any share says nothing.
const LOWER: f64 = 1e-3;
const NEARLY_ALL: f64 = 0.99;
const NOISE: f64 = 100.0;

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
    let site = Site {
        model: &point.origin.model,
        x: point.x,
        sizes: point.plain_sizes(),
        free: &free,
        held: &held,
        multipliers: &active.multipliers.rows,
        is_feasible: &|_| true,
    };
    let Some((x, lengths)) = recession::newton(&site, STEPS) else { return Newton::Stays };
    let fallen = fallen(point, &x, tolerance);
    if fallen <= LOWER {
        return Newton::Stays;
    }
    let stretched = |x: &[f64]| x.iter().zip(point.x).map(|(to, from)| STRETCH * (to - from)).collect();
    let share = |&j: &usize| (x[j] - point.x[j]).abs() / point.plain_sizes()[j];
    if fallen < NEARLY_ALL || free.iter().any(|j| !invented[*j] && share(j) > MOVED) {
        return Newton::LeadsTo(stretched(&x));
    }
    let has_shrunk = |at: usize| lengths[at] < SHRUNK * lengths[0] || lengths[0] <= LENGTH;
    if has_shrunk(SOON) || fallen < 0.5 {
        return Newton::Stays;
    }
    if has_shrunk(STEPS - 1) {
        return Newton::LeadsTo(stretched(&x));
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
