//! Determinants as signed areas and volumes, note 1.3.

use nalgebra::{DMatrix, Matrix2, Matrix3};

/// A determinant or an inverse was asked of a matrix that has none.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
pub enum DeterminantError {
    /// Only square matrices have a determinant.
    #[error("a {rows}×{columns} matrix has no determinant; give a square one")]
    NotSquare {
        /// Its rows.
        rows: usize,
        /// Its columns.
        columns: usize,
    },
    /// The determinant is zero (to working precision), so there is no inverse.
    #[error("the matrix is singular: its determinant is zero, so it has no inverse")]
    Singular,
}

/// Signed area of the parallelogram spanned by `v1 = (a, b)` and `v2 = (c, d)`, note (1.3.1) and (1.3.2): `ad − bc`,
/// positive where `v2` lies anticlockwise of `v1`.
///
/// The vectors are the *rows* of the matrix. The note's text says columns, `v1 = (a, c)`, which does not fit its own
/// vertices (a, b), (c, d) nor its product `(−b, a)·(c, d)`.
///
/// ```
/// assert_eq!(ribopt::math::signed_area([3.0, 1.0], [1.0, 2.0]), 5.0);
/// assert_eq!(ribopt::math::signed_area([1.0, 2.0], [3.0, 1.0]), -5.0);
/// ```
pub fn signed_area(v1: [f64; 2], v2: [f64; 2]) -> f64 {
    Matrix2::from_row_slice(&[v1, v2].concat()).determinant()
}

/// Signed volume of the parallelepiped spanned by three vectors, the rows of the note's (1.3.3); positive for a right-handed triple.
///
/// ```
/// assert_eq!(ribopt::math::signed_volume([2.0, 0.0, 0.0], [0.0, 3.0, 0.0], [1.0, 1.0, 4.0]), 24.0);
/// ```
pub fn signed_volume(u: [f64; 3], v: [f64; 3], w: [f64; 3]) -> f64 {
    Matrix3::from_row_slice(&[u, v, w].concat()).determinant()
}

/// Determinant of an n×n matrix: the signed volume of the n-dimensional parallelepiped spanned by its rows (note 1.3). By LU.
///
/// ```
/// use nalgebra::dmatrix;
/// let a = dmatrix![2.0, 1.0, 0.0, 0.0; 1.0, 2.0, 1.0, 0.0; 0.0, 1.0, 2.0, 1.0; 0.0, 0.0, 1.0, 2.0];
/// assert!((ribopt::math::determinant(&a)? - 5.0).abs() < 1e-14);
/// # Ok::<(), ribopt::math::determinant::DeterminantError>(())
/// ```
///
/// # Errors
/// [`DeterminantError::NotSquare`].
pub fn determinant(a: &DMatrix<f64>) -> Result<f64, DeterminantError> {
    square(a)?;
    Ok(if a.is_empty() { 1.0 } else { a.determinant() })
}

/// The inverse of a *square* matrix whose determinant is not zero (the note's 1.3 says "any matrix"; an m×n one has none).
///
/// ```
/// use nalgebra::dmatrix;
/// let a = dmatrix![4.0, 7.0; 2.0, 6.0];
/// let inverse = ribopt::math::inverse(&a)?;
/// assert!((a * inverse - nalgebra::DMatrix::identity(2, 2)).norm() < 1e-14);
/// # Ok::<(), ribopt::math::determinant::DeterminantError>(())
/// ```
///
/// # Errors
/// [`DeterminantError::NotSquare`], [`DeterminantError::Singular`].
pub fn inverse(a: &DMatrix<f64>) -> Result<DMatrix<f64>, DeterminantError> {
    square(a)?;
    a.clone().try_inverse().filter(|inverse| inverse.iter().all(|entry| entry.is_finite())).ok_or(DeterminantError::Singular)
}

fn square(a: &DMatrix<f64>) -> Result<(), DeterminantError> {
    let (rows, columns) = a.shape();
    if rows == columns { Ok(()) } else { Err(DeterminantError::NotSquare { rows, columns }) }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::dmatrix;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn area_is_the_rotated_vector_dotted(v in prop::array::uniform4(-10.0..10.0f64)) {
            let [a, b, c, d] = v;
            prop_assert!((signed_area([a, b], [c, d]) - (-b * c + a * d)).abs() <= 1e-13);
        }

        #[test]
        fn volume_is_the_expansion_of_1_3_3(m in prop::array::uniform9(-10.0..10.0f64)) {
            let [a, b, c, d, e, f, g, h, i] = m;
            let expansion = a * e * i + b * f * g + c * d * h - c * e * g - b * d * i - a * f * h;
            prop_assert!((signed_volume([a, b, c], [d, e, f], [g, h, i]) - expansion).abs() < 1e-10);
        }

        #[test]
        fn determinant_of_a_product(a in prop::collection::vec(-2.0..2.0f64, 16), b in prop::collection::vec(-2.0..2.0f64, 16)) {
            let (a, b) = (DMatrix::from_vec(4, 4, a), DMatrix::from_vec(4, 4, b));
            let product = determinant(&(&a * &b)).unwrap();
            prop_assert!((product - determinant(&a).unwrap() * determinant(&b).unwrap()).abs() < 1e-9);
        }
    }

    #[test]
    fn what_has_none_is_refused() {
        let wide = dmatrix![1.0, 2.0, 3.0; 4.0, 5.0, 6.0];
        assert_eq!(determinant(&wide), Err(DeterminantError::NotSquare { rows: 2, columns: 3 }));
        assert_eq!(inverse(&dmatrix![1.0, 2.0; 2.0, 4.0]), Err(DeterminantError::Singular));
        assert_eq!(determinant(&DMatrix::zeros(0, 0)), Ok(1.0));
    }
}
