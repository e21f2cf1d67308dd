//! Every number of the interior point that is a choice. Symbols and equations are those of Wächter & Biegler (2006); a value
//! that is not the paper's says so.

use crate::solvers::barrier::{BarrierRule, InertiaCorrection};

mod groups;

pub(super) use groups::{Attempts, Condensing, FilterRule, Polish, PredictorCorrector, Restoration, Saddle, Scaling};

/// The parameters the solver runs with.
pub(super) const PARAMETERS: Parameters = Parameters {
    barrier: BarrierRule::down_to(1e-12),
    mu_warm: 1e-6,
    kappa_d: 1e-5,
    s_max: 100.0,
    epsilon_tol: 1e-11,
    epsilon_acceptable: 1e-6,
    better: 0.9,
    patience_near: 15,
    patience_far: 1500,
    diverging: 1e20,
    diverging_feasible: 1e-6,
    inertia: InertiaCorrection {
        smallest: 1e-20,
        first: 1e-4,
        largest: 1e20,
        decrease: 1.0 / 3.0,
        increase: 8.0,
        first_increase: 100.0,
    },
    delta_c: 1e-8,
    kappa_c: 0.25,
    delta_c_counting: 1e-10,
    bisections: 8,
    condensing: Condensing::DEFAULT,
    filter: FilterRule::DEFAULT,
    tiny_step: 10.0 * f64::EPSILON,
    tiny_violation: 1e-4,
    shortest_in_domain: 1e-14,
    shortest_with_derivatives: 1e-12,
    kappa_1: 1e-2,
    kappa_1_warm: 1e-8,
    kappa_1_large: 1.0,
    towards_middle: [1e-6, 1e-3, 1e-2, 0.1, 0.25, 0.5, 1.0],
    lambda_max: 1e3,
    watchdog_after: 10,
    watchdog_trials: 3,
    large: 1000,
    restoration: Restoration::DEFAULT,
    saddle: Saddle::DEFAULT,
    predictor: PredictorCorrector::DEFAULT,
    polish: Polish::DEFAULT,
    scaling: Scaling::DEFAULT,
    attempts: Attempts::DEFAULT,
};

/// What can be chosen, with the inequality each number stands in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameters {
    /// How the barrier parameter falls, and how close to bounds steps come.
    pub barrier: BarrierRule,
    /// μ₀ where the start is an earlier answer with its multipliers.
    pub mu_warm: f64,
    /// κ_d: a linear pull μ·κ_d keeps variables with one bound from running off (§3.7; the paper has 1e-4, Ipopt 1e-5).
    pub kappa_d: f64,
    /// s_max: multipliers of an average size above it relax the optimality error, equation (5).
    pub s_max: f64,
    /// ε_tol: the run is over where E₀ ≤ ε_tol (the paper has 1e-8: here the certificate wants more digits).
    pub epsilon_tol: f64,
    /// A run that makes no more progress has converged where E₀ is at most this.
    pub epsilon_acceptable: f64,
    /// An iterate is better than the best one where its E₀ is below this share of that one's.
    pub better: f64,
    /// Iterations without a better E₀ after which a run has stalled: near a solution (E₀ ≤ `epsilon_acceptable`),
    pub patience_near: u64,
    /// and far from one.
    pub patience_far: u64,
    /// Scaled objectives below −this, or variables beyond it, are on their way to infinity,
    pub diverging: f64,
    /// the objective where the violation is below this.
    pub diverging_feasible: f64,
    /// Algorithm IC's δ_w.
    pub inertia: InertiaCorrection,
    /// δ̄_c and κ_c: δ_c = δ̄_c·μ^κ_c where the Jacobian seems to have dependent rows.
    pub delta_c: f64,
    /// See [`Parameters::delta_c`].
    pub kappa_c: f64,
    /// δ_c where only the number of negative eigenvalues is wanted.
    pub delta_c_counting: f64,
    /// Halvings (of the logarithm) towards the least δ_w, where a matrix close to singular is wanted.
    pub bisections: usize,
    /// The KKT matrix without its short inequality rows.
    pub condensing: Condensing,
    /// Which trial points are taken.
    pub filter: FilterRule,
    /// A tiny step changes no variable by more than this, relative (§3.9),
    pub tiny_step: f64,
    /// at a point of a violation below this.
    pub tiny_violation: f64,
    /// Backtracking for the sake of the domain alone ends at this length,
    pub shortest_in_domain: f64,
    /// for the sake of a point where the derivatives are numbers too, at this one.
    pub shortest_with_derivatives: f64,
    /// κ₁ = κ₂: how far inside its bounds the start is pushed, absolute and as a share of the distance of two bounds (§3.6).
    pub kappa_1: f64,
    /// The same for an earlier answer.
    pub kappa_1_warm: f64,
    /// The same for the slacks of large problems: among thousands of rows some slack always stops a step short, unless all of them begin well
    /// inside.
    pub kappa_1_large: f64,
    /// Shares of the way from the start towards the middle of the bounds, tried in this order where the start is outside the domain.
    pub towards_middle: [f64; 7],
    /// λ_max: larger least-squares multipliers are no guess worth having (§3.6).
    pub lambda_max: f64,
    /// Shortened steps in a row that call the watchdog (§3.2).
    pub watchdog_after: usize,
    /// Full steps on trial.
    pub watchdog_trials: usize,
    /// Number of variables from which on a problem counts as large: a predictor–corrector without line search first, and polish on trial.
    pub large: usize,
    /// The way back to feasibility.
    pub restoration: Restoration,
    /// Leaving stationary points that are no minima.
    pub saddle: Saddle,
    /// Steps without the filter.
    pub predictor: PredictorCorrector,
    /// The last digits.
    pub polish: Polish,
    /// Scales of variables, rows and objective.
    pub scaling: Scaling,
    /// Further runs.
    pub attempts: Attempts,
}
