//! An orthonormal basis of the null space of rows that may depend on one another, as a dense matrix: for null spaces of few dimensions.
//!
//! (I + AᵀA/δ)⁻¹ v is v with its share along a singular vector of A multiplied by δ/(δ + σ²): what is left of random vectors after two such
//! products spans the null space (subspace iteration: Parlett, The Symmetric Eigenvalue Problem, 1998, chapter 14). Their directions of
//! σ² ≤ [`DEPENDENT`] (Rayleigh and Ritz) are the basis; it is complete where the span held others as well.

use faer::{Mat, Side};
use rayon::prelude::*;

use super::FactorizationError;
use super::entries::Symmetric;
use super::saddle_point::DEPENDENT;
use crate::math::split_mix::SplitMix;

/// δ = σ²/10 for the largest σ of the null space leaves a hundredth of a σ ten times as large.
const DELTA: f64 = 0.1 * DEPENDENT;
/// Vectors whose mean squared share tells the number of dimensions.
const PROBES: u64 = 4;
/// Shares of squared length below this are what the products' rounding has left.
const ROUNDING: f64 = 1e-12;

/// A matrix of rows of length one: (row, column, value).
pub struct Rows<'a> {
    /// Number of rows.
    pub count: usize,
    /// Number of columns.
    pub columns: usize,
    /// Entries in any order.
    pub entries: &'a [(u32, u32, f64)],
}

impl Rows<'_> {
    /// A·V
    fn times(&self, v: &Mat<f64>) -> Mat<f64> {
        let mut product = Mat::zeros(self.count, v.ncols());
        for k in 0..v.ncols() {
            for &(row, column, value) in self.entries {
                product[(row as usize, k)] += value * v[(column as usize, k)];
            }
        }
        product
    }

    /// The basis, column by column. `None` where it has more than so many columns.
    ///
    /// # Errors
    /// The rows have no factors.
    pub fn null_space(&self, most: usize) -> Result<Option<Mat<f64>>, FactorizationError> {
        let projection = Projection::new(self)?;
        let probes = projection.of_random(PROBES as usize)?;
        let dimensions = probes.squared_norm_l2() / PROBES as f64;
        // Beyond what a mean of so many squares is off by.
        let mut size = (1.5 * dimensions + 12.0) as usize;
        loop {
            if size > most {
                return Ok(None);
            }
            let Some(first) = orthonormal(projection.of_random(size)?) else { return Ok(None) };
            let Some(span) = orthonormal(projection.of(&first)?) else { return Ok(None) };
            let Some(basis) = self.flattest(&span) else { return Ok(None) };
            if basis.ncols() < size || size >= self.columns {
                return Ok(Some(basis));
            }
            size *= 2;
        }
    }

    /// The directions of a span along which the rows are no longer than what counts as none.
    fn flattest(&self, span: &Mat<f64>) -> Option<Mat<f64>> {
        let product = self.times(span);
        let eigen = (product.transpose() * &product).self_adjoint_eigen(Side::Lower).ok()?;
        let flat = eigen.S().column_vector().iter().filter(|square| **square <= DEPENDENT).count();
        Some(span * eigen.U().subcols(0, flat))
    }
}

/// v to (I + AᵀA/δ)⁻¹v.
struct Projection {
    matrix: Symmetric,
    columns: usize,
    rows: usize,
}

impl Projection {
    fn new(rows: &Rows<'_>) -> Result<Self, FactorizationError> {
        let (n, m) = (rows.columns, rows.count);
        let mut positions: Vec<(u32, u32)> = (0..(n + m) as u32).map(|k| (k, k)).collect();
        positions.extend(rows.entries.iter().map(|&(row, column, _)| (n as u32 + row, column)));
        let mut matrix = Symmetric::new(n + m, &positions)?;
        let diagonal = std::iter::repeat_n(1.0, n).chain(std::iter::repeat_n(-DELTA, m));
        matrix.factor(diagonal.chain(rows.entries.iter().map(|entry| entry.2)))?;
        Ok(Projection { matrix, columns: n, rows: m })
    }

    fn of(&self, v: &Mat<f64>) -> Result<Mat<f64>, FactorizationError> {
        self.of_columns(v.ncols(), |k| v.col(k).iter().copied().collect())
    }

    /// Of vectors of independent components, uniform and of variance one.
    fn of_random(&self, count: usize) -> Result<Mat<f64>, FactorizationError> {
        self.of_columns(count, |k| {
            let mut numbers = SplitMix::new(k as u64);
            (0..self.columns).map(|_| 3.0_f64.sqrt() * (2.0 * numbers.uniform() - 1.0)).collect()
        })
    }

    fn of_columns(&self, count: usize, column: impl Fn(usize) -> Vec<f64> + Sync) -> Result<Mat<f64>, FactorizationError> {
        let one = |k: usize| {
            let mut right = column(k);
            right.resize(self.columns + self.rows, 0.0);
            self.matrix.solve_once(&right)
        };
        let all: Vec<Vec<f64>> = (0..count).into_par_iter().map(one).collect::<Result<_, _>>()?;
        Ok(Mat::from_fn(self.columns, count, |i, k| all[k][i]))
    }
}

/// An orthonormal basis of the span of columns of about the same length, without what is rounding; `None` where a value is no number.
fn orthonormal(v: Mat<f64>) -> Option<Mat<f64>> {
    let eigen = (v.transpose() * &v).self_adjoint_eigen(Side::Lower).ok()?;
    let squares: Vec<f64> = eigen.S().column_vector().iter().copied().collect();
    let largest = squares.iter().fold(0.0, |most: f64, square| most.max(*square));
    let first = squares.iter().position(|square| *square > ROUNDING * largest).unwrap_or(squares.len());
    let kept = eigen.U().subcols(first, squares.len() - first);
    let scaled = Mat::from_fn(kept.nrows(), kept.ncols(), |i, k| kept[(i, k)] / squares[first + k].sqrt());
    Some(v * scaled)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of rows, each coupled with the next, and every other one once more as a sum of its neighbours; `free` columns that no row has.
    fn chain(n: usize, free: usize) -> (usize, usize, Vec<(u32, u32, f64)>) {
        let row = |k: usize| [(k, 1.0), (k + 1, -0.7)];
        let mut entries: Vec<(u32, u32, f64)> = Vec::new();
        let mut count = 0;
        let mut put = |row: &[(usize, f64)]| {
            let length = row.iter().map(|entry| entry.1 * entry.1).sum::<f64>().sqrt();
            entries.extend(row.iter().map(|&(j, value)| (count, j as u32, value / length)));
            count += 1;
        };
        (0..n).for_each(|k| put(&row(k)));
        (0..n - 1).step_by(2).for_each(|k| put(&[(k, 1.0), (k + 1, 1e4 - 0.7), (k + 2, -7e3)]));
        (count as usize, n + 1 + free, entries)
    }

    #[test]
    fn a_basis_is_orthonormal_and_complete_where_rows_depend_on_one_another() {
        for free in [0, 5, 60] {
            let (count, columns, entries) = chain(200, free);
            let rows = Rows { count, columns, entries: &entries };
            let basis = rows.null_space(columns).unwrap().unwrap();
            assert_eq!(basis.ncols(), 1 + free);
            assert!(rows.times(&basis).norm_max() < 1e-9);
            assert!((basis.transpose() * &basis - Mat::<f64>::identity(1 + free, 1 + free)).norm_max() < 1e-9);
        }
    }

    #[test]
    fn regular_rows_have_none_and_large_ones_are_refused() {
        let entries: Vec<(u32, u32, f64)> = (0..30).map(|k| (k, k, 1.0)).collect();
        assert_eq!(Rows { count: 30, columns: 30, entries: &entries }.null_space(30).unwrap().unwrap().ncols(), 0);
        assert!(Rows { count: 30, columns: 300, entries: &entries }.null_space(100).unwrap().is_none());
    }
}
