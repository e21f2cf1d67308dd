//! Problems and optima from W. Hock, K. Schittkowski: Test Examples for Nonlinear Programming Codes (1981).

use num_dual::DualNum;

use super::{FREE, assert_optimum};
use crate::model::sample::{Sample, Value};

#[test]
fn hs001_rosenbrock_with_a_bound() {
    let model = Sample::new(&[-2.0, 1.0], |x| (x[1] - x[0].powi(2)).powi(2) * 100.0 + (-x[0] + 1.0).powi(2))
        .bounds(&[-FREE, -1.5], &[FREE, FREE]);
    assert_optimum("hs001", &model, 0.0);
}

#[test]
fn hs005_sine_in_a_box() {
    let model = Sample::new(&[0.0, 0.0], |x| (x[0] + x[1]).sin() + (x[0] - x[1]).powi(2) - x[0] * 1.5 + x[1] * 2.5 + 1.0)
        .bounds(&[-1.5, -3.0], &[4.0, 3.0]);
    assert_optimum("hs005", &model, -(3f64.sqrt()) / 2.0 - std::f64::consts::FRAC_PI_3);
}

#[test]
fn hs006_and_hs008_equalities() {
    let hs006 = Sample::new(&[-1.2, 1.0], |x| (-x[0] + 1.0).powi(2)).row(0.0, 0.0, |x| (x[1] - x[0].powi(2)) * 10.0);
    assert_optimum("hs006", &hs006, 0.0);
    let hs008 =
        Sample::new(&[2.0, 1.0], |_| Value::from_re(-1.0))
            .row(25.0, 25.0, |x| x[0].powi(2) + x[1].powi(2))
            .row(9.0, 9.0, |x| x[0] * x[1]);
    assert_optimum("hs008", &hs008, -1.0);
}

#[test]
fn hs010_one_quadratic_row() {
    let model = Sample::new(&[-10.0, 10.0], |x| x[0] - x[1])
        .row(0.0, FREE, |x| -x[0].powi(2) * 3.0 + x[0] * x[1] * 2.0 - x[1].powi(2) + 1.0);
    assert_optimum("hs010", &model, -1.0);
}

#[test]
fn hs015_rosenbrock_with_rows() {
    let model = Sample::new(&[-2.0, 1.0], |x| (x[1] - x[0].powi(2)).powi(2) * 100.0 + (-x[0] + 1.0).powi(2))
        .bounds(&[-FREE, -FREE], &[0.5, FREE])
        .row(1.0, FREE, |x| x[0] * x[1])
        .row(0.0, FREE, |x| x[0] + x[1].powi(2));
    assert_optimum("hs015", &model, 306.5);
}

#[test]
fn hs023_five_rows() {
    let model = Sample::new(&[3.0, 1.0], |x| x[0].powi(2) + x[1].powi(2))
        .bounds(&[-50.0; 2], &[50.0; 2])
        .row(1.0, FREE, |x| x[0] + x[1])
        .row(1.0, FREE, |x| x[0].powi(2) + x[1].powi(2))
        .row(9.0, FREE, |x| x[0].powi(2) * 9.0 + x[1].powi(2))
        .row(0.0, FREE, |x| x[0].powi(2) - x[1])
        .row(0.0, FREE, |x| x[1].powi(2) - x[0]);
    assert_optimum("hs023", &model, 2.0);
}

#[test]
fn hs026_singular_hessian_at_the_solution() {
    let model = Sample::new(&[-2.6, 2.0, 2.0], |x| (x[0] - x[1]).powi(2) + (x[1] - x[2]).powi(4))
        .row(3.0, 3.0, |x| (x[1].powi(2) + 1.0) * x[0] + x[2].powi(4));
    assert_optimum("hs026", &model, 0.0);
}

#[test]
fn hs030_and_hs038() {
    let hs030 = Sample::new(&[1.0; 3], |x| x[0].powi(2) + x[1].powi(2) + x[2].powi(2))
        .bounds(&[1.0, -10.0, -10.0], &[10.0; 3])
        .row(1.0, FREE, |x| x[0].powi(2) + x[1].powi(2));
    assert_optimum("hs030", &hs030, 1.0);
    let hs038 = Sample::new(&[-3.0, -1.0, -3.0, -1.0], |x| {
        (x[1] - x[0].powi(2)).powi(2) * 100.0
            + (-x[0] + 1.0).powi(2)
            + (x[3] - x[2].powi(2)).powi(2) * 90.0
            + (-x[2] + 1.0).powi(2)
            + ((x[1] - 1.0).powi(2) + (x[3] - 1.0).powi(2)) * 10.1
            + (x[1] - 1.0) * (x[3] - 1.0) * 19.8
    })
    .bounds(&[-10.0; 4], &[10.0; 4]);
    assert_optimum("hs038", &hs038, 0.0);
}

#[test]
fn hs043_rosen_suzuki() {
    let model = Sample::new(&[0.0; 4], |x| {
        x[0].powi(2) + x[1].powi(2) + x[2].powi(2) * 2.0 + x[3].powi(2) - x[0] * 5.0 - x[1] * 5.0 - x[2] * 21.0 + x[3] * 7.0
    })
    .row(-FREE, 8.0, |x| x[0].powi(2) + x[1].powi(2) + x[2].powi(2) + x[3].powi(2) + x[0] - x[1] + x[2] - x[3])
    .row(-FREE, 10.0, |x| x[0].powi(2) + x[1].powi(2) * 2.0 + x[2].powi(2) + x[3].powi(2) * 2.0 - x[0] - x[3])
    .row(-FREE, 5.0, |x| x[0].powi(2) * 2.0 + x[1].powi(2) + x[2].powi(2) + x[0] * 2.0 - x[1] - x[3]);
    let solution = assert_optimum("hs043", &model, -44.0);
    // The known multipliers, in the convention L = f + yᵀc.
    let y = solution.multipliers.unwrap();
    assert!((y[0] - 1.0).abs() < 1e-9 && y[1].abs() < 1e-9 && (y[2] - 2.0).abs() < 1e-9, "{y:?}");
}

#[test]
fn hs061_and_hs063_nonlinear_equalities() {
    let hs061 = Sample::new(&[0.0; 3], |x| {
        x[0].powi(2) * 4.0 + x[1].powi(2) * 2.0 + x[2].powi(2) * 2.0 - x[0] * 33.0 + x[1] * 16.0 - x[2] * 24.0
    })
    .row(7.0, 7.0, |x| x[0] * 3.0 - x[1].powi(2) * 2.0)
    .row(11.0, 11.0, |x| x[0] * 4.0 - x[2].powi(2));
    assert_optimum("hs061", &hs061, -143.646_142_201_031_67);
    let hs063 =
        Sample::new(&[2.0; 3], |x| -x[0].powi(2) - x[1].powi(2) * 2.0 - x[2].powi(2) - x[0] * x[1] - x[0] * x[2] + 1000.0)
            .bounds(&[0.0; 3], &[FREE; 3])
            .row(56.0, 56.0, |x| x[0] * 8.0 + x[1] * 14.0 + x[2] * 7.0)
            .row(25.0, 25.0, |x| x[0].powi(2) + x[1].powi(2) + x[2].powi(2));
    assert_optimum("hs063", &hs063, 961.715_172_130_052_1);
}

#[test]
fn hs071_the_tutorial_problem() {
    let model = Sample::new(&[1.0, 5.0, 5.0, 1.0], |x| x[0] * x[3] * (x[0] + x[1] + x[2]) + x[2])
        .bounds(&[1.0; 4], &[5.0; 4])
        .row(25.0, FREE, |x| x[0] * x[1] * x[2] * x[3])
        .row(40.0, 40.0, |x| x[0].powi(2) + x[1].powi(2) + x[2].powi(2) + x[3].powi(2));
    let solution = assert_optimum("hs071", &model, 17.014_017_289_156_57);
    assert_eq!(solution.x[0], 1.0, "active bounds are met exactly");
}

#[test]
fn hs100_four_rows_in_seven_variables() {
    let model = Sample::new(&[1.0, 2.0, 0.0, 4.0, 0.0, 1.0, 1.0], |x| {
        (x[0] - 10.0).powi(2)
            + (x[1] - 12.0).powi(2) * 5.0
            + x[2].powi(4)
            + (x[3] - 11.0).powi(2) * 3.0
            + x[4].powi(6) * 10.0
            + x[5].powi(2) * 7.0
            + x[6].powi(4)
            - x[5] * x[6] * 4.0
            - x[5] * 10.0
            - x[6] * 8.0
    })
    .row(-FREE, 127.0, |x| x[0].powi(2) * 2.0 + x[1].powi(4) * 3.0 + x[2] + x[3].powi(2) * 4.0 + x[4] * 5.0)
    .row(-FREE, 282.0, |x| x[0] * 7.0 + x[1] * 3.0 + x[2].powi(2) * 10.0 + x[3] - x[4])
    .row(-FREE, 196.0, |x| x[0] * 23.0 + x[1].powi(2) + x[5].powi(2) * 6.0 - x[6] * 8.0)
    .row(-FREE, 0.0, |x| x[0].powi(2) * 4.0 + x[1].powi(2) - x[0] * x[1] * 3.0 + x[2].powi(2) * 2.0 + x[5] * 5.0 - x[6] * 11.0);
    assert_optimum("hs100", &model, 680.630_057_374_402);
}

#[test]
fn hs106_heat_exchanger_badly_scaled() {
    let start = [5000.0, 5000.0, 5000.0, 200.0, 350.0, 150.0, 225.0, 425.0];
    let model = Sample::new(&start, |x| x[0] + x[1] + x[2])
        .bounds(&[100.0, 1000.0, 1000.0, 10.0, 10.0, 10.0, 10.0, 10.0], &[1e4, 1e4, 1e4, 1e3, 1e3, 1e3, 1e3, 1e3])
        .row(-FREE, 1.0, |x| (x[3] + x[5]) * 0.0025)
        .row(-FREE, 1.0, |x| (x[4] + x[6] - x[3]) * 0.0025)
        .row(-FREE, 1.0, |x| (x[7] - x[4]) * 0.01)
        .row(0.0, FREE, |x| x[0] * x[5] - x[3] * 833.33252 - x[0] * 100.0 + 83333.333)
        .row(0.0, FREE, |x| x[1] * x[6] - x[4] * 1250.0 - x[1] * x[3] + x[3] * 1250.0)
        .row(0.0, FREE, |x| x[2] * x[7] - 1_250_000.0 - x[2] * x[4] + x[4] * 2500.0);
    let solution = super::solve(&model);
    // The book's optimum is 7049.3309; more digits from Ipopt with tolerance 1e-12.
    let objective = solution.x[..3].iter().sum::<f64>();
    assert!((objective - 7049.248).abs() < 1e-2, "{objective}: {solution:?}");
    assert!(super::violation(&model, &solution.x) < 1e-6);
}
