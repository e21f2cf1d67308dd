//! The strategies one by one, on states put where they are called for.

use super::acceptance::{Acceptance, Here};
use super::begin::InitialPoint;
use super::parameters::PARAMETERS;
use super::polish::TrialPolish;
use super::predictor::{Predicted, Predictor};
use super::slack_form::Source;
use super::state::State;
use super::watchdog::{Trial, Watchdog};
use crate::model::Model;
use crate::model::sample::Sample;

fn state(model: &Sample) -> State<'_> {
    State::at_start(Source::Given(model), InitialPoint::at(&model.meta().start)).unwrap()
}

/// min (x − 2)² from 1, without limits: nothing is scaled, and a full step of Newton's ends at 2.
fn parabola() -> Sample {
    Sample::new(&[1.0], |x| (x[0] - 2.0) * (x[0] - 2.0))
}

/// The trial of a step of this length along x.
fn trial(state: &mut State<'_>, watchdog: &mut Watchdog, step: f64) -> Trial {
    state.direction.w[0] = step;
    watchdog.full_step(state, &mut Acceptance::new(0.0)).unwrap()
}

#[test]
fn a_full_step_that_the_filter_takes_ends_the_watchdog() {
    let model = parabola();
    let mut state = state(&model);
    assert!(state.newton_direction().unwrap());
    let mut watchdog = Watchdog::at(&state, Here::of(&state));
    assert_eq!(watchdog.full_step(&mut state, &mut Acceptance::new(0.0)).unwrap(), Trial::Kept(1.0));
    assert!((state.trial.w[0] - 2.0).abs() < 1e-12, "{}", state.trial.w[0]);
}

#[test]
fn full_steps_against_the_filter_are_undone_after_a_few() {
    let model = parabola();
    let mut state = state(&model);
    state.newton_direction().unwrap();
    let mut watchdog = Watchdog::at(&state, Here::of(&state));
    for _ in 0..PARAMETERS.watchdog_trials {
        assert_eq!(trial(&mut state, &mut watchdog, 10.0), Trial::Another(1.0), "uphill, on trial");
        state.take(1.0).unwrap();
    }
    assert_eq!(state.iterate.w[0], 31.0);
    assert_eq!(trial(&mut state, &mut watchdog, 10.0), Trial::Undone);
    assert_eq!(state.iterate.w[0], 1.0, "back where the trials began");
}

#[test]
fn a_full_step_out_of_the_domain_is_undone_at_once() {
    let model = Sample::new(&[1.0], |x| x[0] - num_dual::DualNum::ln(&x[0]));
    let mut state = state(&model);
    state.newton_direction().unwrap();
    let mut watchdog = Watchdog::at(&state, Here::of(&state));
    assert_eq!(trial(&mut state, &mut watchdog, -2.0), Trial::Undone);
}

#[test]
fn the_predictor_solves_a_convex_problem_without_the_filter() {
    let model = Sample::new(&[0.5, 0.5], |x| (x[0] - 2.0) * (x[0] - 2.0) + (x[1] - 0.3) * (x[1] - 0.3))
        .bounds(&[0.0; 2], &[1.0; 2])
        .row(f64::NEG_INFINITY, 1.2, |x| x[0] + x[1]);
    let (mut state, mut predictor) = (state(&model), Predictor::new(true));
    let mut steps = 0;
    while state.errors.largest() > PARAMETERS.epsilon_tol {
        assert_eq!(predictor.step(&mut state).unwrap(), Predicted::Step, "after {steps} steps: {:?}", state.errors);
        steps += 1;
    }
    // min subject to x + y ≤ 1.2 and x ≤ 1: (1, 0.2).
    let x = state.point().x;
    assert!((x[0] - 1.0).abs() < 1e-8 && (x[1] - 0.2).abs() < 1e-8, "{x:?}");
    assert!(steps < 15, "{steps}");
}

#[test]
fn where_the_curvature_is_negative_the_predictor_hands_over_for_good_at_the_best_iterate() {
    let model = Sample::new(&[0.5], |x| -x[0] * x[0] * 10.0).bounds(&[-1.0], &[2.0]);
    let (mut state, mut predictor) = (state(&model), Predictor::new(true));
    let best = state.best.iterate.w[0];
    state.iterate.w[0] = 0.7;
    assert_eq!(predictor.step(&mut state).unwrap(), Predicted::HandedOver);
    assert!(!predictor.is_in_charge());
    assert_eq!(state.iterate.w[0], best);
    assert_eq!(predictor.step(&mut state).unwrap(), Predicted::Nothing);
}

#[test]
fn small_problems_are_left_to_the_filter_from_the_outset() {
    let model = parabola();
    assert_eq!(Predictor::new(false).step(&mut state(&model)).unwrap(), Predicted::Nothing);
    assert!(!TrialPolish::new(false).succeeds(&mut state(&model)).unwrap());
}

/// min (x − 2)² + (y − 0.3)² in the unit square, off the minimum (1, 0.3) by what the barrier leaves.
fn nearly_solved(model: &Sample) -> State<'_> {
    let mut state = state(model);
    let upper = state.form.upper[0];
    (state.iterate.w[0], state.iterate.w[1]) = (upper - 1e-7, 0.3 / state.form.variable_scale[1] + 1e-7);
    state.iterate.evaluate(&mut state.form).unwrap();
    state.iterate.z_lower.fill(0.0);
    state.iterate.z_upper.fill(0.0);
    state.iterate.z_upper[0] = -state.iterate.gradient[0];
    state.forget_best();
    state
}

fn square() -> Sample {
    Sample::new(&[0.5, 0.5], |x| (x[0] - 2.0) * (x[0] - 2.0) + (x[1] - 0.3) * (x[1] - 0.3)).bounds(&[0.0; 2], &[1.0; 2])
}

#[test]
fn the_polish_puts_a_variable_on_its_bound_exactly_and_the_others_right_to_rounding() {
    let model = square();
    let mut state = nearly_solved(&model);
    let before = state.errors.largest();
    assert!(before > 1e-8, "{before}");
    state.polish().unwrap();
    let x = state.point().x;
    assert_eq!(x[0], 1.0);
    assert!((x[1] - 0.3).abs() < 1e-15, "{x:?}");
    assert!(state.errors.largest() < 1e-14, "{:?}", state.errors);
}

#[test]
fn a_polish_on_trial_ends_the_run_where_the_active_set_is_right() {
    let model = square();
    let mut state = nearly_solved(&model);
    assert!(TrialPolish::new(true).succeeds(&mut state).unwrap());
    assert!(state.errors.largest() <= PARAMETERS.epsilon_tol);
    assert_eq!(state.point().x[0], 1.0);
}

#[test]
fn a_point_far_from_optimal_is_not_polished_on_trial() {
    let model = square();
    let mut state = state(&model);
    let there = state.iterate.w.clone();
    assert!(state.errors.largest() > PARAMETERS.polish.first_trial);
    assert!(!TrialPolish::new(true).succeeds(&mut state).unwrap());
    assert_eq!(state.iterate.w, there);
}
