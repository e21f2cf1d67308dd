//! A primal-dual interior point with a filter line search: Wächter & Biegler, "On the implementation of an interior-point filter
//! line-search algorithm for large-scale nonlinear programming", Math. Program. 106 (2006).
//!
//! | file | subject |
//! |---|---|
//! | `parameters` | every number that is a choice, by the paper's symbols |
//! | `slack_form`, `scaling` | the problem with slacks, without fixed variables, scaled |
//! | `barrier` | the logarithmic barrier |
//! | `iterate` | a primal-dual point and its optimality error |
//! | `kkt` | the Newton system and its inertia |
//! | `state` | the point, the direction, the matrix: the algebra of a run, which decides nothing |
//! | `begin`, `start` | the first state |
//! | `filter`, `acceptance` | which trial points are taken |
//! | `line_search`, `watchdog` | the points that are tried: ever shorter steps; full ones where too many were cut short |
//! | `globalization` | proposes the next point, by one of these two |
//! | `predictor` | steps of large problems without a line search, while they do well |
//! | `restoration`, `elastic` | the way back to feasibility, or to the least violation |
//! | `saddle` | leaving stationary points that are no minima |
//! | `polish` | the last digits, on the active set |
//! | `ending` | when it is over, and why |
//! | `engine` | one iteration: decides which of the above it is, and what becomes of a proposal |
//! | `attempts` | a second run in better scales, or from elsewhere |

mod acceptance;
mod attempts;
mod barrier;
mod begin;
mod elastic;
mod ending;
mod engine;
mod filter;
mod globalization;
mod iterate;
mod kkt;
mod line_search;
mod parameters;
mod polish;
mod predictor;
mod restoration;
mod saddle;
mod scaling;
mod slack_form;
mod start;
mod state;
#[cfg(test)]
mod tests;
mod vectors;
mod watchdog;

use super::{Conclusion, Progress, RankedPoint, Solver, StopTest};
use crate::model::Evaluator;
use attempts::Attempts;
use begin::InitialPoint;
use engine::Engine;
use slack_form::Source;

/// A primal-dual interior point with a filter line search.
pub struct InteriorPoint<'a> {
    model: &'a Evaluator<'a>,
    start: Vec<f64>,
    multipliers: Option<Vec<f64>>,
    stop_test: Option<StopTest<'a>>,
    engine: Option<Engine<'a>>,
    attempts: Attempts,
}

impl<'a> InteriorPoint<'a> {
    /// From `start`, with row multipliers of an earlier answer if there are any. What passes the stop test is not solved again in other scales.
    pub fn new(
        model: &'a Evaluator<'a>,
        start: Vec<f64>,
        multipliers: Option<Vec<f64>>,
        stop_test: Option<StopTest<'a>>,
    ) -> Self {
        InteriorPoint { model, start, multipliers, stop_test, engine: None, attempts: Attempts::default() }
    }
}

impl Solver for InteriorPoint<'_> {
    fn name(&self) -> &'static str {
        "interior point"
    }

    fn begin(&mut self) -> Progress {
        let beginning = InitialPoint { multipliers: self.multipliers.as_deref(), ..InitialPoint::at(&self.start) };
        match Engine::new(Source::Given(self.model), beginning) {
            Ok(engine) => Progress::at(self.engine.insert(engine).state.point(), 0.0, self.model.evaluations()),
            Err(error) => Progress::failed(&error),
        }
    }

    fn step(&mut self, _is_last: bool) -> Progress {
        let Some(engine) = &mut self.engine else { return self.begin() };
        let ending = match engine.step() {
            Ok(None) => return Progress::at(engine.state.point(), engine.state.step_norm, self.model.evaluations()),
            Ok(Some(ending)) => ending,
            Err(error) => return Progress::failed(&error),
        };
        let (conclusion, point) = engine.conclude(&ending);
        let progress = Progress::at(point.clone(), engine.state.step_norm, self.model.evaluations());
        let passes = |x: &[f64]| self.stop_test.is_some_and(|test| test(x));
        match self.attempts.next(self.model, &self.start, engine, (ending, conclusion, point), &passes) {
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
pub(super) fn solve_alone(model: &Evaluator<'_>, start: &[f64]) -> Option<RankedPoint> {
    let mut engine = Engine::new(Source::Given(model), InitialPoint::at(start)).ok()?;
    let ending = loop {
        if let Some(ending) = engine.step().ok()? {
            break ending;
        }
    };
    let (_, point) = engine.conclude(&ending);
    ending.is_solved().then_some(point)
}
