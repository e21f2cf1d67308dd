//! Linear systems with a band matrix, by elimination without pivoting: O(n·band²) time, O(n·band) memory.
//!
//! Meant for the matrices of splines, where pivoting is not needed: diagonally dominant ones, totally positive collocation
//! matrices (de Boor, *A Practical Guide to Splines*, XIII) and positive definite normal equations.

/// An n×n matrix with `lower` diagonals below and `upper` above the main one.
#[derive(Debug, Clone)]
pub struct Banded {
    n: usize,
    lower: usize,
    upper: usize,
    /// Row by row, each of lower + 1 + upper entries.
    entries: Vec<f64>,
}

/// The elimination met a pivot that is zero or no number.
#[derive(Debug, Clone, Copy, PartialEq, Eq, thiserror::Error)]
#[error("the system of equations is singular in row {row}")]
pub struct Singular {
    /// The row, counted from 0.
    pub row: usize,
}

impl Banded {
    /// A zero matrix with this band.
    ///
    /// ```
    /// use ribopt::math::banded::Banded;
    /// let mut a = Banded::zeros(3, 1, 1);
    /// for i in 0..3 {
    ///     *a.entry(i, i) = 2.0;
    ///     if i > 0 {
    ///         *a.entry(i, i - 1) = 1.0;
    ///     }
    /// }
    /// let mut x = vec![[2.0], [3.0], [4.0]];
    /// a.solve(&mut x)?;
    /// assert_eq!(x, [[1.0], [1.0], [1.5]]);
    /// # Ok::<(), ribopt::math::banded::Singular>(())
    /// ```
    pub fn zeros(n: usize, lower: usize, upper: usize) -> Self {
        Banded { n, lower, upper, entries: vec![0.0; n * (lower + 1 + upper)] }
    }

    /// The entry in row i, column j.
    ///
    /// # Panics
    /// Outside the band.
    pub fn entry(&mut self, i: usize, j: usize) -> &mut f64 {
        assert!(i < self.n && j < self.n && j + self.lower >= i && j <= i + self.upper, "entry ({i}, {j}) lies outside the band");
        let at = self.at(i, j);
        &mut self.entries[at]
    }

    fn at(&self, i: usize, j: usize) -> usize {
        i * (self.lower + 1 + self.upper) + (j + self.lower - i)
    }

    /// Solves for D right-hand sides at once, in place: `x[i]` holds row i of them and then of the solutions.
    ///
    /// # Errors
    /// [`Singular`].
    pub fn solve<const D: usize>(mut self, x: &mut [[f64; D]]) -> Result<(), Singular> {
        debug_assert_eq!(x.len(), self.n);
        let size: Vec<f64> = (0..self.n).map(|i| self.row_size(i)).collect();
        for (k, size) in size.into_iter().enumerate() {
            let pivot = self.entries[self.at(k, k)];
            // `>` also catches NaN.
            if !(pivot.abs() > f64::EPSILON * f64::EPSILON * size && pivot.is_finite()) {
                return Err(Singular { row: k });
            }
            for i in k + 1..self.n.min(k + self.lower + 1) {
                self.eliminate(k, i, pivot, x);
            }
        }
        self.substitute(x);
        Ok(())
    }

    fn row_size(&self, i: usize) -> f64 {
        let width = self.lower + 1 + self.upper;
        self.entries[i * width..(i + 1) * width].iter().fold(0.0, |size: f64, entry| size.max(entry.abs()))
    }

    /// Row i less a multiple of row k.
    fn eliminate<const D: usize>(&mut self, k: usize, i: usize, pivot: f64, x: &mut [[f64; D]]) {
        let factor = self.entries[self.at(i, k)] / pivot;
        if factor == 0.0 {
            return;
        }
        for j in k..self.n.min(k + self.upper + 1) {
            let (target, source) = (self.at(i, j), self.at(k, j));
            self.entries[target] -= factor * self.entries[source];
        }
        let source = x[k];
        for (target, source) in x[i].iter_mut().zip(source) {
            *target -= factor * source;
        }
    }

    fn substitute<const D: usize>(&self, x: &mut [[f64; D]]) {
        for k in (0..self.n).rev() {
            let mut row = x[k];
            for (j, known) in x.iter().enumerate().take(k + self.upper + 1).skip(k + 1) {
                let factor = self.entries[self.at(k, j)];
                row.iter_mut().zip(known).for_each(|(target, known)| *target -= factor * known);
            }
            x[k] = row.map(|value| value / self.entries[self.at(k, k)]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use nalgebra::DMatrix;
    use proptest::prelude::*;

    proptest! {
        #[test]
        fn as_a_dense_solver(entries in prop::collection::vec(-1.0..1.0f64, 7 * 7), right in prop::collection::vec(-1.0..1.0f64, 14)) {
            let dominant = |i: usize, j: usize| entries[7 * i + j] + if i == j { 8.0 } else { 0.0 };
            let inside = |i: usize, j: usize| j + 2 >= i && j <= i + 1;
            let dense = DMatrix::from_fn(7, 7, |i, j| if inside(i, j) { dominant(i, j) } else { 0.0 });
            let mut band = Banded::zeros(7, 2, 1);
            for (i, j) in (0..49).map(|at| (at / 7, at % 7)).filter(|&(i, j)| inside(i, j)) {
                *band.entry(i, j) = dominant(i, j);
            }
            let mut x: Vec<[f64; 2]> = right.chunks_exact(2).map(|pair| [pair[0], pair[1]]).collect();
            band.solve(&mut x).unwrap();
            let product = dense * DMatrix::from_row_slice(7, 2, &x.concat());
            prop_assert!((product - DMatrix::from_row_slice(7, 2, &right)).norm() < 1e-13);
        }
    }

    #[test]
    fn a_zero_pivot_is_named() {
        let mut band = Banded::zeros(2, 1, 1);
        *band.entry(0, 0) = 1.0;
        assert_eq!(band.solve(&mut [[1.0], [1.0]]), Err(Singular { row: 1 }));
    }
}
