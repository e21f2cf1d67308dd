//! One run of one NLopt algorithm on one translated problem.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::Instant;

use super::algorithms::Algorithm;
use super::ffi::{Halt, Setup};
use super::form::{InequalityForm, LARGEST, RowKind};
use super::watch::{Candidate, Watch};
use super::worker::{self, Exchange};
use crate::model::{EvaluationError, Evaluator, Stop};

/// Seed of NLopt's random algorithms, so that a run can be repeated.
const SEED: u32 = 20_240_607;
/// Relative changes at which a run ends by itself: below them rounding decides.
const TOLERANCE: f64 = 1e-15;
/// The same without gradients, whose models of the functions are never that exact.
const TOLERANCE_WITHOUT_GRADIENTS: f64 = 1e-10;
/// Scaled violation that NLopt may overlook.
const VIOLATION: f64 = 1e-12;

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

impl End {
    /// A failure of our own account, in NLopt's numbers.
    fn failed(words: impl Into<String>) -> Self {
        End::Ended { code: -1, words: words.into() }
    }
}

struct Session<'s, 'w, 'j> {
    form: &'s InequalityForm<'s>,
    evaluator: &'s Evaluator<'s>,
    watch: &'s mut Watch<'w, 'j>,
    /// Whether the algorithm steps back from a point whose objective is +∞; from the first it cannot.
    steps_back: bool,
    has_values: bool,
    error: Option<EvaluationError>,
    panic: Option<String>,
}

impl Session<'_, '_, '_> {
    /// Values and, where asked for, derivatives at the exchange's point. A panic of the model ends the run like an error.
    fn answer(&mut self, exchange: &mut Exchange) -> Result<(), Halt> {
        match catch_unwind(AssertUnwindSafe(|| self.evaluate(exchange))) {
            Ok(Ok(candidate)) => {
                self.has_values = true;
                let is_over = self.watch.see(candidate, self.evaluator.evaluations());
                if is_over { Err(Halt) } else { Ok(()) }
            }
            Ok(Err(EvaluationError::Invalid { .. })) if self.may_step_back(&exchange.w) => {
                exchange.objective = f64::INFINITY;
                Ok(())
            }
            Ok(Err(error)) => {
                self.error = Some(error);
                Err(Halt)
            }
            Err(payload) => {
                self.panic = Some(panic_text(payload.as_ref()));
                Err(Halt)
            }
        }
    }

    fn may_step_back(&self, w: &[f64]) -> bool {
        self.steps_back && self.has_values && w.iter().all(|value| value.is_finite())
    }

    fn evaluate(&self, exchange: &mut Exchange) -> Result<Candidate, EvaluationError> {
        let form = self.form;
        within_range("trial point", &exchange.w)?;
        let full = form.complete(&exchange.w);
        let rows = form.rows(&full)?;
        form.spread(RowKind::Inequalities, &rows, &mut exchange.inequalities.values);
        form.spread(RowKind::Equalities, &rows, &mut exchange.equalities.values);
        exchange.objective = form.objective(&full, exchange.derivatives.then_some(&mut exchange.gradient[..]))?;
        if exchange.derivatives && !rows.is_empty() {
            let jacobian = form.jacobian(&full)?;
            within_range("derivative of a row", &jacobian)?;
            form.spread_jacobian(RowKind::Inequalities, &jacobian, &mut exchange.inequalities.jacobian);
            form.spread_jacobian(RowKind::Equalities, &jacobian, &mut exchange.equalities.jacobian);
        }
        within_range("objective", &[exchange.objective])?;
        within_range("derivative of the objective", &exchange.gradient)?;
        within_range("row", &exchange.inequalities.values)?;
        within_range("row", &exchange.equalities.values)?;
        Ok(self.candidate(&full, &rows, exchange.objective))
    }

    fn candidate(&self, full: &[f64], rows: &[f64], objective: f64) -> Candidate {
        let (violation, feasibility) = self.form.violation(rows);
        Candidate {
            x: self.form.unscaled(full),
            objective: self.form.unscaled_objective(objective),
            scaled_objective: objective,
            violation,
            feasibility,
        }
    }

    /// NLopt's own answer as a candidate: it may be stationary without being the best by merit.
    fn own_answer(&self, w: &[f64]) -> Option<Candidate> {
        if self.error.is_some() || self.panic.is_some() || w.iter().any(|value| !value.is_finite()) {
            return None;
        }
        let full = self.form.complete(w);
        let rows = self.form.rows(&full).ok()?;
        let objective = self.form.objective(&full, None).ok()?;
        Some(self.candidate(&full, &rows, objective))
    }
}

fn panic_text(payload: &(dyn Any + Send)) -> String {
    let text = payload.downcast_ref::<String>().map(String::as_str).or(payload.downcast_ref::<&str>().copied());
    text.unwrap_or("no message").to_owned()
}

/// What is no number, or so large that NLopt's arithmetic would overflow on it, does not reach NLopt.
fn within_range(term: &str, values: &[f64]) -> Result<(), EvaluationError> {
    match values.iter().find(|value| value.is_nan() || value.abs() > LARGEST) {
        None => Ok(()),
        Some(value) => Err(EvaluationError::Invalid {
            term: term.into(),
            cause: format!("{value:.0e} in units of its scale is more than NLopt can calculate with"),
        }),
    }
}

/// Runs `algorithm` on `form` for at most `evaluations`, and tests the certificate at its end.
pub(super) fn run(
    algorithm: &Algorithm,
    form: &InequalityForm<'_>,
    evaluations: u64,
    evaluator: &Evaluator<'_>,
    watch: &mut Watch<'_, '_>,
) -> End {
    let steps_back = algorithm.steps_back;
    let mut session = Session { form, evaluator, watch, steps_back, has_values: false, error: None, panic: None };
    let budget = evaluator.budget();
    let is_over = || budget.check(0).is_err();
    let setup = setup(algorithm, form, evaluations, budget.deadline);
    let mut answer = |exchange: &mut Exchange| session.answer(exchange);
    let returned = match algorithm.is_bounded {
        true => worker::minimise_here(&setup, form.start(), &mut answer),
        false => worker::minimise(setup, form.start(), &mut answer, &is_over),
    };
    let own = match &returned {
        worker::End::Returned(_, w) => session.own_answer(w),
        _ => None,
    };
    let Session { error, panic, watch, .. } = session;
    watch.test_at_end(own, evaluator.evaluations());
    match (error, panic, returned) {
        (Some(EvaluationError::Stopped(stop)), ..) => End::Stopped(stop),
        (Some(error), ..) => End::Invalid(error.to_string()),
        (None, Some(words), _) => End::failed(format!("a model function panicked: {words}")),
        (None, None, worker::End::Returned(outcome, _)) => End::Ended { code: outcome.code, words: outcome.message },
        (None, None, worker::End::Unable) => End::failed("NLopt could not be set up for this size"),
        (None, None, worker::End::Left) => match budget.check(0) {
            Err(stop) => End::Stopped(stop),
            Ok(()) => End::failed("NLopt did not come back from one of its own loops, and was left"),
        },
    }
}

fn setup(algorithm: &Algorithm, form: &InequalityForm<'_>, evaluations: u64, deadline: Option<Instant>) -> Setup {
    Setup {
        algorithm: algorithm.code,
        inner: algorithm.inner,
        lower: form.lower().to_vec(),
        upper: form.upper().to_vec(),
        inequalities: form.count(RowKind::Inequalities),
        equalities: form.count(RowKind::Equalities),
        most_equalities: algorithm.most_equalities.map(|most| most(form.lower().len())),
        violation: VIOLATION,
        tolerance: if algorithm.gradients { TOLERANCE } else { TOLERANCE_WITHOUT_GRADIENTS },
        evaluations,
        seconds: deadline.map(|deadline| deadline.saturating_duration_since(Instant::now()).as_secs_f64().max(1e-3)),
        seed: SEED,
    }
}
