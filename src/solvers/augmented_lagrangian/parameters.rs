//! Every number of the augmented Lagrangian that is a choice. Symbols are those of Birgin & Martínez, *Practical Augmented Lagrangian
//! Methods* (2014), algorithm 4.1.

/// The parameters the solver runs with.
pub(super) const PARAMETERS: Parameters = Parameters {
    tau: 0.25,
    gamma: 10.0,
    rho_1: [1e1, 1e3, 1e5, 1e-1],
    rho_max: 1e8,
    lambda_max: 1e10,
    epsilon: 1e-11,
    patience: 12,
    worthwhile: 0.8,
    extra_iterations_after_pass: 2,
    stale: 30.0,
    renewals: 10,
    solved: 1e-6,
};

/// What can be chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Parameters {
    /// τ: the violation must fall to this share of the last one, or the penalty grows.
    pub tau: f64,
    /// γ: by this factor.
    pub gamma: f64,
    /// ρ₁ of each try, for the scaled model: a larger one follows rows before the objective.
    pub rho_1: [f64; 4],
    /// The largest penalty: beyond it φ is rounding.
    pub rho_max: f64,
    /// λ_max: multipliers of the scaled model are kept within this.
    pub lambda_max: f64,
    /// ε: tightest tolerance of a subproblem, and the residual at which all is done.
    pub epsilon: f64,
    /// Iterations without a better residual after which rounding has ended the progress.
    pub patience: u32,
    /// A residual is better where it is below this share of the best one.
    pub worthwhile: f64,
    /// Iterations after the stop test passed, so that the answer is better than just accepted.
    pub extra_iterations_after_pass: u32,
    /// Scales that are off by more than this factor are renewed.
    pub stale: f64,
    /// Renewals of scales at the most.
    pub renewals: u32,
    /// Residual below which a try is not repeated.
    pub solved: f64,
}
