//! The Kronecker product, note 1.4.

use nalgebra::DMatrix;

/// `A ⊗ B`: every entry of A (m×n) times the whole of B (p×q), an mp×nq matrix; note (1.4.1) and (1.4.2).
///
/// The note's example (1.4.3):
/// ```
/// use nalgebra::dmatrix;
/// let product = ribopt::math::kronecker(&dmatrix![1.0, 2.0; 3.0, 4.0], &dmatrix![0.0, 5.0; 6.0, 7.0]);
/// assert_eq!(product, dmatrix![
///      0.0,  5.0,  0.0, 10.0;
///      6.0,  7.0, 12.0, 14.0;
///      0.0, 15.0,  0.0, 20.0;
///     18.0, 21.0, 24.0, 28.0]);
/// ```
pub fn kronecker(a: &DMatrix<f64>, b: &DMatrix<f64>) -> DMatrix<f64> {
    a.kronecker(b)
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn maps_compose(entries in prop::collection::vec(-2.0..2.0f64, 26)) {
            let take = |rows, columns, at: usize| DMatrix::from_row_slice(rows, columns, &entries[at..at + rows * columns]);
            let (a, b, c, d) = (take(2, 3, 0), take(4, 2, 6), take(3, 2, 14), take(2, 3, 20));
            let left = kronecker(&a, &b) * kronecker(&c, &d);
            prop_assert_eq!(left.shape(), (8, 6));
            prop_assert!((left - kronecker(&(&a * &c), &(&b * &d))).norm() < 1e-10);
        }
    }
}
