//! The backend `argmin`, the only room naming that library: solvers of our own under its `Executor`, with a state of
//! our own, watched by an argmin observer.

mod interior_point;
mod state;
#[cfg(test)]
pub(crate) mod test_models;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::time::Instant;

use argmin::core::observers::ObserverMode;
use argmin::core::{Executor, Solver};

use super::{Backend, Iteration, Job, Solution, Termination};
use crate::model::{Evaluator, Model};
use interior_point::InteriorPoint;
use state::{NlpState, Watch};

const INTERIOR_POINT: &str = "interior-point";

/// argmin: the interior point (default), for every model.
#[derive(Debug, Clone, Copy, Default)]
pub struct Argmin;

impl Backend for Argmin {
    fn name(&self) -> &'static str {
        "argmin"
    }

    fn algorithms(&self) -> &'static [&'static str] {
        &[INTERIOR_POINT]
    }

    fn refusal(&self, algorithm: &str, _model: &dyn Model) -> Option<String> {
        let known = algorithm == "auto" || self.algorithms().contains(&algorithm);
        (!known).then(|| format!("argmin has no algorithm `{algorithm}`; it has {}", self.algorithms().join(", ")))
    }

    fn solve(&self, model: &dyn Model, job: &mut Job<'_>) -> Solution {
        if let Some(message) = self.refusal(job.algorithm, model) {
            return refused(job, message);
        }
        let began = Instant::now();
        let evaluator = Evaluator::new(model, job.budget);
        let solver = InteriorPoint::new(job.start.to_vec(), job.start_multipliers.map(<[f64]>::to_vec));
        let state = run(solver, &evaluator, job);
        solution(INTERIOR_POINT, state, &evaluator, began)
    }
}

/// Runs a solver under argmin's executor.
fn run<'a, S>(solver: S, evaluator: &'a Evaluator<'a>, job: &mut Job<'_>) -> Finished
where
    S: for<'s> Solver<&'a Evaluator<'a>, NlpState<'s>>,
{
    let observer = RefCell::new(&mut *job.observer);
    let report = |iteration: &Iteration<'_>| (observer.borrow_mut())(iteration);
    let executor = Executor::new(evaluator, solver)
        .configure(|state: NlpState<'_>| {
            state.start(job.start).max_iterations(job.max_iterations).tolerance(job.constraint_tolerance).report_to(&report)
        })
        .add_observer(Watch, ObserverMode::Always)
        // The process has one handler, and the command line owns it.
        .ctrlc(false);
    match executor.run() {
        Ok(result) => result.state.finish(),
        Err(error) => Finished::failed(job.start, error.to_string()),
    }
}

/// What a run leaves behind.
struct Finished {
    termination: Termination,
    message: String,
    invalid: Option<String>,
    x: Vec<f64>,
    multipliers: Option<Vec<f64>>,
    iterations: u64,
}

impl Finished {
    fn failed(start: &[f64], message: String) -> Self {
        let termination = Termination::Failed;
        Finished { termination, message, invalid: None, x: start.to_vec(), multipliers: None, iterations: 0 }
    }
}

fn solution(algorithm: &str, run: Finished, evaluator: &Evaluator<'_>, began: Instant) -> Solution {
    Solution {
        algorithm: algorithm.into(),
        termination: run.termination,
        message: run.message,
        x: run.x,
        multipliers: run.multipliers,
        iterations: Some(run.iterations),
        evaluations: evaluator.evaluations(),
        seconds: began.elapsed().as_secs_f64(),
        invalid: run.invalid,
    }
}

fn refused(job: &Job<'_>, message: String) -> Solution {
    Solution {
        algorithm: job.algorithm.into(),
        termination: Termination::Refused,
        message,
        x: job.start.to_vec(),
        multipliers: None,
        iterations: None,
        evaluations: 0,
        seconds: 0.0,
        invalid: None,
    }
}
