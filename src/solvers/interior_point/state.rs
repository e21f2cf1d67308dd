//! The state of a run: the form, the point, the direction, the KKT matrix, and the algebra on them. It decides nothing.

use super::barrier;
use super::iterate::{Errors, Iterate};
use super::kkt::{Blocks, Kkt, RightHandSide};
use super::parameters::PARAMETERS;
use super::slack_form::SlackForm;
use super::vectors::moved;
use crate::model::EvaluationError;
use crate::solvers::RankedPoint;
use crate::solvers::barrier::longest_multiplier_step;

/// A Newton direction.
pub(super) struct Direction {
    pub w: Vec<f64>,
    pub y: Vec<f64>,
    pub z_lower: Vec<f64>,
    pub z_upper: Vec<f64>,
}

/// The iterate with the least optimality error.
pub(super) struct Best {
    pub error: f64,
    pub iterate: Iterate,
    /// When it was reached.
    pub iteration: u64,
}

/// Room for the values a KKT system is made of.
pub(super) struct Workspace {
    /// ∇φ of the current iterate.
    pub barrier_gradient: Vec<f64>,
    /// The right-hand side −(∇φ + Aᵀy) of the current system.
    pub right: Vec<f64>,
    /// W, along [`SlackForm::hessian`].
    pub hessian: Vec<f64>,
    /// Σ
    pub sigma: Vec<f64>,
}

/// Where a run stands.
pub(super) struct State<'a> {
    pub form: SlackForm<'a>,
    pub kkt: Kkt,
    pub mu: f64,
    pub iterate: Iterate,
    pub trial: Iterate,
    pub direction: Direction,
    pub work: Workspace,
    /// The optimality error of the iterate.
    pub errors: Errors,
    pub best: Best,
    pub iterations: u64,
    /// Norm of the last step of the variables, in the model's units.
    pub step_norm: f64,
}

impl<'a> State<'a> {
    /// At a first iterate.
    pub fn new(form: SlackForm<'a>, kkt: Kkt, mu: f64, iterate: Iterate) -> Self {
        let (size, m) = (form.size(), form.rows.len());
        let zeros = || vec![0.0; size];
        let mut state = State {
            kkt,
            mu,
            trial: iterate.clone(),
            best: Best { error: f64::INFINITY, iterate: iterate.clone(), iteration: 0 },
            iterate,
            direction: Direction { w: zeros(), y: vec![0.0; m], z_lower: zeros(), z_upper: zeros() },
            work: Workspace { barrier_gradient: zeros(), right: zeros(), hessian: vec![0.0; form.hessian.len()], sigma: zeros() },
            errors: Errors { dual: 0.0, primal: 0.0, complementarity: 0.0 },
            iterations: 0,
            step_norm: 0.0,
            form,
        };
        state.assess();
        state
    }

    /// τ of the fraction-to-the-boundary rule.
    pub fn tau(&self) -> f64 {
        PARAMETERS.barrier.tau(self.mu)
    }

    /// The longest step along the direction that keeps w inside its bounds.
    pub fn longest_step(&self) -> f64 {
        barrier::longest_step(&self.form, &self.iterate.w, &self.direction.w, self.tau())
    }

    /// The optimality error, and the best iterate so far.
    pub fn assess(&mut self) {
        self.errors = self.iterate.errors(&self.form, 0.0, &mut self.work.right);
        let error = self.errors.largest();
        if error < PARAMETERS.better * self.best.error {
            self.best.error = error;
            self.best.iteration = self.iterations;
            self.best.iterate.clone_from(&self.iterate);
        }
    }

    /// Begins the search for the best iterate anew.
    pub fn forget_best(&mut self) {
        self.best.error = f64::INFINITY;
        self.assess();
    }

    /// Iterations since the best iterate.
    pub fn idle_iterations(&self) -> u64 {
        self.iterations - self.best.iteration
    }

    /// E_μ of the iterate.
    pub fn barrier_error(&mut self) -> f64 {
        self.iterate.errors(&self.form, self.mu, &mut self.work.right).largest()
    }

    /// E_μ of the trial point.
    pub fn trial_barrier_error(&mut self) -> f64 {
        self.trial.errors(&self.form, self.mu, &mut self.work.right).largest()
    }

    /// W and Σ at the iterate.
    pub fn second_order(&mut self) -> Result<(), EvaluationError> {
        let Self { form, iterate, work, .. } = self;
        form.hessian(&iterate.w, &iterate.y, &mut work.hessian)?;
        barrier::sigma(form, &iterate.w, &iterate.z_lower, &iterate.z_upper, &mut work.sigma);
        Ok(())
    }

    /// Solves the KKT system at the iterate. `false`: it has no usable factors.
    pub fn newton_direction(&mut self) -> Result<bool, EvaluationError> {
        self.second_order()?;
        let Self { form, iterate, work, mu, kkt, direction, .. } = self;
        work.barrier_gradient.fill(0.0);
        work.barrier_gradient[..form.variables()].copy_from_slice(&iterate.gradient);
        barrier::add_gradient(form, &iterate.w, *mu, &mut work.barrier_gradient);
        iterate.lagrangian_gradient(form, &mut work.right);
        barrier::add_gradient(form, &iterate.w, *mu, &mut work.right);
        work.right.iter_mut().for_each(|value| *value = -*value);
        let blocks = Blocks { hessian: &work.hessian, jacobian: &iterate.jacobian, sigma: &work.sigma };
        if !kkt.factor_corrected(blocks, *mu, || form.model.may_go_on().is_ok()).unwrap_or(false) {
            form.model.may_go_on()?;
            return Ok(false);
        }
        let rows: Vec<f64> = iterate.residual.iter().map(|value| -value).collect();
        Ok(kkt.solve(RightHandSide { w: &work.right, rows: &rows }, &mut direction.w, &mut direction.y).is_ok())
    }

    /// Puts the trial point's w at this length along the direction.
    pub fn move_trial(&mut self, length: f64) {
        moved(&self.iterate.w, length, &self.direction.w, &mut self.trial.w);
        self.form.keep_inside(&mut self.trial.w);
    }

    /// Values and first derivatives at the trial point's w. `false`: it is outside the domain.
    pub fn evaluate_trial(&mut self) -> Result<bool, EvaluationError> {
        match self.trial.evaluate(&mut self.form) {
            Ok(()) => Ok(true),
            Err(EvaluationError::Invalid { .. }) => Ok(false),
            Err(stopped) => Err(stopped),
        }
    }

    /// Makes the trial point (w and its values are there already) the iterate, multipliers stepped.
    pub fn take(&mut self, length: f64) -> Result<(), EvaluationError> {
        self.trial.evaluate(&mut self.form)?;
        self.step_multipliers(length);
        self.arrive();
        Ok(())
    }

    /// Makes the trial point the iterate.
    pub fn arrive(&mut self) {
        let n = self.form.variables();
        let change = |j: usize| (self.trial.w[j] - self.iterate.w[j]) * self.form.variable_scale[j];
        self.step_norm = (0..n).map(|j| change(j).powi(2)).sum::<f64>().sqrt();
        std::mem::swap(&mut self.iterate, &mut self.trial);
        self.assess();
    }

    /// Sets the trial point's multipliers: y by the primal length, bounds' by their own.
    pub fn step_multipliers(&mut self, length: f64) {
        let tau = self.tau();
        let Self { form, iterate, trial, direction, mu, .. } = self;
        barrier::multiplier_steps(
            form,
            &iterate.w,
            &direction.w,
            *mu,
            (&iterate.z_lower, &iterate.z_upper),
            (&mut direction.z_lower, &mut direction.z_upper),
        );
        let dual = longest_multiplier_step(&iterate.z_lower, &direction.z_lower, tau).min(longest_multiplier_step(
            &iterate.z_upper,
            &direction.z_upper,
            tau,
        ));
        moved(&iterate.y, length, &direction.y, &mut trial.y);
        moved(&iterate.z_lower, dual, &direction.z_lower, &mut trial.z_lower);
        moved(&iterate.z_upper, dual, &direction.z_upper, &mut trial.z_upper);
        barrier::reset_multipliers(form, &trial.w, *mu, &mut trial.z_lower, &mut trial.z_upper);
    }

    /// The current iterate as the user knows it.
    pub fn point(&mut self) -> RankedPoint {
        let x = self.form.x(&self.iterate.w).to_vec();
        RankedPoint {
            x,
            objective: self.iterate.objective / self.form.objective_scale,
            relative_violation: self.form.scaled_violation(&self.iterate.rows),
            feasibility: self.form.violation(&self.iterate.rows),
            optimality: self.errors.largest(),
            multipliers: Some(self.form.multipliers(&self.iterate.y)),
        }
    }
}
