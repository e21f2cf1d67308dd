//! The tests of [`super::kkt`] on small dense matrices.

use super::system::{Hessian, weight};
use crate::certificate::point::Point;
use crate::linear_algebra::saddle_point::SaddlePoint;

/// Takes the entries of S and A over these variables and rows, both ascending.
pub(super) fn fill(matrices: &mut SaddlePoint, point: &Point<'_>, hessian: &Hessian, free: &[usize], held: &[usize]) {
    matrices.reset(free.len(), held.len());
    for (weights, &j) in matrices.weights.iter_mut().zip(free) {
        *weights = weight(hessian.size[j]);
    }
    let pattern = &point.meta().hessian;
    for (row, &i) in free.iter().enumerate() {
        for at in pattern.range(i) {
            if let Ok(column) = free.binary_search(&(pattern.columns[at] as usize)) {
                matrices.hessian[row * free.len() + column] += hessian.values[at];
            }
        }
    }
    for (row, &i) in held.iter().enumerate() {
        for (j, value) in point.row_in_sizes(i) {
            if let Ok(column) = free.binary_search(&j) {
                matrices.rows[row * free.len() + column] = value;
            }
        }
    }
}
