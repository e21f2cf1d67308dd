//! The backend `argmin`, the only room naming that library: solvers of our own under its `Executor`, with a state of
//! our own, watched by an argmin observer.

mod augmented_lagrangian;
mod components;
mod interior_point;
mod state;
#[cfg(test)]
mod tests;

use std::cell::RefCell;
use std::time::Instant;

use argmin::core::observers::ObserverMode;
use argmin::core::{Executor, Solver};

use super::{Backend, Iteration, Job, Solution, Termination};
use crate::model::{EvaluationError, Evaluator, Model};
use augmented_lagrangian::AugmentedLagrangian;
use components::Components;
use interior_point::InteriorPoint;
use state::{Conclusion, NlpState, Watch};

const INTERIOR_POINT: &str = "interior-point";
const AUGMENTED_LAGRANGIAN: &str = "augmented-lagrangian";

/// argmin: the interior point (default), for every model, and the augmented Lagrangian.
#[derive(Debug, Clone, Copy, Default)]
pub struct Argmin;

impl Backend for Argmin {
    fn name(&self) -> &'static str {
        "argmin"
    }

    fn takes_states(&self) -> bool {
        true
    }

    fn algorithms(&self) -> &'static [&'static str] {
        &[INTERIOR_POINT, AUGMENTED_LAGRANGIAN]
    }

    fn refusal(&self, algorithm: &str, model: &dyn Model) -> Option<String> {
        let known = algorithm == "auto" || self.algorithms().contains(&algorithm);
        match algorithm {
            AUGMENTED_LAGRANGIAN => augmented_lagrangian::refusal(model.meta()),
            _ if known => None,
            _ => Some(format!("argmin has no algorithm `{algorithm}`; it has {}", self.algorithms().join(", "))),
        }
    }

    /// A sparse factorisation costs about twice as much as the values and derivatives it is made of (11 000 evaluations of 30
    /// variables and 22 rows: 1 s).
    fn work_per_evaluation(&self, model: &dyn Model) -> f64 {
        3.0 * super::entries(model)
    }

    fn solve(&self, model: &dyn Model, job: &mut Job<'_>) -> Solution {
        if let Some(message) = self.refusal(job.algorithm, model) {
            return refused(job, message);
        }
        let began = Instant::now();
        let evaluator = Evaluator::new(model, job.budget);
        let (algorithm, finished) = match job.algorithm {
            AUGMENTED_LAGRANGIAN => (AUGMENTED_LAGRANGIAN, augmented_lagrangian(&evaluator, job)),
            _ if let Some(pieces) = components::fall_apart(&evaluator) => {
                let solver = Components::new(pieces.as_ref(), &evaluator, job.start, job.start_multipliers);
                (INTERIOR_POINT, run(solver, &evaluator, job))
            }
            _ => {
                let solver = InteriorPoint::new(job.start.to_vec(), job.start_multipliers.map(<[f64]>::to_vec));
                (INTERIOR_POINT, run(solver, &evaluator, job))
            }
        };
        solution(algorithm, finished, &evaluator, began)
    }
}

fn augmented_lagrangian(evaluator: &Evaluator<'_>, job: &mut Job<'_>) -> Finished {
    match AugmentedLagrangian::new(evaluator, job) {
        Ok(solver) => run(solver, evaluator, job),
        Err(error) => Finished::without_value(job.start, &error),
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
    fn without_value(start: &[f64], error: &EvaluationError) -> Self {
        let Conclusion { termination, message, invalid } = Conclusion::of(error);
        Finished { termination, invalid, ..Self::failed(start, message) }
    }

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
