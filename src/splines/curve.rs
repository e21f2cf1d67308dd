//! B-spline curves by control points, note (1.5.1).

use super::{KnotVector, SplineError, finite};

/// A curve Σ α_i B_i(x) with control points α_i of D coordinates (D = 1: a spline function).
#[derive(Debug, Clone, PartialEq)]
pub struct BSplineCurve<const D: usize> {
    knots: KnotVector,
    controls: Vec<[f64; D]>,
}

impl<const D: usize> BSplineCurve<D> {
    /// From knots and as many control points as there are basis functions.
    ///
    /// ```
    /// use ribopt::splines::{BSplineCurve, KnotVector};
    /// let knots = KnotVector::clamped_uniform(2, 3, 0.0, 1.0)?;
    /// let arch = BSplineCurve::new(knots, vec![[0.0, 0.0], [1.0, 2.0], [2.0, 0.0]])?;
    /// assert_eq!(arch.evaluate(0.5)?, [1.0, 1.0]);
    /// assert_eq!(arch.evaluate(1.0)?, [2.0, 0.0]);
    /// assert_eq!(arch.derivative(0.0, 1)?, [2.0, 4.0]);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// A number of control points that does not fit the knots, or a coordinate that is not finite.
    pub fn new(knots: KnotVector, controls: Vec<[f64; D]>) -> Result<Self, SplineError> {
        let (degree, knots_given) = (knots.degree(), knots.knots().len());
        if controls.len() != knots.count() {
            return Err(SplineError::KnotCount { knots: knots_given, controls: controls.len(), degree });
        }
        finite("control coordinate", controls.as_flattened())?;
        Ok(BSplineCurve { knots, controls })
    }

    /// The knots.
    pub fn knots(&self) -> &KnotVector {
        &self.knots
    }

    /// The control points.
    pub fn controls(&self) -> &[[f64; D]] {
        &self.controls
    }

    /// The point at parameter x. It lies in the hull of degree + 1 control points: bounds on control values bound the curve.
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn evaluate(&self, x: f64) -> Result<[f64; D], SplineError> {
        self.derivative(x, 0)
    }

    /// The derivative of any order at x (order 0: the point).
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn derivative(&self, x: f64, order: usize) -> Result<[f64; D], SplineError> {
        let basis = self.knots.basis_derivatives(x, order)?;
        let near = &self.controls[basis.first..];
        let mut point = [0.0; D];
        for (weight, control) in basis.values[order].iter().zip(near) {
            for (sum, coordinate) in point.iter_mut().zip(control) {
                *sum += weight * coordinate;
            }
        }
        Ok(point)
    }

    /// The same curve with one more knot at x (Boehm 1980): the new control points cut the corners of the old ones.
    ///
    /// ```
    /// use ribopt::splines::{BSplineCurve, KnotVector};
    /// let curve = BSplineCurve::new(KnotVector::clamped_uniform(2, 4, 0.0, 1.0)?, vec![[0.0], [1.0], [3.0], [2.0]])?;
    /// let finer = curve.insert_knot(0.3)?;
    /// assert_eq!(finer.controls().len(), 5);
    /// assert!((finer.evaluate(0.4)?[0] - curve.evaluate(0.4)?[0]).abs() < 1e-15);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// Outside the domain, or a knot that already stands degree + 1 times.
    pub fn insert_knot(&self, x: f64) -> Result<Self, SplineError> {
        let (p, span) = (self.knots.degree(), self.knots.span(x)?);
        let knots = self.knots.with(x)?;
        let t = self.knots.knots();
        let control = |i: usize| {
            // Share of the old control point i in the new one i; the rest is the one before.
            let share = match i {
                _ if i + p <= span => 1.0,
                _ if i > span || t[i + p] == t[i] => 0.0,
                _ => (x - t[i]) / (t[i + p] - t[i]),
            };
            let (here, before) = (self.controls.get(i), i.checked_sub(1).and_then(|at| self.controls.get(at)));
            match (here, before) {
                (Some(here), Some(before)) => std::array::from_fn(|d| share * here[d] + (1.0 - share) * before[d]),
                (Some(only), None) | (None, Some(only)) => *only,
                (None, None) => [0.0; D],
            }
        };
        let controls = (0..=self.controls.len()).map(control).collect();
        Ok(BSplineCurve { knots, controls })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn curve() -> impl Strategy<Value = BSplineCurve<2>> {
        (1usize..5, 0usize..5, prop::collection::vec(prop::array::uniform2(-5.0..5.0f64), 10)).prop_map(
            |(degree, more, points)| {
                let count = degree + 1 + more;
                let knots = KnotVector::clamped_uniform(degree, count, -1.0, 2.0).unwrap();
                BSplineCurve::new(knots, points[..count].to_vec()).unwrap()
            },
        )
    }

    proptest! {
        #[test]
        fn insertion_keeps_the_curve(curve in curve(), at in -1.0..=2.0f64, x in -1.0..=2.0f64, repeats in 1usize..3) {
            let mut finer = curve.clone();
            for _ in 0..repeats.min(curve.knots().degree()) {
                finer = finer.insert_knot(at).unwrap();
            }
            let (before, after) = (curve.evaluate(x).unwrap(), finer.evaluate(x).unwrap());
            prop_assert!((0..2).all(|d| (before[d] - after[d]).abs() < 1e-12), "{before:?} {after:?}");
        }

        #[test]
        fn greville_points_reproduce_lines(degree in 1usize..6, more in 0usize..5, x in 0.0..=1.0f64) {
            let knots = KnotVector::clamped_uniform(degree, degree + 1 + more, 0.0, 1.0).unwrap();
            let controls = knots.greville().iter().map(|g| [3.0 * g - 1.0]).collect();
            let line = BSplineCurve::new(knots, controls).unwrap();
            prop_assert!((line.evaluate(x).unwrap()[0] - (3.0 * x - 1.0)).abs() < 1e-14);
            prop_assert!((line.derivative(x, 1).unwrap()[0] - 3.0).abs() < 1e-12);
        }

        #[test]
        fn control_bounds_bound_the_curve(curve in curve(), x in -1.0..=2.0f64) {
            let point = curve.evaluate(x).unwrap();
            for d in 0..2 {
                let low = curve.controls().iter().map(|c| c[d]).fold(f64::INFINITY, f64::min);
                let high = curve.controls().iter().map(|c| c[d]).fold(f64::NEG_INFINITY, f64::max);
                prop_assert!(low - 1e-14 <= point[d] && point[d] <= high + 1e-14);
            }
        }
    }

    #[test]
    fn ends_take_the_last_knots_too() {
        let curve =
            BSplineCurve::new(KnotVector::clamped_uniform(2, 4, 0.0, 1.0).unwrap(), vec![[0.0], [1.0], [3.0], [2.0]]).unwrap();
        assert!(matches!(curve.insert_knot(1.0), Err(SplineError::FullKnot { count: 3, .. })));
        assert!(matches!(curve.insert_knot(1.5), Err(SplineError::Outside { .. })));
        let open = KnotVector::new(2, (0..8).map(f64::from).collect()).unwrap();
        let curve = BSplineCurve::new(open, vec![[0.0], [1.0], [3.0], [2.0], [5.0]]).unwrap();
        let finer = curve.insert_knot(5.0).unwrap();
        for x in [2.0, 2.7, 4.2, 5.0] {
            assert!((curve.evaluate(x).unwrap()[0] - finer.evaluate(x).unwrap()[0]).abs() < 1e-14);
        }
        let knots = KnotVector::clamped_uniform(1, 2, 0.0, 1.0).unwrap();
        assert!(matches!(BSplineCurve::new(knots, vec![[0.0]; 3]), Err(SplineError::KnotCount { .. })));
    }
}
