//! One run of one NLopt algorithm on one translated problem.

use std::time::Instant;

use super::algorithms::Algorithm;
use super::ffi::{self, Functions, Halt, Setup};
use super::form::{Form, Kind};
use super::watch::{Candidate, Watch};
use crate::model::{EvaluationError, Evaluator, Stop};

/// Seed of NLopt's random algorithms, so that a run can be repeated.
pub(super) const SEED: u32 = 20_240_607;

/// How an attempt ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum End {
    /// NLopt ended by itself (its number and words), or the watch ended it.
    Ended {
        /// NLopt's number: negative for its failures.
        code: i32,
        /// NLopt's words.
        words: String,
    },
    /// A budget ended it.
    Stopped(Stop),
    /// The model gave no number.
    Invalid(String),
}

/// The point of the last call, with what is known of it.
#[derive(Default)]
struct Point {
    w: Vec<f64>,
    full: Vec<f64>,
    rows: Vec<f64>,
    jacobian: Option<Vec<f64>>,
}

struct Session<'s, 'w, 'j> {
    form: &'s Form<'s>,
    evaluator: &'s Evaluator<'s>,
    watch: &'s mut Watch<'w, 'j>,
    point: Point,
    error: Option<EvaluationError>,
}

impl Session<'_, '_, '_> {
    /// Keeps the first error and ends the run.
    fn halt(&mut self, error: EvaluationError) -> Halt {
        self.error.get_or_insert(error);
        Halt
    }

    /// Evaluates the rows where `w` is new.
    fn go_to(&mut self, w: &[f64]) -> Result<(), Halt> {
        if self.point.w == w {
            return Ok(());
        }
        let full = self.form.complete(w);
        let rows = self.form.rows(&full).map_err(|error| self.halt(error))?;
        self.point = Point { w: w.to_vec(), full, rows, jacobian: None };
        Ok(())
    }

    fn rows(&mut self, kind: Kind, w: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt> {
        self.go_to(w)?;
        self.form.spread(kind, &self.point.rows, values);
        if let Some(dense) = jacobian {
            if self.point.jacobian.is_none() {
                self.point.jacobian = Some(self.form.jacobian(&self.point.full).map_err(|error| self.halt(error))?);
            }
            self.form.spread_jacobian(kind, self.point.jacobian.as_deref().unwrap_or_default(), dense);
        }
        Ok(())
    }

    fn candidate(&self, objective: f64) -> Candidate {
        let (violation, feasibility) = self.form.violation(&self.point.rows);
        Candidate {
            x: self.form.unscaled(&self.point.full),
            objective: self.form.unscaled_objective(objective),
            scaled_objective: objective,
            violation,
            feasibility,
        }
    }
}

impl Functions for Session<'_, '_, '_> {
    fn objective(&mut self, w: &[f64], gradient: Option<&mut [f64]>) -> Result<f64, Halt> {
        if w.iter().any(|value| !value.is_finite()) {
            let error = EvaluationError::Invalid {
                term: "trial point".into(),
                cause: "NLopt asked for a point that is no number".into(),
            };
            return Err(self.halt(error));
        }
        self.go_to(w)?;
        let value = self.form.objective(&self.point.full, gradient).map_err(|error| self.halt(error))?;
        let candidate = self.candidate(value);
        if self.watch.see(candidate, self.evaluator.evaluations()) { Err(Halt) } else { Ok(value) }
    }

    fn inequalities(&mut self, w: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt> {
        self.rows(Kind::Inequalities, w, values, jacobian)
    }

    fn equalities(&mut self, w: &[f64], values: &mut [f64], jacobian: Option<&mut [f64]>) -> Result<(), Halt> {
        self.rows(Kind::Equalities, w, values, jacobian)
    }
}

/// Runs `algorithm` on `form` for at most `evaluations`, and tests the certificate at its end.
pub(super) fn run(
    algorithm: &Algorithm,
    form: &Form<'_>,
    evaluations: u64,
    evaluator: &Evaluator<'_>,
    watch: &mut Watch<'_, '_>,
) -> End {
    let deadline = evaluator.budget().deadline;
    let tolerance = if algorithm.gradients { 1e-15 } else { 1e-10 };
    let setup = Setup {
        algorithm: algorithm.code,
        inner: algorithm.inner,
        lower: form.lower(),
        upper: form.upper(),
        inequalities: form.count(Kind::Inequalities),
        equalities: form.count(Kind::Equalities),
        violation: 1e-12,
        tolerance,
        evaluations,
        seconds: deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()).as_secs_f64().max(1e-3)),
        seed: SEED,
    };
    let mut w = form.start();
    let mut session = Session { form, evaluator, watch, point: Point::default(), error: None };
    let outcome = ffi::minimise(&setup, &mut session, &mut w);
    let panicked = outcome.as_ref().is_none_or(|outcome| outcome.panic.is_some());
    let own = if panicked { None } else { own_answer(&mut session, &w) };
    let error = session.error.take();
    watch.test_at_end(own, evaluator.evaluations());
    match (error, outcome) {
        (Some(EvaluationError::Stopped(stop)), _) => End::Stopped(stop),
        (Some(error), _) => End::Invalid(error.to_string()),
        (None, None) => End::Ended { code: -3, words: "NLopt could not be set up for this size".into() },
        (None, Some(outcome)) => match outcome.panic {
            Some(words) => End::Ended { code: -1, words: format!("a model function panicked: {words}") },
            None => End::Ended { code: outcome.code, words: outcome.message },
        },
    }
}

/// NLopt's own answer as a candidate: it may be stationary without being the best by merit.
fn own_answer(session: &mut Session<'_, '_, '_>, w: &[f64]) -> Option<Candidate> {
    if session.error.is_some() || w.iter().any(|value| !value.is_finite()) {
        return None;
    }
    session.go_to(w).ok()?;
    let value = session.form.objective(&session.point.full, None).ok()?;
    Some(session.candidate(value))
}
