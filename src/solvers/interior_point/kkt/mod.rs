//! The KKT system of one Newton step, slacks eliminated, with inertia correction.
//!
//! ```text
//! [ W + Σ_x + δ_w   Aᵀ              ] [ dx ]   [ r_x             ]
//! [ A               −(1/D + δ_c)    ] [ dy ] = [ r_g + r_s/D     ]     D = Σ_s + δ_w (no 1/D for an equality)
//! ```
//! Inertia (n, m, 0) makes dx a descent direction: Wächter & Biegler (2006), §3.1, Algorithm IC.

mod condensed;
mod full;
mod system;

use super::parameters::PARAMETERS;
use super::slack_form::SlackForm;
use crate::linear_algebra::{Effort, FactorizationError, Inertia};
use condensed::Condensed;
use full::Full;
use system::System;

/// Matrix, factors and the memory of earlier corrections.
pub(super) struct Kkt {
    system: System,
    /// The condensed form, where it is in use; the whole matrix, where that was needed.
    condensed: Option<Box<Condensed>>,
    full: Option<Box<Full>>,
    /// Whether the whole matrix was factorised last.
    in_full: bool,
    /// Times the condensed form failed.
    failures: usize,
    /// Whether pivots are sought far, and the whole matrix is factorised, where the condensed form fails: a matter of many times the time.
    pub patient: bool,
    /// Slack of each row.
    slack: Vec<Option<usize>>,
    variables: usize,
    /// D of each row with a slack, of the matrix factorised last.
    slack_diagonal: Vec<f64>,
    last_correction: f64,
    /// δ_w of the matrix factorised last.
    pub correction: f64,
    /// Whether the Jacobian seemed to have dependent rows.
    pub dependent: bool,
    right: Vec<f64>,
    solution: Vec<f64>,
}

/// The values a KKT matrix is made of.
#[derive(Clone, Copy)]
pub(super) struct Blocks<'b> {
    /// Along [`SlackForm::hessian`].
    pub hessian: &'b [f64],
    /// Along [`SlackForm::jacobian`].
    pub jacobian: &'b [f64],
    /// Σ, for variables and slacks.
    pub sigma: &'b [f64],
}

/// Right-hand sides, or the steps they lead to: of w (variables, then slacks) and of the rows.
pub(super) struct RightHandSide<'s> {
    pub w: &'s [f64],
    pub rows: &'s [f64],
}

impl Kkt {
    /// Analyses the pattern.
    pub fn new(form: &SlackForm<'_>) -> Result<Self, FactorizationError> {
        let system = System::new(form);
        let condensed = Condensed::new(&system, &form.slack).map(Box::new);
        let full = if condensed.is_none() { Some(Box::new(Full::new(&system)?)) } else { None };
        let (rows, order) = (form.rows.len(), system.order());
        Ok(Kkt {
            system,
            in_full: condensed.is_none(),
            condensed,
            full,
            failures: 0,
            patient: true,
            slack: form.slack.clone(),
            variables: form.variables(),
            slack_diagonal: vec![0.0; rows],
            last_correction: 0.0,
            correction: 0.0,
            dependent: false,
            right: vec![0.0; order],
            solution: vec![0.0; order],
        })
    }

    /// The Σ that holds a variable in its place: large, but no larger than the factors can bear.
    pub fn rigid(&self) -> f64 {
        if self.condensed.is_some() { PARAMETERS.condensing.rigid } else { PARAMETERS.condensing.rigid_in_full }
    }

    /// Factorises with the corrections δ_w and δ_c.
    pub fn factor(&mut self, blocks: Blocks<'_>, primal: f64, dual: f64) -> Result<Inertia, FactorizationError> {
        let system = &mut self.system;
        system.hessian_values.copy_from_slice(blocks.hessian);
        system.jacobian_values.copy_from_slice(blocks.jacobian);
        for (value, sigma) in system.primal.iter_mut().zip(blocks.sigma) {
            *value = sigma + primal;
        }
        for (i, value) in system.dual.iter_mut().enumerate() {
            *value = dual;
            if let Some(slack) = self.slack[i] {
                self.slack_diagonal[i] = blocks.sigma[slack] + primal;
                *value += 1.0 / self.slack_diagonal[i];
            }
        }
        self.correction = primal;
        if let Some(condensed) = &mut self.condensed {
            self.in_full = false;
            let inertia = condensed.factor(system, if self.patient { Effort::Any } else { Effort::Quick });
            if inertia.is_ok() {
                return inertia;
            }
        }
        self.factor_in_full()
    }

    /// Factorises the whole matrix; gives the condensed form up where that has failed too often.
    fn factor_in_full(&mut self) -> Result<Inertia, FactorizationError> {
        if self.condensed.is_some() {
            if !self.patient {
                return Err(FactorizationError::Singular);
            }
            self.failures += 1;
            if self.failures >= PARAMETERS.condensing.most_failures {
                self.condensed = None;
            }
        }
        self.in_full = true;
        let full = match &mut self.full {
            Some(full) => full,
            None => self.full.insert(Box::new(Full::new(&self.system)?)),
        };
        full.factor(&self.system)
    }

    /// The inertia of a minimum.
    fn wanted(&self) -> Inertia {
        Inertia { positive: self.variables, negative: self.slack.len(), zero: 0 }
    }

    /// Factorises without corrections. `false`: the inertia is not that of a minimum.
    pub fn factor_uncorrected(&mut self, blocks: Blocks<'_>) -> bool {
        let wanted = self.wanted();
        self.factor(blocks, 0.0, 0.0).is_ok_and(|inertia| inertia == wanted)
    }

    /// Factorises with the least corrections found that give the inertia of a minimum. `false`: none was found while it `may_go_on`.
    pub fn factor_corrected(
        &mut self,
        blocks: Blocks<'_>,
        mu: f64,
        may_go_on: impl Fn() -> bool,
    ) -> Result<bool, FactorizationError> {
        let wanted = self.wanted();
        let regularisation = PARAMETERS.delta_c * mu.powf(PARAMETERS.kappa_c);
        let mut dual = if self.dependent { regularisation } else { 0.0 };
        match self.factor(blocks, 0.0, dual) {
            Ok(inertia) if inertia == wanted => return Ok(true),
            Ok(Inertia { zero: 0, .. }) => {}
            Ok(_) | Err(FactorizationError::Singular) => {
                dual = regularisation;
                if self.factor(blocks, 0.0, dual).is_ok_and(|inertia| inertia == wanted) {
                    self.dependent = true;
                    return Ok(true);
                }
            }
            Err(error) => return Err(error),
        }
        let mut primal = PARAMETERS.inertia.begin(self.last_correction);
        let factor = PARAMETERS.inertia.growth(self.last_correction);
        while primal <= PARAMETERS.inertia.largest && may_go_on() {
            match self.factor(blocks, primal, dual) {
                Ok(inertia) if inertia == wanted => {
                    self.last_correction = primal;
                    return Ok(true);
                }
                Ok(Inertia { zero: 0, .. }) => {}
                Ok(_) | Err(FactorizationError::Singular) => dual = regularisation,
                Err(error) => return Err(error),
            }
            primal *= factor;
        }
        Ok(false)
    }

    /// Factorises with a δ_w that is hardly larger than needed for the inertia of a minimum, so that inverse iteration
    /// finds the direction of least curvature. `false`: none was found.
    pub fn factor_close(&mut self, blocks: Blocks<'_>) -> bool {
        if !self.factor_corrected(blocks, 1.0, || true).unwrap_or(false) {
            return false;
        }
        let wanted = self.wanted();
        let (mut too_small, mut enough) = (self.correction / PARAMETERS.inertia.first_increase, self.correction);
        for _ in 0..PARAMETERS.bisections {
            let middle = (too_small * enough).sqrt();
            let right = self.factor(blocks, middle, PARAMETERS.delta_c).is_ok_and(|inertia| inertia == wanted);
            *(if right { &mut enough } else { &mut too_small }) = middle;
        }
        self.factor(blocks, enough, PARAMETERS.delta_c).is_ok()
    }

    /// Solves for the steps (w_step, y_step) that belong to right-hand sides.
    pub fn solve(&mut self, right: RightHandSide<'_>, w_step: &mut [f64], y_step: &mut [f64]) -> Result<(), FactorizationError> {
        let n = self.variables;
        self.right[..n].copy_from_slice(&right.w[..n]);
        for (i, slack) in self.slack.iter().enumerate() {
            let from_slack = slack.map_or(0.0, |slack| right.w[slack] / self.slack_diagonal[i]);
            self.right[n + i] = right.rows[i] + from_slack;
        }
        self.solve_whole()?;
        w_step[..n].copy_from_slice(&self.solution[..n]);
        y_step.copy_from_slice(&self.solution[n..]);
        for (i, slack) in self.slack.iter().enumerate() {
            if let Some(slack) = *slack {
                w_step[slack] = (right.w[slack] + y_step[i]) / self.slack_diagonal[i];
            }
        }
        if self.solution.iter().any(|value| !value.is_finite()) {
            return Err(FactorizationError::Singular);
        }
        Ok(())
    }

    /// solution = K⁻¹·right
    fn solve_whole(&mut self) -> Result<(), FactorizationError> {
        if let Some(condensed) = self.condensed.as_mut().filter(|_| !self.in_full) {
            if condensed.solve(&self.system, &self.right, &mut self.solution).is_some() {
                return Ok(());
            }
            self.factor_in_full()?;
        }
        self.full.as_ref().ok_or(FactorizationError::Singular)?.solve(&self.right, &mut self.solution)
    }
}

#[cfg(test)]
mod tests;
