//! The backend on small models whose answers are known.

mod augmented_lagrangian;
mod degenerate;
mod hock_schittkowski;
mod large;
mod runs;
mod wells;

use super::Argmin;
use crate::backends::{Backend, Job, Solution};
use crate::model::sample::Sample;
use crate::model::{Budget, Model};

const FREE: f64 = f64::INFINITY;

/// Solves from the model's own start without any limit.
fn solve(model: &dyn Model) -> Solution {
    solve_with(model, Budget::default(), None)
}

fn solve_with(model: &dyn Model, budget: Budget<'_>, multipliers: Option<&[f64]>) -> Solution {
    let start = model.meta().start.clone();
    let mut job = Job {
        algorithm: "auto",
        start: &start,
        start_multipliers: multipliers,
        optimality_tolerance: 1e-6,
        step_tolerance: 1e-6,
        constraint_tolerance: 1e-8,
        max_iterations: 3000,
        budget,
        stop_test: None,
        part_test: None,
        observer: &mut |_| {},
    };
    Argmin.solve(model, &mut job)
}

/// The largest violation of rows and bounds.
fn violation(model: &dyn Model, x: &[f64]) -> f64 {
    let meta = model.meta();
    let mut rows = vec![0.0; meta.rows()];
    model.constraints(x, &mut rows).unwrap();
    let beyond = |value: f64, lower: f64, upper: f64| (lower - value).max(value - upper).max(0.0);
    let of_rows = rows.iter().enumerate().map(|(i, &value)| beyond(value, meta.row_lower[i], meta.row_upper[i]));
    let of_bounds = x.iter().enumerate().map(|(j, &value)| beyond(value, meta.lower[j], meta.upper[j]));
    of_rows.chain(of_bounds).fold(0.0, f64::max)
}

/// Largest component of ∇f + Jᵀy outside the sign its bound allows.
fn stationarity(model: &dyn Model, solution: &Solution) -> f64 {
    let meta = model.meta();
    let mut gradient = vec![0.0; meta.variables()];
    model.gradient(&solution.x, &mut gradient).unwrap();
    let mut jacobian = vec![0.0; meta.jacobian.len()];
    model.jacobian(&solution.x, &mut jacobian).unwrap();
    let y = solution.multipliers.as_ref().expect("multipliers are handed back");
    meta.jacobian.add_transposed(&jacobian, y, &mut gradient);
    let free_part = |(j, &g): (usize, &f64)| {
        let x = solution.x[j];
        if meta.lower[j] == meta.upper[j] || (x <= meta.lower[j] && g > 0.0) || (x >= meta.upper[j] && g < 0.0) {
            0.0
        } else {
            g.abs()
        }
    };
    gradient.iter().enumerate().map(free_part).fold(0.0, f64::max)
}

/// Solved: the optimum is met to nine digits, feasible to rounding, with multipliers that prove it.
fn assert_optimum(name: &str, model: &Sample, optimum: f64) -> Solution {
    let solution = solve(model);
    let objective = model.objective(&solution.x).unwrap();
    let report = format!("{name}: f = {objective:e} instead of {optimum:e}; {solution:?}");
    assert!((objective - optimum).abs() <= 1e-9 * optimum.abs().max(1.0), "{report}");
    assert!(violation(model, &solution.x) <= 1e-9, "{report}");
    let stationarity = stationarity(model, &solution);
    assert!(stationarity <= 1e-7 * optimum.abs().max(1.0), "stationarity {stationarity:e} of {report}");
    assert!(solution.iterations.is_some_and(|iterations| iterations <= 120), "{report}");
    solution
}
