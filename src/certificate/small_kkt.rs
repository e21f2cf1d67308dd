//! The tests of [`super::kkt`] on small dense matrices.
//!
//! Most pass by a definite matrix of half the order, which proves the same by Haynsworth's inertia additivity ("Determination
//! of the inertia of a partitioned Hermitian matrix", 1968); the indefinite one is factorised only where that fails.

use super::curvature::Hessian;
use super::kkt::{DEPENDENT, DUAL, weight};
use super::point::Point;
use crate::linear_algebra::bunch_kaufman::{self, Pivot};
use crate::linear_algebra::{Inertia, cholesky};

/// What an active row adds across itself, in units of the yardsticks: far above any curvature, and far below what would hide
/// in rounding what decides (a share of 1e−7).
const PENALTY: f64 = 1e3;

/// S and A over some free variables and active rows, and room for factors.
#[derive(Default)]
pub(super) struct Matrices {
    free: usize,
    held: usize,
    /// S, row by row.
    hessian: Vec<f64>,
    /// The yardstick of each row of S.
    weights: Vec<f64>,
    /// A, row by row, each divided by its slope.
    rows: Vec<f64>,
    matrix: Vec<f64>,
    pivots: Vec<Pivot>,
}

impl Matrices {
    /// Takes the entries of S and A over these variables and rows, both ascending.
    pub(super) fn fill(&mut self, point: &Point<'_>, hessian: &Hessian, free: &[usize], held: &[usize]) {
        (self.free, self.held) = (free.len(), held.len());
        self.weights.clear();
        self.weights.extend(free.iter().map(|&j| weight(hessian.size[j])));
        reset(&mut self.hessian, free.len() * free.len());
        let pattern = &point.meta().hessian;
        for (row, &i) in free.iter().enumerate() {
            for at in pattern.range(i) {
                if let Ok(column) = free.binary_search(&(pattern.columns[at] as usize)) {
                    self.hessian[row * free.len() + column] += hessian.values[at];
                }
            }
        }
        reset(&mut self.rows, held.len() * free.len());
        for (row, &i) in held.iter().enumerate() {
            for (j, value) in point.row_in_sizes(i) {
                if let Ok(column) = free.binary_search(&j) {
                    self.rows[row * free.len() + column] = value;
                }
            }
        }
    }

    /// As [`Kkt::dependent_rows`](super::kkt::Kkt::dependent_rows).
    pub(super) fn has_dependent_rows(&mut self) -> bool {
        let (p, m) = (self.free, self.held);
        if m == 0 || m > p {
            return m > 0;
        }
        !self.are_independent() && self.inertia(false, |at| if at < p { 1.0 } else { DEPENDENT }).negative < m
    }

    /// AAᵀ − εI is positive definite: the Schur complement of I in [I Aᵀ; A εI] is its negative, so that matrix has one
    /// negative eigenvalue per row.
    fn are_independent(&mut self) -> bool {
        let (p, m) = (self.free, self.held);
        reset(&mut self.matrix, m * m);
        for i in 0..m {
            for j in 0..=i {
                let product: f64 = self.row(i).iter().zip(self.row(j)).map(|(a, b)| a * b).sum();
                self.matrix[i * m + j] = if i == j { product - DEPENDENT } else { product };
            }
        }
        debug_assert_eq!(self.rows.len(), m * p);
        cholesky::factor(&mut self.matrix, m)
    }

    /// As [`Kkt::bends_down`](super::kkt::Kkt::bends_down).
    pub(super) fn bends_down(&mut self, shift: f64) -> bool {
        let (p, m) = (self.free, self.held);
        if self.bends_up(shift) {
            return false;
        }
        let weights = std::mem::take(&mut self.weights);
        let inertia = self.inertia(true, |at| if at < p { shift * weights[at] } else { -DUAL });
        self.weights = weights;
        inertia.negative > m
    }

    /// S + shift·W + AᵀPA is positive definite for a P ≤ I/δ. Then S + shift·W + AᵀA/δ is, which is the Schur complement of −δI
    /// in [S + shift·W, Aᵀ; A, −δI], and that matrix has one negative eigenvalue per row. Tested in units of the yardsticks W,
    /// each row of A at the length one: nothing is lost in rounding.
    fn bends_up(&mut self, shift: f64) -> bool {
        let (p, m) = (self.free, self.held);
        reset(&mut self.matrix, p * p);
        for i in 0..p {
            for j in 0..=i {
                let curvature = self.hessian[i * p + j] / (self.weights[i] * self.weights[j]).sqrt();
                self.matrix[i * p + j] = if i == j { curvature + shift } else { curvature };
            }
        }
        let mut direction = Vec::with_capacity(p);
        for k in 0..m {
            direction.clear();
            direction.extend(self.row(k).iter().zip(&self.weights).map(|(a, weight)| a / weight.sqrt()));
            let square: f64 = direction.iter().map(|a| a * a).sum();
            if square == 0.0 {
                continue;
            }
            let penalty = (PENALTY / square).min(1.0 / DUAL);
            for (i, a) in direction.iter().enumerate().filter(|(_, a)| **a != 0.0) {
                for (entry, b) in self.matrix[i * p..=i * p + i].iter_mut().zip(&direction) {
                    *entry += penalty * a * b;
                }
            }
        }
        cholesky::factor(&mut self.matrix, p)
    }

    fn row(&self, k: usize) -> &[f64] {
        &self.rows[k * self.free..(k + 1) * self.free]
    }

    /// The inertia of [S + …, Aᵀ; A, …] with this added to its diagonal, S being left out where it is not wanted.
    fn inertia(&mut self, with_hessian: bool, diagonal: impl Fn(usize) -> f64) -> Inertia {
        let (p, order) = (self.free, self.free + self.held);
        reset(&mut self.matrix, order * order);
        self.pivots.clear();
        self.pivots.resize(order, Pivot::default());
        for i in 0..order {
            let source = match i.checked_sub(p) {
                Some(k) => &self.rows[k * p..(k + 1) * p],
                None if with_hessian => &self.hessian[i * p..(i + 1) * p],
                None => &[],
            };
            self.matrix[i * order..i * order + source.len()].copy_from_slice(source);
            self.matrix[i * order + i] += diagonal(i);
        }
        bunch_kaufman::factor(&mut self.matrix, &mut self.pivots)
    }
}

fn reset(values: &mut Vec<f64>, count: usize) {
    values.clear();
    values.resize(count, 0.0);
}
