//! The interior point as an argmin solver.
//!
//! | file | subject |
//! |---|---|
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
mod polish;
mod predictor;
mod restoration;
mod saddle;
mod scaling;
mod start;
mod vectors;
mod watchdog;

use argmin::argmin_error;
use argmin::core::{Error, KV, Problem, Solver};

use super::state::{Conclusion, NlpState, Point, given};
use crate::backends::Termination;
use crate::model::Evaluator;
use attempts::Attempts;
use begin::Beginning;
use engine::{Ending, Engine};
use form::Source;
pub(super) use start::pushed;

/// A primal-dual interior point with a filter line search.
pub(super) struct InteriorPoint<'a> {
    start: Vec<f64>,
    multipliers: Option<Vec<f64>>,
    engine: Option<Engine<'a>>,
    attempts: Attempts,
}

impl<'a> InteriorPoint<'a> {
    /// From `start`, with row multipliers of an earlier answer if there are any.
    pub fn new(start: Vec<f64>, multipliers: Option<Vec<f64>>) -> Self {
        InteriorPoint { start, multipliers, engine: None, attempts: Attempts::default() }
    }
}

impl<'a, 's> Solver<&'a Evaluator<'a>, NlpState<'s>> for InteriorPoint<'a> {
    fn name(&self) -> &str {
        "interior point"
    }

    fn init(
        &mut self,
        problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let model = given(problem)?;
        let beginning = Beginning { multipliers: self.multipliers.as_deref(), ..Beginning::at(&self.start) };
        match Engine::new(Source::Given(model), beginning) {
            Ok(mut engine) => {
                let point = engine.point();
                self.engine = Some(engine);
                Ok((state.at(point, 0.0, model.evaluations()), None))
            }
            Err(error) => Ok((state.conclude(Conclusion::of(&error), None), None)),
        }
    }

    fn next_iter(
        &mut self,
        problem: &mut Problem<&'a Evaluator<'a>>,
        state: NlpState<'s>,
    ) -> Result<(NlpState<'s>, Option<KV>), Error> {
        let model = given(problem)?;
        let Some(engine) = &mut self.engine else {
            return Err(argmin_error!(NotInitialized, "the interior point has no iterate"));
        };
        let state = match engine.step() {
            Ok(None) => {
                let point = engine.point();
                state.at(point, engine.step_norm, model.evaluations())
            }
            Ok(Some(ending)) => {
                let (conclusion, point) = engine.conclude(&ending);
                let state = state.at(point.clone(), engine.step_norm, model.evaluations());
                match self.attempts.next(model, &self.start, engine, (ending, conclusion, point)) {
                    Ok(Some(next)) => {
                        *engine = next;
                        state
                    }
                    Ok(None) => match std::mem::take(&mut self.attempts).conclude() {
                        Some((conclusion, answer)) => state.conclude(conclusion, answer),
                        None => state,
                    },
                    Err(error) => state.conclude(Conclusion::of(&error), None),
                }
            }
            Err(error) => state.conclude(Conclusion::of(&error), None),
        };
        Ok((state, None))
    }
}

/// Runs to the end without an executor, for components of a larger model. `None`: no minimum was reached.
pub(super) fn solve_alone(model: &Evaluator<'_>, start: &[f64]) -> Option<Point> {
    let mut engine = Engine::new(Source::Given(model), Beginning::at(start)).ok()?;
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
        let (termination, message, invalid) = match ending {
            Ending::Optimal | Ending::Acceptable => {
                std::mem::swap(&mut self.iterate, &mut self.best.iterate);
                self.form.tighten();
                // A run told to stop keeps the point as it is.
                let _ = self.polish();
                (Termination::Converged, format!("converged: optimality error {:.1e}", self.errors.largest()), None)
            }
            Ending::Infeasible => {
                let violation = self.form.violation(&self.iterate.rows);
                (Termination::Converged, format!("the violation {violation:.3e} is a local minimum: locally infeasible"), None)
            }
            Ending::Diverging(message) => (Termination::Converged, message.clone(), None),
            Ending::Stuck(message) => (Termination::Failed, message.clone(), None),
            Ending::Invalid(term) => (Termination::Failed, term.clone(), Some(term.clone())),
        };
        (Conclusion { termination, message, invalid }, self.point())
    }
}
