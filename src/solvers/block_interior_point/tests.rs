//! The crossover on one component that is known by heart.

use super::arena::{Arena, ComponentIterate};
use super::crossover::Crossover;
use super::frame::Frame;
use super::parameters::PARAMETERS;
use crate::model::Model;
use crate::model::components::{Components, Local, Partition};
use crate::model::sample::Sample;

/// A sample seen as a single component.
struct Whole {
    model: Sample,
    partition: Partition,
}

impl Components for Whole {
    fn partition(&self) -> &Partition {
        &self.partition
    }

    fn constant(&self) -> f64 {
        0.0
    }

    fn local(&self) -> Box<dyn Local + '_> {
        Box::new(Dense(&self.model))
    }

    fn model(&self, _: usize) -> Box<dyn Model + '_> {
        unreachable!("the crossover takes components as they are")
    }
}

struct Dense<'m>(&'m Sample);

impl Local for Dense<'_> {
    fn select(&mut self, _: usize) {}

    fn values(&mut self, x: &[f64], rows: &mut [f64]) -> f64 {
        self.0.constraints(x, rows).unwrap();
        self.0.objective(x).unwrap()
    }

    fn first_order(&mut self, x: &[f64], rows: &mut [f64], gradient: &mut [f64], jacobian: &mut [f64]) -> f64 {
        self.0.constraints(x, rows).unwrap();
        self.0.jacobian(x, jacobian).unwrap();
        self.0.gradient(x, gradient).unwrap()
    }

    fn hessian(&mut self, x: &[f64], weight: f64, y: &[f64], hessian: &mut [f64]) {
        let mut values = vec![0.0; self.0.meta().hessian.len()];
        self.0.hessian(x, weight, y, &mut values).unwrap();
        for (value, (i, j)) in values.iter().zip(self.0.meta().hessian.iter()) {
            hessian[i * x.len() + j] = *value;
        }
    }
}

/// min `sign`·((x − 3)² + (y − 1)²) subject to x + y ≤ 3 within ±10. For sign 1 the minimum is (2.5, 0.5), the row's multiplier 1.
fn whole(sign: f64) -> Whole {
    let objective = move |x: &[_]| ((x[0] - 3.0) * (x[0] - 3.0) + (x[1] - 1.0) * (x[1] - 1.0)) * sign;
    let model = Sample::new(&[1.0, 1.0], objective).bounds(&[-10.0; 2], &[10.0; 2]).row(f64::NEG_INFINITY, 3.0, |x| x[0] + x[1]);
    // A positive limit of a nonlinear row would be taken by its logarithm.
    let model = model.linear();
    let partition = Partition::of_patterns(&model.meta().jacobian, &model.meta().hessian).unwrap();
    Whole { model, partition }
}

/// What the crossover makes of an iterate that `place` has put somewhere: its w and y where it accepts.
fn crossed(whole: &Whole, place: impl Fn(&mut ComponentIterate<'_>)) -> Option<(Vec<f64>, Vec<f64>)> {
    let meta = whole.model.meta();
    let mut arena = Arena::new(&whole.partition, meta, 64);
    let mut iterates = arena.iterates(&whole.partition, |_| true);
    let iterate = &mut iterates[0];
    iterate.row_scale.fill(1.0);
    let mut frame = Frame::new(whole, meta, &meta.start);
    frame.select(iterate);
    place(iterate);
    let accepted = Crossover::default().attempt(&mut frame, iterate);
    accepted.then(|| (iterate.w.to_vec(), iterate.y.to_vec()))
}

#[test]
fn a_limit_whose_multiplier_outweighs_its_slack_is_met_to_the_last_digit() {
    let (w, y) = crossed(&whole(1.0), |iterate| {
        iterate.w.copy_from_slice(&[2.4, 0.55, 2.999]);
        iterate.z_upper[2] = 0.9;
        iterate.y[0] = 0.9;
    })
    .expect("the active set is right");
    for (found, known) in w.iter().zip([2.5, 0.5, 3.0]) {
        assert!((found - known).abs() < 1e-14, "{w:?}");
    }
    // ∂L/∂x = 2(x − 3) + y is what the residual accepted is of.
    assert!((y[0] - 1.0).abs() <= PARAMETERS.accepted, "{y:?}");
}

#[test]
fn an_active_set_that_leaves_out_a_limit_is_refused_and_the_iterate_stays() {
    let start = [2.4, 0.55, 2.9];
    let whole = whole(1.0);
    assert_eq!(crossed(&whole, |iterate| iterate.w.copy_from_slice(&start)), None, "the free minimum (3, 1) violates the row");
}

#[test]
fn a_bound_that_only_a_multiplier_of_the_wrong_sign_would_hold_is_refused() {
    let refused = crossed(&whole(1.0), |iterate| {
        iterate.w.copy_from_slice(&[-9.999, 0.5, -9.0]);
        iterate.z_lower[0] = 1.0;
    });
    assert_eq!(refused, None, "the objective falls into the box");
}

#[test]
fn a_maximum_is_no_answer() {
    assert_eq!(crossed(&whole(-1.0), |iterate| iterate.w.copy_from_slice(&[3.0, 1.0, 2.0])), None);
}
