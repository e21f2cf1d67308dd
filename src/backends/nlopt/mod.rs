//! NLopt's algorithms behind [`Backend`]. The only room that names NLopt.
//!
//! NLopt's status is text to show. A solve is one short sequence of attempts (`plan`), each on a thread that can be left
//! (`worker`), on a problem of a shape and of numbers that NLopt can take (`algorithms`, `form`, `independent`; docs/nlopt.md).
//! It ends when the stop test handed in (the certificate) passes. Models that decompose are solved part by part (`components`).

mod algorithms;
mod attempt;
mod components;
mod driver;
mod ffi;
mod form;
mod independent;
mod plan;
#[cfg(test)]
mod tests;
mod watch;
mod worker;

use std::time::Instant;

use self::attempt::End;
use self::driver::Outcome;
use self::watch::Watch;
use super::{Backend, Job, Solution, Termination};
use crate::model::{Evaluator, Model, Stop};

/// NLopt 2.9.1, linked statically.
#[derive(Debug, Clone, Copy, Default)]
pub struct Nlopt;

impl Backend for Nlopt {
    fn name(&self) -> &'static str {
        "nlopt"
    }

    fn algorithms(&self) -> &'static [&'static str] {
        &algorithms::NAMES
    }

    fn refusal(&self, algorithm: &str, model: &dyn Model) -> Option<String> {
        let meta = model.meta();
        if algorithms::is_fixed(meta) && (algorithm == "auto" || algorithms::find(algorithm).is_some()) {
            return None;
        }
        let able = algorithms::able(meta);
        let obstacle = match (algorithm, algorithms::find(algorithm)) {
            ("auto", _) if able.is_empty() => "auto finds no algorithm for this problem".to_owned(),
            ("auto", _) => plan::too_much(meta)?,
            (_, None) => format!("{algorithm} is no algorithm of this backend"),
            (_, Some(found)) => format!("{algorithm} {}", found.obstacle(meta)?),
        };
        Some(match able.is_empty() {
            true => format!("NLopt: {obstacle}; none of its algorithms can take it, use the argmin backend"),
            false => format!("NLopt: {obstacle}; these can take it: {}", able.join(", ")),
        })
    }

    /// SLSQP solves a dense least-squares problem of all variables and rows per evaluation; its flops are cheaper than entries.
    fn work_per_evaluation(&self, model: &dyn Model) -> f64 {
        let (n, m) = (model.meta().variables() as f64, model.meta().rows() as f64);
        let is_dense = m > 0.0 && model.components().is_none();
        super::entries(model) + if is_dense { n * n * (n + m) / 40.0 } else { 0.0 }
    }

    fn solve(&self, model: &dyn Model, job: &mut Job<'_>) -> Solution {
        let began = Instant::now();
        let mut solution = match self.refusal(job.algorithm, model).or_else(|| odd_start(model, job.start)) {
            Some(refusal) => Solution::at_start(job, Termination::Refused, refusal),
            None if algorithms::is_fixed(model.meta()) => fixed(job),
            None => components::solve(model, job).unwrap_or_else(|| run(model, job)),
        };
        solution.seconds = began.elapsed().as_secs_f64();
        solution
    }
}

/// A start NLopt would read past.
fn odd_start(model: &dyn Model, start: &[f64]) -> Option<String> {
    let fits = start.len() == model.meta().variables() && start.iter().all(|value| value.is_finite());
    (!fits).then(|| format!("NLopt: the start must hold {} finite numbers", model.meta().variables()))
}

/// The answer where there is nothing to vary.
fn fixed(job: &Job<'_>) -> Solution {
    Solution::at_start(job, Termination::Converged, "every variable is fixed")
}

fn run(model: &dyn Model, job: &mut Job<'_>) -> Solution {
    let blank = Solution::at_start(job, Termination::Failed, "NLopt: there was nothing to try");
    let meta = model.meta();
    let plan = match algorithms::find(job.algorithm) {
        Some(algorithm) => plan::named(algorithm, meta),
        None => plan::automatic(meta),
    };
    let is_auto = job.algorithm == "auto";
    let evaluator = Evaluator::new(model, job.budget);
    let mut watch = Watch::new(job);
    let outcome = driver::drive(&plan, &evaluator, &mut watch);
    let answer = watch.proved().or(watch.best());
    let x = answer.map_or_else(|| blank.x.clone(), |answer| answer.x.clone());
    let evaluations = evaluator.evaluations();
    match outcome {
        None => blank,
        Some(outcome) => Solution {
            algorithm: outcome.algorithm.into(),
            termination: termination(&outcome.end, watch.proved().is_some() || watch.is_unbounded(), is_auto),
            message: message(&outcome, &watch),
            x,
            evaluations,
            invalid: invalid(&outcome.end, watch.proved().is_some()),
            ..blank
        },
    }
}

fn termination(end: &End, settled: bool, is_auto: bool) -> Termination {
    match end {
        _ if settled => Termination::Converged,
        End::Stopped(Stop::Interrupted) => Termination::Interrupted,
        // 5: the plan's own limit on evaluations, which the user never set; `auto` has given up.
        End::Ended { code: 5, .. } if is_auto => Termination::Failed,
        // 5: evaluations, 6: time, −5: the watch counted max_iterations.
        End::Stopped(_) | End::Ended { code: 5 | 6 | -5, .. } => Termination::LimitReached,
        // −4: rounding limits progress, which is where a solution often lies.
        End::Ended { code: 1.. | -4, .. } => Termination::Converged,
        End::Ended { .. } | End::Invalid(_) => Termination::Failed,
    }
}

fn invalid(end: &End, proved: bool) -> Option<String> {
    match end {
        End::Invalid(error) if !proved => Some(error.clone()),
        _ => None,
    }
}

fn message(outcome: &Outcome, watch: &Watch<'_, '_>) -> String {
    let Outcome { algorithm, end } = outcome;
    let how = match end {
        End::Ended { code: -5, .. } if watch.is_unbounded() => "stopped where the objective falls without end".to_owned(),
        End::Ended { code: -5, .. } if watch.proved().is_some() => "stopped after the stop test passed".to_owned(),
        End::Ended { code: -5, .. } => "stopped at the limit on iterations".to_owned(),
        End::Ended { words, .. } => format!("ended with {words}"),
        End::Stopped(stop) => format!("stopped: {stop}"),
        End::Invalid(error) => format!("ended where the model has no value ({error})"),
    };
    let point = match watch.best() {
        _ if watch.proved().is_some() && !how.ends_with("passed") => "; its point passed the test".to_owned(),
        Some(best) if watch.is_infeasible() => format!("; rows are violated by up to {:.3e}", best.feasibility),
        _ => String::new(),
    };
    format!("NLopt's {algorithm} {how}{point}")
}
