//! The B-spline basis and its derivatives, note (1.5.2) to (1.5.5), by the stable triangular form of Cox–de Boor
//! (Piegl and Tiller, *The NURBS Book*, A2.2 and A2.3).

use super::{KnotVector, SplineError};

/// The basis functions that are not zero at one x: `values[j][i]` is the j-th derivative of basis function `first + i`.
#[derive(Debug, Clone, PartialEq)]
pub struct Support {
    /// Number of the first one, counted from 0.
    pub first: usize,
    /// Rows by order of derivative, degree + 1 functions each.
    pub values: Vec<Vec<f64>>,
}

impl KnotVector {
    /// The degree + 1 basis functions that are not zero at x. They are ≥ 0 and sum to one over the whole domain, right end included.
    ///
    /// The note's recursion (1.5.3) has B_{i+1,k−1} in a denominator, which cannot hold (its terms would not sum to one); the form is
    /// B_{i,k} = (x−t_i)/(t_{i+k−1}−t_i)·B_{i,k−1} + (t_{i+k}−x)/(t_{i+k}−t_{i+1})·B_{i+1,k−1} with 0/0 = 0, order k = degree + 1.
    ///
    /// ```
    /// let knots = ribopt::splines::KnotVector::clamped_uniform(2, 4, 0.0, 2.0)?;
    /// let basis = knots.basis(0.5)?;
    /// assert_eq!((basis.first, basis.values[0].as_slice()), (0, [0.25, 0.625, 0.125].as_slice()));
    /// let end = knots.basis(2.0)?;
    /// assert_eq!((end.first, end.values[0].as_slice()), (1, [0.0, 0.0, 1.0].as_slice()));
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn basis(&self, x: f64) -> Result<Support, SplineError> {
        self.basis_derivatives(x, 0)
    }

    /// The basis functions that are not zero at x and their derivatives up to `order` (zero beyond the degree). At a knot where they jump,
    /// the value from the right is given; at the right end the one from the left.
    ///
    /// ```
    /// let knots = ribopt::splines::KnotVector::clamped_uniform(2, 3, 0.0, 1.0)?; // Bernstein's polynomials
    /// let basis = knots.basis_derivatives(0.5, 2)?;
    /// assert_eq!(basis.values, [[0.25, 0.5, 0.25], [-1.0, 0.0, 1.0], [2.0, -4.0, 2.0]]);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn basis_derivatives(&self, x: f64, order: usize) -> Result<Support, SplineError> {
        let (p, span) = (self.degree(), self.span(x)?);
        let mut values = Vec::with_capacity(order + 1);
        for j in 0..=order {
            values.push(if j <= p { self.derivative_row(x, span, j) } else { vec![0.0; p + 1] });
        }
        Ok(Support { first: span - p, values })
    }

    /// The j-th derivatives at x in this span: values of degree p − j raised j times by
    /// B'_{i,q} = q·(B_{i,q−1}/(t_{i+q}−t_i) − B_{i+1,q−1}/(t_{i+q+1}−t_{i+1})).
    fn derivative_row(&self, x: f64, span: usize, j: usize) -> Vec<f64> {
        let p = self.degree();
        let mut row = vec![1.0];
        for degree in 1..=p {
            row = if degree <= p - j { self.raise(&row, x, span, degree) } else { self.differentiate(&row, span, degree) };
        }
        row
    }

    /// From the functions of degree − 1 to those of `degree`. All divisors hold the span, so none is zero.
    fn raise(&self, lower: &[f64], x: f64, span: usize, degree: usize) -> Vec<f64> {
        let t = self.knots();
        let mut row = vec![0.0; degree + 1];
        for (r, value) in lower.iter().enumerate() {
            let (left, right) = (t[span + r + 1 - degree], t[span + r + 1]);
            let share = value / (right - left);
            row[r] += (right - x) * share;
            row[r + 1] += (x - left) * share;
        }
        row
    }

    fn differentiate(&self, lower: &[f64], span: usize, degree: usize) -> Vec<f64> {
        let t = self.knots();
        let mut row = vec![0.0; degree + 1];
        for (r, value) in lower.iter().enumerate() {
            let slope = degree as f64 * value / (t[span + r + 1] - t[span + r + 1 - degree]);
            row[r] -= slope;
            row[r + 1] += slope;
        }
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn knots() -> impl Strategy<Value = KnotVector> {
        let steps = prop::collection::vec(prop_oneof![Just(0.0), 0.05..1.0f64], 1..6);
        (0usize..5, steps).prop_filter_map("too many repeats", |(degree, steps)| {
            let mut t = vec![0.0; degree + 1];
            let mut last = 0.0;
            for step in steps {
                last += step;
                t.push(last);
            }
            t.extend(vec![last + 0.5; degree + 1]);
            KnotVector::new(degree, t).ok()
        })
    }

    /// The note's recursion, corrected, as it stands (half-open spans, the last one closed).
    fn recursion(t: &[f64], i: usize, k: usize, x: f64) -> f64 {
        if k == 1 {
            let last = x == t[t.len() - 1] && t[i + 1] == x && t[i] < x;
            return if (t[i] <= x && x < t[i + 1]) || last { 1.0 } else { 0.0 };
        }
        let ratio = |upper: f64, lower: f64| if lower == 0.0 { 0.0 } else { upper / lower };
        ratio(x - t[i], t[i + k - 1] - t[i]) * recursion(t, i, k - 1, x)
            + ratio(t[i + k] - x, t[i + k] - t[i + 1]) * recursion(t, i + 1, k - 1, x)
    }

    proptest! {
        #[test]
        fn partition_of_unity_and_the_recursion(knots in knots(), share in 0.0..=1.0f64) {
            let (from, to) = knots.domain();
            let x = from + share * (to - from);
            let basis = knots.basis_derivatives(x, 1).unwrap();
            prop_assert!((basis.values[0].iter().sum::<f64>() - 1.0).abs() < 1e-14);
            prop_assert!(basis.values[0].iter().all(|value| *value >= 0.0));
            let slopes: f64 = basis.values[1].iter().map(|slope| slope.abs()).sum();
            prop_assert!(basis.values[1].iter().sum::<f64>().abs() <= 1e-14 * (1.0 + slopes));
            for i in 0..knots.count() {
                let ours = i.checked_sub(basis.first).and_then(|at| basis.values[0].get(at)).copied().unwrap_or(0.0);
                prop_assert!((ours - recursion(knots.knots(), i, knots.degree() + 1, x)).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn as_scipy() {
        #[derive(serde::Deserialize)]
        struct Case {
            degree: usize,
            knots: Vec<f64>,
            x: Vec<f64>,
            values: Vec<Vec<Vec<f64>>>,
        }
        let cases: Vec<Case> = serde_json::from_str(include_str!("../../tests/data/bspline_basis.json")).unwrap();
        for case in cases {
            let knots = KnotVector::new(case.degree, case.knots).unwrap();
            for (at, x) in case.x.iter().enumerate() {
                let ours = knots.basis_derivatives(*x, case.degree).unwrap();
                for (order, rows) in case.values.iter().enumerate() {
                    let mut full = vec![0.0; knots.count()];
                    full[ours.first..=ours.first + case.degree].copy_from_slice(&ours.values[order]);
                    let size = rows[at].iter().fold(1.0, |size: f64, value| size.max(value.abs()));
                    for (ours, scipy) in full.iter().zip(&rows[at]) {
                        assert!(
                            (ours - scipy).abs() <= 2e-14 * size,
                            "degree {} x {x} order {order}: {ours} {scipy}",
                            case.degree
                        );
                    }
                }
            }
        }
    }

    #[test]
    fn orders_beyond_the_degree_are_zero() {
        let knots = KnotVector::clamped_uniform(1, 2, 0.0, 1.0).unwrap();
        assert_eq!(knots.basis_derivatives(0.5, 3).unwrap().values[2..], [[0.0; 2], [0.0; 2]]);
    }
}
