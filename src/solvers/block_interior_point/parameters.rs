//! Every number of the small interior point that is a choice. Symbols as in the sparse one, where it has them.

use crate::model::components;
use crate::solvers::barrier::{BarrierRule, InertiaCorrection};

/// The parameters the solver runs with.
pub(super) const PARAMETERS: Parameters = Parameters {
    largest: components::SMALL,
    fewest_variables: components::FEWEST_VARIABLES,
    batch: components::BATCH,
    steps: 5,
    barrier: BarrierRule::down_to(1e-11),
    kappa_1: 1e-2,
    epsilon_tol: 1e-10,
    patience: 200,
    inertia: InertiaCorrection {
        smallest: 1e-12,
        first: 1e-4,
        largest: 1e12,
        decrease: 1.0 / 3.0,
        increase: 8.0,
        first_increase: 8.0,
    },
    eta: 1e-4,
    shortest: 1e-9,
    penalty_kept: 0.3,
    distance_kept: 0.1,
    crossover: 1e-3,
    crossover_steps: 12,
    augmentation: 1e-3,
    proximal: 1e-10,
    exact: 1e-14,
    accepted: 1e-12,
    no_multiplier: 1e-12,
    idle: 1e-10,
    level: 1e-12,
};

/// What can be chosen, with the inequality each number stands in.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameters {
    /// Components of more variables or rows than this are no work for dense matrices.
    pub largest: usize,
    /// Models with fewer variables are solved as a whole.
    pub fewest_variables: usize,
    /// Components a thread takes at a time.
    pub batch: usize,
    /// Steps every component takes in one iteration: turning from one to the next costs about as much as a step.
    pub steps: u32,
    /// How the barrier parameter falls, and how close to bounds steps come.
    pub barrier: BarrierRule,
    /// κ₁ = κ₂: how far inside its bounds the start is pushed.
    pub kappa_1: f64,
    /// ε_tol: the scaled optimality error that ends the iterations.
    pub epsilon_tol: f64,
    /// Iterations after which the sparse interior point takes over.
    pub patience: u32,
    /// The regularisation δ of the condensed matrix.
    pub inertia: InertiaCorrection,
    /// η of Armijo's condition for the ℓ₁ merit function.
    pub eta: f64,
    /// Shorter steps are none.
    pub shortest: f64,
    /// What is left of a penalty ν from one iteration to the next: one wild step must not weigh down all that follow.
    pub penalty_kept: f64,
    /// A slack keeps this share of its distance to its limit at the least, however its row moves.
    pub distance_kept: f64,
    /// From this barrier parameter on the active set is tried.
    pub crossover: f64,
    /// Newton steps on an active set at the most.
    pub crossover_steps: usize,
    /// ε of W + AᵀA/ε, positive definite where the minimum is strict.
    pub augmentation: f64,
    /// δ of the Schur complement A·P⁻¹·Aᵀ + δI: tames dependent limits.
    pub proximal: f64,
    /// The residual at which nothing is left to gain,
    pub exact: f64,
    /// and the one that is accepted where rounding ends the progress.
    pub accepted: f64,
    /// Multipliers of the wrong sign up to this are zero.
    pub no_multiplier: f64,
    /// An earlier answer's row is at a limit where its scaled multiplier |y_i| is above this.
    pub idle: f64,
    /// A row is scaled by its slope where ‖∇c_i‖_∞ is above this share of its largest limit, by that limit otherwise.
    pub level: f64,
}
