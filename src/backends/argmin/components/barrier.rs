//! Distances to bounds, and what the logarithmic barrier makes of them.

/// w less its lower bound, upper bound less w: infinite where open.
pub(super) fn distances(w: f64, lower: f64, upper: f64) -> (f64, f64) {
    (w - lower, upper - w)
}

/// μ/distance, 0 where open.
pub(super) fn force(mu: f64, distance: f64) -> f64 {
    if distance.is_finite() { mu / distance } else { 0.0 }
}

/// −μ·ln of both distances.
pub(super) fn value(mu: f64, (below, above): (f64, f64)) -> f64 {
    let term = |distance: f64| if distance.is_finite() { -mu * distance.ln() } else { 0.0 };
    term(below) + term(above)
}

/// Push of the start off its bounds.
pub(super) const PUSH: f64 = 1e-2;

/// Moves a value inside its bounds by a share of the room there is.
pub(super) fn pushed(value: f64, lower: f64, upper: f64, push: f64) -> f64 {
    let room = |bound: f64| (push * bound.abs().max(1.0)).min(push * (upper - lower));
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => value.max(lower + room(lower)).min(upper - room(upper)),
        (true, false) => value.max(lower + push * lower.abs().max(1.0)),
        (false, true) => value.min(upper - push * upper.abs().max(1.0)),
        (false, false) => value,
    }
}
