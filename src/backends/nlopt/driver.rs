//! Runs the steps of a plan until the certificate passes, a budget ends, or the plan does.

use super::attempt::{End, run};
use super::form::Form;
use super::plan::{From, Step};
use super::watch::Watch;
use crate::model::scaled::{Scales, valid_start};
use crate::model::{EvaluationError, Evaluator, Model};

/// What a plan came to.
pub(super) struct Outcome {
    /// The algorithm of the attempt that counts.
    pub algorithm: &'static str,
    /// How that attempt ended.
    pub end: End,
}

/// Runs `plan`; the answer is in the watch.
pub(super) fn drive(plan: &[Step], evaluator: &Evaluator<'_>, watch: &mut Watch<'_, '_>) -> Option<Outcome> {
    let mut counted: Option<Outcome> = None;
    for step in plan {
        let before = watch.iterations();
        let end = attempt(step, evaluator, watch);
        let is_final = is_over(&end, watch);
        let improved = watch.iterations() > before && !matches!(end, End::Invalid(_));
        if is_final || improved || counted.is_none() {
            counted = Some(Outcome { algorithm: step.algorithm.name, end });
        }
        if is_final {
            break;
        }
    }
    counted
}

/// Whether nothing further should be tried.
fn is_over(end: &End, watch: &Watch<'_, '_>) -> bool {
    let stopped = matches!(end, End::Stopped(_));
    stopped || watch.proved().is_some() || watch.is_unbounded() || watch.iterations() >= watch.job().max_iterations
}

fn attempt(step: &Step, evaluator: &Evaluator<'_>, watch: &mut Watch<'_, '_>) -> End {
    let start = watch.job().start;
    let mut origin = match (step.from, watch.best()) {
        (From::Best, Some(best)) => best.x.clone(),
        _ => start.to_vec(),
    };
    evaluator.meta().clamp(&mut origin);
    match translated(&origin, start, step, evaluator) {
        Err(EvaluationError::Stopped(stop)) => End::Stopped(stop),
        Err(error) => End::Invalid(error.to_string()),
        Ok(form) if form.start().is_empty() => End::Ended { code: 1, words: "no variable that has room to move".into() },
        Ok(form) => {
            watch.begin();
            watch.measure(|x| form.violation_at(x));
            run(step.algorithm, &form, step.evaluations, evaluator, watch)
        }
    }
}

/// The problem as NLopt sees it, in units of `origin`, which is moved inside its bounds until the model has values there.
fn translated<'a>(
    origin: &[f64],
    start: &[f64],
    step: &Step,
    evaluator: &'a Evaluator<'_>,
) -> Result<Form<'a>, EvaluationError> {
    let meta = evaluator.meta();
    // Where the model's own start is 0 it says nothing of a variable's size, and a point near 0 by chance does not either.
    let unknown = |j: usize| if meta.start[j] == 0.0 { (meta.upper[j] - meta.lower[j]).min(1.0) } else { 0.0 };
    let size = |(j, (x, start)): (usize, (&f64, &f64))| x.abs().max(start.abs()).max(unknown(j));
    let (x, scales): (Vec<f64>, Scales) =
        valid_start(evaluator, origin, |x| x.iter().zip(start).enumerate().map(size).collect())?;
    let mut form = Form::new(evaluator, scales, &x);
    if step.algorithm.most_equalities.is_some() {
        form.keep_independent()?;
    }
    Ok(form)
}
