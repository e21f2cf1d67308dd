use num_dual::DualNum;

use crate::backends::argmin::Argmin;
use crate::backends::{Backend, Job, Solution, Termination};
use crate::model::handmade::{Formulas, Handmade};
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
        observer: &mut |_| iterations += 1,
    };
    let solution = Argmin.solve(model, &mut job);
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
struct Hs71;

impl Formulas for Hs71 {
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D {
        x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2]
    }

    fn rows<D: DualNum<f64> + Copy>(&self, x: &[D]) -> Vec<D> {
        vec![x[0] * x[1] * x[2] * x[3], x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3]]
    }
}

fn hs71() -> Handmade<Hs71> {
    Handmade::new(Hs71, &[1.0, 5.0, 5.0, 1.0].map(|start| (1.0, start, 5.0)), &[(25.0, OPEN), (40.0, 40.0)])
}

#[test]
fn an_equality_an_inequality_and_an_active_bound() {
    assert_solved(&hs71(), 17.014_017_289_151_34);
}

struct Rosenbrock;

impl Formulas for Rosenbrock {
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D {
        (x[1] - x[0] * x[0]).powi(2) * 100.0 + (-x[0] + 1.0).powi(2)
    }
}

#[test]
fn bounds_only() {
    assert_solved(&Handmade::new(Rosenbrock, &[(-2.0, -1.2, 2.0), (-2.0, 1.0, 2.0)], &[]), 0.0);
    assert_solved(&Handmade::new(Rosenbrock, &[(-2.0, -1.2, 0.5), (-2.0, 1.0, 2.0)], &[]), 0.25);
    assert_solved(&Handmade::new(Rosenbrock, &[(0.5, 0.5, 0.5), (-2.0, 1.0, 2.0)], &[]), 0.25);
}

/// Svanberg's cantilever with sizes in very different units: x_0 in thousandths.
struct Cantilever;

impl Formulas for Cantilever {
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D {
        (x[0] * 1e-3 + x[1] + x[2] + x[3] + x[4]) * 0.0624
    }

    fn rows<D: DualNum<f64> + Copy>(&self, x: &[D]) -> Vec<D> {
        let weights = [61e9, 37.0, 19.0, 7.0, 1.0];
        vec![x.iter().zip(weights).fold(D::from(0.0), |sum, (x, weight)| sum + x.powi(-3) * weight)]
    }
}

#[test]
fn mixed_units() {
    let optimum = 0.0624 * [61.0, 37.0, 19.0, 7.0, 1.0_f64].map(|weight| weight.powf(0.25)).iter().sum::<f64>().powf(4.0 / 3.0);
    let mut variables = [(0.1, 5.0, 10.0); 5];
    variables[0] = (100.0, 5e3, 1e4);
    assert_solved(&Handmade::new(Cantilever, &variables, &[(-OPEN, 1.0)]), optimum);
}

/// min x + y within the ring 1 ≤ x² + y² ≤ 4, x ≥ y twice over (dependent rows).
struct Ring;

impl Formulas for Ring {
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D {
        x[0] + x[1]
    }

    fn rows<D: DualNum<f64> + Copy>(&self, x: &[D]) -> Vec<D> {
        vec![x[0] * x[0] + x[1] * x[1], x[0] - x[1], (x[0] - x[1]) * 2.0]
    }
}

#[test]
fn two_sided_and_dependent_rows() {
    let rows = [(1.0, 4.0), (0.0, OPEN), (0.0, OPEN)];
    assert_solved(&Handmade::new(Ring, &[(-3.0, 1.0, 3.0), (-3.0, 0.5, 3.0)], &rows), -8.0_f64.sqrt());
}

/// −log x + x on x ≥ 0.
struct Barrier;

impl Formulas for Barrier {
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D {
        -x[0].ln() + x[0]
    }
}

#[test]
fn trial_steps_out_of_the_domain_are_shortened() {
    assert_solved(&Handmade::new(Barrier, &[(0.0, 40.0, 50.0)], &[]), 1.0);
}

/// √(−1 − x²)
struct Nowhere;

impl Formulas for Nowhere {
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D {
        (-x[0] * x[0] - 1.0).sqrt()
    }
}

#[test]
fn a_start_without_value_is_moved_or_told() {
    assert_solved(&Handmade::new(Barrier, &[(0.0, 0.0, 50.0)], &[]), 1.0);
    let solution = solve(&Handmade::new(Nowhere, &[(-1.0, 0.0, 1.0)], &[]));
    assert_eq!(solution.termination, Termination::Failed);
    assert!(solution.invalid.unwrap().contains("objective"));
}

#[test]
fn rows_that_cannot_be_met_end_the_run() {
    let solution = solve(&Handmade::new(Ring, &[(-3.0, 1.0, 3.0), (-3.0, 0.5, 3.0)], &[(20.0, OPEN), (0.0, 0.0), (1.0, OPEN)]));
    assert!(solution.message.contains("falls no further"), "{}", solution.message);
}

#[test]
fn budgets_stop_inside_the_subproblem() {
    let solution = solve_within(&hs71(), Budget { max_evaluations: 9, ..Budget::default() });
    assert_eq!((solution.termination, solution.evaluations), (Termination::LimitReached, 9));
}
