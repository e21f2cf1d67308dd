//! B-spline surfaces: tensor products of two bases over a net of control points.

use super::{KnotVector, SplineError, finite, same_length};

/// A surface Σ Σ c_ij B_i(u) B_j(v) in space.
#[derive(Debug, Clone, PartialEq)]
pub struct BSplineSurface {
    u: KnotVector,
    v: KnotVector,
    /// Row by row: all v of the first u first.
    controls: Vec<[f64; 3]>,
}

impl BSplineSurface {
    /// From knots in u and v and a net of control points, `controls[i][j]` for basis function i in u and j in v.
    ///
    /// ```
    /// use ribopt::splines::{BSplineSurface, KnotVector};
    /// let u = KnotVector::clamped_uniform(2, 3, 0.0, 1.0)?;
    /// let v = KnotVector::clamped_uniform(1, 2, 0.0, 1.0)?;
    /// let vault = BSplineSurface::new(u, v, &[
    ///     vec![[0.0, 0.0, 0.0], [0.0, 4.0, 0.0]],
    ///     vec![[1.0, 0.0, 2.0], [1.0, 4.0, 2.0]],
    ///     vec![[2.0, 0.0, 0.0], [2.0, 4.0, 0.0]]])?;
    /// assert_eq!(vault.evaluate(0.5, 0.5)?, [1.0, 2.0, 1.0]);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// A net that does not fit the knots, or a coordinate that is not finite.
    pub fn new(u: KnotVector, v: KnotVector, controls: &[Vec<[f64; 3]>]) -> Result<Self, SplineError> {
        same_length("rows of the control net", u.count(), controls.len())?;
        for row in controls {
            same_length("a row of the control net", v.count(), row.len())?;
            finite("control coordinate", row.as_flattened())?;
        }
        Ok(BSplineSurface { u, v, controls: controls.concat() })
    }

    /// Knots in u and in v.
    pub fn knots(&self) -> (&KnotVector, &KnotVector) {
        (&self.u, &self.v)
    }

    /// The point at (u, v).
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn evaluate(&self, u: f64, v: f64) -> Result<[f64; 3], SplineError> {
        self.derivative(u, v, [0, 0])
    }

    /// A partial derivative at (u, v): `order` = times by u, times by v.
    ///
    /// # Errors
    /// [`SplineError::Outside`].
    pub fn derivative(&self, u: f64, v: f64, order: [usize; 2]) -> Result<[f64; 3], SplineError> {
        let (in_u, in_v) = (self.u.basis_derivatives(u, order[0])?, self.v.basis_derivatives(v, order[1])?);
        let mut point = [0.0; 3];
        for (i, a) in in_u.values[order[0]].iter().enumerate() {
            let row = &self.controls[(in_u.first + i) * self.v.count() + in_v.first..];
            for (b, control) in in_v.values[order[1]].iter().zip(row) {
                for (sum, coordinate) in point.iter_mut().zip(control) {
                    *sum += a * b * coordinate;
                }
            }
        }
        Ok(point)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn surface(net: &[[f64; 3]]) -> BSplineSurface {
        let u = KnotVector::clamped_uniform(3, 5, 0.0, 2.0).unwrap();
        let v = KnotVector::clamped_uniform(2, 4, -1.0, 1.0).unwrap();
        BSplineSurface::new(u, v, &net.chunks(4).map(<[_]>::to_vec).collect::<Vec<_>>()).unwrap()
    }

    proptest! {
        #[test]
        fn derivatives_by_differences(net in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 20), u in 0.01..1.99f64, v in -0.99..0.99f64) {
            let (surface, step) = (surface(&net), 1e-6);
            prop_assume!([u - 1.0, v].iter().all(|knot| knot.abs() > 2.0 * step));
            let by_u = [surface.evaluate(u + step, v).unwrap(), surface.evaluate(u - step, v).unwrap()];
            let by_v = [surface.derivative(u, v + step, [1, 0]).unwrap(), surface.derivative(u, v - step, [1, 0]).unwrap()];
            for d in 0..3 {
                let difference = (by_u[0][d] - by_u[1][d]) / (2.0 * step);
                prop_assert!((surface.derivative(u, v, [1, 0]).unwrap()[d] - difference).abs() < 1e-7);
                let mixed = (by_v[0][d] - by_v[1][d]) / (2.0 * step);
                prop_assert!((surface.derivative(u, v, [1, 1]).unwrap()[d] - mixed).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn corners_and_bad_nets() {
        let net: Vec<[f64; 3]> = (0..20).map(|k| [f64::from(k), 0.5 * f64::from(k), 1.0]).collect();
        let surface = surface(&net);
        assert_eq!(surface.evaluate(0.0, -1.0).unwrap(), net[0]);
        assert_eq!(surface.evaluate(2.0, 1.0).unwrap(), net[19]);
        assert!(matches!(surface.evaluate(2.1, 0.0), Err(SplineError::Outside { .. })));
        let knots = KnotVector::clamped_uniform(1, 2, 0.0, 1.0).unwrap();
        let short = [vec![[0.0; 3]; 2], vec![[0.0; 3]; 1]];
        assert!(matches!(
            BSplineSurface::new(knots.clone(), knots, &short),
            Err(SplineError::Length { expected: 2, found: 1, .. })
        ));
    }
}
