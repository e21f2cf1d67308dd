//! Every number of the interior point that is a choice. Symbols are those of Wächter & Biegler (2006).

use crate::solvers::barrier::{BarrierRule, InertiaCorrection};

/// The parameters the solver runs with.
pub(super) const PARAMETERS: Parameters = Parameters {
    barrier: BarrierRule::down_to(1e-12),
    mu_warm: 1e-6,
    kappa_d: 1e-5,
    s_max: 100.0,
    epsilon_tol: 1e-11,
    epsilon_acceptable: 1e-6,
    patience_near: 15,
    patience_far: 1500,
    diverging: 1e20,
    inertia: InertiaCorrection {
        smallest: 1e-20,
        first: 1e-4,
        largest: 1e20,
        decrease: 1.0 / 3.0,
        increase: 8.0,
        first_increase: 100.0,
    },
    delta_c: 1e-8,
    delta_c_counting: 1e-10,
    gamma_theta: 1e-5,
    gamma_phi: 1e-8,
    delta: 1.0,
    s_theta: 1.1,
    s_phi: 2.3,
    eta_phi: 1e-8,
    gamma_alpha: 0.05,
    kappa_soc: 0.99,
    p_max: 4,
    tiny_step: 10.0 * f64::EPSILON,
    shortest_in_domain: 1e-14,
    kappa_1: 1e-2,
    kappa_1_warm: 1e-8,
    kappa_1_large: 1.0,
    largest_guess: 1e3,
    kappa_resto: 0.9,
    largest_restored_multiplier: 1e3,
    most_restorations: 60,
    watchdog_after: 10,
    watchdog_trials: 3,
    large: 1000,
};

/// What can be chosen, with the inequality each number stands in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameters {
    /// How the barrier parameter falls, and how close to bounds steps come.
    pub barrier: BarrierRule,
    /// μ₀ where the start is an earlier answer with its multipliers.
    pub mu_warm: f64,
    /// κ_d: a linear pull μ·κ_d keeps variables with one bound from running off (§3.7).
    pub kappa_d: f64,
    /// s_max: multipliers of an average size above it relax the optimality error, equation (5).
    pub s_max: f64,
    /// ε_tol: the run is over where E₀ ≤ ε_tol.
    pub epsilon_tol: f64,
    /// A run that makes no more progress has converged where E₀ is at most this.
    pub epsilon_acceptable: f64,
    /// Iterations without a better E₀ after which a run has stalled: near a solution (E₀ ≤ `epsilon_acceptable`),
    pub patience_near: u64,
    /// and far from one.
    pub patience_far: u64,
    /// Scaled objectives below −this, or variables beyond it, are on their way to infinity.
    pub diverging: f64,
    /// Algorithm IC's δ_w.
    pub inertia: InertiaCorrection,
    /// δ̄_c: δ_c = δ̄_c·μ^¼ where the Jacobian seems to have dependent rows.
    pub delta_c: f64,
    /// δ_c where only the number of negative eigenvalues is wanted.
    pub delta_c_counting: f64,
    /// γ_θ: a point must lower θ by this share, or
    pub gamma_theta: f64,
    /// γ_φ: φ by this share of θ, equation (18).
    pub gamma_phi: f64,
    /// δ, s_θ, s_φ of the switching condition α(−∇φᵀd)^s_φ > δ·θ^s_θ, equation (19).
    pub delta: f64,
    /// See [`Parameters::delta`].
    pub s_theta: f64,
    /// See [`Parameters::delta`].
    pub s_phi: f64,
    /// η_φ of Armijo's condition, equation (20).
    pub eta_phi: f64,
    /// γ_α: the shortest step is this times equation (23).
    pub gamma_alpha: f64,
    /// κ_soc: a further second-order correction is tried where the last left less than this share of θ.
    pub kappa_soc: f64,
    /// p_max: second-order corrections at the most.
    pub p_max: usize,
    /// A tiny step changes no variable by more than this, relative (§3.9).
    pub tiny_step: f64,
    /// Backtracking for the sake of the domain alone ends here.
    pub shortest_in_domain: f64,
    /// κ₁ = κ₂: how far inside its bounds the start is pushed, absolute and as a share of the distance of two bounds (§3.6).
    pub kappa_1: f64,
    /// The same for an earlier answer.
    pub kappa_1_warm: f64,
    /// The same for the slacks of large problems: among thousands of rows some slack always stops a step short, unless all of them begin well
    /// inside.
    pub kappa_1_large: f64,
    /// λ_max: larger least-squares multipliers are no guess worth having (§3.6).
    pub largest_guess: f64,
    /// κ_resto: the violation must fall to this share before the iterations return from a restoration (§3.3).
    pub kappa_resto: f64,
    /// Larger bound multipliers are not taken over from a restoration.
    pub largest_restored_multiplier: f64,
    /// Restorations in one run; more mean that it goes in circles.
    pub most_restorations: usize,
    /// Shortened steps in a row that call the watchdog (§3.2).
    pub watchdog_after: usize,
    /// Full steps on trial.
    pub watchdog_trials: usize,
    /// Number of variables from which on a problem counts as large: a predictor–corrector without line search first, and polish on trial.
    pub large: usize,
}
