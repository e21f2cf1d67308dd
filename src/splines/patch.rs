//! Bicubic surface patches, note 1.5.3: three bicubic polynomials, one per coordinate, on the unit square.

use super::{SplineError, finite};

/// A patch Σ Σ p_ij b_i(u) b_j(v) with Bernstein's cubic polynomials b and 4×4 control points (a Bézier patch).
#[derive(Debug, Clone, PartialEq)]
pub struct BicubicPatch {
    controls: [[[f64; 3]; 4]; 4],
}

/// What a patch is at one corner: the data of Ferguson's (Hermite's) form.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Corner {
    /// The point.
    pub point: [f64; 3],
    /// ∂/∂u there.
    pub along_u: [f64; 3],
    /// ∂/∂v there.
    pub along_v: [f64; 3],
    /// The twist ∂²/∂u∂v there; zero for a flat twist.
    pub twist: [f64; 3],
}

impl BicubicPatch {
    /// From 4×4 control points, `controls[i][j]` for Bernstein polynomial i in u and j in v. The corners are on the surface.
    ///
    /// ```
    /// use ribopt::splines::BicubicPatch;
    /// let flat = std::array::from_fn(|i| std::array::from_fn(|j| [i as f64, 2.0 * j as f64, 0.0]));
    /// let patch = BicubicPatch::new(flat)?;
    /// assert_eq!(patch.evaluate(0.5, 0.5)?, [1.5, 3.0, 0.0]);
    /// assert_eq!(patch.derivative(0.5, 0.5, [0, 1])?, [0.0, 6.0, 0.0]);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn new(controls: [[[f64; 3]; 4]; 4]) -> Result<Self, SplineError> {
        finite("control coordinate", controls.as_flattened().as_flattened())?;
        Ok(BicubicPatch { controls })
    }

    /// From points, tangents and twists at the four corners, `corners[i][j]` at u = i, v = j. Neighbouring patches with equal corner data
    /// join smoothly.
    ///
    /// ```
    /// use ribopt::splines::BicubicPatch;
    /// let at = |x: f64, y: f64| ribopt::splines::Corner { point: [x, y, 0.0], along_u: [1.0, 0.0, 0.0], along_v: [0.0, 1.0, 0.0], ..Default::default() };
    /// let unit = BicubicPatch::from_corners([[at(0.0, 0.0), at(0.0, 1.0)], [at(1.0, 0.0), at(1.0, 1.0)]])?;
    /// let [x, y, z] = unit.evaluate(0.25, 0.75)?;
    /// assert!((x - 0.25).abs() < 1e-15 && (y - 0.75).abs() < 1e-15 && z == 0.0);
    /// # Ok::<(), ribopt::splines::SplineError>(())
    /// ```
    ///
    /// # Errors
    /// A coordinate that is not finite.
    pub fn from_corners(corners: [[Corner; 2]; 2]) -> Result<Self, SplineError> {
        let control = |i: usize, j: usize| {
            let corner = corners[i / 2][j / 2];
            // Inner control points sit a third of the tangent inwards.
            let inwards = |k: usize| [0.0, 1.0 / 3.0, -1.0 / 3.0, 0.0][k];
            let (a, b) = (inwards(i), inwards(j));
            std::array::from_fn(|d| corner.point[d] + a * corner.along_u[d] + b * corner.along_v[d] + a * b * corner.twist[d])
        };
        Self::new(std::array::from_fn(|i| std::array::from_fn(|j| control(i, j))))
    }

    /// The control points.
    pub fn controls(&self) -> &[[[f64; 3]; 4]; 4] {
        &self.controls
    }

    /// The point at (u, v), both in [0, 1].
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
        let (in_u, in_v) = (bernstein(u, order[0])?, bernstein(v, order[1])?);
        let mut point = [0.0; 3];
        for (a, row) in in_u.iter().zip(&self.controls) {
            for (b, control) in in_v.iter().zip(row) {
                for (sum, coordinate) in point.iter_mut().zip(control) {
                    *sum += a * b * coordinate;
                }
            }
        }
        Ok(point)
    }
}

/// Derivatives of Bernstein's cubic polynomials: values of degree 3 − order, differenced `order` times.
fn bernstein(t: f64, order: usize) -> Result<[f64; 4], SplineError> {
    if !(0.0..=1.0).contains(&t) {
        return Err(SplineError::Outside { x: t, from: 0.0, to: 1.0 });
    }
    let s = 1.0 - t;
    Ok(match order {
        0 => [s * s * s, 3.0 * t * s * s, 3.0 * t * t * s, t * t * t],
        1 => [-3.0 * s * s, 3.0 * s * s - 6.0 * s * t, 6.0 * s * t - 3.0 * t * t, 3.0 * t * t],
        2 => [6.0 * s, 6.0 * t - 12.0 * s, 6.0 * s - 12.0 * t, 6.0 * t],
        3 => [-6.0, 18.0, -18.0, 6.0],
        _ => [0.0; 4],
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::splines::{BSplineSurface, KnotVector};
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn is_the_b_spline_surface_without_inner_knots(net in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 16), u in 0.0..=1.0f64, v in 0.0..=1.0f64) {
            let patch = BicubicPatch::new(std::array::from_fn(|i| std::array::from_fn(|j| net[4 * i + j]))).unwrap();
            let knots = KnotVector::clamped_uniform(3, 4, 0.0, 1.0).unwrap();
            let surface = BSplineSurface::new(knots.clone(), knots, &net.chunks(4).map(<[_]>::to_vec).collect::<Vec<_>>()).unwrap();
            for order in [[0, 0], [1, 0], [0, 1], [1, 1], [2, 0], [3, 1], [4, 0]] {
                let (ours, theirs) = (patch.derivative(u, v, order).unwrap(), surface.derivative(u, v, order).unwrap());
                prop_assert!((0..3).all(|d| (ours[d] - theirs[d]).abs() < 1e-12), "{order:?}");
            }
        }

        #[test]
        fn corner_data_come_back(data in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 16)) {
            let corner = |k: usize| Corner { point: data[k], along_u: data[4 + k], along_v: data[8 + k], twist: data[12 + k] };
            let patch = BicubicPatch::from_corners([[corner(0), corner(1)], [corner(2), corner(3)]]).unwrap();
            for k in 0..4 {
                let (u, v) = ((k / 2) as f64, (k % 2) as f64);
                for (order, expected) in [([0, 0], data[k]), ([1, 0], data[4 + k]), ([0, 1], data[8 + k]), ([1, 1], data[12 + k])] {
                    let ours = patch.derivative(u, v, order).unwrap();
                    prop_assert!((0..3).all(|d| (ours[d] - expected[d]).abs() < 1e-12), "corner {k} {order:?}");
                }
            }
        }
    }

    #[test]
    fn outside_is_an_error() {
        let patch = BicubicPatch::new([[[0.0; 3]; 4]; 4]).unwrap();
        assert!(matches!(patch.evaluate(1.1, 0.0), Err(SplineError::Outside { .. })));
        assert!(matches!(patch.evaluate(0.0, f64::NAN), Err(SplineError::Outside { .. })));
        assert!(BicubicPatch::new([[[f64::NAN; 3]; 4]; 4]).is_err());
    }
}
