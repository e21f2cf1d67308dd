//! A model that decomposes, solved part by part: the work of NLopt's dense algorithms grows with the cube of the size they are given.

use rayon::prelude::*;

use super::Nlopt;
use crate::backends::{Backend, Iteration, Job, PartTest, Solution, StopTest, Termination};
use crate::model::components::Components;
use crate::model::{Budget, Model};

/// Models with fewer variables are solved as a whole. Fewer than of our own solvers, since the work of SLSQP grows with n³.
const FEWEST_VARIABLES: usize = 100;
/// Parts solved between two lines of the log; a fixed number, so that nothing depends on the number of threads.
const BATCH: usize = 16;

/// The joined answers of all parts; `None` where the model is small, has bounds only, or does not decompose.
pub(super) fn solve(model: &dyn Model, job: &mut Job<'_>) -> Option<Solution> {
    let meta = model.meta();
    // What takes bounds only grows with the size itself.
    if job.algorithm != "auto" || meta.rows() == 0 || meta.variables() < FEWEST_VARIABLES {
        return None;
    }
    let components = model.components().filter(|components| components.partition().len() > 1)?;
    let common = Common::of(job);
    let parts: Vec<usize> = (0..components.partition().len()).collect();
    let mut joined = Joined { x: job.start.to_vec(), evaluations: 0, worst: Vec::new(), algorithm: None };
    for (number, batch) in parts.chunks(BATCH).enumerate() {
        let before = joined.x.clone();
        let solved: Vec<Solution> = batch.par_iter().map(|&k| common.part(components.as_ref(), k)).collect();
        batch.iter().zip(solved).for_each(|(&k, solution)| joined.take(components.partition().variables(k), solution));
        report(model, &joined, &before, number as u64, job);
    }
    Some(joined.solution(parts.len(), job))
}

/// What every part's job shares with the whole's.
struct Common<'a> {
    start: &'a [f64],
    tolerances: [f64; 3],
    max_iterations: u64,
    budget: Budget<'a>,
    test: Option<PartTest<'a>>,
}

impl<'a> Common<'a> {
    fn of(job: &Job<'a>) -> Self {
        Common {
            start: job.start,
            tolerances: [job.optimality_tolerance, job.step_tolerance, job.constraint_tolerance],
            max_iterations: job.max_iterations,
            budget: job.budget,
            test: job.part_test,
        }
    }

    /// Part k from its own share of the start; a run that goes on after a limit finds most parts solved.
    fn part(&self, components: &dyn Components, k: usize) -> Solution {
        let model = components.model(k);
        let start: Vec<f64> = components.partition().variables(k).iter().map(|&j| self.start[j as usize]).collect();
        let test = self.test.map(|test| |x: &[f64]| test(model.as_ref(), x));
        let [optimality_tolerance, step_tolerance, constraint_tolerance] = self.tolerances;
        let mut job = Job {
            algorithm: "auto",
            start: &start,
            start_multipliers: None,
            optimality_tolerance,
            step_tolerance,
            constraint_tolerance,
            max_iterations: self.max_iterations,
            budget: self.budget,
            stop_test: test.as_ref().map(|test| test as StopTest),
            part_test: None,
            observer: &mut |_| {},
        };
        if job.stop_test.is_some_and(|passes| passes(&start)) {
            return Solution::at_start(&job, Termination::Converged, "the start passes");
        }
        Nlopt.solve(model.as_ref(), &mut job)
    }
}

/// The parts solved so far.
struct Joined {
    x: Vec<f64>,
    /// Of the part with the most: all parts could have been evaluated side by side.
    evaluations: u64,
    /// Parts that did not converge.
    worst: Vec<Solution>,
    algorithm: Option<String>,
}

impl Joined {
    fn take(&mut self, variables: &[u32], solution: Solution) {
        variables.iter().zip(&solution.x).for_each(|(&j, &value)| self.x[j as usize] = value);
        self.evaluations = self.evaluations.max(solution.evaluations);
        if solution.evaluations > 0 {
            self.algorithm.get_or_insert_with(|| solution.algorithm.clone());
        }
        if solution.termination != Termination::Converged {
            self.worst.push(solution);
        }
    }

    /// An interrupted or limited part speaks for the whole before a failed one.
    fn solution(mut self, parts: usize, job: &Job<'_>) -> Solution {
        let rank = |part: &Solution| match part.termination {
            Termination::Interrupted => 0,
            Termination::LimitReached => 1,
            _ => 2,
        };
        self.worst.sort_by_key(rank);
        let passed = job.stop_test.is_some_and(|test| test(&self.x));
        let unsolved = self.worst.len();
        let end = match self.worst.first() {
            _ if passed => "; the stop test passed".to_owned(),
            Some(part) => format!(", {unsolved} of them not solved: {}", part.message),
            None => String::new(),
        };
        let worst = self.worst.into_iter().next().filter(|_| !passed);
        let algorithm = self.algorithm.unwrap_or_else(|| job.algorithm.to_owned());
        Solution {
            termination: worst.as_ref().map_or(Termination::Converged, |part| part.termination),
            message: format!("NLopt's {algorithm} solved {parts} independent components{end}"),
            algorithm,
            x: self.x,
            multipliers: None,
            iterations: None,
            evaluations: self.evaluations,
            seconds: 0.0,
            invalid: worst.and_then(|part| part.invalid),
        }
    }
}

/// One line of the log: the joined point so far.
fn report(model: &dyn Model, joined: &Joined, before: &[f64], iteration: u64, job: &mut Job<'_>) {
    let (meta, x) = (model.meta(), &joined.x);
    let mut rows = vec![0.0; meta.rows()];
    let known = model.constraints(x, &mut rows).is_ok();
    let limits = meta.row_lower.iter().zip(&meta.row_upper);
    let violation = rows.iter().zip(limits).map(|(c, (lower, upper))| (lower - c).max(c - upper)).fold(0.0, f64::max);
    let moved = x.iter().zip(before).map(|(x, old)| (x - old) * (x - old)).sum::<f64>().sqrt();
    (job.observer)(&Iteration {
        iteration,
        evaluations: joined.evaluations,
        objective: model.objective(x).unwrap_or(f64::NAN),
        feasibility: if known { violation } else { f64::NAN },
        optimality: f64::NAN,
        step_norm: moved,
        x,
    });
}
