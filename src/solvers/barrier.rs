//! What both interior points do alike, by the rules and under the names of Wächter & Biegler, "On the implementation of an
//! interior-point filter line-search algorithm for large-scale nonlinear programming", Math. Program. 106 (2006).

/// Where a component of w, a variable or a slack, is held: at its lower or upper bound, or not at all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum BoundState {
    /// Nothing holds it.
    Free,
    /// At its lower bound.
    Lower,
    /// At its upper bound.
    Upper,
}

/// When and how the barrier parameter falls, and how close to their bounds steps may come.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct BarrierRule {
    /// μ₀, the first barrier parameter.
    pub mu_0: f64,
    /// The last barrier parameter: complementarity ends there.
    pub mu_last: f64,
    /// κ_ε: a barrier problem is solved where E_μ ≤ κ_ε·μ.
    pub kappa_epsilon: f64,
    /// κ_μ and θ_μ: the next parameter is min(κ_μ·μ, μ^θ_μ), equation (7).
    pub kappa_mu: f64,
    /// See [`BarrierRule::kappa_mu`].
    pub theta_mu: f64,
    /// τ_min: a step leaves the share 1 − max(τ_min, 1 − μ) of every distance to a bound, equation (8).
    pub tau_min: f64,
    /// κ_Σ: bound multipliers stay within this factor of μ/distance, equation (16).
    pub kappa_sigma: f64,
}

impl BarrierRule {
    /// The paper's values (§4), down to the barrier parameter `mu_last`.
    pub const fn down_to(mu_last: f64) -> Self {
        BarrierRule { mu_0: 0.1, mu_last, kappa_epsilon: 10.0, kappa_mu: 0.2, theta_mu: 1.5, tau_min: 0.99, kappa_sigma: 1e10 }
    }

    /// Whether this optimality error of the barrier problem is small enough to go on to the next.
    pub fn is_solved(&self, error: f64, mu: f64) -> bool {
        error <= self.kappa_epsilon * mu
    }

    /// The barrier parameter after μ.
    pub fn next(&self, mu: f64) -> f64 {
        self.mu_last.max((self.kappa_mu * mu).min(mu.powf(self.theta_mu)))
    }

    /// τ of the fraction-to-the-boundary rule.
    pub fn tau(&self, mu: f64) -> f64 {
        self.tau_min.max(1.0 - mu)
    }
}

/// Algorithm IC: which regularisation δ_w is tried next until the KKT matrix has the inertia of a minimum.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct InertiaCorrection {
    /// δ̄_w^min, the least one.
    pub smallest: f64,
    /// δ̄_w⁰, the first one ever tried.
    pub first: f64,
    /// δ̄_w^max: beyond it the step is given up.
    pub largest: f64,
    /// κ_w⁻: what the last successful one is multiplied by for a new matrix.
    pub decrease: f64,
    /// κ_w⁺: growth from try to try.
    pub increase: f64,
    /// κ̄_w⁺: the same where no matrix has been corrected before.
    pub first_increase: f64,
}

impl InertiaCorrection {
    /// The first correction of a new matrix, `last` being the last that succeeded, 0 where there was none.
    pub fn begin(&self, last: f64) -> f64 {
        if last == 0.0 { self.first } else { (self.decrease * last).max(self.smallest) }
    }

    /// The factor from one correction to the next.
    pub fn growth(&self, last: f64) -> f64 {
        if last == 0.0 { self.first_increase } else { self.increase }
    }
}

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
