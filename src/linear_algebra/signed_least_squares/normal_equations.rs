//! The least squares of [`super`] where columns are few and well independent: normal equations, refined once by
//! the residual itself (corrected seminormal equations: Å. Björck, "Stability analysis of the method of seminormal equations",
//! 1987), which are then as good as an orthogonal factorisation. The minimiser is unique there, so no proximal term is needed.

use super::problem::{Column, Stationary};
use crate::linear_algebra::{FactorizationError, cholesky};

/// More columns are left to others.
const MOST_COLUMNS: usize = 48;
/// Columns of which less than this (squared) is their own are not well independent.
const OWN_SHARE: f64 = 1e-4;

/// One system, and room for those that follow.
#[derive(Default)]
pub struct NormalEquations {
    /// g and B, column by column, each of g's length.
    g: Vec<f64>,
    columns: Vec<f64>,
    /// The diagonal of T².
    weights: Vec<f64>,
    /// BᵀB + T², row by row.
    gram: Vec<f64>,
    basic: Vec<usize>,
    factor: Vec<f64>,
    right: Vec<f64>,
    residual: Vec<f64>,
}

impl NormalEquations {
    /// Takes a system; false where it is too large.
    pub(super) fn fill(&mut self, g: &[f64], columns: &[Column<'_>]) -> bool {
        let (p, count) = (g.len(), columns.len());
        if count > MOST_COLUMNS {
            return false;
        }
        self.g.clear();
        self.g.extend_from_slice(g);
        reset(&mut self.columns, p * count);
        self.weights.clear();
        self.weights.extend(columns.iter().map(|column| column.weight * column.weight));
        reset(&mut self.gram, count * count);
        for (k, column) in columns.iter().enumerate() {
            column.entries.iter().for_each(|&(row, value)| self.columns[k * p + row as usize] += value);
            for other in 0..=k {
                let dense = &self.columns[other * p..(other + 1) * p];
                let product: f64 = column.entries.iter().map(|&(row, value)| value * dense[row as usize]).sum();
                self.gram[k * count + other] = if other == k { product + self.weights[k] } else { product };
            }
        }
        true
    }

    /// Factorises BᵀB + T² over the basic columns; false where they are not well independent.
    fn factorise(&mut self, basic: &[bool]) -> bool {
        let count = basic.len();
        self.basic.clear();
        self.basic.extend((0..count).filter(|&k| basic[k]));
        let size = self.basic.len();
        reset(&mut self.factor, size * size);
        for (at, &k) in self.basic.iter().enumerate() {
            for (place, &other) in self.factor[at * size..=at * size + at].iter_mut().zip(&self.basic) {
                *place = self.gram[k * count + other];
            }
        }
        let is_definite = cholesky::factor(&mut self.factor, size);
        let own = |(at, &k): (usize, &usize)| self.factor[at * size + at].powi(2) >= OWN_SHARE * self.gram[k * count + k];
        is_definite && self.basic.iter().enumerate().all(own)
    }

    /// −Bᵀ(residual) − T²y over the basic columns, solved for.
    fn step(&mut self, y: &[f64]) {
        let p = self.g.len();
        self.right.clear();
        for &k in &self.basic {
            let column = &self.columns[k * p..(k + 1) * p];
            let slope: f64 = column.iter().zip(&self.residual).map(|(b, r)| b * r).sum();
            self.right.push(-slope - self.weights[k] * y[k]);
        }
        cholesky::solve(&self.factor, &mut self.right);
    }
}

impl Stationary for &mut NormalEquations {
    fn stationary(&mut self, basic: &[bool], is_new: bool, _: &[f64]) -> Result<Vec<f64>, FactorizationError> {
        if is_new && !self.factorise(basic) {
            return Err(FactorizationError::Singular);
        }
        let (p, mut y) = (self.g.len(), vec![0.0; basic.len()]);
        for _ in 0..2 {
            self.residual.clone_from(&self.g);
            for &k in &self.basic {
                let column = &self.columns[k * p..(k + 1) * p];
                self.residual.iter_mut().zip(column).for_each(|(r, b)| *r += b * y[k]);
            }
            self.step(&y);
            self.basic.iter().zip(&self.right).for_each(|(&k, step)| y[k] += step);
        }
        match y.iter().all(|y| y.is_finite()) {
            true => Ok(y),
            false => Err(FactorizationError::Singular),
        }
    }
}

fn reset(values: &mut Vec<f64>, count: usize) {
    values.clear();
    values.resize(count, 0.0);
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::signed_least_squares::{solve, solve_one_of_many};

    fn column(entries: &[(u32, f64)], sign: f64, weight: f64) -> Column<'_> {
        Column { entries, sign, weight, basic: true }
    }

    #[test]
    fn it_finds_what_the_augmented_system_finds() {
        let g = [-1.0, 0.3, -0.7, 0.2];
        let columns = [
            column(&[(0, 1.0), (1, 0.2), (2, -0.5)], 1.0, 0.0),
            column(&[(0, 0.4), (1, -1.0), (3, 0.8)], 1.0, 1e-4),
            column(&[(1, 0.5), (2, 1.0)], -1.0, 0.0),
            column(&[(3, 1.0)], 0.0, 0.0),
        ];
        let mut room = NormalEquations::default();
        let (quick, slow) = (solve_one_of_many(&g, &columns, &mut room, None).unwrap(), solve(&g, &columns, None).unwrap());
        assert!(quick.iter().zip(&slow).all(|(a, b)| (a - b).abs() < 1e-12), "{quick:?} {slow:?}");
        // The room serves again.
        let single = solve_one_of_many(&[-2.0], &[column(&[(0, 1.0)], 1.0, 0.0)], &mut room, None).unwrap();
        assert_eq!(single, [2.0]);
    }

    #[test]
    fn dependent_columns_are_left_to_others() {
        let twice = [column(&[(0, 1.0), (1, 0.5)], 1.0, 0.0), column(&[(0, 1.0), (1, 0.5)], 1.0, 0.0)];
        let mut room = NormalEquations::default();
        assert!(room.fill(&[-2.0, -1.0], &twice) && !room.factorise(&[true, true]));
        let y = solve_one_of_many(&[-2.0, -1.0], &twice, &mut room, None).unwrap();
        assert!((y[0] + y[1] - 2.0).abs() < 1e-9, "{y:?}");
    }
}
