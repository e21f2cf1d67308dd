//! Points whose nature is known by hand.

mod weak_limits;

use super::*;
use crate::model::sample::{Sample, Value};
use num_dual::DualNum;

const INF: f64 = f64::INFINITY;

fn judge(model: &Sample, x: &[f64]) -> Certificate {
    let certificate = certify(model, Class::Nonlinear, x, None, Tolerances::default()).unwrap();
    println!("{x:?}: {certificate:#?}");
    certificate
}

fn disc() -> Sample {
    // min x + y in the unit disc: (−1, −1)/√2, multiplier 1/√2.
    Sample::new(&[0.5, 0.5], |x| x[0] + x[1]).row(-INF, 1.0, |x| x[0] * x[0] + x[1] * x[1])
}

#[test]
fn a_minimum_on_a_circle_passes_and_its_mirror_image_does_not() {
    let s = 0.5f64.sqrt();
    let good = judge(&disc(), &[-s, -s]);
    assert!(good.certified);
    assert!((good.row_multipliers[0] - s).abs() < 1e-12);
    assert_eq!(good.row_sides, [Side::Upper]);
    let maximum = judge(&disc(), &[s, s]);
    assert!(!maximum.certified && maximum.dual_infeasibility > 0.1, "the multiplier has the wrong sign");
    assert!(!judge(&disc(), &[-s * 1.001, -s]).certified, "outside");
    assert!(!judge(&disc(), &[-s * 0.999, -s]).certified, "inside, but complementarity fails");
}

#[test]
fn infeasible_by_a_millionth_is_infeasible() {
    let s = 0.5f64.sqrt() * (1.0 + 1e-6);
    let point = judge(&disc(), &[-s, -s]);
    assert!(!point.certified && point.primal_infeasibility > 5e-7);
}

#[test]
fn a_stationary_maximum_or_saddle_never_passes() {
    let maximum = Sample::new(&[0.0], |x| -(x[0] * x[0]));
    let top = judge(&maximum, &[0.0]);
    assert!(!top.certified && top.negative_curvature && top.sigma == 0.0);
    let saddle = Sample::new(&[1.0, 1.0], |x| x[0] * x[0] - x[1] * x[1]);
    let point = judge(&saddle, &[0.0, 0.0]);
    assert!(point.negative_curvature);
    let escape = point.escape.unwrap();
    assert!(escape[1].abs() > 1e3 * escape[0].abs(), "{escape:?}");
}

#[test]
fn a_maximum_on_a_bound_with_zero_multiplier_does_not_pass() {
    let model = Sample::new(&[1.0], |x| -(x[0] * x[0])).bound(0, 0.0, 2.0);
    let point = judge(&model, &[0.0]);
    assert!(point.negative_curvature && point.escape.as_ref().unwrap()[0] > 0.0);
    assert!(judge(&model, &[2.0]).certified);
    // What rounding has left of a zero says nothing of the variable's size.
    let model = Sample::new(&[3.0, 0.0], |x| (x[0] - 2.0) * (x[0] - 2.0) - x[1] * x[1]).bound(1, 0.0, 2.0);
    for rounding in [0.0, 1e-18, 1e-15, 1e-9] {
        let point = judge(&model, &[2.0, rounding]);
        assert!(point.negative_curvature && point.escape.unwrap()[1] > 0.0);
    }
    // x·y on the quadrant: a minimum at the origin although the Hessian is indefinite.
    let quadrant = Sample::new(&[1.0, 1.0], |x| x[0] * x[1]).bound(0, 0.0, INF).bound(1, 0.0, INF);
    assert!(judge(&quadrant, &[0.0, 0.0]).certified);
}

#[test]
fn a_saddle_on_a_curved_row_is_seen_through_the_lagrangian() {
    // min x on the circle x² + y² = 1: both ends are stationary, one is the maximum.
    let circle = Sample::new(&[0.5, 0.5], |x| x[0]).row(1.0, 1.0, |x| x[0] * x[0] + x[1] * x[1]);
    assert!(judge(&circle, &[-1.0, 0.0]).certified);
    assert!(judge(&circle, &[1.0, 0.0]).negative_curvature);
}

#[test]
fn duplicated_and_redundant_rows_pass_and_say_so() {
    let rib = |x: &[Value]| x[0] * x[1];
    let stress = |x: &[Value]| (x[0] * x[1] * x[1]).recip() * 1e-3;
    let model = Sample::new(&[0.1, 0.3], rib)
        .bound(0, 0.01, 0.5)
        .bound(1, 0.01, 1.0)
        .row(-INF, 1.0, stress)
        .row(-INF, 1.0, stress)
        .row(-INF, 0.0, |x| x[1] - x[0] * 5.0)
        .row(-INF, 5.0, |x| x[1] / x[0]);
    let b = (1e-3f64 / 25.0).cbrt();
    let point = judge(&model, &[b, 5.0 * b]);
    assert!(point.certified && point.multipliers_not_unique);
    assert!(!judge(&model, &[b * 1.001, 5.0 * b]).certified);
}

#[test]
fn an_optimal_face_may_not_be_unique() {
    let model =
        Sample::new(&[0.05, 0.05], |x| x[0] + x[1]).bound(0, 0.01, 0.2).bound(1, 0.01, 0.2).row(0.2, INF, |x| x[0] + x[1]);
    let point = judge(&model, &[0.12, 0.08]);
    assert!(point.certified && point.minimiser_may_not_be_unique && !point.multipliers_not_unique);
}

#[test]
fn where_no_multipliers_exist_nothing_is_certified() {
    // Hock–Schittkowski 13 at its minimiser (1, 0).
    let model = Sample::new(&[0.0, 0.0], |x| (x[0] - 2.0).powi(2) + x[1] * x[1]).bound(0, 0.0, INF).bound(1, 0.0, INF).row(
        0.0,
        INF,
        |x| (-x[0] + 1.0).powi(3) - x[1],
    );
    let point = judge(&model, &[1.0, 0.0]);
    assert!(!point.certified && point.multipliers_not_unique);
    assert!(point.messages.iter().any(|text| text.contains("no multipliers may exist")), "{:?}", point.messages);
}

#[test]
fn a_variable_that_ran_away_is_named() {
    let falling = Sample::new(&[0.0], |x| x[0].exp());
    for x in [-15.0, -40.0, -800.0] {
        let point = judge(&falling, &[x]);
        assert!(!point.certified && (point.runaway == [0] || point.dual_infeasibility > 1e-6), "{x}");
    }
    // By its own size 1/x is as steep at 1e6 as at 1: not even stationary.
    let inverse = Sample::new(&[2.0], |x| x[0].recip()).bound(0, 1.0, INF);
    assert!(judge(&inverse, &[1e6]).dual_infeasibility > 0.1);
    // Far from the start, but attained.
    let far = Sample::new(&[0.0], |x| (x[0] - 1e6).powi(2));
    assert!(judge(&far, &[1e6]).certified);
    let flat = Sample::new(&[4.0, -3.0], |x| (x[0] + x[1] - 2.0).powi(2) + (x[0] - x[1]).powi(4));
    let point = judge(&flat, &[1.0, 1.0]);
    assert!(point.certified && point.minimiser_may_not_be_unique);
}

#[test]
fn what_has_run_away_where_everything_is_level_is_named() {
    // exp(-x) is 0 at 911 and so is its slope; the point passes every other test.
    let lost = Sample::new(&[1.0, 1.0], |x| (-x[0]).exp() + x[1] * x[1]).bound(0, 0.0, INF);
    assert_eq!(judge(&lost, &[911.0, 0.0]).runaway, [0]);
    // Along x·y = 1 and down the valley about it no straight line shows it.
    let row = Sample::new(&[1.0, 1.0], |x| x[0] * x[0]).row(1.0, INF, |x| x[0] * x[1]);
    assert!(!judge(&row, &[1e-9, 1e9]).certified);
    let valley = Sample::new(&[1.0, 1.0], |x| x[0] * x[0] + (x[0] * x[1] - 1.0).powi(2));
    assert!(!judge(&valley, &[1e-6, 1e6]).certified);
    // Cancels to the last digit out there.
    let asymptote = Sample::new(&[0.0], |x| (x[0] * x[0] + 1.0).sqrt() - x[0]);
    assert!(!judge(&asymptote, &[7.06e7]).certified);
    assert!(!judge(&asymptote, &[1e9]).certified);
    // The row is level, not the objective.
    let level_row = Sample::new(&[1.0, 1.0], |x| x[0]).row(0.0, INF, |x| x[0] - (-x[1]).exp());
    assert_eq!(judge(&level_row, &[0.0, 40.0]).runaway, [1]);
    // Far away along a valley that is level all the way: attained.
    let flat = Sample::new(&[1.0, 1.0], |x| x[1] * x[1]);
    assert!(judge(&flat, &[1e6, 0.0]).certified);
}

#[test]
fn flat_to_second_order_a_point_passes_only_where_nothing_falls_beyond() {
    let cubic = Sample::new(&[1.0, 1.0], |x| x[0].powi(3) + x[1] * x[1]);
    for x in [0.0, 1e-9, 1e-5, 3e-4] {
        let point = judge(&cubic, &[x, 0.0]);
        let is_seen = point.descends_at_higher_order && point.escape.as_ref().is_some_and(|escape| escape[0] < 0.0);
        assert!(!point.certified && (is_seen || point.dual_infeasibility > 1e-6), "{x}");
    }
    assert!(judge(&cubic.bound(0, 0.0, INF), &[0.0, 0.0]).certified);
    let monkey = Sample::new(&[0.0, 0.0], |x| x[0].powi(3) - x[0] * x[1] * x[1] * 3.0);
    assert!(judge(&monkey, &[0.0, 0.0]).descends_at_higher_order);
    // Peano: rises along every line, falls along y = 1.5·x².
    let peano = Sample::new(&[0.0, 0.0], |x| (x[1] - x[0] * x[0]) * (x[1] - x[0] * x[0] * 2.0));
    // Found by finite steps, or by following the curve outwards.
    let point = judge(&peano, &[0.0, 0.0]);
    assert!(!point.certified && (point.descends_at_higher_order || !point.runaway.is_empty()));
    // y = x³ is an inflection of the row.
    let row = Sample::new(&[1.0, 1.0], |x| x[1]).row(0.0, INF, |x| x[1] - x[0].powi(3));
    assert!(judge(&row, &[0.0, 0.0]).descends_at_higher_order);
    // Minima, although flat: one by the fourth order, one with a deeper place farther off.
    assert!(judge(&Sample::new(&[1.0, 1.0], |x| x[0].powi(4) + x[1].powi(6)), &[0.0, 0.0]).certified);
    assert!(judge(&Sample::new(&[1.0], |x| x[0].powi(4) - x[0].powi(6)), &[0.0]).certified);
}

#[test]
fn rows_that_contradict_one_another_are_not_met_by_going_far_away() {
    let parallel = Sample::new(&[0.0, 0.0], |x| x[0]).row(1.0, 1.0, |x| x[0] + x[1]).row(1.000_001, 1.000_001, |x| x[0] + x[1]);
    let point = judge(&parallel, &[-1e5, 1e5 + 1.0]);
    assert!(point.feasible_only_at_infinity && point.primal_infeasibility > 1e-8);
    // Rounding of far values is no contradiction.
    let far = Sample::new(&[0.0, 0.0], |x| (x[0] - 4.6e9).powi(2)).row(1.0, 1.0, |x| x[0] - x[1]);
    assert!(judge(&far, &[4.6e9, 4.6e9 - 1.0 + 5e-7]).certified);
    // A slope without end measures nothing.
    let root = Sample::new(&[1.0], |x| x[0]).bound(0, 0.0, INF).row(-INF, -1.0, |x| x[0].sqrt());
    assert!(judge(&root, &[1e-25]).primal_infeasibility > 0.5);
}

#[test]
fn what_rounding_leaves_of_a_zero_makes_no_slope_vanish() {
    let model = Sample::new(&[0.0, 1.0], |x| x[0] + (x[1] - 3.0).powi(2));
    for rounding in [0.0, 1e-17, -1e-12] {
        // The slope 1 over σ = 12.
        assert!(judge(&model, &[rounding, 3.0]).dual_infeasibility > 0.08, "{rounding}");
    }
    assert!(judge(&model.bound(0, 0.0, INF), &[1e-17, 3.0]).certified);
}

#[test]
fn a_slope_without_end_beside_its_limit_makes_no_gap_small() {
    // √(1 − x) at 1 − δ: the slope 1/(2√δ) times the size 1 is so large that the gap, half the objective, seems nothing.
    let root = Sample::new(&[0.5], |x| (-(x[0] - 1.0)).sqrt()).row(-INF, 1.0, |x| x[0]);
    for gap in [1e-8, 1e-10, 1e-12] {
        assert!(!judge(&root, &[1.0 - gap]).certified, "{gap}");
    }
    // A slope that holds to the limit does.
    let line = Sample::new(&[0.5], |x| -x[0]).row(-INF, 1.0, |x| x[0]);
    assert!(judge(&line, &[1.0 - 1e-9]).certified);
}

#[test]
fn units_do_not_matter() {
    // The same cantilever in units a million apart.
    for unit in [1e-6, 1.0, 1e6] {
        let model = Sample::new(&[2.0 * unit, 2.0 * unit], |x| x[0] + x[1])
            .bound(0, 0.1 * unit, INF)
            .bound(1, 0.1 * unit, INF)
            .row(-INF, 1.0, move |x| (x[0] / unit).powi(-3) * 8.0 + (x[1] / unit).powi(-3));
        // Stationarity: 24/x⁴ = 3/y⁴, so x = 8^¼·y, and 8/x³ + 1/y³ = 1.
        let ratio = 8f64.powf(0.25);
        let y = (8.0 / ratio.powi(3) + 1.0).cbrt();
        assert!(judge(&model, &[ratio * y * unit, y * unit]).certified);
        assert!(!judge(&model, &[1.001 * ratio * y * unit, y * unit]).certified);
    }
}

#[test]
fn fixed_variables_and_equalities_need_no_sign() {
    let model =
        Sample::new(&[1.0, 1.0, 1.0], |x| x[0] * x[0] + x[1] * x[1] + x[2]).bound(2, 1.0, 1.0).row(2.0, 2.0, |x| x[0] + x[1]);
    let point = judge(&model, &[1.0, 1.0, 1.0]);
    assert!(point.certified);
    assert_eq!(point.bound_sides[2], Side::Equal);
    assert!((point.bound_multipliers[2] + 1.0).abs() < 1e-12 && (point.row_multipliers[0] + 2.0).abs() < 1e-10);
}

#[test]
fn the_lower_bound_of_a_convex_problem_is_close_and_below() {
    let model = disc().bound(0, -2.0, 2.0).bound(1, -2.0, 2.0);
    let s = 0.5f64.sqrt();
    let bound = lower_bound(&model, &[-s, -s], &[s]).unwrap().unwrap();
    assert!(bound <= -2f64.sqrt() && bound > -2f64.sqrt() - 1e-12, "{bound}");
    let rough = lower_bound(&model, &[-0.7, -0.72], &[0.7]).unwrap().unwrap();
    assert!(rough < -2f64.sqrt() && rough > -1.6, "{rough}");
    assert_eq!(lower_bound(&disc(), &[-0.7, -0.72], &[0.7]).unwrap(), None);
}

#[test]
fn a_search_cut_short_proves_nothing() {
    let flat = Sample::new(&[1.0, 1.0], |x| x[1] * x[1]);
    let judge = |until| Certifier::new(&flat, Class::Nonlinear, Tolerances::default()).with_deadline(until);
    let late = judge(Some(Instant::now())).certify(&[1.0, 0.0], None).unwrap();
    assert!(late.cut_short && !late.certified, "{late:?}");
    assert!(judge(None).certify(&[1.0, 0.0], None).unwrap().certified);
}

#[test]
fn a_slope_that_is_small_only_in_an_invented_unit_is_followed() {
    // x is 1e-7 at the minimum, and nothing tells; there y is 4.
    let model = Sample::new(&[0.0, 3.0], |x| {
        let (a, b) = (x[0] * 1e7 - 1.0, x[1] - 3.0 - x[0] * 1e7);
        a * a + b * b
    });
    let begin = judge(&model, &[0.0, 3.0]);
    assert!(begin.led_on && !begin.certified);
    // A tenth of the way leads to a lower point.
    let there: Vec<f64> = begin.escape.unwrap().iter().zip([0.0, 3.0]).map(|(way, x)| x + 0.1 * way).collect();
    assert!(model.objective(&there).unwrap() < 0.9);
    assert!(judge(&model, &[1e-7, 4.0]).certified);
}

#[test]
fn what_cannot_move_is_no_measure() {
    let beside = |fixed: f64| Sample::new(&[1.0, fixed], |x| x[0] * x[0] + x[1] * 1e9).bound(1, fixed, fixed);
    assert!(!judge(&beside(1.0), &[1e-3, 1.0]).certified);
    assert!(judge(&beside(1.0), &[0.0, 1.0]).certified);
}
