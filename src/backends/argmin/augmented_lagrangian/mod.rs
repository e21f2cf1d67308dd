//! The augmented Lagrangian as an argmin solver: minimise φ within the bounds, move the multipliers, raise the penalty where
//! the violation does not fall (Birgin & Martínez, *Practical Augmented Lagrangian Methods*, algorithm 4.1).
//!
//! | file | subject |
//! |---|---|
//! | [`subproblem`] | φ minimised by argmin's trust region on faces of the box |
//! | [`face`] | φ over the variables that are not at rest on a bound |
//! | [`steihaug`] | the trust region's step, by conjugate gradients |

mod face;
mod steihaug;
mod subproblem;
#[cfg(test)]
mod tests;

use argmin::core::{Error, KV, Problem, Solver};

use self::subproblem::minimise;
use super::state::{Conclusion, NlpState, Point};
use crate::backends::{Job, StopTest, Termination};
use crate::model::augmented::Augmented;
use crate::model::scaled::{Scaled, Scales, valid_start};
use crate::model::{EvaluationError, Evaluator, Meta, Model};

/// Violation must fall to this share of the last one, or the penalty grows.
const ENOUGH_PROGRESS: f64 = 0.25;
/// Growth of the penalty.
const GROWTH: f64 = 10.0;
/// The first penalty, for the scaled model.
const FIRST_PENALTY: f64 = 10.0;
/// The largest penalty: beyond it φ is rounding.
const LARGEST_PENALTY: f64 = 1e8;
/// Multipliers of the scaled model are kept within this.
const LARGEST_MULTIPLIER: f64 = 1e10;
/// Tightest tolerance of a subproblem, and the residual at which all is done.
const TIGHTEST: f64 = 1e-11;
/// Iterations without a better residual after which rounding has ended the progress.
const PATIENCE: u32 = 12;
/// Iterations after the stop test passed, so that the answer is better than just accepted.
const AFTERGLOW: u32 = 2;

/// The start, moved to where the model has values, and the units the subproblems are solved in.
///
/// # Errors
/// Those of the model at the start.
pub(super) fn start(evaluator: &Evaluator<'_>, start: &[f64]) -> Result<(Vec<f64>, Scales), EvaluationError> {
    valid_start(evaluator, start, |x| x.iter().zip(start).map(|(x, start)| x.abs().max(start.abs())).collect())
}

/// Why the rows cannot be taken; `None` where they can.
pub(super) fn refusal(meta: &Meta) -> Option<String> {
    let products = Augmented::products(meta);
    (products > Augmented::MOST_PRODUCTS)
        .then(|| format!("augmented-lagrangian multiplies rows out, which takes {products} entries here; use interior-point"))
}

/// The solver. Its values are those of the scaled model.
pub(super) struct AugmentedLagrangian<'a> {
    scaled: &'a Scaled<'a>,
    subproblem: Augmented<'a>,
    stop_test: Option<StopTest<'a>>,
    x: Vec<f64>,
    multipliers: Vec<f64>,
    penalty: f64,
    tolerance: f64,
    infeasibility: f64,
    best: Option<Best>,
    /// Iterations since the best residual.
    idle: u32,
    /// Iterations since the stop test passed.
    passed: Option<u32>,
}

/// The point with the smallest residual.
struct Best {
    residual: f64,
    point: Point,
}

impl<'a> AugmentedLagrangian<'a> {
    /// From `x` (inside the bounds, in the model's own units), as the job says; `None` where [`refusal`] speaks.
    pub fn new<'j: 'a>(scaled: &'a Scaled<'a>, x: &[f64], job: &Job<'j>) -> Option<Self> {
        let rows = scaled.meta().rows();
        let known = job.start_multipliers.filter(|known| known.len() == rows);
        Some(AugmentedLagrangian {
            subproblem: Augmented::new(scaled)?,
            stop_test: job.stop_test,
            x: scaled.scaled_point(x),
            multipliers: known.map_or(vec![0.0; rows], |known| scaled.scaled_multipliers(known)),
            penalty: FIRST_PENALTY,
            tolerance: 1e-1,
            infeasibility: f64::INFINITY,
            best: None,
            idle: 0,
            passed: None,
            scaled,
        })
    }

    fn rows(&self) -> Result<Vec<f64>, EvaluationError> {
        let mut rows = vec![0.0; self.scaled.meta().rows()];
        if !rows.is_empty() {
            self.scaled.constraints(&self.x, &mut rows)?;
        }
        Ok(rows)
    }

    /// The current point as the user knows it.
    fn point(&self, optimality: f64) -> Result<Point, EvaluationError> {
        let (meta, scales) = (self.scaled.meta(), self.scaled.scales());
        let (mut relative_violation, mut feasibility) = (0.0_f64, 0.0_f64);
        for (i, row) in self.rows()?.into_iter().enumerate() {
            let violation = (meta.row_lower[i] - row).max(row - meta.row_upper[i]).max(0.0);
            relative_violation = relative_violation.max(violation);
            feasibility = feasibility.max(violation * scales.rows[i]);
        }
        Ok(Point {
            x: self.scaled.unscaled_point(&self.x),
            objective: self.scaled.objective(&self.x)? * scales.objective,
            relative_violation,
            feasibility,
            optimality,
            multipliers: Some(self.scaled.unscaled_multipliers(&self.multipliers)),
        })
    }

    /// One subproblem, then multipliers, penalty and tolerance for the next. Returns the new point and the step's length.
    fn iterate(&mut self) -> Result<(Point, f64), EvaluationError> {
        let before = self.scaled.unscaled_point(&self.x);
        self.subproblem.set(&self.multipliers, self.penalty);
        let minimum = minimise(&self.subproblem, &self.x, self.tolerance)?;
        self.x = minimum.x;
        let estimate = self.subproblem.next_multipliers(&self.rows()?);
        // c − s: violation where a row is active, and how far an inactive one's multiplier is from zero.
        let distance = estimate.iter().zip(&self.multipliers).map(|(new, old)| ((new - old) / self.penalty).abs());
        let infeasibility = distance.fold(0.0, f64::max);
        self.multipliers = estimate.into_iter().map(|y| y.clamp(-LARGEST_MULTIPLIER, LARGEST_MULTIPLIER)).collect();
        if infeasibility > (ENOUGH_PROGRESS * self.infeasibility).max(TIGHTEST) {
            self.penalty = (GROWTH * self.penalty).min(LARGEST_PENALTY);
        }
        self.infeasibility = infeasibility;
        self.tolerance = (0.1 * self.tolerance).min(infeasibility).max(TIGHTEST);
        let point = self.point(minimum.stationarity)?;
        self.remember(&point, infeasibility.max(minimum.stationarity));
        let step = point.x.iter().zip(&before).map(|(new, old)| (new - old) * (new - old)).sum::<f64>().sqrt();
        Ok((point, step))
    }

    fn remember(&mut self, point: &Point, residual: f64) {
        self.idle += 1;
        self.passed = self.passed.map(|iterations| iterations + 1);
        if self.best.as_ref().is_none_or(|best| residual < best.residual) {
            self.best = Some(Best { residual, point: point.clone() });
            self.idle = 0;
        }
        if self.passed.is_none() && residual < 1e-4 && self.stop_test.is_some_and(|test| test(&point.x)) {
            self.passed = Some(0);
        }
    }

    /// How the run ends, if it does.
    fn conclusion(&self) -> Option<Conclusion> {
        let best = self.best.as_ref()?;
        let is_done = best.residual <= TIGHTEST || self.passed.is_some_and(|iterations| iterations >= AFTERGLOW);
        let message = match (is_done, self.idle > PATIENCE, best.point.relative_violation > 1e-6) {
            (true, _, _) => format!("residual {:.1e}", best.residual),
            (_, true, false) => format!("no further progress: residual {:.1e}", best.residual),
            (_, true, true) => format!("the violation {:.3e} falls no further from here", best.point.feasibility),
            _ => return None,
        };
        Some(Conclusion { termination: Termination::Converged, message, invalid: None })
    }
}

impl<'a, 's> Solver<&'a Evaluator<'a>, NlpState<'s>> for AugmentedLagrangian<'a> {
    fn name(&self) -> &str {
        "augmented Lagrangian"
    }

    fn init(
        &mut self,
        problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let evaluations = problem.problem.map_or(0, |evaluator| evaluator.evaluations());
        Ok(match self.point(f64::NAN) {
            Ok(point) => (state.at(point, 0.0, evaluations), None),
            Err(error) => (state.conclude(Conclusion::of(&error), None), None),
        })
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let (point, step_norm) = match self.iterate() {
            Ok(found) => found,
            Err(error) => return Ok((state.conclude(Conclusion::of(&error), None), None)),
        };
        let evaluations = problem.problem.map_or(0, |evaluator| evaluator.evaluations());
        let state = state.at(point, step_norm, evaluations);
        Ok(match self.conclusion() {
            Some(conclusion) => (state.conclude(conclusion, self.best.as_ref().map(|best| best.point.clone())), None),
            None => (state, None),
        })
    }
}
