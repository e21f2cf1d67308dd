//! The least squares of [`super`] where few variables carry many columns (more active rows than variables): an
//! active set on dense matrices, which never holds more columns than it needs.
//!
//! C. L. Lawson, R. J. Hanson, Solving Least Squares Problems (1974), chapter 23 (NNLS).

use std::time::Instant;

use nalgebra::{DMatrix, DVector};

use super::block_pivoting::is_over;
use super::problem::{Column, PROXIMAL, residual};

/// Above this many variables a dense factorisation costs more than the sparse one.
const MOST_VARIABLES: usize = 256;
/// Below this many columns block pivoting is as fast.
const FEWEST_COLUMNS: usize = 64;
/// Slopes smaller than this, relative to the multipliers, no longer call a column in: the proximal term alone, which shares the load
/// among all columns, would.
const FLAT: f64 = 10.0 * PROXIMAL;

/// Whether this is the better way for a system of this size.
pub(super) fn fits(variables: usize, columns: usize) -> bool {
    variables <= MOST_VARIABLES && columns >= FEWEST_COLUMNS && columns > 2 * variables
}

/// The columns in use and their multipliers.
pub(super) struct ActiveSet<'a> {
    g: &'a [f64],
    columns: &'a [Column<'a>],
    /// Columns in use, in the order they came in.
    basic: Vec<usize>,
    y: Vec<f64>,
    /// When to take what is there.
    until: Option<Instant>,
}

impl<'a> ActiveSet<'a> {
    pub(super) fn new(g: &'a [f64], columns: &'a [Column<'a>], until: Option<Instant>) -> Self {
        let basic = (0..columns.len()).filter(|&k| columns[k].sign == 0.0).collect();
        ActiveSet { g, columns, basic, y: vec![0.0; columns.len()], until }
    }

    /// The minimiser with the proximal term around `centre`, from the set of columns in use; `None` where numbers overflow.
    pub(super) fn solve(&mut self, centre: &[f64]) -> Option<Vec<f64>> {
        let mut refused = vec![false; self.columns.len()];
        for _ in 0..3 * self.columns.len() + 30 {
            self.settle(centre)?;
            let entering = self.entering(centre, &refused).filter(|_| !is_over(self.until));
            let Some(entering) = entering else { break };
            self.basic.push(entering);
            let z = self.stationary(centre)?;
            // Rounding alone called it in where it then moves the wrong way.
            let moves = z.last().is_some_and(|z| z * self.columns[entering].sign > 0.0);
            if !moves {
                self.basic.pop();
                refused[entering] = true;
            }
        }
        Some(self.y.clone())
    }

    /// Moves towards the stationary point over the columns in use; those whose multiplier would change its sign are released.
    fn settle(&mut self, centre: &[f64]) -> Option<()> {
        loop {
            let z = self.stationary(centre)?;
            let share = |(&k, &z): (&usize, &f64)| {
                let blocked = self.columns[k].sign * z < 0.0;
                blocked.then(|| self.y[k] / (self.y[k] - z))
            };
            let step = self.basic.iter().zip(&z).filter_map(share).fold(1.0, f64::min);
            let blocks: Vec<bool> =
                self.basic.iter().zip(&z).map(|pair| share(pair).is_some_and(|share| share <= step)).collect();
            for ((&k, &z), &blocks) in self.basic.iter().zip(&z).zip(&blocks) {
                self.y[k] = if blocks { 0.0 } else { self.y[k] + step * (z - self.y[k]) };
            }
            if !blocks.contains(&true) {
                return Some(());
            }
            let mut blocks = blocks.into_iter();
            self.basic.retain(|_| !blocks.next().unwrap_or(false));
        }
    }

    /// The column not in use that helps most.
    fn entering(&self, centre: &[f64], refused: &[bool]) -> Option<usize> {
        let residual = residual(self.g, self.columns, &self.y);
        let gain = |k: usize| {
            let column = &self.columns[k];
            -(column.dot(&residual) - PROXIMAL * centre[k]) * column.sign
        };
        let flat = FLAT * self.basic.iter().fold(1.0, |most: f64, &k| most.max(self.y[k].abs()));
        let mut used = refused.to_vec();
        self.basic.iter().for_each(|&k| used[k] = true);
        let candidates = (0..self.columns.len()).filter(|&k| !used[k]).map(|k| (k, gain(k)));
        candidates.filter(|&(_, gain)| gain > flat).max_by(|a, b| a.1.total_cmp(&b.1).then(b.0.cmp(&a.0))).map(|(k, _)| k)
    }

    /// The unconstrained minimiser over the columns in use, in their order: QR of [B; √(T² + ε²)].
    fn stationary(&self, centre: &[f64]) -> Option<Vec<f64>> {
        let (p, size) = (self.g.len(), self.basic.len());
        if size == 0 {
            return Some(Vec::new());
        }
        let mut matrix = DMatrix::zeros(p + size, size);
        let mut right = DVector::zeros(p + size);
        right.rows_mut(0, p).iter_mut().zip(self.g).for_each(|(right, g)| *right = -g);
        for (at, &k) in self.basic.iter().enumerate() {
            let column = &self.columns[k];
            for &(row, value) in column.entries {
                matrix[(row as usize, at)] += value;
            }
            let weight = (column.weight * column.weight + PROXIMAL).sqrt();
            matrix[(p + at, at)] = weight;
            right[p + at] = PROXIMAL * centre[k] / weight;
        }
        let factors = matrix.qr();
        factors.q_tr_mul(&mut right);
        let solution = factors.r().solve_upper_triangular(&right.rows(0, size).into_owned())?;
        solution.iter().all(|value| value.is_finite()).then(|| solution.iter().copied().collect())
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::signed_least_squares::solve;

    /// A fixed number in [−1, 1) without pattern.
    fn scattered(k: u64) -> f64 {
        let mixed = (k + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
        (mixed ^ (mixed >> 29)).wrapping_mul(0xBF58_476D_1CE4_E5B9) as f64 / 2f64.powi(63) - 1.0
    }

    #[test]
    fn far_more_columns_than_variables_satisfy_the_optimality_conditions() {
        let (p, count) = (12u64, 400u64);
        let g: Vec<f64> = (0..p).map(scattered).collect();
        let entries = |k: u64| (0..p).map(|row| (row as u32, scattered(1000 + k * p + row))).collect();
        let all: Vec<Vec<(u32, f64)>> = (0..count).map(entries).collect();
        let column = |k: u64| Column {
            entries: &all[k as usize],
            sign: if k.is_multiple_of(7) { -1.0 } else { 1.0 },
            weight: 0.0,
            basic: true,
        };
        let columns: Vec<Column<'_>> = (0..count).map(column).collect();
        assert!(fits(g.len(), columns.len()));
        let y = solve(&g, &columns, None).unwrap();
        let mut residual = g.clone();
        for (column, y) in columns.iter().zip(&y) {
            column.entries.iter().for_each(|&(row, value)| residual[row as usize] += value * y);
        }
        for (column, &y) in columns.iter().zip(&y) {
            let slope: f64 = column.entries.iter().map(|&(row, value)| value * residual[row as usize]).sum();
            assert!(y * column.sign >= 0.0 && slope * column.sign > -1e-9 && (y * slope).abs() < 1e-9, "{y} {slope}");
        }
    }

    #[test]
    fn rows_that_meet_in_one_point_share_what_is_needed() {
        // Σx with x_i + x_j ≥ 2 for all pairs: every row is active at 1; the residual must vanish.
        let n = 20u32;
        let pairs = (0..n).flat_map(|i| (i + 1..n).map(move |j| [(i, 1.0), (j, 1.0)]));
        let pairs: Vec<[(u32, f64); 2]> = pairs.collect();
        let column = |entries| Column { entries, sign: -1.0, weight: 0.0, basic: true };
        let columns: Vec<Column<'_>> = pairs.iter().map(|pair| column(&pair[..])).collect();
        let y = solve(&vec![1.0; n as usize], &columns, None).unwrap();
        let mut residual = vec![1.0; n as usize];
        for (column, y) in columns.iter().zip(&y) {
            assert!(*y <= 0.0);
            column.entries.iter().for_each(|&(row, value)| residual[row as usize] += value * y);
        }
        assert!(residual.iter().all(|r| r.abs() < 1e-11), "{residual:?}");
    }
}
