//! The parameters of the strategies, one struct each.

/// The filter line search, §2.3 and §2.4.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FilterRule {
    /// θ_min = this·max(1, θ₀): only below it φ alone must fall.
    pub theta_min: f64,
    /// θ_max = this·max(1, θ₀): no point beyond is taken.
    pub theta_max: f64,
    /// γ_θ: a point must lower θ by this share, or
    pub gamma_theta: f64,
    /// γ_φ: φ by this share of θ, equation (18) (the paper has 1e-5, Ipopt 1e-8).
    pub gamma_phi: f64,
    /// δ, s_θ, s_φ of the switching condition α(−∇φᵀd)^s_φ > δ·θ^s_θ, equation (19).
    pub delta: f64,
    /// See [`FilterRule::delta`].
    pub s_theta: f64,
    /// See [`FilterRule::delta`].
    pub s_phi: f64,
    /// η_φ of Armijo's condition, equation (20) (the paper has 1e-4, Ipopt 1e-8).
    pub eta_phi: f64,
    /// γ_α: the shortest step is this times equation (23).
    pub gamma_alpha: f64,
    /// κ_soc: a further second-order correction is tried where the last left at most this share of θ.
    pub kappa_soc: f64,
    /// p_max: second-order corrections at the most.
    pub p_max: usize,
}

impl FilterRule {
    pub(super) const DEFAULT: Self = FilterRule {
        theta_min: 1e-4,
        theta_max: 1e4,
        gamma_theta: 1e-5,
        gamma_phi: 1e-8,
        delta: 1.0,
        s_theta: 1.1,
        s_phi: 2.3,
        eta_phi: 1e-8,
        gamma_alpha: 0.05,
        kappa_soc: 0.99,
        p_max: 4,
    };
}

/// The restoration of feasibility, §3.3.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Restoration {
    /// κ_resto: the violation must fall to this share before the iterations return.
    pub kappa_resto: f64,
    /// Steps tried, each half the last, that lower the primal-dual error where the filter accepts none (in the spirit of §3.10),
    pub soft_steps: usize,
    /// to this share.
    pub kappa_soft: f64,
    /// ζ = this·√μ weighs the distance from the iterate that is left, equation (29) (the paper has √μ),
    pub proximity: f64,
    /// and this is ζ for the last word on infeasibility.
    pub last_proximity: f64,
    /// The first μ is the violation, but at most this.
    pub largest_mu: f64,
    /// Violations (scaled) up to this cannot be told from rounding: no verdict of infeasibility.
    pub smallest_violation: f64,
    /// Larger bound multipliers are not taken over.
    pub largest_multiplier: f64,
    /// Restorations in one run; more mean that it goes in circles.
    pub most_restorations: usize,
}

impl Restoration {
    pub(super) const DEFAULT: Self = Restoration {
        kappa_resto: 0.9,
        soft_steps: 3,
        kappa_soft: 1.0 - 1e-4,
        proximity: 1e-3,
        last_proximity: 1e-9,
        largest_mu: 1e3,
        smallest_violation: 1e-9,
        largest_multiplier: 1e3,
        most_restorations: 60,
    };
}

/// Leaving stationary points along negative curvature.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Saddle {
    /// Times a run may try.
    pub most_escapes: usize,
    /// Curvature above −this·max|W| is rounding.
    pub curvature: f64,
    /// Inverse iterations towards the direction of least curvature.
    pub inverse_iterations: usize,
    /// How far the escape goes, relative to the variables.
    pub distance: f64,
    /// By how much the objective may rise, relative: rounding.
    pub rounding: f64,
    /// μ to go on with.
    pub mu: f64,
}

impl Saddle {
    pub(super) const DEFAULT: Self =
        Saddle { most_escapes: 4, curvature: 1e-8, inverse_iterations: 6, distance: 1e-2, rounding: 1e-12, mu: 1e-3 };
}

/// Mehrotra's steps for large problems.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PredictorCorrector {
    /// Iterations without a better optimality error after which the filter takes over.
    pub patience: u64,
    /// Shares of the correction that are tried (Colombo & Gondzio).
    pub shares: usize,
}

impl PredictorCorrector {
    pub(super) const DEFAULT: Self = PredictorCorrector { patience: 8, shares: 5 };
}

/// Newton's method on the active set.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Polish {
    /// Newton steps at the most,
    pub most_steps: usize,
    /// and factorisations on trial.
    pub trial_factors: usize,
    /// Optimality errors up to this are rounding.
    pub rounding: f64,
    /// The optimality error at which a large problem is polished on trial first (where a few Newton steps succeed they save the
    /// barrier's last iterations),
    pub first_trial: f64,
    /// and by which factor lower each time again.
    pub next_trial: f64,
    /// Factors are used again while each step leaves at most this share of the error.
    pub worthwhile: f64,
    /// 1/Σ of the slack of a row that is left out.
    pub inactive_weight: f64,
    /// δ_w and δ_c where active rows are dependent or the reduced Hessian is singular.
    pub regularisation: f64,
    /// Larger multipliers look like those of dependent rows.
    pub large_multiplier: f64,
    /// A slack and its multiplier that are both below this do not tell which of them is zero.
    pub ambiguous: f64,
}

impl Polish {
    pub(super) const DEFAULT: Self = Polish {
        most_steps: 10,
        trial_factors: 5,
        rounding: 1e-14,
        first_trial: 1e-5,
        next_trial: 0.1,
        worthwhile: 0.1,
        inactive_weight: 1e30,
        regularisation: 1e-9,
        large_multiplier: 1e5,
        ambiguous: 1e-4,
    };
}

/// Scales, after §3.8, which scales down only.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scaling {
    /// Variables whose magnitude lies between these keep their scale 1.
    pub ordinary: (f64, f64),
    /// g_max: larger gradients are scaled down to it.
    pub largest_gradient: f64,
    /// Smaller gradients are scaled up to it.
    pub smallest_gradient: f64,
    /// Gradients below this share of the row's limit are flat.
    pub flat: f64,
    /// No scale goes beyond this or below its inverse,
    pub extreme: f64,
    /// unless it is plainly a matter of units: then it goes as far as this.
    pub any_unit: f64,
}

impl Scaling {
    pub(super) const DEFAULT: Self = Scaling {
        ordinary: (1e-2, 1e2),
        largest_gradient: 100.0,
        smallest_gradient: 1e-2,
        flat: 1e-8,
        extreme: 1e12,
        any_unit: 1e60,
    };
}

/// Runs after the first.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Attempts {
    /// Scales that moved by less than this factor still fit.
    pub outgrown: f64,
    /// A variable's scale shrinks to this share at the most.
    pub smallest_share: f64,
    /// E₀ in new scales up to which an answer is as good there as any solver's.
    pub good_enough: f64,
    /// Runs in new scales at the most.
    pub most_rescaled: usize,
    /// Runs from elsewhere: the share of the way towards the middle of the bounds, and μ₀.
    pub elsewhere: [(f64, f64); 2],
    /// By how much these ease the limits of rows, relative, so that rows without an interior have one.
    pub ease: f64,
    /// Problems of more variables are not begun again from elsewhere: it would take too long.
    pub largest_repeated: usize,
}

impl Attempts {
    pub(super) const DEFAULT: Self = Attempts {
        outgrown: 1e3,
        smallest_share: 1e-8,
        good_enough: 1e-8,
        most_rescaled: 3,
        elsewhere: [(0.1, 1.0), (0.5, 10.0)],
        ease: 1e-9,
        largest_repeated: 10_000,
    };
}

/// The KKT matrix with its short inequality rows eliminated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Condensing {
    /// Smaller systems are factorised as they are.
    pub least_order: usize,
    /// Δ·a² is at most this multiple of the curvature the row's variables have without it: half of the digits for each,
    pub stiffest: f64,
    /// curvature counting as this at the least.
    pub least_curvature: f64,
    /// Refinement steps at the most,
    pub most_steps: usize,
    /// the relative residual at which they end,
    pub enough: f64,
    /// and the one up to which a solution is any good.
    pub usable: f64,
    /// Failures after which the condensed form is given up.
    pub most_failures: usize,
    /// Σ of a variable that is held: large, but no larger than the condensed
    pub rigid: f64,
    /// or the whole matrix can bear.
    pub rigid_in_full: f64,
}

impl Condensing {
    pub(super) const DEFAULT: Self = Condensing {
        least_order: 500,
        stiffest: 1e8,
        least_curvature: 1e-10,
        most_steps: 10,
        enough: 1e-11,
        usable: 1e-7,
        most_failures: 3,
        rigid: 1e12,
        rigid_in_full: 1e30,
    };
}
