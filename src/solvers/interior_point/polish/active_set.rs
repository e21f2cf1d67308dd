//! Which components of w are held at which bound, and what follows from it.

use super::super::iterate::Iterate;
use super::super::parameters::PARAMETERS;
use super::super::slack_form::SlackForm;
use crate::math::within;

/// Where each component of w is held: at its lower or upper bound, or not at all.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Side {
    Free,
    Lower,
    Upper,
}

/// What to do with components whose slack and multiplier are both near zero.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Doubt {
    /// The larger of the two decides.
    Compare,
    /// Hold them.
    Hold,
}

/// Which bounds are active: those whose multiplier outweighs their slack.
pub(super) fn active_set(form: &SlackForm<'_>, iterate: &Iterate, doubt: Doubt) -> Vec<Side> {
    let active = |slack: f64, z: f64| {
        z > slack || (doubt == Doubt::Hold && slack < PARAMETERS.polish.ambiguous && z < PARAMETERS.polish.ambiguous)
    };
    (0..form.size())
        .map(|j| {
            let (below, above) = (iterate.w[j] - form.lower[j], form.upper[j] - iterate.w[j]);
            match (active(below, iterate.z_lower[j]), active(above, iterate.z_upper[j])) {
                (true, false) => Side::Lower,
                (false, true) => Side::Upper,
                (true, true) if below < above => Side::Lower,
                (true, true) => Side::Upper,
                (false, false) => Side::Free,
            }
        })
        .collect()
}

/// Lets go what is held with a multiplier of the wrong sign, and holds what has run into a bound. Whether any did.
pub(super) fn revise(form: &SlackForm<'_>, sides: &mut [Side], point: &Iterate, scratch: &mut [f64]) -> bool {
    point.lagrangian_gradient(form, scratch);
    let mut changed = false;
    for (j, side) in sides.iter_mut().enumerate() {
        let revised = match *side {
            Side::Lower if scratch[j] < 0.0 => Side::Free,
            Side::Upper if scratch[j] > 0.0 => Side::Free,
            Side::Free if point.w[j] <= form.lower[j] => Side::Lower,
            Side::Free if point.w[j] >= form.upper[j] => Side::Upper,
            same => same,
        };
        changed |= revised != *side;
        *side = revised;
    }
    changed
}

/// Turns a gradient into the right-hand side of the free variables.
pub(super) fn restrict(sides: &[Side], variables: usize, right: &mut [f64]) {
    for (j, side) in sides.iter().enumerate() {
        right[j] = if *side != Side::Free || j >= variables { 0.0 } else { -right[j] };
    }
}

/// Σ that holds what is not free: a held variable stays, a held slack makes its row an equality, a free one takes its row out.
/// Variables get `rigid` or `free`.
pub(super) fn hold_firmly(sides: &[Side], variables: usize, (rigid, free): (f64, f64), sigma: &mut [f64]) {
    for (j, side) in sides.iter().enumerate() {
        sigma[j] = match (*side != Side::Free, j < variables) {
            (true, true) => rigid,
            (false, true) => free,
            (true, false) => f64::INFINITY,
            (false, false) => 1.0 / PARAMETERS.polish.inactive_weight,
        };
    }
}

/// Puts held components onto their bounds.
pub(super) fn hold(form: &SlackForm<'_>, sides: &[Side], point: &mut Iterate) {
    for (j, side) in sides.iter().enumerate() {
        match side {
            Side::Lower => point.w[j] = form.lower[j],
            Side::Upper => point.w[j] = form.upper[j],
            Side::Free => {}
        }
    }
}

/// Free slacks at their rows' values, bound multipliers from stationarity; the optimality error of the result.
pub(super) fn settle(form: &SlackForm<'_>, sides: &[Side], point: &mut Iterate, scratch: &mut [f64]) -> f64 {
    for (slack, row) in form.slack.iter().zip(&point.rows) {
        if let Some(slack) = slack.filter(|&slack| sides[slack] == Side::Free) {
            point.w[slack] = within(*row, form.lower[slack], form.upper[slack]);
        }
    }
    form.residual(&point.w, &point.rows, &mut point.residual);
    point.lagrangian_gradient(form, scratch);
    for (j, side) in sides.iter().enumerate() {
        point.z_lower[j] = if *side == Side::Lower { scratch[j].max(0.0) } else { 0.0 };
        point.z_upper[j] = if *side == Side::Upper { (-scratch[j]).max(0.0) } else { 0.0 };
    }
    point.errors(form, 0.0, scratch).largest()
}
