//! A primal-dual interior point with a filter line search: Wächter & Biegler, "On the implementation of an interior-point filter
//! line-search algorithm for large-scale nonlinear programming", Math. Program. 106 (2006).
//!
//! | file | subject |
//! |---|---|
//! | [`parameters`] | every number that is a choice, by the paper's symbols |
//! | [`form`], [`scaling`] | the problem with slacks, without fixed variables, scaled |
//! | [`engine`] | one iteration |
//! | [`iterate`] | a primal-dual point and its optimality error |
//! | [`begin`], [`start`] | the first iterate |
//! | [`barrier`] | the logarithmic barrier |
//! | [`kkt`] | the Newton system and its inertia |
//! | [`predictor`] | steps of large problems without a line search, while they do well |
//! | [`line_search`], [`filter`] | which steps are taken |
//! | [`restoration`], [`elastic`] | the way back to feasibility, or to the least violation |
//! | [`watchdog`] | full steps on trial where the filter cuts too many short |
//! | [`saddle`] | leaving stationary points that are no minima |
//! | [`polish`] | the last digits, on the active set |
//! | [`attempts`] | a second run in better scales, or from elsewhere |

mod attempts;
mod barrier;
mod begin;
mod elastic;
mod engine;
mod filter;
mod form;
mod iterate;
mod kkt;
mod line_search;
mod parameters;
mod polish;
mod predictor;
mod restoration;
mod saddle;
mod scaling;
mod start;
mod vectors;
mod watchdog;

use super::{Conclusion, Point, Progress, Solver, Why};
use crate::model::Evaluator;
use attempts::Attempts;
use begin::InitialPoint;
use engine::{Ending, Engine};
use form::Source;

/// A primal-dual interior point with a filter line search.
pub struct InteriorPoint<'a> {
    model: &'a Evaluator<'a>,
    start: Vec<f64>,
    multipliers: Option<Vec<f64>>,
    engine: Option<Engine<'a>>,
    attempts: Attempts,
}

impl<'a> InteriorPoint<'a> {
    /// From `start`, with row multipliers of an earlier answer if there are any.
    pub fn new(model: &'a Evaluator<'a>, start: Vec<f64>, multipliers: Option<Vec<f64>>) -> Self {
        InteriorPoint { model, start, multipliers, engine: None, attempts: Attempts::default() }
    }
}

impl Solver for InteriorPoint<'_> {
    fn name(&self) -> &'static str {
        "interior point"
    }

    fn begin(&mut self) -> Progress {
        let beginning = InitialPoint { multipliers: self.multipliers.as_deref(), ..InitialPoint::at(&self.start) };
        match Engine::new(Source::Given(self.model), beginning) {
            Ok(engine) => Progress::at(self.engine.insert(engine).point(), 0.0, self.model.evaluations()),
            Err(error) => Progress::failed(&error),
        }
    }

    fn step(&mut self, _is_last: bool) -> Progress {
        let Some(engine) = &mut self.engine else { return self.begin() };
        let ending = match engine.step() {
            Ok(None) => return Progress::at(engine.point(), engine.step_norm, self.model.evaluations()),
            Ok(Some(ending)) => ending,
            Err(error) => return Progress::failed(&error),
        };
        let (conclusion, point) = engine.conclude(&ending);
        let progress = Progress::at(point.clone(), engine.step_norm, self.model.evaluations());
        match self.attempts.next(self.model, &self.start, engine, (ending, conclusion, point)) {
            Ok(Some(next)) => {
                *engine = next;
                progress
            }
            Ok(None) => match std::mem::take(&mut self.attempts).conclude() {
                Some((conclusion, answer)) => progress.concluded(conclusion, answer),
                None => progress,
            },
            Err(error) => progress.concluded(Conclusion::of(&error), None),
        }
    }
}

/// Runs to the end, for components of a larger model. `None`: no minimum was reached.
pub(super) fn solve_alone(model: &Evaluator<'_>, start: &[f64]) -> Option<Point> {
    let mut engine = Engine::new(Source::Given(model), InitialPoint::at(start)).ok()?;
    let ending = loop {
        if let Some(ending) = engine.step().ok()? {
            break ending;
        }
    };
    let (_, point) = engine.conclude(&ending);
    matches!(ending, Ending::Optimal | Ending::Acceptable).then_some(point)
}

impl Engine<'_> {
    /// The current iterate as the user knows it.
    fn point(&mut self) -> Point {
        let x = self.form.x(&self.iterate.w).to_vec();
        Point {
            x,
            objective: self.iterate.objective / self.form.objective_scale,
            relative_violation: self.form.scaled_violation(&self.iterate.rows),
            feasibility: self.form.violation(&self.iterate.rows),
            optimality: self.errors.largest(),
            multipliers: Some(self.form.multipliers(&self.iterate.y)),
        }
    }

    /// The run's conclusion and its point.
    fn conclude(&mut self, ending: &Ending) -> (Conclusion, Point) {
        let (why, message, invalid) = match ending {
            Ending::Optimal | Ending::Acceptable => {
                std::mem::swap(&mut self.iterate, &mut self.best.iterate);
                self.form.tighten();
                // A run told to stop keeps the point as it is.
                let _ = self.polish();
                (Why::Converged, format!("converged: optimality error {:.1e}", self.errors.largest()), None)
            }
            Ending::Infeasible => {
                let violation = self.form.violation(&self.iterate.rows);
                (Why::Converged, format!("the violation {violation:.3e} is a local minimum: locally infeasible"), None)
            }
            Ending::Diverging(message) => (Why::Converged, message.clone(), None),
            Ending::Stuck(message) => (Why::Failed, message.clone(), None),
            Ending::Invalid(term) => (Why::Failed, term.clone(), Some(term.clone())),
        };
        (Conclusion { why, message, invalid }, self.point())
    }
}
