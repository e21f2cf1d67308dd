//! Where textbooks assume things away: dependent rows, vertices, saddles, no solution at all.

use num_dual::DualNum;

use super::{FREE, assert_optimum, solve, violation};
use crate::backends::Termination;
use crate::model::Model;
use crate::model::sample::Sample;

#[test]
fn duplicated_rows_and_equalities() {
    let model = Sample::new(&[3.0, -1.0], |x| x[0].powi(2) + x[1].powi(2))
        .row(1.0, 1.0, |x| x[0] + x[1])
        .row(2.0, 2.0, |x| (x[0] + x[1]) * 2.0)
        .row(0.25, FREE, |x| x[0])
        .row(0.25, FREE, |x| x[0]);
    assert_optimum("duplicates", &model, 0.5);
}

#[test]
fn more_equalities_than_variables() {
    let model =
        Sample::new(&[5.0], |x| x[0].powi(2))
            .row(2.0, 2.0, |x| x[0])
            .row(4.0, 4.0, |x| x[0].powi(2))
            .row(8.0, 8.0, |x| x[0].powi(3));
    assert_optimum("overdetermined", &model, 4.0);
}

#[test]
fn fixed_variables_keep_their_value() {
    let model = Sample::new(&[1.0, 3.0, 0.0], |x| (x[0] - x[1]).powi(2) + x[2])
        .bounds(&[-FREE, 3.0, -1.0], &[FREE, 3.0, -1.0])
        .row(-FREE, 7.0, |x| x[0] + x[1]);
    let solution = assert_optimum("fixed", &model, -1.0);
    assert_eq!(solution.x[1..], [3.0, -1.0]);
}

#[test]
fn everything_fixed_and_nothing_constrained() {
    let fixed = Sample::new(&[2.0], |x| x[0].powi(2)).bounds(&[2.0], &[2.0]).row(-FREE, 5.0, |x| x[0]);
    assert_optimum("fixed", &fixed, 4.0);
    let free = Sample::new(&[10.0], |x| (x[0] - 3.0).powi(4));
    let solution = solve(&free);
    assert!((solution.x[0] - 3.0).abs() < 1e-3, "{solution:?}");
}

#[test]
fn linear_program_ends_in_its_vertex() {
    let model = Sample::new(&[1.0, 1.0], |x| -x[0] - x[1] * 2.0)
        .bounds(&[0.0, 0.0], &[FREE, FREE])
        .row(-FREE, 4.0, |x| x[0] + x[1])
        .row(-FREE, 6.0, |x| x[0] + x[1] * 3.0);
    let solution = assert_optimum("lp", &model, -5.0);
    assert!((solution.x[0] - 3.0).abs() < 1e-12 && (solution.x[1] - 1.0).abs() < 1e-12, "{:?}", solution.x);
}

#[test]
fn saddles_and_maxima_are_left() {
    let saddle = Sample::new(&[0.0, 0.0], |x| x[0].powi(2) - x[1].powi(2) + x[1].powi(4));
    assert_optimum("saddle", &saddle, -0.25);
    let maximum = Sample::new(&[0.0], |x| -x[0].powi(2)).bounds(&[-1.0], &[1.0]);
    assert_optimum("maximum", &maximum, -1.0);
    let on_a_circle = Sample::new(&[1.0, 0.0], |x| x[0] * 2.0 + x[1] * 0.0).row(1.0, 1.0, |x| x[0].powi(2) + x[1].powi(2));
    assert_optimum("maximum on a circle", &on_a_circle, -2.0);
}

#[test]
fn infeasible_rows_end_at_the_least_violation() {
    let linear = Sample::new(&[0.0], |x| x[0].powi(2)).row(3.0, FREE, |x| x[0]).row(-FREE, 1.0, |x| x[0]);
    let solution = solve(&linear);
    assert_eq!(solution.termination, Termination::Converged);
    assert!(solution.message.contains("locally infeasible"), "{solution:?}");
    assert!((1.0..=3.0).contains(&solution.x[0]) && violation(&linear, &solution.x) <= 2.0 + 1e-9, "{solution:?}");
    let curved = Sample::new(&[2.0, 2.0], |x| x[0] + x[1]).row(-FREE, -1.0, |x| x[0].powi(2) + x[1].powi(2));
    let solution = solve(&curved);
    assert!(solution.x.iter().all(|x| x.abs() < 1e-5), "{solution:?}");
    assert!(solution.message.contains("locally infeasible"), "{solution:?}");
}

#[test]
fn infeasible_by_a_millionth_is_infeasible() {
    let model = Sample::new(&[0.3, 0.3], |x| x[0]).row(1.0 + 1e-6, FREE, |x| x[0] + x[1]).row(-FREE, 1.0, |x| x[0] + x[1]);
    let solution = solve(&model);
    assert!(violation(&model, &solution.x) > 1e-8);
    assert!(!solution.message.contains("no further progress"), "{solution:?}");
}

#[test]
fn unbounded_objectives_are_told() {
    let model = Sample::new(&[0.0, 0.0], |x| x[0] - x[1]).bounds(&[-FREE, 0.0], &[3.0, FREE]);
    let solution = solve(&model);
    assert!(solution.message.contains("diverge"), "{solution:?}");
    assert!(model.objective(&solution.x).unwrap() < -1e6);
}

#[test]
fn no_interior_between_opposite_rows() {
    let model = Sample::new(&[4.0, 4.0], |x| x[0].powi(2) + x[1].powi(2))
        .row(-FREE, 1.0, |x| x[0] + x[1])
        .row(1.0, FREE, |x| x[0] + x[1]);
    assert_optimum("opposite rows", &model, 0.5);
}

#[test]
fn complementarity_constraints() {
    let model = Sample::new(&[1.0, 1.0], |x| (x[0] - 1.0).powi(2) + (x[1] - 2.0).powi(2)).bounds(&[0.0, 0.0], &[FREE, FREE]).row(
        -FREE,
        0.0,
        |x| x[0] * x[1],
    );
    let solution = solve(&model);
    let objective = model.objective(&solution.x).unwrap();
    // Both (0, 2) and (1, 0) are local minima, and no local solver owes us the lower one.
    assert!((objective - 1.0).abs() < 1e-6 || (objective - 4.0).abs() < 1e-6, "{solution:?}");
    assert!(violation(&model, &solution.x) < 1e-8);
}
