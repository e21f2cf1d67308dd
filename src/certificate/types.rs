//! What a certificate says.

use crate::model::Class;

/// What is accepted.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tolerances {
    /// Largest accepted dual infeasibility and complementarity.
    pub optimality: f64,
    /// Largest accepted primal infeasibility.
    pub constraint: f64,
}

impl Default for Tolerances {
    fn default() -> Self {
        Tolerances { optimality: 1e-6, constraint: 1e-8 }
    }
}

/// How far a certified minimum reaches.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Extent {
    /// The class of the problem proves that no feasible point is better.
    Global,
    /// No better point nearby.
    #[default]
    Local,
}

impl Extent {
    /// The word of the result file.
    pub fn as_str(self) -> &'static str {
        match self {
            Extent::Global => "global",
            Extent::Local => "local",
        }
    }

    /// What a class proves.
    pub fn of(class: Class) -> Extent {
        if class.is_global() { Extent::Global } else { Extent::Local }
    }
}

/// Which limit a variable or row rests on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Side {
    #[default]
    None,
    Lower,
    Upper,
    Equal,
}

impl Side {
    /// The word of the result file.
    pub fn as_str(self) -> &'static str {
        match self {
            Side::None => "none",
            Side::Lower => "lower",
            Side::Upper => "upper",
            Side::Equal => "equal",
        }
    }
}

/// What a point is. All measures are relative to the problem's own scale, see docs/certificate.md.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Certificate {
    /// Every test holds and no variable has run away.
    pub certified: bool,
    /// How far it reaches, where certified.
    pub scope: Extent,
    /// f(x)
    pub objective: f64,
    /// c(x), length m.
    pub row_values: Vec<f64>,
    /// max violation_i/s_i over rows, over d_j for bounds, less rounding; or the relative distance to a point without violation,
    /// where one lies within the tolerance.
    pub primal_infeasibility: f64,
    /// max |∂L/∂x_j|·d_j/σ
    pub dual_infeasibility: f64,
    /// Σ|multiplier|·|distance to its limit|/σ, violations and bounds included.
    pub complementarity: f64,
    /// The Lagrangian has negative curvature along a direction of the critical cone, beyond rounding.
    pub negative_curvature: bool,
    /// Proved is neither that its curvature on the critical cone is positive nor that it is negative somewhere: at so many weakly active limits; 0 where
    /// the multipliers, one choice of many, decide.
    pub undecided: Option<usize>,
    /// Flat to second order along a direction, the objective falls further along it: an inflection, no minimum.
    pub descends_at_higher_order: bool,
    /// The rows are met only in the measure of variables that have grown large, and by no point beside this one.
    pub feasible_only_at_infinity: bool,
    /// A direction along which its curvature is negative or the objective falls further, or Newton's steps lead on; length n, in the problem's variables.
    pub escape: Option<Vec<f64>>,
    /// y, length m: ≥ 0 where the upper side is active, ≤ 0 where the lower side is.
    pub row_multipliers: Vec<f64>,
    /// z, length n, signs alike.
    pub bound_multipliers: Vec<f64>,
    /// The side each row rests on, length m.
    pub row_sides: Vec<Side>,
    /// The side each variable rests on, length n; `Equal` for a fixed one.
    pub bound_sides: Vec<Side>,
    /// The active rows and bounds are linearly dependent: the multipliers are one choice of many.
    pub multipliers_not_unique: bool,
    /// The reduced Hessian is singular: the minimiser may not be unique.
    pub minimiser_may_not_be_unique: bool,
    /// Variables that have run away: a point that passes only because of them is no minimum.
    pub runaway: Vec<usize>,
    /// Along their way the objective falls no less the farther one goes: it has no lower bound.
    pub falls_without_end: bool,
    /// Newton's steps lead on, to another point: this one is stationary only in a measure that deceives.
    pub led_on: bool,
    /// A slope that is small beside the variables' sizes leads to a feasible point far away that is lower: no global minimum.
    pub falls_far_away: bool,
    /// The deadline ended a search for lower points before it was done: nothing is proved.
    pub cut_short: bool,
    /// d_j: |x_j|, or, where 0 is allowed and |x_j| is smaller, what is known of the variable's size otherwise
    /// (docs/certificate.md, «Measures»).
    pub variable_scales: Vec<f64>,
    /// σ: the objective's scale, its largest slope |∂f/∂x_j|·d_j or, where that is no measure, what its curvature makes of the
    /// sizes; 0 where every point is stationary.
    pub sigma: f64,
    /// What failed, and at which variable or row, one plain sentence each; also remarks on a certified point.
    pub messages: Vec<String>,
}

impl Certificate {
    /// Whether the point meets rows and bounds.
    pub fn is_feasible(&self, tolerances: &Tolerances) -> bool {
        self.primal_infeasibility <= tolerances.constraint
    }
}
