//! The augmented Lagrangian: minimise φ within the bounds, move the multipliers, raise the penalty where
//! the violation does not fall (Birgin & Martínez, *Practical Augmented Lagrangian Methods*, algorithm 4.1).
//!
//! | file | subject |
//! |---|---|
//! | `faces` | φ minimised on one face of the box after another |
//! | `face` | φ over the variables that are not at rest on a bound |
//! | `trust_region`, `steihaug` | the minimisation on one face, and its steps by conjugate gradients |

mod face;
mod faces;
mod parameters;
mod steihaug;
mod trust_region;

use self::faces::minimise;
use super::{Conclusion, Progress, RankedPoint, Solver, StopTest, Why};
use crate::model::views::augmented::{Augmented, MOST_PRODUCTS, needed_products};
use crate::model::views::scaled::{Scaled, Scales, valid_start};
use crate::model::{EvaluationError, Evaluator, Meta, Model};
use parameters::PARAMETERS;

/// Why the rows cannot be taken; `None` where they can.
pub fn refusal(meta: &Meta) -> Option<String> {
    let products = needed_products(meta);
    (products > MOST_PRODUCTS)
        .then(|| format!("augmented-lagrangian multiplies rows out, which takes {products} entries here; use interior-point"))
}

/// The solver. x, multipliers and residuals are those of the scaled model.
pub struct AugmentedLagrangian<'a> {
    evaluator: &'a Evaluator<'a>,
    subproblem: Augmented<Scaled<'a>>,
    stop_test: Option<StopTest<'a>>,
    start: Vec<f64>,
    x: Vec<f64>,
    multipliers: Vec<f64>,
    penalty: f64,
    tolerance: f64,
    infeasibility: f64,
    best: Option<Best>,
    tries: usize,
    renewals: u32,
    /// σ at the start.
    objective_scale: f64,
    escaped: bool,
    /// Iterations since the best residual of this try.
    idle: u32,
    idle_best: f64,
    /// Iterations since the stop test passed.
    passed: Option<u32>,
}

/// The point with the smallest residual.
struct Best {
    residual: f64,
    point: RankedPoint,
}

/// The units of the subproblems at x.
fn units<'x>(start: &'x [f64]) -> impl Fn(&[f64]) -> Vec<f64> + 'x {
    move |x| x.iter().zip(start).map(|(x, start)| x.abs().max(start.abs())).collect()
}

impl<'a> AugmentedLagrangian<'a> {
    /// From `start` (with the row multipliers of an earlier answer, if there are any), moved to where the model has values. The
    /// rows must be such that [`refusal`] is silent.
    ///
    /// # Errors
    /// The model has no value near the start.
    pub fn new(
        evaluator: &'a Evaluator<'a>,
        start: &[f64],
        multipliers: Option<&[f64]>,
        stop_test: Option<StopTest<'a>>,
    ) -> Result<Self, EvaluationError> {
        let (x, scales) = valid_start(evaluator, start, units(start))?;
        let subproblem = subproblem(evaluator, scales)?;
        let scaled = subproblem.model();
        let rows = scaled.meta().rows();
        let known = multipliers.filter(|known| known.len() == rows);
        Ok(AugmentedLagrangian {
            stop_test,
            start: x.clone(),
            x: scaled.scaled_point(&x),
            multipliers: known.map_or(vec![0.0; rows], |known| scaled.scaled_multipliers(known)),
            penalty: PARAMETERS.rho_1[0],
            tolerance: 1e-1,
            infeasibility: f64::INFINITY,
            best: None,
            tries: 1,
            renewals: 0,
            objective_scale: scaled.scales().objective,
            escaped: false,
            idle: 0,
            idle_best: f64::INFINITY,
            passed: None,
            subproblem,
            evaluator,
        })
    }

    fn scaled(&self) -> &Scaled<'a> {
        self.subproblem.model()
    }

    fn rows(&self) -> Result<Vec<f64>, EvaluationError> {
        let mut rows = vec![0.0; self.scaled().meta().rows()];
        if !rows.is_empty() {
            self.scaled().constraints(&self.x, &mut rows)?;
        }
        Ok(rows)
    }

    /// The current point as the user knows it.
    fn point(&self, optimality: f64) -> Result<RankedPoint, EvaluationError> {
        let (meta, scales) = (self.scaled().meta(), self.scaled().scales());
        let (mut relative_violation, mut feasibility) = (0.0_f64, 0.0_f64);
        for (i, row) in self.rows()?.into_iter().enumerate() {
            let violation = (meta.row_lower[i] - row).max(row - meta.row_upper[i]).max(0.0);
            relative_violation = relative_violation.max(violation);
            feasibility = feasibility.max(violation * scales.rows[i]);
        }
        Ok(RankedPoint {
            x: self.scaled().unscaled_point(&self.x),
            objective: self.scaled().objective(&self.x)? * scales.objective,
            relative_violation,
            feasibility,
            optimality,
            multipliers: Some(self.scaled().unscaled_multipliers(&self.multipliers)),
        })
    }

    /// One subproblem, then multipliers, penalty and tolerance for the next. Returns the new point and the step's length.
    fn iterate(&mut self) -> Result<(RankedPoint, f64), EvaluationError> {
        let before = self.scaled().unscaled_point(&self.x);
        self.subproblem.set(&self.multipliers, self.penalty);
        let minimum = minimise(&self.subproblem, &self.x, self.tolerance)?;
        let penalty_helps = !self.multipliers.is_empty() && self.penalty < PARAMETERS.rho_max;
        self.escaped = minimum.escaped && !penalty_helps;
        if minimum.escaped && penalty_helps {
            self.penalty = (PARAMETERS.gamma * self.penalty).min(PARAMETERS.rho_max);
            return Ok((self.point(minimum.stationarity)?, 0.0));
        }
        self.x = minimum.x;
        self.update()?;
        let point = self.point(minimum.stationarity)?;
        self.remember(&point, self.infeasibility.max(minimum.stationarity));
        self.renew(&point.x)?;
        let step = point.x.iter().zip(&before).map(|(new, old)| (new - old) * (new - old)).sum::<f64>().sqrt();
        Ok((point, step))
    }

    fn update(&mut self) -> Result<(), EvaluationError> {
        let estimate = self.subproblem.next_multipliers(&self.rows()?);
        // c − s: violation where a row is active, and how far an inactive one's multiplier is from zero.
        let distance = estimate.iter().zip(&self.multipliers).map(|(new, old)| ((new - old) / self.penalty).abs());
        let infeasibility = distance.fold(0.0, f64::max);
        self.multipliers = estimate.into_iter().map(|y| y.clamp(-PARAMETERS.lambda_max, PARAMETERS.lambda_max)).collect();
        if infeasibility > (PARAMETERS.tau * self.infeasibility).max(PARAMETERS.epsilon) {
            self.penalty = (PARAMETERS.gamma * self.penalty).min(PARAMETERS.rho_max);
        }
        self.infeasibility = infeasibility;
        self.tolerance = (0.1 * self.tolerance).min(infeasibility).max(PARAMETERS.epsilon);
        Ok(())
    }

    fn remember(&mut self, point: &RankedPoint, residual: f64) {
        self.idle += 1;
        self.passed = self.passed.map(|iterations| iterations + 1);
        if residual < PARAMETERS.worthwhile * self.idle_best {
            (self.idle, self.idle_best) = (0, residual);
        }
        if self.best.as_ref().is_none_or(|best| residual < best.residual) {
            self.best = Some(Best { residual, point: point.clone() });
        }
        if self.passed.is_none() && residual < 1e-4 && self.stop_test.is_some_and(|test| test(&point.x)) {
            self.passed = Some(0);
        }
    }

    /// New units where those in use have become far too large or small.
    fn renew(&mut self, x: &[f64]) -> Result<(), EvaluationError> {
        if self.renewals >= PARAMETERS.renewals || self.passed.is_some() {
            return Ok(());
        }
        let scales = match Scales::at(self.evaluator, x, units(&self.start)(x)) {
            // The gradient may vanish at the solution: the start's scale stays the least.
            Ok(scales) => Scales { objective: scales.objective.max(self.objective_scale), ..scales },
            Err(error @ EvaluationError::Stopped(_)) => return Err(error),
            Err(_) => return Ok(()),
        };
        if !is_stale(self.scaled().scales(), &scales) {
            return Ok(());
        }
        self.renewals += 1;
        let multipliers = self.scaled().unscaled_multipliers(&self.multipliers);
        self.subproblem = subproblem(self.evaluator, scales)?;
        self.x = self.scaled().scaled_point(x);
        self.multipliers = self.scaled().scaled_multipliers(&multipliers);
        self.begin(self.penalty);
        self.best = None;
        Ok(())
    }

    /// Forgets what the last subproblems came to.
    fn begin(&mut self, penalty: f64) {
        (self.penalty, self.tolerance, self.infeasibility) = (penalty, 1e-1, f64::INFINITY);
        (self.idle, self.idle_best) = (0, f64::INFINITY);
    }

    /// How the run ends, if it does; a try that came to nothing is repeated from the start with another first penalty.
    fn conclusion(&mut self) -> Option<Conclusion> {
        let best = self.best.as_ref()?;
        if self.escaped && best.point.relative_violation <= PARAMETERS.solved {
            return Some(concluded("the objective falls without end".into()));
        }
        let is_done = best.residual <= PARAMETERS.epsilon
            || self.passed.is_some_and(|iterations| iterations >= PARAMETERS.extra_iterations_after_pass);
        let is_idle = self.idle > PARAMETERS.patience;
        let is_infeasible = best.point.relative_violation > PARAMETERS.solved;
        if !is_done && is_idle && best.residual > PARAMETERS.solved && self.tries < PARAMETERS.rho_1.len() {
            let penalty = PARAMETERS.rho_1[self.tries];
            self.tries += 1;
            self.x = self.scaled().scaled_point(&self.start);
            self.multipliers.fill(0.0);
            self.begin(penalty);
            return None;
        }
        let message = match (is_done, is_idle, is_infeasible) {
            (true, _, _) => format!("residual {:.1e}", best.residual),
            (_, true, false) => format!("no further progress: residual {:.1e}", best.residual),
            (_, true, true) => format!("the violation {:.3e} falls no further from here", best.point.feasibility),
            _ => return None,
        };
        Some(concluded(message))
    }
}

fn concluded(message: String) -> Conclusion {
    Conclusion::new(Why::Converged, message)
}

fn subproblem<'a>(evaluator: &'a Evaluator<'a>, scales: Scales) -> Result<Augmented<Scaled<'a>>, EvaluationError> {
    Augmented::new(Scaled::new(evaluator, scales))
        .ok_or_else(|| EvaluationError::Invalid { term: "rows".into(), cause: "too dense to multiply out".into() })
}

fn is_stale(old: &Scales, new: &Scales) -> bool {
    let off = |old: f64, new: f64| old / new > PARAMETERS.stale || new / old > PARAMETERS.stale;
    let rows = old.rows.iter().zip(&new.rows).any(|(&old, &new)| off(old, new));
    rows || off(old.objective, new.objective) || old.variables.iter().zip(&new.variables).any(|(&old, &new)| off(old, new))
}

impl Solver for AugmentedLagrangian<'_> {
    fn name(&self) -> &'static str {
        "augmented Lagrangian"
    }

    fn begin(&mut self) -> Progress {
        let evaluations = self.evaluator.evaluations();
        match self.point(f64::NAN) {
            Ok(point) => Progress::at(point, 0.0, evaluations),
            Err(error) => Progress::failed(&error),
        }
    }

    fn step(&mut self, _is_last: bool) -> Progress {
        let progress = match self.iterate() {
            Ok((point, step_norm)) => Progress::at(point, step_norm, self.evaluator.evaluations()),
            Err(error) => return Progress::failed(&error),
        };
        match self.conclusion() {
            Some(conclusion) => progress.concluded(conclusion, self.best.as_ref().map(|best| best.point.clone())),
            None => progress,
        }
    }
}
