//! The logarithmic barrier of the bounds on w: value, gradient, primal-dual Hessian, fraction to the boundary.
//!
//! Wächter & Biegler (2006), equations (3), (8), (12), (13), (15), (16), and §3.7 for the damping of one-sided bounds.

use super::parameters::PARAMETERS;
use super::slack_form::SlackForm;

/// +1 where only the lower bound is there, −1 where only the upper one is, else 0.
fn one_sided(lower: f64, upper: f64) -> f64 {
    f64::from(u8::from(lower.is_finite())) - f64::from(u8::from(upper.is_finite()))
}

/// The barrier terms −μ·Σ ln(slack) with damping. +∞ outside the interior.
pub(super) fn value(form: &SlackForm<'_>, w: &[f64], mu: f64) -> f64 {
    let (mut product_log, mut damping) = (0.0, 0.0);
    for ((&w, &lower), &upper) in w.iter().zip(&form.lower).zip(&form.upper) {
        let side = one_sided(lower, upper);
        if lower.is_finite() {
            product_log += log(w - lower);
            damping += if side > 0.0 { w - lower } else { 0.0 };
        }
        if upper.is_finite() {
            product_log += log(upper - w);
            damping += if side < 0.0 { upper - w } else { 0.0 };
        }
    }
    mu * (PARAMETERS.kappa_d * damping - product_log)
}

fn log(slack: f64) -> f64 {
    if slack > 0.0 { slack.ln() } else { f64::NEG_INFINITY }
}

/// Adds the gradient of the barrier terms.
pub(super) fn add_gradient(form: &SlackForm<'_>, w: &[f64], mu: f64, gradient: &mut [f64]) {
    for (j, gradient) in gradient.iter_mut().enumerate() {
        let (lower, upper) = (form.lower[j], form.upper[j]);
        // An infinite bound contributes ±0.
        *gradient += mu * (1.0 / (upper - w[j]) - 1.0 / (w[j] - lower) + PARAMETERS.kappa_d * one_sided(lower, upper));
    }
}

/// The damping's part of the gradient alone.
pub(super) fn damping(form: &SlackForm<'_>, j: usize, mu: f64) -> f64 {
    mu * PARAMETERS.kappa_d * one_sided(form.lower[j], form.upper[j])
}

/// Σ = z_l/(w − l) + z_u/(u − w).
pub(super) fn sigma(form: &SlackForm<'_>, w: &[f64], lower: &[f64], upper: &[f64], sigma: &mut [f64]) {
    for (j, sigma) in sigma.iter_mut().enumerate() {
        *sigma = lower[j] / (w[j] - form.lower[j]) + upper[j] / (form.upper[j] - w[j]);
    }
}

/// Steps of the bound multipliers that belong to a step of w.
pub(super) fn multiplier_steps(
    form: &SlackForm<'_>,
    w: &[f64],
    step: &[f64],
    mu: f64,
    (lower, upper): (&[f64], &[f64]),
    (lower_step, upper_step): (&mut [f64], &mut [f64]),
) {
    for j in 0..w.len() {
        if form.lower[j].is_finite() {
            let slack = w[j] - form.lower[j];
            lower_step[j] = (mu - lower[j] * step[j]) / slack - lower[j];
        }
        if form.upper[j].is_finite() {
            let slack = form.upper[j] - w[j];
            upper_step[j] = (mu + upper[j] * step[j]) / slack - upper[j];
        }
    }
}

/// The longest step in (0, 1] that keeps the share 1 − τ of every slack.
pub(super) fn longest_step(form: &SlackForm<'_>, w: &[f64], step: &[f64], tau: f64) -> f64 {
    let mut longest: f64 = 1.0;
    for j in 0..w.len() {
        if step[j] < 0.0 {
            longest = longest.min(tau * (form.lower[j] - w[j]) / step[j]);
        } else if step[j] > 0.0 {
            longest = longest.min(tau * (form.upper[j] - w[j]) / step[j]);
        }
    }
    longest
}

/// Keeps bound multipliers within κ_Σ of μ/slack, so that Σ stays an approximation of the barrier's Hessian.
pub(super) fn reset_multipliers(form: &SlackForm<'_>, w: &[f64], mu: f64, lower: &mut [f64], upper: &mut [f64]) {
    for j in 0..w.len() {
        if form.lower[j].is_finite() {
            lower[j] = within_ratio(lower[j], mu / (w[j] - form.lower[j]));
        }
        if form.upper[j].is_finite() {
            upper[j] = within_ratio(upper[j], mu / (form.upper[j] - w[j]));
        }
    }
}

fn within_ratio(z: f64, central: f64) -> f64 {
    z.min(central * PARAMETERS.barrier.kappa_sigma).max(central / PARAMETERS.barrier.kappa_sigma)
}
