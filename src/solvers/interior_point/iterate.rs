//! A primal-dual point with everything evaluated there, and how far it is from optimal.

use super::barrier;
use super::parameters::PARAMETERS;
use super::slack_form::SlackForm;
use super::vectors::{norm_max, norm_sum};
use crate::model::EvaluationError;

/// w, multipliers, and values at w.
#[derive(Clone)]
pub(super) struct Iterate {
    /// Variables and slacks.
    pub w: Vec<f64>,
    /// Multipliers of g.
    pub y: Vec<f64>,
    /// Multipliers of the bounds, ≥ 0; 0 where there is none.
    pub z_lower: Vec<f64>,
    pub z_upper: Vec<f64>,
    /// Scaled f.
    pub objective: f64,
    /// Scaled ∇f, variables only.
    pub gradient: Vec<f64>,
    /// Scaled row values.
    pub rows: Vec<f64>,
    /// g(w)
    pub residual: Vec<f64>,
    /// Along [`SlackForm::jacobian`].
    pub jacobian: Vec<f64>,
}

/// The parts of the optimality error, scaled as in equation (5) of Wächter & Biegler.
#[derive(Debug, Clone, Copy)]
pub(super) struct Errors {
    pub dual: f64,
    pub primal: f64,
    pub complementarity: f64,
}

impl Errors {
    /// E_μ
    pub fn largest(&self) -> f64 {
        self.dual.max(self.primal).max(self.complementarity)
    }
}

impl Iterate {
    /// Room for a point of this form.
    pub fn new(form: &SlackForm<'_>) -> Self {
        let (n, size, m) = (form.variables(), form.size(), form.rows.len());
        Iterate {
            w: vec![0.0; size],
            y: vec![0.0; m],
            z_lower: vec![0.0; size],
            z_upper: vec![0.0; size],
            objective: 0.0,
            gradient: vec![0.0; n],
            rows: vec![0.0; m],
            residual: vec![0.0; m],
            jacobian: vec![0.0; form.jacobian.len()],
        }
    }

    /// Values and first derivatives at w.
    pub fn evaluate(&mut self, form: &mut SlackForm<'_>) -> Result<(), EvaluationError> {
        self.objective = form.first_order(&self.w, &mut self.rows, &mut self.gradient, &mut self.jacobian)?;
        form.residual(&self.w, &self.rows, &mut self.residual);
        Ok(())
    }

    /// θ = ‖g‖₁
    pub fn violation(&self) -> f64 {
        norm_sum(&self.residual)
    }

    /// ∇f + Aᵀy over variables and slacks (bound multipliers left out), into `target`.
    pub fn lagrangian_gradient(&self, form: &SlackForm<'_>, target: &mut [f64]) {
        target.fill(0.0);
        target[..form.variables()].copy_from_slice(&self.gradient);
        form.add_transposed(&self.jacobian, &self.y, target);
    }

    /// The optimality error for a barrier parameter (0: of the problem itself).
    pub fn errors(&self, form: &SlackForm<'_>, mu: f64, scratch: &mut [f64]) -> Errors {
        self.lagrangian_gradient(form, scratch);
        let mut complementarity: f64 = 0.0;
        let mut bounds = 0;
        for (j, dual) in scratch.iter_mut().enumerate() {
            *dual += self.z_upper[j] - self.z_lower[j] + barrier::damping(form, j, mu);
            for (bound, slack, z) in [
                (form.lower[j], self.w[j] - form.lower[j], self.z_lower[j]),
                (form.upper[j], form.upper[j] - self.w[j], self.z_upper[j]),
            ] {
                if bound.is_finite() {
                    bounds += 1;
                    complementarity = complementarity.max((slack * z - mu).abs());
                }
            }
        }
        let bound_sum = self.sum_of_bounds();
        Errors {
            dual: norm_max(scratch) / relaxation(bound_sum + norm_sum(&self.y), bounds + self.y.len()),
            primal: norm_max(&self.residual),
            complementarity: complementarity / relaxation(bound_sum, bounds),
        }
    }

    /// The dual error that rounding alone may leave: a term of ∇f + Aᵀy − z is rounded as a derivative, as a multiplier, as their product and in
    /// the sum.
    pub fn dual_rounding(&self, form: &SlackForm<'_>) -> f64 {
        let mut terms: Vec<f64> = self.z_lower.iter().zip(&self.z_upper).map(|(lower, upper)| lower + upper).collect();
        terms.iter_mut().zip(&self.gradient).for_each(|(term, gradient)| *term += gradient.abs());
        let magnitudes = |values: &[f64]| values.iter().map(|value| value.abs()).collect::<Vec<f64>>();
        form.jacobian.add_transposed(&magnitudes(&self.jacobian), &magnitudes(&self.y), &mut terms[..form.variables()]);
        let finite = |bounds: &[f64]| bounds.iter().filter(|bound| bound.is_finite()).count();
        let count = finite(&form.lower) + finite(&form.upper) + self.y.len();
        4.0 * f64::EPSILON * norm_max(&terms) / relaxation(self.sum_of_bounds() + norm_sum(&self.y), count)
    }

    fn sum_of_bounds(&self) -> f64 {
        norm_sum(&self.z_lower) + norm_sum(&self.z_upper)
    }
}

/// s_d and s_c: what large multipliers relax the errors by.
fn relaxation(sum: f64, count: usize) -> f64 {
    (sum / count.max(1) as f64).max(PARAMETERS.s_max) / PARAMETERS.s_max
}
