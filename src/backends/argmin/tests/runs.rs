//! Limits, interruption, domains, warm starts, scales.

use std::sync::atomic::AtomicBool;

use num_dual::DualNum;

use super::{FREE, assert_optimum, solve, solve_with};
use crate::backends::argmin::Argmin;
use crate::backends::{Backend, Job, Termination};
use crate::model::sample::Sample;
use crate::model::{Budget, Model};

fn rosenbrock() -> Sample {
    Sample::new(&[-1.2, 1.0], |x| (x[1] - x[0].powi(2)).powi(2) * 100.0 + (-x[0] + 1.0).powi(2))
}

#[test]
fn limits_and_interrupts_hand_back_the_best_point() {
    let model = rosenbrock();
    let few = solve_with(&model, Budget { max_evaluations: 12, ..Budget::default() }, None);
    assert_eq!(few.termination, Termination::LimitReached);
    assert!(few.evaluations <= 12);
    assert!(model.objective(&few.x).unwrap() <= model.objective(&model.meta().start).unwrap());
    let flag = AtomicBool::new(true);
    let interrupted = solve_with(&model, Budget { interrupt: Some(&flag), ..Budget::default() }, None);
    assert_eq!(interrupted.termination, Termination::Interrupted);
    assert_eq!(interrupted.x, model.meta().start);
}

#[test]
fn the_best_point_is_feasible_before_it_is_cheap() {
    let model = Sample::new(&[10.0, 10.0], |x| x[0] + x[1]).row(1.0, FREE, |x| x[0] * x[1]).bounds(&[0.0; 2], &[FREE; 2]);
    let stopped = solve_with(&model, Budget { max_evaluations: 8, ..Budget::default() }, None);
    assert_eq!(stopped.termination, Termination::LimitReached);
    assert!(super::violation(&model, &stopped.x) <= 1e-8, "{stopped:?}");
}

#[test]
fn iterations_are_shown_and_limited() {
    let model = rosenbrock();
    let (mut seen, start) = (Vec::new(), model.meta().start.clone());
    let mut job = Job {
        algorithm: "interior-point",
        start: &start,
        start_multipliers: None,
        optimality_tolerance: 1e-6,
        step_tolerance: 1e-6,
        constraint_tolerance: 1e-8,
        max_iterations: 5,
        budget: Budget::default(),
        stop_test: None,
        part_test: None,
        observer: &mut |iteration| seen.push((iteration.iteration, iteration.objective)),
    };
    let solution = Argmin.solve(&model, &mut job);
    assert_eq!(solution.termination, Termination::LimitReached);
    assert_eq!(solution.iterations, Some(5));
    assert_eq!(seen.iter().map(|(iteration, _)| *iteration).collect::<Vec<_>>(), [0, 1, 2, 3, 4, 5]);
    assert!((seen[0].1 - 24.2).abs() < 1e-12);
}

#[test]
fn unknown_algorithms_are_refused() {
    let model = rosenbrock();
    assert!(Argmin.refusal("simplex", &model).is_some_and(|message| message.contains("interior-point")));
    assert!(Argmin.refusal("auto", &model).is_none());
}

#[test]
fn the_edge_of_the_domain_shortens_steps() {
    let model = Sample::new(&[100.0], |x| x[0] - x[0].ln());
    assert_optimum("log", &model, 1.0);
}

#[test]
fn a_start_outside_the_domain_is_moved_or_named() {
    let model = Sample::new(&[0.0], |x| x[0] - x[0].ln()).bounds(&[-1.0], &[5.0]);
    let solution = solve(&model);
    assert!((solution.x[0] - 1.0).abs() < 1e-9, "{solution:?}");
    let hopeless = Sample::new(&[0.0], |x| (-x[0].powi(2) - 1.0).ln());
    let solution = solve(&hopeless);
    assert_eq!(solution.termination, Termination::Failed);
    assert!(solution.invalid.is_some_and(|term| term.contains("objective")));
    assert_eq!(solution.x, [0.0]);
}

#[test]
fn a_warm_start_takes_few_iterations() {
    let model = |start: [f64; 4]| {
        Sample::new(&start, |x| x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2])
            .bounds(&[1.0; 4], &[5.0; 4])
            .row(25.0, FREE, |x| x[0] * x[1] * x[2] * x[3])
            .row(40.0, 40.0, |x| x[0].powi(2) + x[1].powi(2) + x[2].powi(2) + x[3].powi(2))
    };
    let cold = solve(&model([1.0, 5.0, 5.0, 1.0]));
    let start = [cold.x[0], cold.x[1], cold.x[2], cold.x[3]];
    let warm = solve_with(&model(start), Budget::default(), cold.multipliers.as_deref());
    assert!(warm.iterations < cold.iterations && warm.iterations <= Some(5), "{:?} then {:?}", cold.iterations, warm.iterations);
    assert!(warm.x.iter().zip(&cold.x).all(|(warm, cold)| (warm - cold).abs() < 1e-9));
}

#[test]
fn units_do_not_matter() {
    for unit in [1e-6, 1e-3, 1e3, 1e6] {
        let model = Sample::new(&[3.0 * unit, 2.0 * unit], move |x| x[0] * x[1] * 7.0)
            .bounds(&[0.1 * unit, 0.1 * unit], &[10.0 * unit, 10.0 * unit])
            .row(8.0 * unit.powi(4), FREE, |x| x[0] * x[1].powi(3));
        let solution = solve(&model);
        let optimum = 7.0 * 0.1 * 80f64.cbrt() * unit * unit;
        let objective = model.objective(&solution.x).unwrap();
        assert!((objective / optimum - 1.0).abs() < 1e-9, "unit {unit}: {objective:e} instead of {optimum:e}; {solution:?}");
    }
}

#[test]
fn the_same_job_gives_the_same_bits() {
    let model = rosenbrock();
    let (first, second) = (solve(&model), solve(&model));
    assert_eq!(first.x, second.x);
    assert_eq!(first.evaluations, second.evaluations);
}
