//! The backend `argmin`, the only room naming that library: our own solvers under its `Executor`.

mod executor;
#[cfg(test)]
mod tests;

use std::time::Instant;

use super::{Backend, Job, Solution, Termination};
use crate::model::views::bounded_states::BoundedStates;
use crate::model::{Evaluator, Model};
use crate::solvers::augmented_lagrangian::{self, AugmentedLagrangian};
use crate::solvers::block_interior_point::{self, BlockInteriorPoint};
use crate::solvers::interior_point::InteriorPoint;
use crate::solvers::{Conclusion, StopTest};
use executor::{concluded, run};

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
    /// variables and 22 rows: 1 s); what the model does besides filling them in is no part of it.
    fn work_per_evaluation(&self, model: &dyn Model) -> f64 {
        3.0 * super::entries(model) - 2.0 * model.meta().extra_work
    }

    fn solve(&self, model: &dyn Model, job: &mut Job<'_>) -> Solution {
        if let Some(message) = self.refusal(job.algorithm, model) {
            return Solution::at_start(job, Termination::Refused, message);
        }
        let began = Instant::now();
        let (algorithm, solution) = match job.algorithm {
            AUGMENTED_LAGRANGIAN => (AUGMENTED_LAGRANGIAN, by_augmented_lagrangian(model, job)),
            _ => (INTERIOR_POINT, by_interior_point(model, job)),
        };
        Solution { algorithm: algorithm.into(), seconds: began.elapsed().as_secs_f64(), ..solution }
    }
}

fn by_interior_point(model: &dyn Model, job: &mut Job<'_>) -> Solution {
    let bounded = BoundedStates::of(model, job.start);
    let evaluator = Evaluator::new(bounded.as_ref().map_or(model, |bounded| bounded), job.budget);
    let solution = match block_interior_point::decomposes(&evaluator) {
        Some(components) => {
            let solver = BlockInteriorPoint::new(&evaluator, components.as_ref(), job.start, job.start_multipliers);
            run(solver, &evaluator, job)
        }
        None => {
            let multipliers = job.start_multipliers.map(<[f64]>::to_vec);
            // A solved point need only pass: with nothing to spare, as what it is short of is rounding.
            let passes = job.part_test.map(|test| move |x: &[f64]| test(model, x));
            let passes = passes.as_ref().map(|test| test as StopTest);
            run(InteriorPoint::new(&evaluator, job.start.to_vec(), multipliers, passes), &evaluator, job)
        }
    };
    let of_rows = |y| bounded.iter().fold(y, |y, bounded| bounded.multipliers(&solution.x, y));
    Solution { multipliers: solution.multipliers.map(of_rows), evaluations: evaluator.evaluations(), ..solution }
}

fn by_augmented_lagrangian(model: &dyn Model, job: &mut Job<'_>) -> Solution {
    let evaluator = Evaluator::new(model, job.budget);
    let solution = match AugmentedLagrangian::new(&evaluator, job.start, job.start_multipliers, job.stop_test) {
        Ok(solver) => run(solver, &evaluator, job),
        Err(error) => concluded(Conclusion::of(&error), None, job),
    };
    Solution { evaluations: evaluator.evaluations(), ..solution }
}
