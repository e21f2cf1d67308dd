//! Whether a symmetric matrix S has negative curvature on the null space of a matrix A, by the inertia of [S Aᵀ; A −δI], dense.
//!
//! Most pass by a definite matrix of half the order, which proves the same by Haynsworth's inertia additivity ("Determination
//! of the inertia of a partitioned Hermitian matrix", 1968); the indefinite one is factorised only where that fails.

use super::bunch_kaufman::{self, Pivot};
use super::{Inertia, cholesky};

/// −δ of the dual block: dependent rows neither break the factorisation nor change the count.
pub const DUAL: f64 = 1e-11;
/// Rows whose combination is shorter than this (squared) are dependent.
pub const DEPENDENT: f64 = 1e-12;
/// P of S + AᵀPA, in units of the scales W: above |S| (1 in these units), so that S decides on the null space alone, and below the
/// 1e9 at which its rounding (1e−16 of it) would reach the curvature that decides (1e−7).
const PENALTY: f64 = 1e3;

/// S and A, and room for factors.
#[derive(Default)]
pub struct SaddlePoint {
    free: usize,
    held: usize,
    /// S, row by row, lower triangle.
    pub hessian: Vec<f64>,
    /// W, the scale of each row of S.
    pub weights: Vec<f64>,
    /// A, row by row.
    pub rows: Vec<f64>,
    matrix: Vec<f64>,
    pivots: Vec<Pivot>,
}

impl SaddlePoint {
    /// S of this order and this many rows of A, all zero.
    pub fn reset(&mut self, free: usize, held: usize) {
        (self.free, self.held) = (free, held);
        reset(&mut self.hessian, free * free);
        reset(&mut self.weights, free);
        reset(&mut self.rows, held * free);
    }

    /// Whether the rows of A are linearly dependent: [I Aᵀ; A εI] gains a positive eigenvalue for every singular value below √ε.
    pub fn has_dependent_rows(&mut self) -> bool {
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

    /// Whether S + shift·W has negative curvature on the null space of A.
    pub fn has_negative_curvature(&mut self, shift: f64) -> bool {
        let (p, m) = (self.free, self.held);
        if self.is_positive_on_null_space(shift) {
            return false;
        }
        let weights = std::mem::take(&mut self.weights);
        let inertia = self.inertia(true, |at| if at < p { shift * weights[at] } else { -DUAL });
        self.weights = weights;
        inertia.negative > m
    }

    /// S + shift·W + AᵀPA is positive definite for a P ≤ I/δ. Then S + shift·W + AᵀA/δ is, which is the Schur complement of −δI
    /// in [S + shift·W, Aᵀ; A, −δI], and that matrix has one negative eigenvalue per row. Tested in units of the scales W,
    /// each row of A at the length one: nothing is lost in rounding.
    fn is_positive_on_null_space(&mut self, shift: f64) -> bool {
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
