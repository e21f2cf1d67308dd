use std::sync::Arc;

use super::*;
use crate::math::split_mix::SplitMix;
use crate::model::Pattern;

/// A ring of variables with two short inequality rows each (over neighbours), and two long rows over all of them, one an equality.
fn ring(variables: usize, active: f64) -> (System, Vec<Option<usize>>) {
    let n = variables;
    let mut hessian: Vec<(u32, u32)> = (0..n as u32).map(|j| (j, j)).chain((1..n as u32).map(|j| (j, j - 1))).collect();
    let rows = 2 * n + 2;
    let mut jacobian = Vec::new();
    for i in 0..2 * n as u32 {
        jacobian.extend([(i, i / 2), (i, (i / 2 + 1) % n as u32)]);
    }
    jacobian.extend((2 * n as u32..rows as u32).flat_map(|i| (0..n as u32).map(move |j| (i, j))));
    let hessian = Pattern::from_positions(n, &mut hessian);
    let jacobian = Pattern::from_positions(rows, &mut jacobian);
    let mut random = SplitMix::new(7);
    let mut some = |count: usize| (0..count).map(|_| random.uniform() - 0.5).collect::<Vec<f64>>();
    let (hessian_values, jacobian_values) = (some(hessian.len()), some(jacobian.len()));
    // Every third row is as good as an equality, every third hardly there.
    let dual = (0..rows).map(|i| if i + 1 == rows { 0.0 } else { [1.0 / active, 1e6, 1.0][i % 3] }).collect();
    let slack = (0..rows).map(|i| (i + 1 < rows).then_some(n + i)).collect();
    let system = System {
        hessian: Arc::new(hessian),
        jacobian: Arc::new(jacobian),
        hessian_values,
        jacobian_values,
        primal: vec![3.0; n],
        dual,
    };
    (system, slack)
}

fn agree(active: f64) {
    let (system, slack) = ring(800, active);
    let mut condensed = Condensed::new(&system, &slack).unwrap();
    let mut full = Full::new(&system).unwrap();
    assert_eq!(condensed.factor(&system, Effort::Any).unwrap(), full.factor(&system).unwrap());
    let right: Vec<f64> = (0..system.order()).map(|k| (k as f64).sin()).collect();
    let (mut x, mut rest) = (vec![0.0; right.len()], right.clone());
    condensed.solve(&system, &right, &mut x).unwrap();
    system.residual(&right, &x, &mut rest);
    assert!(rest.iter().all(|rest| rest.abs() < 1e-9), "{active}");
}

#[test]
fn the_condensed_form_solves_the_whole_system_and_knows_its_inertia() {
    agree(1e3);
}

#[test]
fn limits_that_are_as_good_as_equalities_are_met_by_refinement() {
    agree(1e14);
}

#[test]
fn small_systems_and_long_rows_are_left_alone() {
    let (system, slack) = ring(100, 1.0);
    assert!(Condensed::new(&system, &slack).is_none());
    let (system, _) = ring(800, 1.0);
    assert!(Condensed::new(&system, &vec![None; slack.len().max(1602)]).is_none());
}
