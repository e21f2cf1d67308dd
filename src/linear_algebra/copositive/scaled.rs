//! The search on a matrix scaled to a unit diagonal.

use super::{BEYOND, STEPS, SWEEPS, TIE, TOLERANCE, WIDEST, ZERO};
use nalgebra::{DMatrix, SymmetricEigen};
use std::collections::HashSet;

/// M with the diagonal 1 where that is possible.
pub(super) struct Scaled {
    pub(super) k: usize,
    pub(super) entries: DMatrix<f64>,
    pub(super) scale: Vec<f64>,
}

impl Scaled {
    pub(super) fn new(matrix: &[f64], k: usize) -> Self {
        let row = |i: usize| &matrix[i * k..(i + 1) * k];
        let scale = |i: usize| {
            let largest = row(i).iter().fold(0.0, |most: f64, m| most.max(m.abs()));
            let size = row(i)[i].abs().max(f64::EPSILON * largest);
            if size > 0.0 { size.sqrt().recip() } else { 1.0 }
        };
        let scale: Vec<f64> = (0..k).map(scale).collect();
        let entry = |i: usize, j: usize| 0.5 * (matrix[i * k + j] + matrix[j * k + i]) * scale[i] * scale[j];
        Scaled { k, entries: DMatrix::from_fn(k, k, entry), scale }
    }

    pub(super) fn unscaled(&self, s: &[f64]) -> Vec<f64> {
        s.iter().zip(&self.scale).map(|(s, scale)| s * scale).collect()
    }

    pub(super) fn value(&self, s: &[f64]) -> f64 {
        (0..self.k).map(|i| s[i] * self.slope(s, i)).sum()
    }

    /// (Ms)_i
    pub(super) fn slope(&self, s: &[f64], i: usize) -> f64 {
        (0..self.k).map(|j| self.entries[(i, j)] * s[j]).sum()
    }

    /// From every index, the others are moved to where they help most, one after the other: a vector whose value is negative
    /// beyond rounding, where that finds one.
    pub(super) fn descended(&self) -> Option<Vec<f64>> {
        (0..self.k).find_map(|first| {
            let mut s = vec![0.0; self.k];
            s[first] = 1.0;
            for _ in 0..SWEEPS {
                let mut moved = 0.0f64;
                for i in (0..self.k).filter(|&i| i != first) {
                    let diagonal = self.entries[(i, i)].max(TOLERANCE);
                    let to = (s[i] - self.slope(&s, i) / diagonal).clamp(0.0, 1e3);
                    moved = moved.max((to - s[i]).abs());
                    s[i] = to;
                }
                let square: f64 = s.iter().map(|s| s * s).sum();
                if self.value(&s) < -TOLERANCE * self.k as f64 * square {
                    return Some(s);
                }
                if moved < 1e-12 {
                    break;
                }
            }
            None
        })
    }

    /// A vector of lower value for its length, by steps against the slope.
    pub(super) fn lowered(&self, mut s: Vec<f64>) -> Vec<f64> {
        let row = |i: usize| self.entries.row(i).iter().map(|m| m.abs()).sum::<f64>();
        let longest = (0..self.k).map(row).fold(f64::MIN_POSITIVE, f64::max);
        for _ in 0..SWEEPS {
            let next: Vec<f64> = (0..self.k).map(|i| (s[i] - self.slope(&s, i) / longest).max(0.0)).collect();
            let length = next.iter().map(|s| s * s).sum::<f64>().sqrt();
            s = next.into_iter().map(|s| s / length).collect();
        }
        s
    }

    /// Visits the lowest eigenvectors without negative entries of the submatrices whose lowest eigenvalue is below `threshold`,
    /// until `visit` has seen enough. False where not all could be looked at.
    pub(super) fn search(&self, threshold: f64, faces: usize, mut visit: impl FnMut(&[f64]) -> bool) -> bool {
        let (mut waiting, mut seen, mut left) = (vec![(0..self.k).collect::<Vec<usize>>()], HashSet::new(), faces);
        while let Some(support) = waiting.pop() {
            let mut parts = self.tied(&support);
            if parts.len() > 1 {
                waiting.append(&mut parts);
                continue;
            }
            if !seen.insert(support.clone()) {
                continue;
            }
            // Without its positive entries off the diagonal M is less; where it is definite even so, no part of it falls.
            let is_bounded = || threshold < 0.0 && self.is_above(threshold, &support, |off| off.min(0.0));
            if self.is_above(threshold, &support, |off| off) || is_bounded() {
                continue;
            }
            let Some((lowest, vector)) = lowest(self.part(&support, |entry| entry)) else { return false };
            if lowest >= threshold {
                continue;
            }
            if left == 0 {
                return false;
            }
            left -= 1;
            if let Some(s) = self.spread(&support, &vector)
                && visit(&s)
            {
                return true;
            }
            // Of few indices all 2^k faces can be looked at.
            let has_many = left.checked_ilog2().is_none_or(|most| support.len() > most as usize);
            if threshold < 0.0 && has_many && self.is_sum(threshold, &support, &mut left) {
                continue;
            }
            if support.len() > WIDEST {
                return false;
            }
            // A minimiser over the face is this vector, or lies on a smaller face.
            for out in 0..support.len() {
                let smaller: Vec<usize> = (0..support.len()).filter(|&at| at != out).map(|at| support[at]).collect();
                waiting.push(smaller);
            }
        }
        true
    }

    /// The parts of a support that negative entries tie together.
    pub(super) fn tied(&self, support: &[usize]) -> Vec<Vec<usize>> {
        let (mut left, mut parts) = (support.to_vec(), Vec::new());
        while let Some(first) = left.pop() {
            let (mut part, mut at) = (vec![first], 0);
            while at < part.len() {
                let i = part[at];
                left.retain(|&j| {
                    let tied = self.entries[(i, j)] < -TIE;
                    if tied {
                        part.push(j);
                    }
                    !tied
                });
                at += 1;
            }
            part.sort_unstable();
            parts.push(part);
        }
        parts
    }

    /// A part of the matrix, its entries off the diagonal being changed.
    fn part(&self, support: &[usize], off: impl Fn(f64) -> f64) -> DMatrix<f64> {
        let entry = |i: usize, j: usize| {
            if i == j { self.entries[(support[i], support[i])] } else { off(self.entries[(support[i], support[j])]) }
        };
        DMatrix::from_fn(support.len(), support.len(), entry)
    }

    /// Whether all eigenvalues of such a part are above a threshold: exactly then the part less the threshold has a Cholesky factorisation, at
    /// a thirtieth of the eigenvalues' price.
    fn is_above(&self, threshold: f64, support: &[usize], off: impl Fn(f64) -> f64) -> bool {
        let mut part = self.part(support, off);
        (0..support.len()).for_each(|at| part[(at, at)] -= threshold);
        part.cholesky().is_some()
    }

    /// Whether a part, less the threshold, is found to be the sum of a definite matrix and one without negative entries, which makes it copositive
    /// (P. H. Diananda, "On non-negative forms in real variables some or all of which are non-negative", Proc. Cambridge Philos. Soc. 58, 1962).
    ///
    /// The second, N, is sought by Y. Nesterov's accelerated gradient steps (Soviet Math. Doklady 27, 1983) towards the least ½‖(M − N)₋‖², whose
    /// gradient is −(M − N)₋, the part with negative eigenvalues. Every such part costs one of the faces `left`.
    fn is_sum(&self, threshold: f64, support: &[usize], left: &mut usize) -> bool {
        let k = support.len();
        let mut rest = self.part(support, |entry| entry);
        (0..k).for_each(|at| rest[(at, at)] -= threshold);
        let beyond = DMatrix::from_diagonal_element(k, k, BEYOND);
        let (mut taken, mut ahead, mut weight) = (DMatrix::zeros(k, k), DMatrix::zeros(k, k), 1.0f64);
        for _ in 0..STEPS.min(*left) {
            *left -= 1;
            let Some(negative) = negative_part(&rest - &ahead - &beyond) else { return false };
            let mut next = (&ahead + negative).map(|entry: f64| entry.max(0.0));
            next.fill_diagonal(0.0);
            if (&rest - &next).cholesky().is_some() {
                return true;
            }
            let heavier = 0.5 * (1.0 + (1.0 + 4.0 * weight * weight).sqrt());
            ahead = &next + (&next - taken) * ((weight - 1.0) / heavier);
            (taken, weight) = (next, heavier);
        }
        false
    }

    /// A vector over a support or its negative among all indices, where one has no negative entry.
    pub(super) fn spread(&self, support: &[usize], vector: &[f64]) -> Option<Vec<f64>> {
        let sign = if vector.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
        if vector.iter().any(|v| sign * v < -ZERO) {
            return None;
        }
        let mut s = vec![0.0; self.k];
        support.iter().zip(vector).for_each(|(&i, v)| s[i] = (sign * v).max(0.0));
        Some(s)
    }
}

/// The lowest eigenvalue and its vector.
fn lowest(matrix: DMatrix<f64>) -> Option<(f64, Vec<f64>)> {
    if matrix.len() == 1 {
        return Some((matrix[(0, 0)], vec![1.0]));
    }
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, 1000)?;
    let (at, lowest) = eigen.eigenvalues.argmin();
    Some((lowest, eigen.eigenvectors.column(at).iter().copied().collect()))
}

/// Σ λ·v·vᵀ over the negative eigenvalues.
fn negative_part(matrix: DMatrix<f64>) -> Option<DMatrix<f64>> {
    let eigen = SymmetricEigen::try_new(matrix, f64::EPSILON, 1000)?;
    let scaled = DMatrix::from_fn(eigen.eigenvectors.nrows(), eigen.eigenvectors.ncols(), |i, j| {
        eigen.eigenvectors[(i, j)] * eigen.eigenvalues[j].min(0.0)
    });
    Some(scaled * eigen.eigenvectors.transpose())
}
