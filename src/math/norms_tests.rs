use super::*;
use nalgebra::{Complex, dmatrix};
use proptest::prelude::*;

fn complex(entries: &[f64]) -> Vec<Complex<f64>> {
    entries.chunks_exact(2).map(|pair| Complex::new(pair[0], pair[1])).collect()
}

proptest! {
    #[test]
    fn the_two_frobenius_forms_agree(entries in prop::collection::vec(-1e3..1e3f64, 24)) {
        let (real, complex) = (DMatrix::from_row_slice(4, 6, &entries), DMatrix::from_row_slice(3, 4, &complex(&entries)));
        prop_assert!((frobenius(&real) - frobenius_by_trace(&real)).abs() <= 1e-14 * frobenius(&real));
        prop_assert!((frobenius(&complex) - frobenius_by_trace(&complex)).abs() <= 1e-14 * frobenius(&complex));
    }

    #[test]
    fn rank_one_is_where_spectral_equals_frobenius(entries in prop::collection::vec(-1e3..1e3f64, 14)) {
        let (u, v) = entries.split_at(8);
        let (u, v) = (DVector::from_vec(complex(u)), DVector::from_vec(complex(v)));
        let rank_one = &u * v.adjoint();
        prop_assert!((spectral(&rank_one) - frobenius(&rank_one)).abs() <= 1e-13 * frobenius(&rank_one));
        // A second, orthogonal direction makes the difference strict.
        let mut rank_two = rank_one.clone();
        rank_two[(0, 0)] += Complex::new(frobenius(&rank_one), 0.0);
        rank_two[(1, 1)] -= Complex::new(0.0, 2.0 * frobenius(&rank_one));
        prop_assert!(spectral(&rank_two) < frobenius(&rank_two) * (1.0 - 1e-6));
    }

    #[test]
    fn spectral_is_the_largest_eigenvalue(entries in prop::collection::vec(-10.0..10.0f64, 15)) {
        let a = DMatrix::from_row_slice(5, 3, &entries);
        let eigenvalue = (a.transpose() * &a).symmetric_eigenvalues().max();
        prop_assert!((spectral(&a) - eigenvalue.sqrt()).abs() <= 1e-12 * eigenvalue.sqrt());
        prop_assert!((spectral(&a) - spectral(&a.transpose())).abs() <= 1e-12 * spectral(&a));
        prop_assert!(spectral(&a).powi(2) <= one(&a) * infinity(&a) * (1.0 + 1e-12));
    }

    #[test]
    fn norms_are_homogeneous_far_from_one(entries in prop::collection::vec(-1.0..1.0f64, 6), exponent in -900..900i32) {
        let factor = 2f64.powi(exponent);
        let a = DMatrix::from_row_slice(2, 3, &entries);
        for norm in [one, infinity, spectral, frobenius, frobenius_by_trace] as [fn(&DMatrix<f64>) -> f64; 5] {
            prop_assert!((norm(&(&a * factor)) - norm(&a) * factor).abs() <= 1e-13 * norm(&a) * factor);
        }
    }
}

#[test]
fn sums_by_column_and_row_of_a_complex_matrix() {
    let a = dmatrix![Complex::new(3.0, 4.0), Complex::new(0.0, -1.0), Complex::new(20.0, 0.0);
                     Complex::new(0.0, 0.0), Complex::new(5.0, 12.0), Complex::new(1.0, 0.0)];
    assert_eq!(one(&a), 21.0);
    assert_eq!(infinity(&a), 26.0);
}

#[test]
fn far_entries_and_no_numbers() {
    assert_eq!(l2(&[3e-200, 4e-200]), 5e-200);
    assert!((l2(&[5e-324, 5e-324]) - 5e-324).abs() <= 5e-324);
    assert_eq!(l2(&[1.0, f64::INFINITY]), f64::INFINITY);
    assert!(l2(&[f64::INFINITY, f64::NAN]).is_nan());
    assert!(spectral(&dmatrix![f64::NAN, 1.0; 1.0, 1.0]).is_nan());
    assert_eq!(spectral(&DMatrix::<f64>::zeros(2, 3)), 0.0);
    assert_eq!(frobenius(&DMatrix::<f64>::zeros(0, 3)), 0.0);
    assert_eq!(l2::<f64>(&[]), 0.0);
}

#[test]
fn functions_real_complex_large_and_peaked() {
    let real = l2_of_function(|x| x, 0.0, 3.0, 1e-13).unwrap();
    assert!((real.value - 3.0).abs() <= 1e-12);
    let wave = l2_of_function(|x| Complex::from_polar(2.0, 5.0 * x), 0.0, 2.25, 1e-13).unwrap();
    assert!((wave.value - 3.0).abs() <= 1e-12);
    let large = l2_of_function(|x| 1e200 * x, 0.0, 3.0, 1e-13).unwrap();
    assert!((large.value / 3e200 - 1.0).abs() <= 1e-12);
    // ∫ 1/(1e-4 + x²) over −1..1 = 200·atan(100)
    let peak = l2_of_function(|x: f64| (1e-4 + x * x).sqrt().recip(), -1.0, 1.0, 1e-11).unwrap();
    let exact = (200.0 * 100f64.atan()).sqrt();
    assert!((peak.value - exact).abs() <= peak.error.max(1e-11 * exact), "{peak:?} {exact}");
    assert_eq!(l2_of_function(|_| 0.0, 0.0, 1.0, 1e-12).unwrap().value, 0.0);
    assert!(l2_of_function(|x| x, 1.0, 0.0, 1e-12).is_err());
}
