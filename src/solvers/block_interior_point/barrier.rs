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
