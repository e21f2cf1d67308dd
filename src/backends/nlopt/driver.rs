//! Runs the steps of a plan until the certificate passes, a budget ends, or the plan does.

use super::attempt::{End, run};
use super::form::InequalityForm;
use super::plan::{StartPoint, Step};
use super::watch::Watch;
use crate::math::split_mix::SplitMix;
use crate::model::views::scaled::valid_start;
use crate::model::{EvaluationError, Evaluator, Meta, Model};

/// Share of a variable's size by which a point beside another lies apart: far enough to leave a flat region of third order,
/// near enough to stay in its neighbourhood.
const BESIDE: f64 = 0.01;
/// Where the signs of such a move come from.
const SEED: u64 = 20_240_607;

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
        // What has passed is polished by another algorithm only: by its own it ended where rounding did not let it go on.
        if watch.proved().is_some() && counted.as_ref().is_some_and(|last| last.algorithm == step.algorithm.name) {
            break;
        }
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
    matches!(end, End::Stopped(_)) || watch.is_unbounded() || watch.iterations() >= watch.job().max_iterations
}

fn attempt(step: &Step, evaluator: &Evaluator<'_>, watch: &mut Watch<'_, '_>) -> End {
    let start = watch.job().start;
    let sizes =
        |x: &[f64]| x.iter().zip(start).enumerate().map(|(j, (&x, &start))| size(j, x, start, evaluator.meta())).collect();
    let best = watch.best().map_or(start, |best| &best.x);
    let mut origin = match step.from {
        StartPoint::Start => start.to_vec(),
        StartPoint::Best => best.to_vec(),
        StartPoint::Beside => beside(best, evaluator.meta()),
    };
    evaluator.meta().clamp(&mut origin);
    let form = valid_start(evaluator, &origin, sizes).and_then(|(x, scales)| {
        let mut form = InequalityForm::new(evaluator, scales, &x);
        if step.algorithm.most_equalities.is_some() {
            form.keep_independent()?;
            form.open_what_is_stated();
        }
        Ok(form)
    });
    match form {
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

/// max(|x_j|, |start_j|). Where the model's own start is 0 it says nothing of a variable's size, and a point near 0 by chance
/// does not either: then at least 1, or the room between the bounds.
fn size(j: usize, x: f64, start: f64, meta: &Meta) -> f64 {
    let unknown = if meta.start[j] == 0.0 { (meta.upper[j] - meta.lower[j]).min(1.0) } else { 0.0 };
    x.abs().max(start.abs()).max(unknown)
}

/// A little beside `x`, in its own proportions: a variable that has grown or shrunk by orders of magnitude is moved by its present size, not by that of its start.
fn beside(x: &[f64], meta: &Meta) -> Vec<f64> {
    let mut random = SplitMix::new(SEED);
    let size = |j: usize, x: f64| if x == 0.0 { (meta.upper[j] - meta.lower[j]).min(1.0) } else { x.abs() };
    x.iter().enumerate().map(|(j, &x)| x + BESIDE * size(j, x) * (2.0 * random.uniform() - 1.0)).collect()
}
