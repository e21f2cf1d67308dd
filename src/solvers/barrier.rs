//! What both interior points do alike, by the rules and under the names of Wächter & Biegler, "On the implementation of an
//! interior-point filter line-search algorithm for large-scale nonlinear programming", Math. Program. 106 (2006).

/// Moves a value inside its bounds by at least this push (κ₁ of §3.6 and κ₂ alike), less where two bounds are close.
pub(super) fn pushed(value: f64, lower: f64, upper: f64, push: f64) -> f64 {
    let room = |bound: f64| (push * bound.abs().max(1.0)).min(push * (upper - lower));
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => value.max(lower + room(lower)).min(upper - room(upper)),
        (true, false) => value.max(lower + push * lower.abs().max(1.0)),
        (false, true) => value.min(upper - push * upper.abs().max(1.0)),
        (false, false) => value,
    }
}

/// The longest step in (0, 1] that keeps the share 1 − τ of every multiplier.
pub(super) fn longest_multiplier_step(z: &[f64], step: &[f64], tau: f64) -> f64 {
    z.iter().zip(step).filter(|(_, step)| **step < 0.0).fold(1.0, |longest: f64, (z, step)| longest.min(-tau * z / step))
}
