//! Mehrotra's predictor–corrector (SIAM J. Optim. 2, 1992) for large problems: the barrier parameter follows from what a step without
//! barrier would reach, and a second right-hand side centres and makes up for the products that Newton's method neglects. How much of
//! it is added the longest step decides: Colombo & Gondzio (Comput. Optim. Appl. 41, 2008).
//!
//! Steps are taken without a line search, as is the custom for convex problems: while the matrix has the right inertia uncorrected and the
//! optimality error falls. Once that ends, the filter takes over for good, from the best iterate.

use super::barrier;
use super::iterate::Iterate;
use super::kkt::{Blocks, RightHandSide};
use super::parameters::PARAMETERS;
use super::state::{State, Workspace};
use super::vectors::moved;
use crate::math::dot;
use crate::model::EvaluationError;
use crate::solvers::barrier::longest_multiplier_step;

/// A direction.
struct Step {
    w: Vec<f64>,
    y: Vec<f64>,
    z_lower: Vec<f64>,
    z_upper: Vec<f64>,
}

/// How far a direction leads: w, and the bound multipliers.
#[derive(Clone, Copy)]
struct Lengths {
    primal: f64,
    dual: f64,
}

/// What became of an iteration.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Predicted {
    /// A step was taken.
    Step,
    /// The last step was the last: the state is back at the best iterate, and the filter takes over for good.
    HandedOver,
    /// The filter is in charge.
    Nothing,
}

/// Whether steps are taken without the filter.
pub(super) struct Predictor {
    in_charge: bool,
}

impl Predictor {
    /// For a large problem, or not for any.
    pub fn new(is_large: bool) -> Self {
        Predictor { in_charge: is_large }
    }

    /// Whether steps are taken without the filter.
    pub fn is_in_charge(&self) -> bool {
        self.in_charge
    }

    /// Takes a step while these do well.
    pub fn step(&mut self, state: &mut State<'_>) -> Result<Predicted, EvaluationError> {
        if !self.in_charge {
            return Ok(Predicted::Nothing);
        }
        let patient = state.idle_iterations() <= PARAMETERS.predictor.patience;
        match if patient { state.step_unguarded() } else { Ok(false) } {
            Ok(true) => return Ok(Predicted::Step),
            Ok(false) | Err(EvaluationError::Invalid { .. }) => {}
            Err(stopped) => return Err(stopped),
        }
        self.in_charge = false;
        state.iterate.clone_from(&state.best.iterate);
        state.mu = state.mean_product(None).clamp(PARAMETERS.barrier.mu_last, PARAMETERS.barrier.mu_0);
        Ok(Predicted::HandedOver)
    }
}

impl State<'_> {
    /// One step without a line search. `false`: there is none.
    fn step_unguarded(&mut self) -> Result<bool, EvaluationError> {
        self.second_order()?;
        let blocks = Blocks { hessian: &self.work.hessian, jacobian: &self.iterate.jacobian, sigma: &self.work.sigma };
        if !self.kkt.factor_uncorrected(blocks) {
            return Ok(false);
        }
        let Some((step, Lengths { primal, dual })) = self.corrected_step() else { return Ok(false) };
        moved(&self.iterate.w, primal, &step.w, &mut self.trial.w);
        self.form.keep_inside(&mut self.trial.w);
        self.trial.evaluate(&mut self.form)?;
        moved(&self.iterate.z_lower, dual, &step.z_lower, &mut self.trial.z_lower);
        moved(&self.iterate.z_upper, dual, &step.z_upper, &mut self.trial.z_upper);
        barrier::reset_multipliers(&self.form, &self.trial.w, self.mu, &mut self.trial.z_lower, &mut self.trial.z_upper);
        let length = self.length_of_multipliers(&step.y);
        moved(&self.iterate.y, length, &step.y, &mut self.trial.y);
        self.arrive();
        Ok(true)
    }

    /// The corrected step that leads furthest.
    fn corrected_step(&mut self) -> Option<(Step, Lengths)> {
        let predictor = self.predictor()?;
        let reach = self.lengths(&predictor, 1.0);
        let (now, then) = (self.mean_product(None), self.mean_product(Some((&predictor, reach))));
        self.mu = PARAMETERS.barrier.mu_last.max(now * (then / now).powi(3));
        let corrector = self.corrector(&predictor)?;
        let (least, shares) = (reach.primal * reach.dual, PARAMETERS.predictor.shares);
        let steps = (0..shares).map(|k| {
            let share = least + (1.0 - least) * k as f64 / (shares - 1) as f64;
            let step = predictor.plus(share, &corrector);
            let lengths = self.lengths(&step, self.tau());
            (step, lengths)
        });
        steps.max_by(|(_, a), (_, b)| (a.primal * a.dual).total_cmp(&(b.primal * b.dual)))
    }

    /// Newton's step for the problem without barrier.
    fn predictor(&mut self) -> Option<Step> {
        let Self { form, iterate, work: Workspace { right, .. }, kkt, .. } = self;
        iterate.lagrangian_gradient(form, right);
        right.iter_mut().for_each(|value| *value = -*value);
        let rows: Vec<f64> = iterate.residual.iter().map(|value| -value).collect();
        let mut step = Step::zero(right.len(), rows.len());
        kkt.solve(RightHandSide { w: right, rows: &rows }, &mut step.w, &mut step.y).ok()?;
        let Step { w: w_step, z_lower, z_upper, .. } = &mut step;
        let multipliers = (&iterate.z_lower[..], &iterate.z_upper[..]);
        barrier::multiplier_steps(form, &iterate.w, w_step, 0.0, multipliers, (z_lower, z_upper));
        Some(step)
    }

    /// What is to be added for every product slack·multiplier to become μ, those of the predictor's steps included.
    fn corrector(&mut self, predictor: &Step) -> Option<Step> {
        let Self { form, iterate, work: Workspace { right, .. }, kkt, mu, .. } = self;
        let target = |slack: f64, product: f64| if slack.is_finite() { (*mu - product) / slack } else { 0.0 };
        let mut step = Step::zero(right.len(), iterate.y.len());
        for (j, &w) in iterate.w.iter().enumerate() {
            step.z_lower[j] = target(w - form.lower[j], predictor.w[j] * predictor.z_lower[j]);
            step.z_upper[j] = target(form.upper[j] - w, -predictor.w[j] * predictor.z_upper[j]);
            right[j] = step.z_lower[j] - step.z_upper[j];
        }
        kkt.solve(RightHandSide { w: right, rows: &vec![0.0; iterate.y.len()] }, &mut step.w, &mut step.y).ok()?;
        for (j, &w) in iterate.w.iter().enumerate() {
            step.z_lower[j] -= iterate.z_lower[j] * step.w[j] / (w - form.lower[j]);
            step.z_upper[j] += iterate.z_upper[j] * step.w[j] / (form.upper[j] - w);
        }
        Some(step)
    }

    fn lengths(&self, step: &Step, tau: f64) -> Lengths {
        let Iterate { w, z_lower, z_upper, .. } = &self.iterate;
        let dual = longest_multiplier_step(z_lower, &step.z_lower, tau).min(longest_multiplier_step(z_upper, &step.z_upper, tau));
        Lengths { primal: barrier::longest_step(&self.form, w, &step.w, tau), dual }
    }

    /// The mean of slack·multiplier over all bounds, at the iterate or after a step.
    fn mean_product(&self, step: Option<(&Step, Lengths)>) -> f64 {
        let Self { form, iterate, .. } = self;
        let (mut sum, mut count) = (0.0, 0_usize);
        for j in 0..form.size() {
            let ahead = |(step, lengths): (&Step, Lengths)| {
                (lengths.primal * step.w[j], lengths.dual * step.z_lower[j], lengths.dual * step.z_upper[j])
            };
            let (w, z_lower, z_upper) = step.map_or((0.0, 0.0, 0.0), ahead);
            let w = iterate.w[j] + w;
            for (slack, z) in
                [(w - form.lower[j], iterate.z_lower[j] + z_lower), (form.upper[j] - w, iterate.z_upper[j] + z_upper)]
            {
                if slack.is_finite() {
                    sum += slack * z;
                    count += 1;
                }
            }
        }
        sum / count.max(1) as f64
    }

    /// The length in [0, 1] along `step` of the row multipliers that leaves the trial point least dual infeasible, in the 2-norm.
    fn length_of_multipliers(&mut self, step: &[f64]) -> f64 {
        let Self { form, iterate, trial, work: Workspace { right, .. }, .. } = self;
        trial.y.copy_from_slice(&iterate.y);
        trial.lagrangian_gradient(form, right);
        for (j, right) in right.iter_mut().enumerate() {
            *right += trial.z_upper[j] - trial.z_lower[j];
        }
        let mut along = vec![0.0; form.size()];
        form.add_transposed(&trial.jacobian, step, &mut along);
        let square = dot(&along, &along);
        if square > 0.0 { (-dot(right, &along) / square).clamp(0.0, 1.0) } else { 0.0 }
    }
}

impl Step {
    fn zero(size: usize, rows: usize) -> Self {
        let zeros = || vec![0.0; size];
        Step { w: zeros(), y: vec![0.0; rows], z_lower: zeros(), z_upper: zeros() }
    }

    /// self + share·other
    fn plus(&self, share: f64, other: &Step) -> Step {
        let mut sum = Step::zero(self.w.len(), self.y.len());
        moved(&self.w, share, &other.w, &mut sum.w);
        moved(&self.y, share, &other.y, &mut sum.y);
        moved(&self.z_lower, share, &other.z_lower, &mut sum.z_lower);
        moved(&self.z_upper, share, &other.z_upper, &mut sum.z_upper);
        sum
    }
}
