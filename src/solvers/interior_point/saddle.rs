//! Leaving stationary points that are no minima. Newton's method finds maxima and saddles as readily as minima when it
//! starts on one, or on the symmetry plane of one; the inertia tells.

use super::barrier;
use super::kkt::{Blocks, Kkt, RightHandSide};
use super::parameters::PARAMETERS;
use super::slack_form::SlackForm;
use super::start;
use super::state::{State, Workspace};
use super::vectors::{moved, norm_max};
use crate::model::EvaluationError;

/// Saddle points left so far.
#[derive(Debug, Default)]
pub(super) struct Escapes {
    tried: usize,
}

impl Escapes {
    /// Where the iterate is stationary but curved downwards, moves along that curvature and returns `true`.
    pub fn leave(&mut self, state: &mut State<'_>) -> Result<bool, EvaluationError> {
        if self.tried >= PARAMETERS.saddle.most_escapes || state.form.variables() == 0 {
            return Ok(false);
        }
        self.tried += 1;
        state.leave_saddle()
    }
}

impl State<'_> {
    fn leave_saddle(&mut self) -> Result<bool, EvaluationError> {
        let Some((direction, curvature)) = self.downward_curvature()? else { return Ok(false) };
        let longest = self.escape_length(&direction);
        let from = self.iterate.objective;
        let mut lowest: Option<(f64, f64)> = None;
        for length in [longest, -longest] {
            let room = self.room(&direction, length);
            moved(&self.iterate.w, room, &direction, &mut self.trial.w);
            match self.form.values(&self.trial.w, &mut self.trial.rows) {
                Ok(objective) if lowest.is_none_or(|(least, _)| objective < least) => lowest = Some((objective, room)),
                Ok(_) | Err(EvaluationError::Invalid { .. }) => {}
                Err(stopped) => return Err(stopped),
            }
        }
        let rounding = PARAMETERS.saddle.rounding * from.abs();
        let Some((_, length)) = lowest.filter(|(objective, _)| *objective <= from + rounding) else { return Ok(false) };
        // The objective falls along directions that leave the rows as well: f + yᵀg falls only by the curvature.
        if self.slope_across_rows(&direction) * length.abs() >= 0.5 * curvature.abs() * length * length {
            return Ok(false);
        }
        moved(&self.iterate.w, length, &direction, &mut self.trial.w);
        self.go_on_from_trial()
    }

    /// |y|ᵀ|Jd|: what a direction that is tangent to the rows but for rounding and regularisation has of their slopes.
    fn slope_across_rows(&self, direction: &[f64]) -> f64 {
        let (form, iterate) = (&self.form, &self.iterate);
        let across = |i: usize| {
            let along = |at: usize| iterate.jacobian[at] * direction[form.jacobian.columns[at] as usize];
            form.jacobian.range(i).map(along).sum::<f64>() - form.slack[i].map_or(0.0, |slack| direction[slack])
        };
        iterate.y.iter().enumerate().map(|(i, y)| (y * across(i)).abs()).sum()
    }

    /// The longest step along ±direction inside the bounds, at most `length`.
    fn room(&self, direction: &[f64], length: f64) -> f64 {
        let step: Vec<f64> = direction.iter().map(|value| value * length).collect();
        length * barrier::longest_step(&self.form, &self.iterate.w, &step, 0.5)
    }

    fn escape_length(&self, direction: &[f64]) -> f64 {
        PARAMETERS.saddle.distance * (1.0 + norm_max(&self.iterate.w[..self.form.variables()])) / norm_max(direction)
    }

    /// A direction of negative curvature of the barrier's Lagrangian, tangent to the rows, and that curvature; `None` where there is none.
    fn downward_curvature(&mut self) -> Result<Option<(Vec<f64>, f64)>, EvaluationError> {
        let Self { form, iterate, work: Workspace { hessian, sigma, .. }, kkt, .. } = self;
        match form.hessian(&iterate.w, &iterate.y, hessian) {
            Err(EvaluationError::Invalid { .. }) => return Ok(None),
            other => other?,
        }
        barrier::sigma(form, &iterate.w, &iterate.z_lower, &iterate.z_upper, sigma);
        // A polished iterate lies on its bounds.
        sigma.iter_mut().for_each(|sigma| *sigma = sigma.min(kkt.rigid()).max(1.0 / kkt.rigid()));
        let blocks = Blocks { hessian, jacobian: &iterate.jacobian, sigma };
        // Regularised, so that dependent rows count as negative eigenvalues like all others.
        let regularised = kkt.factor(blocks, 0.0, PARAMETERS.delta_c_counting);
        if regularised.is_ok_and(|inertia| inertia.negative <= form.rows.len()) || !kkt.factor_close(blocks) {
            return Ok(None);
        }
        let Some(direction) = inverse_iteration(kkt, form) else { return Ok(None) };
        let significant = -PARAMETERS.saddle.curvature * norm_max(hessian).max(f64::MIN_POSITIVE);
        let curvature = curvature(form, hessian, sigma, &direction);
        Ok((curvature < significant).then_some((direction, curvature)))
    }

    /// Makes the trial point the iterate, with a larger barrier parameter and fresh multipliers.
    fn go_on_from_trial(&mut self) -> Result<bool, EvaluationError> {
        if !self.evaluate_trial()? {
            return Ok(false);
        }
        std::mem::swap(&mut self.iterate, &mut self.trial);
        let mu = PARAMETERS.saddle.mu;
        self.mu = mu;
        start::place_slacks(&self.form, &mut self.iterate, mu);
        start::central_bound_multipliers(&self.form, &mut self.iterate, mu, 1.0 / mu);
        start::least_squares_multipliers(&self.form, &mut self.kkt, &mut self.iterate);
        Ok(true)
    }
}

/// The direction of least curvature in the KKT matrix factorised last, tangent to the rows, its largest component 1.
fn inverse_iteration(kkt: &mut Kkt, form: &SlackForm<'_>) -> Option<Vec<f64>> {
    let rows = vec![0.0; form.rows.len()];
    let (mut right, mut step, mut y) = (vec![0.0; form.size()], vec![0.0; form.size()], rows.clone());
    for (j, right) in right.iter_mut().take(form.variables()).enumerate() {
        // Any fixed vector without a symmetry will do.
        *right = 1.0 + ((j as f64 + 1.0) * 0.618_033_988_75).fract();
    }
    for _ in 0..PARAMETERS.saddle.inverse_iterations {
        kkt.solve(RightHandSide { w: &right, rows: &rows }, &mut step, &mut y).ok()?;
        let size = norm_max(&step);
        if size == 0.0 {
            return None;
        }
        step.iter_mut().for_each(|step| *step /= size);
        right.copy_from_slice(&step);
    }
    Some(step)
}

/// dᵀ(W + Σ)d
fn curvature(form: &SlackForm<'_>, hessian: &[f64], sigma: &[f64], direction: &[f64]) -> f64 {
    let of_bounds: f64 = sigma.iter().zip(direction).map(|(sigma, d)| sigma * d * d).sum();
    let of_hessian = form.hessian.iter().zip(hessian).map(|((row, column), value)| {
        let times = if row == column { 1.0 } else { 2.0 };
        times * value * direction[row] * direction[column]
    });
    of_bounds + of_hessian.sum::<f64>()
}
