//! The primal-dual interior point with a filter line search, one iteration at a time: Wächter & Biegler, "On the
//! implementation of an interior-point filter line-search algorithm for large-scale nonlinear programming",
//! Math. Program. 106 (2006), Algorithm A.

use super::barrier;
use super::filter::Filter;
use super::form::Form;
use super::iterate::{Errors, Iterate};
use super::kkt::{Blocks, Kkt, Sides};
use super::line_search::Search;
use super::parameters::PARAMETERS;
use super::restoration::Restoration;
use super::vectors::moved;
use super::watchdog::Watchdog;
use crate::model::EvaluationError;
use crate::solvers::barrier::longest_multiplier_step;

/// Why the iterations ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ending {
    /// The optimality error is down to rounding.
    Optimal,
    /// No more progress, but close.
    Acceptable,
    /// A local minimum of the violation, not zero.
    Infeasible,
    /// Objective or variables run off.
    Diverging(String),
    /// No way on was found.
    Stuck(String),
    /// Second derivatives are no numbers at an iterate.
    Invalid(String),
}

/// A Newton direction.
pub(super) struct Direction {
    pub w: Vec<f64>,
    pub y: Vec<f64>,
    pub z_lower: Vec<f64>,
    pub z_upper: Vec<f64>,
}

/// The algorithm's whole state.
pub(super) struct Engine<'a> {
    pub form: Form<'a>,
    pub kkt: Kkt,
    pub filter: Filter,
    pub mu: f64,
    pub iterate: Iterate,
    pub trial: Iterate,
    pub direction: Direction,
    /// ∇φ of the current iterate.
    pub barrier_gradient: Vec<f64>,
    /// The right-hand side −(∇φ + Aᵀy) of the current system.
    pub right: Vec<f64>,
    pub hessian: Vec<f64>,
    pub sigma: Vec<f64>,
    /// θ_min and θ_max.
    pub smallest_violation: f64,
    pub largest_violation: f64,
    pub restoration: Option<Box<Restoration<'a>>>,
    pub restorations: usize,
    /// Norm of the last step of the variables, scaled.
    pub step_norm: f64,
    /// The optimality error of the current iterate.
    pub errors: Errors,
    pub best: Best,
    /// Whether steps are taken without the filter: [`Engine::predictor_corrector`].
    pub unguarded: bool,
    /// Saddle points left so far.
    pub escapes: usize,
    pub watchdog: Option<Box<Watchdog>>,
    pub shortened_steps: usize,
    pub tiny_steps: usize,
    pub iterations: u64,
    /// The optimality error at which a large problem is polished next, on trial.
    pub polish_at: f64,
}

/// The iterate with the least optimality error.
pub(super) struct Best {
    pub error: f64,
    pub iterate: Iterate,
    pub iteration: u64,
}

impl Engine<'_> {
    /// τ of the fraction-to-the-boundary rule.
    pub fn tau(&self) -> f64 {
        PARAMETERS.barrier.tau(self.mu)
    }

    /// One iteration. `Some`: it was the last.
    pub fn step(&mut self) -> Result<Option<Ending>, EvaluationError> {
        self.iterations += 1;
        if self.restoration.is_some() {
            return self.restoration_step();
        }
        match self.ending() {
            Some(Ending::Optimal | Ending::Acceptable) if self.leave_saddle()? => {}
            Some(ending) => return Ok(Some(ending)),
            None if self.polished_early()? || self.predictor_corrector()? => return Ok(None),
            None => {}
        }
        if self.watchdog.is_none() {
            self.decrease_barrier();
        }
        match self.newton_direction() {
            Ok(true) => {}
            Ok(false) => return self.restore("the KKT matrix has no usable factors"),
            Err(EvaluationError::Invalid { term, cause }) => return Ok(Some(Ending::Invalid(format!("{term}: {cause}")))),
            Err(stopped) => return Err(stopped),
        }
        self.move_along()
    }

    /// The optimality error, and the best iterate so far.
    pub fn assess(&mut self) {
        self.errors = self.iterate.errors(&self.form, 0.0, &mut self.right);
        let error = self.errors.largest();
        if error < 0.9 * self.best.error {
            self.best.error = error;
            self.best.iteration = self.iterations;
            self.best.iterate.clone_from(&self.iterate);
        }
    }

    /// Starts the search for the best iterate and the filter anew.
    pub fn forget(&mut self) {
        self.filter.reset(self.largest_violation);
        self.watchdog = None;
        self.best.error = f64::INFINITY;
        self.tiny_steps = 0;
        self.assess();
    }

    fn ending(&self) -> Option<Ending> {
        let idle = self.iterations - self.best.iteration;
        if self.errors.largest() <= PARAMETERS.epsilon_tol {
            return Some(Ending::Optimal);
        }
        if self.best.error <= PARAMETERS.epsilon_acceptable && idle > PARAMETERS.patience_near {
            return Some(Ending::Acceptable);
        }
        if self.iterate.objective < -PARAMETERS.diverging && self.errors.primal < 1e-6 {
            let value = self.iterate.objective / self.form.objective_scale;
            return Some(Ending::Diverging(format!("the objective falls below {value:.1e} and on; it diverges")));
        }
        if let Some(j) = (0..self.form.variables()).find(|&j| self.iterate.w[j].abs() > PARAMETERS.diverging) {
            let name = self.form.model.variable_name(self.form.free[j]);
            return Some(Ending::Diverging(format!("{name} grows beyond all bounds; the iterates diverge")));
        }
        (idle > PARAMETERS.patience_far).then(|| Ending::Stuck(format!("no progress in {} iterations", PARAMETERS.patience_far)))
    }

    /// Lowers μ while the barrier problem is solved well enough: equation (7).
    fn decrease_barrier(&mut self) {
        let forced = self.tiny_steps >= 2;
        let mut force = forced;
        while self.mu > PARAMETERS.barrier.mu_last {
            let error = self.iterate.errors(&self.form, self.mu, &mut self.right).largest();
            if error > PARAMETERS.barrier.kappa_epsilon * self.mu && !force {
                break;
            }
            force = false;
            self.mu = PARAMETERS.barrier.next(self.mu);
            self.filter.reset(self.largest_violation);
            self.tiny_steps = 0;
        }
    }

    /// W and Σ at the iterate.
    pub fn second_order(&mut self) -> Result<(), EvaluationError> {
        let Self { form, iterate, .. } = self;
        form.hessian(&iterate.w, &iterate.y, &mut self.hessian)?;
        barrier::sigma(form, &iterate.w, &iterate.z_lower, &iterate.z_upper, &mut self.sigma);
        Ok(())
    }

    /// Solves the KKT system at the iterate. `false`: it has no usable factors.
    fn newton_direction(&mut self) -> Result<bool, EvaluationError> {
        self.second_order()?;
        let Self { form, iterate, right, .. } = self;
        self.barrier_gradient.fill(0.0);
        self.barrier_gradient[..form.variables()].copy_from_slice(&iterate.gradient);
        barrier::add_gradient(form, &iterate.w, self.mu, &mut self.barrier_gradient);
        iterate.lagrangian_gradient(form, right);
        barrier::add_gradient(form, &iterate.w, self.mu, right);
        right.iter_mut().for_each(|value| *value = -*value);
        let blocks = Blocks { hessian: &self.hessian, jacobian: &iterate.jacobian, sigma: &self.sigma };
        if !self.kkt.factor_corrected(blocks, self.mu).unwrap_or(false) {
            return Ok(false);
        }
        let rows: Vec<f64> = iterate.residual.iter().map(|value| -value).collect();
        let sides = Sides { w: right, rows: &rows };
        if self.kkt.solve(sides, &mut self.direction.w, &mut self.direction.y).is_err() {
            return Ok(false);
        }
        Ok(true)
    }

    /// Line search, then the step; restoration where no length will do.
    fn move_along(&mut self) -> Result<Option<Ending>, EvaluationError> {
        let mut cap: f64 = 1.0;
        loop {
            let found = match self.watchdog.take() {
                None => self.line_search(cap)?,
                Some(watchdog) => match self.full_step_on_trial(watchdog)? {
                    Some(found) => found,
                    None => {
                        self.assess();
                        return Ok(None);
                    }
                },
            };
            let length = match found {
                Search::Step(length) | Search::Tiny(length) => length,
                Search::Failed => return self.line_search_failed(),
            };
            self.tiny_steps = if matches!(found, Search::Tiny(_)) { self.tiny_steps + 1 } else { 0 };
            if self.tiny_steps > 2 && self.mu <= PARAMETERS.barrier.mu_last {
                return Ok(Some(self.end_of_progress("the steps are below rounding")));
            }
            match self.take(length) {
                Ok(()) => return Ok(None),
                // Values exist there, derivatives do not: stay closer.
                Err(EvaluationError::Invalid { .. }) if length > 1e-12 => cap = 0.5 * length,
                Err(EvaluationError::Invalid { .. }) => return self.line_search_failed(),
                Err(stopped) => return Err(stopped),
            }
        }
    }

    /// Makes the trial point (w and its values are there already) the iterate, multipliers stepped.
    fn take(&mut self, length: f64) -> Result<(), EvaluationError> {
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
    fn step_multipliers(&mut self, length: f64) {
        let Self { form, iterate, trial, direction, mu, .. } = self;
        let tau = PARAMETERS.barrier.tau(*mu);
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

    /// A step that lowers the primal-dual error is taken even against the filter (the soft restoration of §3.10 in
    /// spirit: near a solution φ is lost in rounding, the error is not); otherwise feasibility is restored.
    fn line_search_failed(&mut self) -> Result<Option<Ending>, EvaluationError> {
        let before = self.iterate.errors(&self.form, self.mu, &mut self.right).largest();
        let mut length = barrier::longest_step(&self.form, &self.iterate.w, &self.direction.w, self.tau());
        for _ in 0..3 {
            moved(&self.iterate.w, length, &self.direction.w, &mut self.trial.w);
            self.form.keep_inside(&mut self.trial.w);
            match self.trial.evaluate(&mut self.form) {
                Ok(()) => {
                    self.step_multipliers(length);
                    let after = self.trial.errors(&self.form, self.mu, &mut self.right).largest();
                    if after < (1.0 - 1e-4) * before {
                        self.take(length)?;
                        return Ok(None);
                    }
                }
                Err(EvaluationError::Invalid { .. }) => {}
                Err(stopped) => return Err(stopped),
            }
            length *= 0.5;
        }
        self.restore("the line search found no acceptable step")
    }

    /// The ending where nothing moves any more.
    pub fn end_of_progress(&self, why: &str) -> Ending {
        if self.best.error <= PARAMETERS.epsilon_acceptable { Ending::Acceptable } else { Ending::Stuck(why.into()) }
    }
}
