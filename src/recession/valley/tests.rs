//! Valleys that run off, and what is attained.

use num_dual::DualNum;

use super::*;
use crate::model::sample::Sample;

/// Every row held to its lower limit.
fn runs_off(model: &Sample, x: &[f64], multipliers: &[f64], pivot: usize, way: f64) -> bool {
    let mut direction = vec![0.0; x.len()];
    direction[pivot] = way;
    let meta = model.meta();
    let sizes: Vec<f64> = x.iter().map(|x| x.abs().max(1.0)).collect();
    let free: Vec<usize> = (0..x.len()).collect();
    let held: Vec<(usize, f64)> = meta.row_lower.iter().copied().enumerate().collect();
    let is_feasible = |_: &[f64]| true;
    let site = Site { model, x, sizes: &sizes, known: &sizes, free: &free, held: &held, multipliers, is_feasible: &is_feasible };
    Valley::new(site).runs_off(&direction).is_some()
}

#[test]
fn tails_run_off_wherever_the_origin_lies() {
    for shift in [0.0, 4.0, -1e3] {
        let bell = Sample::new(&[1.0, 1.0], move |x| (-(x[0] - shift) * (x[0] - shift)).exp() + x[1] * x[1] - 1.0);
        assert!(runs_off(&bell, &[shift + 6.2, 0.0], &[], 0, 1.0), "{shift}");
        assert!(!runs_off(&bell, &[shift + 6.2, 0.0], &[], 0, -1.0), "{shift}: over the top");
        let asymptote = Sample::new(&[1.0], move |x| ((x[0] - shift) * (x[0] - shift) + 1.0).sqrt() - (x[0] - shift));
        assert!(runs_off(&asymptote, &[shift + 7.06e7], &[], 0, 1.0), "{shift}");
    }
}

#[test]
fn bent_valleys_are_followed() {
    for (shift, unit) in [(0.0, 1.0), (3.0, 1.0), (0.0, 1e-6), (-2.0, 1e6)] {
        let f = move |x: &[crate::model::sample::Value]| {
            let (a, b) = (x[0] - shift, x[1] * unit + shift);
            a * a + (a * b - 1.0).powi(2)
        };
        let valley = Sample::new(&[1.0, 1.0], f);
        let x = [1e-3 + shift, (1e3 - shift) / unit];
        assert!(runs_off(&valley, &x, &[], 1, 1.0), "{shift} {unit}");
    }
    // x² with x·y = 1: y = 1e9, multiplier −2x²·x.
    let row = Sample::new(&[1.0, 1.0], |x| x[0] * x[0]).row(1.0, f64::INFINITY, |x| x[0] * x[1]);
    assert!(runs_off(&row, &[1e-3, 1e3], &[-2e-6], 1, 1.0));
}

#[test]
fn what_is_attained_stays() {
    let level = Sample::new(&[1.0, 1.0], |x| x[1] * x[1]);
    assert!(!runs_off(&level, &[1e6, 0.0], &[], 0, 1.0));
    let far = Sample::new(&[1.0], |x| (-x[0]).exp() + x[0] * x[0] * 1e-20);
    assert!(!runs_off(&far, &[45.0], &[], 0, 1.0));
    let line = Sample::new(&[1.0, 1.0], |x| (x[0] - x[1]).powi(2));
    assert!(!runs_off(&line, &[5.0, 5.0], &[], 0, 1.0));
}

#[test]
fn a_hump_is_found_where_the_variable_comes_from() {
    // At 65 all is level; steps of 14.3·2^k back from there pass over the hump, 12 wide, about 0.
    let bell = Sample::new(&[-7.0, 0.0], |x| (-(x[0] + 8.0).powi(2)).exp() + x[1] * x[1] - 1.0);
    assert!(runs_off(&bell, &[57.2247, 0.0], &[], 0, 1.0));
}

#[test]
fn what_the_start_has_of_digits_is_all_a_valley_has() {
    // y + 16 − 16 is known to the digits of 16: beyond x = 1e7 the floor is lost in them.
    let valley = |x: &[crate::model::sample::Value]| {
        let (a, b) = (x[0] + 3.5, (x[1] + 16.0) - 16.0);
        (a * b - 1.0).powi(2) + b * b
    };
    let valley = Sample::new(&[-1.5, 3.0], valley);
    assert!(runs_off(&valley, &[317_279.0, 1.0 / 317_282.5], &[], 0, 1.0));
}
