//! How a run begins: where, with which multipliers, how far from the bounds.

use super::kkt::Kkt;
use super::parameters::PARAMETERS;
use super::slack_form::{SlackForm, Source};
use super::start;
use super::state::State;
use crate::model::{EvaluationError, Model};

/// How to begin.
#[derive(Clone, Copy)]
pub(super) struct InitialPoint<'s> {
    /// The model's x.
    pub x: &'s [f64],
    /// What the variables are scaled by: their sizes here.
    pub magnitudes: &'s [f64],
    /// The model's row multipliers of an earlier answer.
    pub multipliers: Option<&'s [f64]>,
    /// By how much the limits of rows are eased while iterating.
    pub ease: f64,
    /// First barrier parameter, if not the usual one.
    pub mu: Option<f64>,
    /// Push inside the bounds, if not the usual one.
    pub push: Option<f64>,
}

impl<'s> InitialPoint<'s> {
    /// A cold start.
    pub fn at(x: &'s [f64]) -> Self {
        InitialPoint { x, magnitudes: x, multipliers: None, ease: 0.0, mu: None, push: None }
    }

    /// The optimality error of x with these multipliers as an answer, in the scales that fit here.
    pub fn error_as_answer(&self, model: &'s dyn Model) -> Result<f64, EvaluationError> {
        let mut form = SlackForm::new(Source::Given(model), self.x, self.magnitudes);
        let mut iterate = start::place(&mut form, self.x, 0.0, 0.0)?;
        start::answer_multipliers(&form, &mut iterate, self.multipliers.unwrap_or_default());
        Ok(iterate.errors(&form, 0.0, &mut vec![0.0; form.size()]).largest())
    }
}

impl<'a> State<'a> {
    /// At the start, ready to iterate.
    pub fn at_start(model: Source<'a>, beginning: InitialPoint<'_>) -> Result<Self, EvaluationError> {
        let warm = beginning.multipliers.is_some();
        let mut form = SlackForm::new(model, beginning.x, beginning.magnitudes);
        form.ease = beginning.ease;
        let push = beginning.push.unwrap_or(if warm { PARAMETERS.kappa_1_warm } else { PARAMETERS.kappa_1 });
        let mu = beginning.mu.unwrap_or(if warm { PARAMETERS.mu_warm } else { PARAMETERS.barrier.mu_0 });
        let slack_push = if form.is_large() && !warm { PARAMETERS.kappa_1_large } else { push };
        let mut iterate = start::place(&mut form, beginning.x, push, slack_push)?;
        let mut kkt =
            Kkt::new(&form).map_err(|error| EvaluationError::Invalid { term: "KKT matrix".into(), cause: error.to_string() })?;
        match beginning.multipliers {
            Some(given) => start::warm_multipliers(&form, &mut iterate, given, mu),
            // With slacks that begin well inside, zero is as good a guess as least squares, and free.
            None if form.is_large() => start::unit_bound_multipliers(&form, &mut iterate),
            None => {
                start::unit_bound_multipliers(&form, &mut iterate);
                start::least_squares_multipliers(&form, &mut kkt, &mut iterate);
            }
        }
        Ok(State::new(form, kkt, mu, iterate))
    }
}
