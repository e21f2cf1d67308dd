use super::*;
use proptest::prelude::*;

/// Coefficients of a product of (x − root) in exact whole numbers.
fn from_roots(roots: &[i64]) -> Vec<f64> {
    let mut coefficients = vec![1i64];
    for root in roots {
        let mut next = coefficients.clone();
        next.push(0);
        for (at, coefficient) in coefficients.iter().enumerate() {
            next[at + 1] -= root * coefficient;
        }
        coefficients = next;
    }
    coefficients.into_iter().map(|coefficient| coefficient as f64).collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(64))]

    #[test]
    fn whole_roots_of_any_multiplicity_come_out_exactly(mut roots in prop::collection::vec(-40i64..40, 1..=4)) {
        roots.sort_unstable();
        let found = Polynomial::new(&from_roots(&roots)).unwrap().real_roots().unwrap();
        prop_assert_eq!(found, roots.iter().map(|root| *root as f64).collect::<Vec<_>>());
    }

    #[test]
    fn values_vanish_at_all_roots(coefficients in prop::collection::vec(-1e3..1e3f64, 2..=5)) {
        prop_assume!(coefficients[0].abs() > 1e-3);
        let p = Polynomial::new(&coefficients).unwrap();
        let roots = p.roots().unwrap();
        prop_assert_eq!(roots.len(), p.degree());
        for z in &roots {
            let size = coefficients.iter().fold(0.0, |sum, c| sum * z.norm() + c.abs());
            prop_assert!(p.evaluate_complex(*z).norm() <= 1e-14 * size);
            prop_assert!(roots.contains(&z.conj()));
        }
        // Vieta: the sum of the roots.
        let sum: Complex<f64> = roots.iter().sum();
        let size: f64 = roots.iter().map(|root| root.norm()).sum();
        prop_assert!((sum.re + coefficients[1] / coefficients[0]).abs() <= 1e-14 * size && sum.im == 0.0);
    }

    #[test]
    fn derivative_by_central_difference(coefficients in prop::collection::vec(-10.0..10.0f64, 5), x in -2.0..2.0f64) {
        prop_assume!(coefficients[0] != 0.0);
        let p = Polynomial::new(&coefficients).unwrap();
        let difference = (p.evaluate(x + 1e-5) - p.evaluate(x - 1e-5)) / 2e-5;
        prop_assert!((p.derivative().evaluate(x) - difference).abs() < 1e-6);
    }
}

#[test]
fn close_pairs_and_mixed_clusters() {
    let n = 1_048_576.0f64;
    let pair = Polynomial::quadratic(1.0, -(2.0 * n + 1.0), n * (n + 1.0)).unwrap();
    assert_eq!(pair.real_roots().unwrap(), [n, n + 1.0]);
    // x² − 2x + (1 − 2^−52): roots 1 ± 2^−26, where the usual formula keeps half the digits.
    let close = Polynomial::quadratic(1.0, -2.0, 1.0 - f64::EPSILON).unwrap();
    assert_eq!(close.real_roots().unwrap(), [1.0 - 2f64.powi(-26), 1.0 + 2f64.powi(-26)]);
    // A triple root beside a far one.
    let far = Polynomial::new(&from_roots(&[2, 2, 2, 1000])).unwrap();
    assert_eq!(far.real_roots().unwrap(), [2.0, 2.0, 2.0, 1000.0]);
    // (x² + 1)²
    let double = Polynomial::biquadratic(1.0, 2.0, 1.0).unwrap();
    let i = Complex::new(0.0, 1.0);
    assert_eq!(double.roots().unwrap(), [-i, -i, i, i]);
}

#[test]
fn rounded_coefficients_keep_their_own_roots() {
    // Clusters whose coefficients were rounded: mpmath in 80 digits, see tests/data/make_reference.py.
    #[derive(serde::Deserialize)]
    struct Case {
        coefficients: Vec<f64>,
        roots: Vec<[f64; 2]>,
    }
    let cases: Vec<Case> = serde_json::from_str(include_str!("../../../tests/data/polynomials.json")).unwrap();
    for case in cases {
        let roots = Polynomial::new(&case.coefficients).unwrap().roots().unwrap();
        let expected: Vec<_> = case.roots.iter().map(|[re, im]| Complex::new(*re, *im)).collect();
        assert_eq!(roots, expected, "{:?}", case.coefficients);
    }
}

#[test]
fn far_apart_and_at_the_edges_of_range() {
    let p = Polynomial::quadratic(1e-200, 1.0, 1e-200).unwrap();
    let roots = p.real_roots().unwrap();
    assert!((roots[0] / -1e200 - 1.0).abs() < 1e-15 && (roots[1] / -1e-200 - 1.0).abs() < 1e-15);
    assert_eq!(Polynomial::cubic(1.0, 0.0, 0.0, 0.0).unwrap().real_roots().unwrap(), [0.0; 3]);
    assert_eq!(Polynomial::cubic(1.0, -3.0, 0.0, 0.0).unwrap().real_roots().unwrap(), [0.0, 0.0, 3.0]);
    assert!(Polynomial::new(&[7.0]).unwrap().roots().unwrap().is_empty());
    assert!(Polynomial::new(&[0.0]).unwrap().roots().unwrap().is_empty());
    let tiny = Polynomial::quadratic(5e-324, 0.0, -5e-324).unwrap();
    assert_eq!(tiny.real_roots().unwrap(), [-1.0, 1.0]);
}

#[test]
fn bad_coefficients_are_refused() {
    assert_eq!(Polynomial::new(&[]), Err(PolynomialError::Empty));
    assert_eq!(Polynomial::cubic(0.0, 1.0, 1.0, 1.0), Err(PolynomialError::LeadingZero { degree: 3 }));
    assert!(matches!(Polynomial::new(&[1.0, f64::NAN]), Err(PolynomialError::NotFinite { position: 2, .. })));
    let high = Polynomial::new(&[1.0; 40]).unwrap();
    assert_eq!(high.roots(), Err(PolynomialError::DegreeTooHigh { degree: 39, limit: 32 }));
}
