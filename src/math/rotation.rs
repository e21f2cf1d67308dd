//! Rotation matrices in the plane and in space, note 1.6 and 1.7. Angles in radians, anticlockwise, acting on column vectors.

use nalgebra::{Matrix2, Matrix3, Rotation2, Rotation3, Unit, Vector3};

/// Rotation of the plane by θ, note (1.6.1).
///
/// ```
/// let turned = ribopt::math::rotation::plane(std::f64::consts::FRAC_PI_6) * nalgebra::vector![1.0, 0.0];
/// assert!((turned.y - 0.5).abs() < 1e-15);
/// ```
pub fn plane(theta: f64) -> Matrix2<f64> {
    Rotation2::new(theta).into_inner()
}

/// Rotation of the plane by n right angles, exact: the note's 90°, 180° and 270° (1.6.1). Negative n turns clockwise.
///
/// ```
/// use nalgebra::matrix;
/// use ribopt::math::rotation::quarter_turns;
/// assert_eq!(quarter_turns(1), matrix![0.0, -1.0; 1.0, 0.0]);
/// assert_eq!(quarter_turns(2), matrix![-1.0, 0.0; 0.0, -1.0]);
/// assert_eq!(quarter_turns(3), matrix![0.0, 1.0; -1.0, 0.0]);
/// ```
pub fn quarter_turns(n: i32) -> Matrix2<f64> {
    match n.rem_euclid(4) {
        0 => Matrix2::new(1.0, 0.0, 0.0, 1.0),
        1 => Matrix2::new(0.0, -1.0, 1.0, 0.0),
        2 => Matrix2::new(-1.0, 0.0, 0.0, -1.0),
        _ => Matrix2::new(0.0, 1.0, -1.0, 0.0),
    }
}

/// Rotation of space about the x axis by θ (note 1.7): y turns towards z.
///
/// ```
/// let turned = ribopt::math::rotation::about_x(std::f64::consts::FRAC_PI_2) * nalgebra::vector![0.0, 1.0, 0.0];
/// assert!((turned - nalgebra::vector![0.0, 0.0, 1.0]).norm() < 1e-15);
/// ```
pub fn about_x(theta: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Vector3::x_axis(), theta).into_inner()
}

/// Rotation of space about the y axis by θ (note 1.7): z turns towards x.
///
/// ```
/// let turned = ribopt::math::rotation::about_y(std::f64::consts::FRAC_PI_2) * nalgebra::vector![0.0, 0.0, 1.0];
/// assert!((turned - nalgebra::vector![1.0, 0.0, 0.0]).norm() < 1e-15);
/// ```
pub fn about_y(theta: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Vector3::y_axis(), theta).into_inner()
}

/// Rotation of space about the z axis by θ (note 1.7): x turns towards y, as the note's example (1.7.1) checks.
///
/// ```
/// let turned = ribopt::math::rotation::about_z(std::f64::consts::FRAC_PI_2) * nalgebra::vector![1.0, 0.0, 0.0];
/// assert!((turned - nalgebra::vector![0.0, 1.0, 0.0]).norm() < 1e-15);
/// ```
pub fn about_z(theta: f64) -> Matrix3<f64> {
    Rotation3::from_axis_angle(&Vector3::z_axis(), theta).into_inner()
}

/// Rotation of space about any axis by θ, right-hand rule. The axis may have any length; `None` where it is zero or not finite.
///
/// ```
/// use ribopt::math::rotation::about_axis;
/// // A third of a turn about the space diagonal takes x to y, y to z, z to x.
/// let turn = about_axis([1.0, 1.0, 1.0], 2.0 * std::f64::consts::PI / 3.0).unwrap();
/// assert!((turn * nalgebra::vector![1.0, 0.0, 0.0] - nalgebra::vector![0.0, 1.0, 0.0]).norm() < 1e-15);
/// assert!(about_axis([0.0, 0.0, 0.0], 1.0).is_none());
/// ```
pub fn about_axis(axis: [f64; 3], theta: f64) -> Option<Matrix3<f64>> {
    let largest = axis.iter().fold(0.0f64, |largest, entry| largest.max(entry.abs()));
    if !(largest > 0.0 && axis.iter().all(|entry| entry.is_finite())) {
        return None;
    }
    let axis = Unit::new_normalize(Vector3::from(axis) / largest);
    Some(Rotation3::from_axis_angle(&axis, theta).into_inner())
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn printed(theta: f64) -> [Matrix3<f64>; 3] {
        let (s, c) = theta.sin_cos();
        [
            Matrix3::new(1.0, 0.0, 0.0, 0.0, c, -s, 0.0, s, c),
            Matrix3::new(c, 0.0, s, 0.0, 1.0, 0.0, -s, 0.0, c),
            Matrix3::new(c, -s, 0.0, s, c, 0.0, 0.0, 0.0, 1.0),
        ]
    }

    proptest! {
        #[test]
        fn the_printed_matrices(theta in -10.0..10.0f64) {
            let [x, y, z] = printed(theta);
            prop_assert!((about_x(theta) - x).norm() < 1e-15);
            prop_assert!((about_y(theta) - y).norm() < 1e-15);
            prop_assert!((about_z(theta) - z).norm() < 1e-15);
            prop_assert!((plane(theta) - z.fixed_view::<2, 2>(0, 0)).norm() < 1e-15);
        }

        #[test]
        fn orthogonal_and_proper_about_any_axis(axis in prop::array::uniform3(-1e3..1e3f64), theta in -10.0..10.0f64) {
            prop_assume!(axis.iter().any(|entry| entry.abs() > 1e-3));
            let turn = about_axis(axis, theta).unwrap();
            prop_assert!((turn * turn.transpose() - Matrix3::identity()).norm() < 1e-14);
            prop_assert!((turn.determinant() - 1.0).abs() < 1e-14);
            let axis = Vector3::from(axis);
            prop_assert!((turn * axis - axis).norm() <= 1e-14 * axis.norm());
        }
    }

    #[test]
    fn right_angles_agree_with_the_general_form() {
        for n in -5..=5 {
            assert!((quarter_turns(n) - plane(f64::from(n) * std::f64::consts::FRAC_PI_2)).norm() < 1e-15);
        }
        assert!(about_axis([f64::NAN, 1.0, 0.0], 1.0).is_none());
        assert!(about_axis([1e300, 1e300, 0.0], 1.0).is_some());
        assert!(about_axis([1e-300, 0.0, 0.0], 1.0).is_some());
    }
}
