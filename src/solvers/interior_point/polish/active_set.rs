//! Which components of w are held at which bound, and what follows from it.

use super::super::iterate::Iterate;
use super::super::parameters::PARAMETERS;
use super::super::slack_form::SlackForm;
use crate::math::within;
use crate::solvers::barrier::BoundState;

/// What to do with components whose slack and multiplier are both near zero.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Doubt {
    /// The larger of the two decides.
    Compare,
    /// Hold them.
    Hold,
}

/// Which bounds are active: those whose multiplier outweighs their slack.
pub(super) fn active_set(form: &SlackForm<'_>, iterate: &Iterate, doubt: Doubt) -> Vec<BoundState> {
    let active = |slack: f64, z: f64| {
        z > slack || (doubt == Doubt::Hold && slack < PARAMETERS.polish.ambiguous && z < PARAMETERS.polish.ambiguous)
    };
    (0..form.size())
        .map(|j| {
            let (below, above) = (iterate.w[j] - form.lower[j], form.upper[j] - iterate.w[j]);
            match (active(below, iterate.z_lower[j]), active(above, iterate.z_upper[j])) {
                (true, false) => BoundState::Lower,
                (false, true) => BoundState::Upper,
                (true, true) if below < above => BoundState::Lower,
                (true, true) => BoundState::Upper,
                (false, false) => BoundState::Free,
            }
        })
        .collect()
}

/// Releases what is held with a multiplier of the wrong sign, and holds what has run into a bound. Whether any did.
pub(super) fn revise(form: &SlackForm<'_>, sides: &mut [BoundState], point: &Iterate, scratch: &mut [f64]) -> bool {
    point.lagrangian_gradient(form, scratch);
    let mut changed = false;
    for (j, side) in sides.iter_mut().enumerate() {
        let revised = match *side {
            BoundState::Lower if scratch[j] < 0.0 => BoundState::Free,
            BoundState::Upper if scratch[j] > 0.0 => BoundState::Free,
            BoundState::Free if point.w[j] <= form.lower[j] => BoundState::Lower,
            BoundState::Free if point.w[j] >= form.upper[j] => BoundState::Upper,
            same => same,
        };
        changed |= revised != *side;
        *side = revised;
    }
    changed
}

/// Turns a gradient into the right-hand side of the free variables.
pub(super) fn restrict(sides: &[BoundState], variables: usize, right: &mut [f64]) {
    for (j, side) in sides.iter().enumerate() {
        right[j] = if *side != BoundState::Free || j >= variables { 0.0 } else { -right[j] };
    }
}

/// Σ that holds what is not free: a held variable stays, a held slack makes its row an equality, a free one takes its row out.
/// Variables get `rigid` or `free`.
pub(super) fn hold_firmly(sides: &[BoundState], variables: usize, (rigid, free): (f64, f64), sigma: &mut [f64]) {
    for (j, side) in sides.iter().enumerate() {
        sigma[j] = match (*side != BoundState::Free, j < variables) {
            (true, true) => rigid,
            (false, true) => free,
            (true, false) => f64::INFINITY,
            (false, false) => 1.0 / PARAMETERS.polish.inactive_weight,
        };
    }
}

/// Puts held components onto their bounds.
pub(super) fn hold(form: &SlackForm<'_>, sides: &[BoundState], point: &mut Iterate) {
    for (j, side) in sides.iter().enumerate() {
        match side {
            BoundState::Lower => point.w[j] = form.lower[j],
            BoundState::Upper => point.w[j] = form.upper[j],
            BoundState::Free => {}
        }
    }
}

/// Free slacks at their rows' values, bound multipliers from stationarity; the optimality error of the result.
pub(super) fn settle(form: &SlackForm<'_>, sides: &[BoundState], point: &mut Iterate, scratch: &mut [f64]) -> f64 {
    for (slack, row) in form.slack.iter().zip(&point.rows) {
        if let Some(slack) = slack.filter(|&slack| sides[slack] == BoundState::Free) {
            point.w[slack] = within(*row, form.lower[slack], form.upper[slack]);
        }
    }
    form.residual(&point.w, &point.rows, &mut point.residual);
    point.lagrangian_gradient(form, scratch);
    for (j, side) in sides.iter().enumerate() {
        point.z_lower[j] = if *side == BoundState::Lower { scratch[j].max(0.0) } else { 0.0 };
        point.z_upper[j] = if *side == BoundState::Upper { (-scratch[j]).max(0.0) } else { 0.0 };
    }
    point.errors(form, 0.0, scratch).largest()
}
