//! Any backend on a model stated in other variables.

use super::{Backend, Iteration, Job, Solution};
use crate::model::reformulation::Reformulation;

/// Runs `backend` in the variables of `reformulation`; start, log, stop test and answer stay in the user's.
pub fn solve_reformulated(backend: &dyn Backend, reformulation: &dyn Reformulation, job: &mut Job<'_>) -> Solution {
    let start = reformulation.from_user(job.start);
    let stop_test = job.stop_test.map(|test| move |z: &[f64]| test(&reformulation.to_user(z)));
    let observer = &mut *job.observer;
    let mut translate = |iteration: &Iteration<'_>| {
        observer(&Iteration { x: &reformulation.to_user(iteration.x), ..*iteration });
    };
    let mut inner = Job {
        algorithm: job.algorithm,
        start: &start,
        // Multipliers belong to the rows as the user states them.
        start_multipliers: None,
        optimality_tolerance: job.optimality_tolerance,
        step_tolerance: job.step_tolerance,
        constraint_tolerance: job.constraint_tolerance,
        max_iterations: job.max_iterations,
        budget: job.budget,
        stop_test: stop_test.as_ref().map(|test| test as &(dyn Fn(&[f64]) -> bool + Sync)),
        observer: &mut translate,
    };
    let solution = backend.solve(reformulation, &mut inner);
    Solution { x: reformulation.to_user(&solution.x), multipliers: None, ..solution }
}
