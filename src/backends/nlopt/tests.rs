use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

use num_dual::DualNum;

use super::*;
use crate::backends::{Iteration, StopTest};
use crate::model::sample::Sample;
use crate::model::{Budget, EvaluationError, Meta};

const OPEN: f64 = f64::INFINITY;

/// Hock and Schittkowski's problem 71: f* = 17.0140173.
fn hs71() -> Sample {
    Sample::new(&[1.0, 5.0, 5.0, 1.0], |x| x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2])
        .bounds(&[1.0; 4], &[5.0; 4])
        .row(25.0, OPEN, |x| x[0] * x[1] * x[2] * x[3])
        .row(40.0, 40.0, |x| x[0] * x[0] + x[1] * x[1] + x[2] * x[2] + x[3] * x[3])
}

fn rosenbrock() -> Sample {
    rosenbrock_within([-2.0; 2], [2.0; 2])
}

fn rosenbrock_within(lower: [f64; 2], upper: [f64; 2]) -> Sample {
    let start = [(-1.2_f64).clamp(lower[0], upper[0]), 1.0];
    Sample::new(&start, |x| (x[1] - x[0] * x[0]).powi(2) * 100.0 + (-x[0] + 1.0).powi(2)).bounds(&lower, &upper)
}

/// Svanberg's cantilever of five segments; in closed form f* = 0.0624·(Σ w_i^¼)^(4/3).
fn cantilever() -> Sample {
    Sample::new(&[5.0; 5], |x| (x[0] + x[1] + x[2] + x[3] + x[4]) * 0.0624)
        .bounds(&[0.1; 5], &[10.0; 5])
        .row(-OPEN, 1.0, |x| x.iter().zip([61.0, 37.0, 19.0, 7.0, 1.0]).map(|(x, weight)| x.powi(-3) * weight).sum())
}

struct Options<'a> {
    algorithm: &'a str,
    budget: Budget<'a>,
    stop_test: Option<StopTest<'a>>,
}

const PLAIN: Options<'static> =
    Options { algorithm: "auto", budget: Budget { max_evaluations: u64::MAX, deadline: None, interrupt: None }, stop_test: None };

fn solve(model: &dyn Model, options: &Options<'_>) -> (Solution, Vec<f64>) {
    let mut log = Vec::new();
    let mut observer = |iteration: &Iteration<'_>| log.push(iteration.objective);
    let mut job = Job {
        algorithm: options.algorithm,
        start: &model.meta().start.clone(),
        start_multipliers: None,
        optimality_tolerance: 1e-6,
        step_tolerance: 1e-6,
        constraint_tolerance: 1e-8,
        max_iterations: 500_000,
        budget: options.budget,
        stop_test: options.stop_test,
        part_test: None,
        observer: &mut observer,
    };
    let solution = Nlopt.solve(model, &mut job);
    (solution, log)
}

fn solve_with(model: &dyn Model, algorithm: &str) -> Solution {
    solve(model, &Options { algorithm, ..PLAIN }).0
}

#[track_caller]
fn assert_optimum(model: &dyn Model, solution: &Solution, optimum: f64, tolerance: f64) {
    let value = model.objective(&solution.x).unwrap();
    assert!((value - optimum).abs() <= tolerance * optimum.abs().max(1.0), "{value} after {}", solution.message);
    let mut rows = vec![0.0; model.meta().rows()];
    model.constraints(&solution.x, &mut rows).unwrap();
    for (i, row) in rows.iter().enumerate() {
        let (lower, upper) = (model.meta().row_lower[i], model.meta().row_upper[i]);
        assert!((lower - row).max(row - upper) <= tolerance * row.abs(), "row {i} is {row}: {}", solution.message);
    }
}

#[test]
fn algorithms_with_rows_reach_hs71() {
    for (algorithm, tolerance) in [("auto", 1e-9), ("slsqp", 1e-9), ("auglag", 1e-6), ("cobyla", 1e-6), ("isres", 1e-2)] {
        assert_optimum(&hs71(), &solve_with(&hs71(), algorithm), 17.014_017_289_151_34, tolerance);
    }
}

#[test]
fn algorithms_with_inequalities_reach_the_cantilever() {
    let optimum = 0.0624 * [61.0, 37.0, 19.0, 7.0, 1.0_f64].map(|weight| weight.powf(0.25)).iter().sum::<f64>().powf(4.0 / 3.0);
    for (algorithm, tolerance) in [("auto", 1e-9), ("slsqp", 1e-9), ("mma", 1e-7), ("ccsaq", 1e-7)] {
        assert_optimum(&cantilever(), &solve_with(&cantilever(), algorithm), optimum, tolerance);
    }
}

#[test]
fn algorithms_for_bounds_reach_rosenbrock() {
    for algorithm in ["auto", "lbfgs", "tnewton", "var2", "bobyqa", "mlsl"] {
        assert_optimum(&rosenbrock(), &solve_with(&rosenbrock(), algorithm), 0.0, 1e-8);
    }
}

#[test]
fn refusals_name_what_can_take_the_problem() {
    let refusal = Nlopt.refusal("mma", &hs71()).unwrap();
    assert_eq!(refusal, "NLopt: mma takes no equalities, and there are 1; these can take it: slsqp, auglag, cobyla, isres");
    let solution = solve_with(&hs71(), "lbfgs");
    assert_eq!(solution.termination, Termination::Refused);
    assert!(solution.message.contains("takes bounds only, and there are 2 rows"), "{}", solution.message);
    assert!(Nlopt.refusal("simplex", &hs71()).unwrap().contains("is no algorithm"));
    assert_eq!(Nlopt.refusal("auto", &hs71()), None);
}

#[test]
fn dense_algorithms_refuse_what_they_cannot_hold() {
    let (n, m) = (100_000, 100_000);
    let meta =
        Meta { lower: vec![0.0; n], upper: vec![OPEN; n], row_lower: vec![-OPEN; m], row_upper: vec![1.0; m], ..Meta::default() };
    assert_eq!(algorithms::able(&meta), Vec::<&str>::new());
    let free = Meta { row_lower: vec![], row_upper: vec![], ..meta };
    assert_eq!(algorithms::able(&free), ["mma", "ccsaq", "auglag", "lbfgs", "tnewton", "var2"]);
}

#[test]
fn global_algorithms_need_finite_bounds() {
    let open = rosenbrock_within([-OPEN; 2], [OPEN; 2]);
    assert!(Nlopt.refusal("isres", &open).unwrap().contains("2 variables are open on one side"));
    assert_optimum(&open, &solve_with(&open, "auto"), 0.0, 1e-10);
}

#[test]
fn fixed_variables_stay_where_they_are() {
    let fixed = rosenbrock_within([0.5, -2.0], [0.5, 2.0]);
    assert_optimum(&fixed, &solve_with(&fixed, "auto"), 0.25, 1e-12);
    let all = rosenbrock_within([0.5, 1.0], [0.5, 1.0]);
    let solution = solve_with(&all, "slsqp");
    assert_eq!((solution.termination, solution.x), (Termination::Converged, vec![0.5, 1.0]));
}

#[test]
fn the_stop_test_ends_the_run() {
    let near = |x: &[f64]| (x[0] - 1.0).abs() < 1e-3 && (x[1] - 1.0).abs() < 1e-3;
    let (solution, _) = solve(&rosenbrock(), &Options { stop_test: Some(&near), ..PLAIN });
    assert_eq!(solution.termination, Termination::Converged);
    assert!(near(&solution.x));
    assert!(solution.message.contains("passed"), "{}", solution.message);
}

#[test]
fn budgets_and_interrupts_stop_promptly() {
    let budget = Budget { max_evaluations: 7, ..Budget::default() };
    let (solution, log) = solve(&hs71(), &Options { budget, ..PLAIN });
    assert_eq!((solution.termination, solution.evaluations), (Termination::LimitReached, 7));
    assert!(!log.is_empty() && log.len() <= 7);
    let budget = Budget { deadline: Some(Instant::now() + Duration::from_millis(50)), ..Budget::default() };
    let never = |_: &[f64]| false;
    let (solution, _) = solve(&hs71(), &Options { algorithm: "isres", budget, stop_test: Some(&never) });
    assert_eq!(solution.termination, Termination::LimitReached);
    assert!(solution.seconds < 1.0);
    let flag = AtomicBool::new(true);
    let budget = Budget { interrupt: Some(&flag), ..Budget::default() };
    assert_eq!(solve(&hs71(), &Options { budget, ..PLAIN }).0.termination, Termination::Interrupted);
}

#[test]
fn a_run_can_be_repeated() {
    for algorithm in ["auto", "isres"] {
        assert_eq!(solve_with(&hs71(), algorithm).x, solve_with(&hs71(), algorithm).x);
    }
    assert_eq!(solve_with(&rosenbrock(), "mlsl").x, solve_with(&rosenbrock(), "mlsl").x);
}

/// −log x + x on x ≥ 0: full steps leave the domain, the minimum 1 is at 1.
#[test]
fn auto_finds_a_way_round_values_that_are_no_number() {
    for start in [0.0, 1e-8, 40.0] {
        let barrier = Sample::new(&[start], |x| -x[0].ln() + x[0]).bounds(&[0.0], &[50.0]);
        let solution = solve_with(&barrier, "auto");
        assert_optimum(&barrier, &solution, 1.0, 1e-8);
        assert_eq!(solution.invalid, None);
    }
}

#[test]
fn a_model_without_values_is_an_answer_not_a_crash() {
    let nowhere = Sample::new(&[0.0], |x| (-x[0] * x[0] - 1.0).sqrt()).bounds(&[-1.0], &[1.0]);
    let solution = solve_with(&nowhere, "auto");
    assert_eq!(solution.termination, Termination::Failed);
    assert!(solution.invalid.unwrap().contains("objective"));
}

struct Panicking(Sample);

impl Model for Panicking {
    fn meta(&self) -> &Meta {
        self.0.meta()
    }
    fn objective(&self, _: &[f64]) -> Result<f64, EvaluationError> {
        panic!("a bug in a model")
    }
    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        if x == self.0.meta().start { self.0.gradient(x, gradient) } else { panic!("a bug in a model") }
    }
    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.0.constraints(x, values)
    }
    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.0.jacobian(x, values)
    }
    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.0.hessian(x, weight, y, values)
    }
}

#[test]
fn a_panic_inside_a_callback_does_not_cross_the_c_code() {
    let solution = solve_with(&Panicking(rosenbrock()), "lbfgs");
    assert!(solution.message.contains("a bug in a model"), "{}", solution.message);
    assert_eq!(solution.termination, Termination::Failed);
}
