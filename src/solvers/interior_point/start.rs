//! The first iterate: inside the bounds, inside the domain, with least-squares multipliers.
//!
//! Wächter & Biegler (2006), §3.6, plus a search for the domain where the start is outside of it.

use super::iterate::Iterate;
use super::kkt::{Blocks, Kkt, RightHandSide};
use super::parameters::PARAMETERS;
use super::scaling;
use super::slack_form::SlackForm;
use super::vectors::norm_max;
use crate::model::domain::middle;
use crate::model::{EvaluationError, Meta};
use crate::solvers::barrier::pushed;

/// Puts the variables at `start` (the model's x) and evaluates; slacks follow, scales are chosen.
pub(super) fn place(form: &mut SlackForm<'_>, start: &[f64], push: f64, slack_push: f64) -> Result<Iterate, EvaluationError> {
    let mut iterate = Iterate::new(form);
    for (at, &j) in form.free.iter().enumerate() {
        iterate.w[at] = pushed(start[j] / form.variable_scale[at], form.lower[at], form.upper[at], push);
    }
    evaluate_in_domain(form, &mut iterate)?;
    let (objective_scale, row_scale) = scaling::gradient_scales(
        (iterate.objective, &iterate.gradient),
        (&form.jacobian, &iterate.jacobian),
        &form.limit_sizes(),
    );
    form.rescale(objective_scale, row_scale);
    iterate.evaluate(form)?;
    place_slacks(form, &mut iterate, slack_push);
    Ok(iterate)
}

/// Slacks at the rows' values, pushed inside their limits.
pub(super) fn place_slacks(form: &SlackForm<'_>, iterate: &mut Iterate, push: f64) {
    for (i, slack) in form.slack.iter().enumerate() {
        if let Some(slack) = *slack {
            iterate.w[slack] = pushed(iterate.rows[i], form.lower[slack], form.upper[slack], push);
        }
    }
    form.residual(&iterate.w, &iterate.rows, &mut iterate.residual);
}

/// Evaluates, moving towards the middle of the bounds while a term is outside its domain. The first error is the one
/// that is told.
fn evaluate_in_domain(form: &mut SlackForm<'_>, iterate: &mut Iterate) -> Result<(), EvaluationError> {
    let first = match iterate.evaluate(form) {
        Err(error @ EvaluationError::Invalid { .. }) => error,
        other => return other,
    };
    let start = iterate.w.clone();
    for share in PARAMETERS.towards_middle {
        for (j, &from) in start.iter().enumerate().take(form.variables()) {
            iterate.w[j] = from + share * (middle(from, form.lower[j], form.upper[j], j) - from);
        }
        match iterate.evaluate(form) {
            Err(EvaluationError::Invalid { .. }) => {}
            other => return other,
        }
    }
    Err(first)
}

/// The model's x moved this share of the way towards the middle of its bounds.
pub(super) fn towards_middle(meta: &Meta, x: &[f64], share: f64) -> Vec<f64> {
    let moved = |(j, &x): (usize, &f64)| x + share * (middle(x, meta.lower[j], meta.upper[j], j) - x);
    x.iter().enumerate().map(moved).collect()
}

/// Bound multipliers μ/slack, at most `largest`.
pub(super) fn central_bound_multipliers(form: &SlackForm<'_>, iterate: &mut Iterate, mu: f64, largest: f64) {
    for j in 0..form.size() {
        let central = |slack: f64| if slack.is_finite() { (mu / slack).min(largest) } else { 0.0 };
        iterate.z_lower[j] = central(iterate.w[j] - form.lower[j]);
        iterate.z_upper[j] = central(form.upper[j] - iterate.w[j]);
    }
}

/// Bound multipliers 1, the usual first guess.
pub(super) fn unit_bound_multipliers(form: &SlackForm<'_>, iterate: &mut Iterate) {
    for j in 0..form.size() {
        iterate.z_lower[j] = f64::from(u8::from(form.lower[j].is_finite()));
        iterate.z_upper[j] = f64::from(u8::from(form.upper[j].is_finite()));
    }
}

/// Row multipliers by least squares: min ‖∇f + Aᵀy − z_l + z_u‖₂. Zero where they come out large or not at all.
pub(super) fn least_squares_multipliers(form: &SlackForm<'_>, kkt: &mut Kkt, iterate: &mut Iterate) {
    iterate.y.fill(0.0);
    if iterate.y.is_empty() {
        return;
    }
    let mut right = vec![0.0; form.size()];
    right[..form.variables()].copy_from_slice(&iterate.gradient);
    for (j, right) in right.iter_mut().enumerate() {
        *right = iterate.z_lower[j] - iterate.z_upper[j] - *right;
    }
    let ones = vec![1.0; form.size()];
    let hessian = vec![0.0; form.hessian.len()];
    let blocks = Blocks { hessian: &hessian, jacobian: &iterate.jacobian, sigma: &ones };
    let (mut w_step, mut y) = (vec![0.0; form.size()], vec![0.0; iterate.y.len()]);
    let zeros = vec![0.0; iterate.y.len()];
    let solved = kkt.factor(blocks, 0.0, 0.0).is_ok_and(|inertia| inertia.zero == 0)
        && kkt.solve(RightHandSide { w: &right, rows: &zeros }, &mut w_step, &mut y).is_ok();
    if solved && norm_max(&y) <= PARAMETERS.lambda_max {
        iterate.y = y;
    }
}

/// Multipliers of an earlier answer (the model's rows and units); bound multipliers follow from stationarity.
pub(super) fn answer_multipliers(form: &SlackForm<'_>, iterate: &mut Iterate, given: &[f64]) {
    let gradient = gradient_for(form, iterate, given);
    for (j, gradient) in gradient.into_iter().enumerate() {
        iterate.z_lower[j] = if form.lower[j].is_finite() { gradient.max(0.0) } else { 0.0 };
        iterate.z_upper[j] = if form.upper[j].is_finite() { (-gradient).max(0.0) } else { 0.0 };
    }
}

/// The same, bound multipliers at least those of the barrier parameter.
pub(super) fn warm_multipliers(form: &SlackForm<'_>, iterate: &mut Iterate, given: &[f64], mu: f64) {
    let gradient = gradient_for(form, iterate, given);
    for (j, gradient) in gradient.into_iter().enumerate() {
        if form.lower[j].is_finite() {
            iterate.z_lower[j] = gradient.max(mu / (iterate.w[j] - form.lower[j]));
        }
        if form.upper[j].is_finite() {
            iterate.z_upper[j] = (-gradient).max(mu / (form.upper[j] - iterate.w[j]));
        }
    }
}

/// Takes the row multipliers given; the Lagrangian's gradient with them.
fn gradient_for(form: &SlackForm<'_>, iterate: &mut Iterate, given: &[f64]) -> Vec<f64> {
    for (i, y) in iterate.y.iter_mut().enumerate() {
        *y = given.get(form.rows[i]).copied().filter(|y| y.is_finite()).unwrap_or(0.0) * form.objective_scale / form.row_scale[i];
    }
    let mut gradient = vec![0.0; form.size()];
    iterate.lagrangian_gradient(form, &mut gradient);
    gradient
}
