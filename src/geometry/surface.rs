//! Surfaces given by two parameters, note 3.4: tangents, normal, area element, first fundamental form.

use nalgebra::Vector3;

use crate::math::norms;
use crate::splines::{BSplineSurface, BicubicInterpolant, BicubicPatch, SplineError};

/// Why a surface has no value there.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SurfaceError {
    /// A parameter lies outside the domain.
    #[error(transparent)]
    Outside(#[from] SplineError),
    /// The tangents are parallel or zero: there is no normal.
    #[error("the surface has no normal at u = {u}, v = {v}: its tangents are parallel there")]
    NoNormal {
        /// First parameter.
        u: f64,
        /// Second parameter.
        v: f64,
    },
}

/// Coefficients of E du² + 2F du dv + G dv², the squared length of a step on the surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct FirstFundamentalForm {
    /// T_u·T_u
    pub e: f64,
    /// T_u·T_v
    pub f: f64,
    /// T_v·T_v
    pub g: f64,
}

/// A surface x(u, v), y(u, v), z(u, v), note (3.4.1) to (3.4.3).
///
/// ```
/// use ribopt::geometry::Surface;
/// use ribopt::splines::{BSplineSurface, KnotVector};
/// let line = KnotVector::clamped_uniform(1, 2, 0.0, 1.0)?;
/// // The plane z = y over 2 × 3.
/// let plane = BSplineSurface::new(line.clone(), line, &[
///     vec![[0.0, 0.0, 0.0], [0.0, 3.0, 3.0]],
///     vec![[2.0, 0.0, 0.0], [2.0, 3.0, 3.0]]])?;
/// let [t_u, t_v] = plane.tangents(0.3, 0.4)?;
/// assert_eq!(t_u, [2.0, 0.0, 0.0]);
/// assert!((t_v[1] - 3.0).abs() < 1e-15 && (t_v[2] - 3.0).abs() < 1e-15);
/// assert!((plane.area_element(0.3, 0.4)? - 6.0 * 2f64.sqrt()).abs() < 1e-14);
/// let normal = plane.normal(0.3, 0.4)?;
/// assert!((normal[2] - 0.5f64.sqrt()).abs() < 1e-15 && normal[1] < 0.0);
/// # Ok::<(), ribopt::geometry::surface::SurfaceError>(())
/// ```
pub trait Surface {
    /// The point at (u, v).
    ///
    /// # Errors
    /// [`SurfaceError::Outside`].
    fn point(&self, u: f64, v: f64) -> Result<[f64; 3], SurfaceError>;

    /// The tangent vectors T_u and T_v at (u, v), as the note prints them.
    ///
    /// # Errors
    /// [`SurfaceError::Outside`].
    fn tangents(&self, u: f64, v: f64) -> Result<[[f64; 3]; 2], SurfaceError>;

    /// T_u × T_v: its direction is the normal, its length the area element.
    ///
    /// # Errors
    /// [`SurfaceError::Outside`].
    fn normal_vector(&self, u: f64, v: f64) -> Result<[f64; 3], SurfaceError> {
        let [t_u, t_v] = self.tangents(u, v)?.map(Vector3::from);
        Ok(t_u.cross(&t_v).into())
    }

    /// The unit normal T_u × T_v/‖T_u × T_v‖ (the note stops at the tangents).
    ///
    /// # Errors
    /// [`SurfaceError::Outside`], or [`SurfaceError::NoNormal`] where the tangents are parallel to rounding.
    fn normal(&self, u: f64, v: f64) -> Result<[f64; 3], SurfaceError> {
        let tangents = self.tangents(u, v)?;
        let (normal, [a, b]) = (self.normal_vector(u, v)?, tangents.map(|tangent| norms::l2(&tangent)));
        let length = norms::l2(&normal);
        if length > 4.0 * f64::EPSILON * a * b {
            Ok(normal.map(|part| part / length))
        } else {
            Err(SurfaceError::NoNormal { u, v })
        }
    }

    /// The area element ‖T_u × T_v‖: area of the surface per area in the parameters.
    ///
    /// # Errors
    /// [`SurfaceError::Outside`].
    fn area_element(&self, u: f64, v: f64) -> Result<f64, SurfaceError> {
        Ok(norms::l2(&self.normal_vector(u, v)?))
    }

    /// The first fundamental form at (u, v); E·G − F² is the area element squared.
    ///
    /// # Errors
    /// [`SurfaceError::Outside`].
    fn first_fundamental_form(&self, u: f64, v: f64) -> Result<FirstFundamentalForm, SurfaceError> {
        let [t_u, t_v] = self.tangents(u, v)?.map(Vector3::from);
        Ok(FirstFundamentalForm { e: t_u.dot(&t_u), f: t_u.dot(&t_v), g: t_v.dot(&t_v) })
    }
}

impl Surface for BSplineSurface {
    fn point(&self, u: f64, v: f64) -> Result<[f64; 3], SurfaceError> {
        Ok(self.evaluate(u, v)?)
    }

    fn tangents(&self, u: f64, v: f64) -> Result<[[f64; 3]; 2], SurfaceError> {
        Ok([self.derivative(u, v, [1, 0])?, self.derivative(u, v, [0, 1])?])
    }
}

impl Surface for BicubicPatch {
    fn point(&self, u: f64, v: f64) -> Result<[f64; 3], SurfaceError> {
        Ok(self.evaluate(u, v)?)
    }

    fn tangents(&self, u: f64, v: f64) -> Result<[[f64; 3]; 2], SurfaceError> {
        Ok([self.derivative(u, v, [1, 0])?, self.derivative(u, v, [0, 1])?])
    }
}

/// The heights over the plane: x = u, y = v.
impl Surface for BicubicInterpolant {
    fn point(&self, u: f64, v: f64) -> Result<[f64; 3], SurfaceError> {
        Ok([u, v, self.evaluate(u, v)?])
    }

    fn tangents(&self, u: f64, v: f64) -> Result<[[f64; 3]; 2], SurfaceError> {
        let [dx, dy] = self.gradient(u, v)?;
        Ok([[1.0, 0.0, dx], [0.0, 1.0, dy]])
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::math::integrate;
    use crate::splines::KnotVector;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn lagrange_identity_and_right_angles(net in prop::collection::vec(prop::array::uniform3(-1.0..1.0f64), 16), u in 0.0..=1.0f64, v in 0.0..=1.0f64) {
            let patch = BicubicPatch::new(std::array::from_fn(|i| std::array::from_fn(|j| net[4 * i + j]))).unwrap();
            let form = patch.first_fundamental_form(u, v).unwrap();
            let area = patch.area_element(u, v).unwrap();
            prop_assert!((form.e * form.g - form.f * form.f - area * area).abs() <= 1e-12 * (1.0 + form.e * form.g));
            if let Ok(normal) = patch.normal(u, v) {
                prop_assume!(area > 1e-3);
                for tangent in patch.tangents(u, v).unwrap() {
                    prop_assert!(Vector3::from(normal).dot(&Vector3::from(tangent)).abs() < 1e-11);
                }
                prop_assert!((norms::l2(&normal) - 1.0).abs() < 1e-14);
            }
        }
    }

    #[test]
    fn area_of_a_paraboloid_by_its_element() {
        // z = (x² + y²)/2 over the unit square: ∫∫ √(1 + x² + y²).
        let grid = [0.0, 0.25, 0.5, 1.0];
        let z: Vec<Vec<f64>> = grid.iter().map(|x| grid.iter().map(|y| 0.5 * (x * x + y * y)).collect()).collect();
        let bowl = BicubicInterpolant::new(&grid, &grid, &z).unwrap();
        let strip = |u: f64| integrate(|v| bowl.area_element(u, v).unwrap(), 0.0, 1.0, 1e-12).unwrap().value;
        let area = integrate(strip, 0.0, 1.0, 1e-11).unwrap().value;
        let exact = integrate(|u| integrate(|v| (1.0 + u * u + v * v).sqrt(), 0.0, 1.0, 1e-12).unwrap().value, 0.0, 1.0, 1e-11);
        assert!((area - exact.unwrap().value).abs() < 1e-12);
        let normal = bowl.normal(0.5, 0.5).unwrap();
        assert!((normal[0] + normal[1] + 1.0 / 1.5f64.sqrt()).abs() < 1e-12);
    }

    #[test]
    fn a_folded_surface_has_no_normal() {
        let line = KnotVector::clamped_uniform(1, 2, 0.0, 1.0).unwrap();
        let folded =
            BSplineSurface::new(line.clone(), line, &[vec![[0.0; 3], [1.0, 1.0, 0.0]], vec![[1.0, 1.0, 0.0], [2.0, 2.0, 0.0]]])
                .unwrap();
        assert!(matches!(folded.normal(0.5, 0.5), Err(SurfaceError::NoNormal { .. })));
        assert_eq!(folded.area_element(0.5, 0.5).unwrap(), 0.0);
        assert!(matches!(folded.point(1.5, 0.0), Err(SurfaceError::Outside(_))));
    }
}
