use num_dual::DualNum;

use crate::backends::argmin::Argmin;
use crate::backends::{Backend, Job, Solution, Termination};
use crate::model::sample::Sample;
use crate::model::{Budget, Model};

const OPEN: f64 = f64::INFINITY;

fn solve_within(model: &dyn Model, budget: Budget<'_>) -> Solution {
    let mut iterations = 0;
    let start = model.meta().start.clone();
    let mut job = Job {
        algorithm: "augmented-lagrangian",
        start: &start,
        start_multipliers: None,
        optimality_tolerance: 1e-6,
        step_tolerance: 1e-6,
        constraint_tolerance: 1e-8,
        max_iterations: 1000,
        budget,
        stop_test: None,
        part_test: None,
        observer: &mut |_| iterations += 1,
    };
    let solution = Argmin.solve(model, &mut job);
    // A model without a value at its start has no iteration to show.
    assert!(iterations > 0 || solution.invalid.is_some());
    solution
}

fn solve(model: &dyn Model) -> Solution {
    solve_within(model, Budget::default())
}

/// ‖∇f + Jᵀy‖∞ over variables away from their bounds, and the largest violation.
fn residuals(model: &dyn Model, solution: &Solution) -> (f64, f64) {
    let (meta, x) = (model.meta(), &solution.x);
    let mut gradient = vec![0.0; x.len()];
    model.gradient(x, &mut gradient).unwrap();
    let (mut jacobian, mut rows) = (vec![0.0; meta.jacobian.len()], vec![0.0; meta.rows()]);
    model.jacobian(x, &mut jacobian).unwrap();
    model.constraints(x, &mut rows).unwrap();
    meta.jacobian.add_transposed(&jacobian, solution.multipliers.as_ref().unwrap(), &mut gradient);
    let inside = (0..x.len()).filter(|&j| x[j] > meta.lower[j] && x[j] < meta.upper[j]);
    let violation = |(i, row): (usize, &f64)| (meta.row_lower[i] - row).max(row - meta.row_upper[i]);
    (inside.fold(0.0, |largest, j| largest.max(gradient[j].abs())), rows.iter().enumerate().map(violation).fold(0.0, f64::max))
}

#[track_caller]
fn assert_solved(model: &dyn Model, optimum: f64) {
    let solution = solve(model);
    let value = model.objective(&solution.x).unwrap();
    let (stationarity, violation) = residuals(model, &solution);
    println!(
        "{value:.12} {stationarity:e} {violation:e} {} {:?} {}",
        solution.evaluations, solution.iterations, solution.message
    );
    assert!((value - optimum).abs() <= 1e-8 * optimum.abs().max(1.0), "{value}: {}", solution.message);
    assert!(stationarity <= 1e-7 * optimum.abs().max(1.0), "stationarity {stationarity}: {}", solution.message);
    assert!(violation <= 1e-8, "violation {violation}: {}", solution.message);
    assert_eq!(solution.termination, Termination::Converged);
}

/// Hock and Schittkowski's problem 71.
fn hs71() -> Sample {
    Sample::new(&[1.0, 5.0, 5.0, 1.0], |x| x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2])
        .bounds(&[1.0; 4], &[5.0; 4])
        .row(25.0, OPEN, |x| x[0] * x[1] * x[2] * x[3])
        .row(40.0, 40.0, |x| x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3])
}

#[test]
fn an_equality_an_inequality_and_an_active_bound() {
    assert_solved(&hs71(), 17.014_017_289_151_34);
}

fn rosenbrock(x: (f64, f64, f64)) -> Sample {
    let (lower, start, upper) = x;
    Sample::new(&[start, 1.0], |x| (x[1] - x[0] * x[0]).powi(2) * 100.0 + (-x[0] + 1.0).powi(2))
        .bounds(&[lower, -2.0], &[upper, 2.0])
}

#[test]
fn bounds_only() {
    assert_solved(&rosenbrock((-2.0, -1.2, 2.0)), 0.0);
    assert_solved(&rosenbrock((-2.0, -1.2, 0.5)), 0.25);
    assert_solved(&rosenbrock((0.5, 0.5, 0.5)), 0.25);
}

/// Svanberg's cantilever with sizes in very different units: x_0 in thousandths.
#[test]
fn mixed_units() {
    let optimum = 0.0624 * [61.0, 37.0, 19.0, 7.0, 1.0_f64].map(|weight| weight.powf(0.25)).iter().sum::<f64>().powf(4.0 / 3.0);
    let cantilever = Sample::new(&[5e3, 5.0, 5.0, 5.0, 5.0], |x| (x[0] * 1e-3 + x[1] + x[2] + x[3] + x[4]) * 0.0624)
        .bounds(&[100.0, 0.1, 0.1, 0.1, 0.1], &[1e4, 10.0, 10.0, 10.0, 10.0])
        .row(-OPEN, 1.0, |x| x.iter().zip([61e9, 37.0, 19.0, 7.0, 1.0]).map(|(x, weight)| x.powi(-3) * weight).sum());
    assert_solved(&cantilever, optimum);
}

/// min x + y under limits of x² + y², x − y and 2(x − y) (dependent rows).
fn ring(rows: [(f64, f64); 3]) -> Sample {
    Sample::new(&[1.0, 0.5], |x| x[0] + x[1])
        .bounds(&[-3.0; 2], &[3.0; 2])
        .row(rows[0].0, rows[0].1, |x| x[0] * x[0] + x[1] * x[1])
        .row(rows[1].0, rows[1].1, |x| x[0] - x[1])
        .row(rows[2].0, rows[2].1, |x| (x[0] - x[1]) * 2.0)
}

#[test]
fn two_sided_and_dependent_rows() {
    assert_solved(&ring([(1.0, 4.0), (0.0, OPEN), (0.0, OPEN)]), -8.0_f64.sqrt());
}

/// −log x + x on x ≥ 0.
fn barrier(start: f64) -> Sample {
    Sample::new(&[start], |x| -x[0].ln() + x[0]).bounds(&[0.0], &[50.0])
}

#[test]
fn trial_steps_out_of_the_domain_are_shortened() {
    assert_solved(&barrier(40.0), 1.0);
}

#[test]
fn a_start_without_value_is_moved_or_told() {
    assert_solved(&barrier(0.0), 1.0);
    let nowhere = Sample::new(&[0.0], |x| (-x[0] * x[0] - 1.0).sqrt()).bounds(&[-1.0], &[1.0]);
    let solution = solve(&nowhere);
    assert_eq!(solution.termination, Termination::Failed);
    assert!(solution.invalid.unwrap().contains("objective"));
}

#[test]
fn rows_that_cannot_be_met_end_the_run() {
    let solution = solve(&ring([(20.0, OPEN), (0.0, 0.0), (1.0, OPEN)]));
    assert!(solution.message.contains("falls no further"), "{}", solution.message);
}

#[test]
fn budgets_stop_inside_the_subproblem() {
    let solution = solve_within(&hs71(), Budget { max_evaluations: 9, ..Budget::default() });
    assert_eq!((solution.termination, solution.evaluations), (Termination::LimitReached, 9));
}
