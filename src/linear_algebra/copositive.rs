//! Copositivity: whether sᵀMs ≥ 0 for all s ≥ 0.
//!
//! Theorem (W. Kaplan, "A test for copositive matrices", Linear Algebra and its Applications 313, 2000): M is copositive exactly
//! where no principal submatrix has an eigenvector with positive entries to a negative eigenvalue. Such a vector of a least
//! support minimises sᵀMs over the unit vectors of its face, so it belongs to the submatrix's *lowest* eigenvalue; and where
//! that is not negative, also where it is not without positive entries off the diagonal, no submatrix of it need be looked at. Indices that no negative entry ties together are tested apart,
//! which is exact: what stands between them only adds.
//!
//! The work doubles with every index in the worst case: faces are counted, and `Undecided` is an answer.

use std::collections::HashSet;

use nalgebra::{DMatrix, SymmetricEigen};

/// λ < −TOLERANCE·k is negative, the diagonal being 1: rounding of an eigenvalue of a matrix of order k.
const TOLERANCE: f64 = 1e-13;
/// |M_ij| ≤ TIE ties nothing: dropping it moves an eigenvalue by less than TOLERANCE·k.
const TIE: f64 = 1e-14;
/// Entries of an eigenvector of unit length above −ZERO count as not negative: the value is computed anew without them.
const ZERO: f64 = 1e-9;
/// Supports are sets of at most this many indices.
const WIDEST: usize = 64;
/// Sweeps of the search for a vector that shows M is not copositive.
const SWEEPS: usize = 50;

/// What is known of M.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// sᵀMs ≥ 0 for all s ≥ 0, beyond rounding of M's entries.
    Copositive,
    /// s ≥ 0 with sᵀMs < 0.
    Falls(Vec<f64>),
    /// The budget of faces is used up.
    Undecided,
}

/// Tests a symmetric matrix of order k, row by row; `faces` are looked at, at the most.
///
/// ```
/// use ribopt::linear_algebra::copositive::{Verdict, test};
/// assert_eq!(test(&[1.0, 5.0, 5.0, 1.0], 2, 100), Verdict::Copositive);
/// assert!(matches!(test(&[1.0, -1.5, -1.5, 1.0], 2, 100), Verdict::Falls(_)));
/// ```
pub fn test(matrix: &[f64], k: usize, faces: usize) -> Verdict {
    if k == 0 {
        return Verdict::Copositive;
    }
    let scaled = Scaled::new(matrix, k);
    if let Some(s) = scaled.descended() {
        return Verdict::Falls(scaled.unscaled(&scaled.lowered(s)));
    }
    let mut found = None;
    let is_complete = scaled.search(-TOLERANCE * k as f64, faces, |s| {
        let falls = scaled.value(s) < 0.0;
        if falls {
            found = Some(scaled.unscaled(s));
        }
        falls
    });
    match (found, is_complete) {
        (Some(s), _) => Verdict::Falls(s),
        (None, true) => Verdict::Copositive,
        (None, false) => Verdict::Undecided,
    }
}

/// Vectors s ≥ 0 along which sᵀMs is less than `share` of the largest it could be, face by face; `most` of them.
pub fn low_vectors(matrix: &[f64], k: usize, share: f64, most: usize) -> Vec<Vec<f64>> {
    let scaled = Scaled::new(matrix, k);
    let mut found = Vec::new();
    scaled.search(share, 8 * most, |s| {
        found.push(scaled.unscaled(s));
        found.len() >= most
    });
    found
}

/// M with the diagonal 1 where that is possible.
struct Scaled {
    k: usize,
    entries: DMatrix<f64>,
    scale: Vec<f64>,
}

impl Scaled {
    fn new(matrix: &[f64], k: usize) -> Self {
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

    fn unscaled(&self, s: &[f64]) -> Vec<f64> {
        s.iter().zip(&self.scale).map(|(s, scale)| s * scale).collect()
    }

    fn value(&self, s: &[f64]) -> f64 {
        (0..self.k).map(|i| s[i] * self.slope(s, i)).sum()
    }

    /// (Ms)_i
    fn slope(&self, s: &[f64], i: usize) -> f64 {
        (0..self.k).map(|j| self.entries[(i, j)] * s[j]).sum()
    }

    /// From every index, the others are moved to where they help most, one after the other: a vector whose value is negative
    /// beyond rounding, where that finds one.
    fn descended(&self) -> Option<Vec<f64>> {
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
    fn lowered(&self, mut s: Vec<f64>) -> Vec<f64> {
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
    fn search(&self, threshold: f64, faces: usize, mut visit: impl FnMut(&[f64]) -> bool) -> bool {
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
            let Some((lowest, vector)) = self.lowest(&support, |entry| entry) else { return false };
            // Without its positive entries off the diagonal M is less; where it is definite even so, no part of it falls.
            let bounded = |off: f64| off.min(0.0);
            let is_bounded = || threshold < 0.0 && self.lowest(&support, bounded).is_some_and(|(least, _)| least >= threshold);
            if lowest >= threshold || is_bounded() {
                continue;
            }
            if left == 0 || support.len() > WIDEST {
                return false;
            }
            left -= 1;
            if let Some(s) = self.spread(&support, &vector)
                && visit(&s)
            {
                return true;
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
    fn tied(&self, support: &[usize]) -> Vec<Vec<usize>> {
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

    /// The lowest eigenvalue over a support and its vector, the entries off the diagonal being changed.
    fn lowest(&self, support: &[usize], off: impl Fn(f64) -> f64) -> Option<(f64, Vec<f64>)> {
        if let [only] = support {
            return Some((self.entries[(*only, *only)], vec![1.0]));
        }
        let entry = |i: usize, j: usize| {
            if i == j { self.entries[(support[i], support[i])] } else { off(self.entries[(support[i], support[j])]) }
        };
        let part = DMatrix::from_fn(support.len(), support.len(), entry);
        let eigen = SymmetricEigen::try_new(part, f64::EPSILON, 1000)?;
        let (at, lowest) = eigen.eigenvalues.argmin();
        Some((lowest, eigen.eigenvectors.column(at).iter().copied().collect()))
    }

    /// A vector over a support or its negative among all indices, where one has no negative entry.
    fn spread(&self, support: &[usize], vector: &[f64]) -> Option<Vec<f64>> {
        let sign = if vector.iter().sum::<f64>() < 0.0 { -1.0 } else { 1.0 };
        if vector.iter().any(|v| sign * v < -ZERO) {
            return None;
        }
        let mut s = vec![0.0; self.k];
        support.iter().zip(vector).for_each(|(&i, v)| s[i] = (sign * v).max(0.0));
        Some(s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn all_pairs(k: usize, off: f64) -> Vec<f64> {
        (0..k * k).map(|at| if at / k == at % k { 1.0 } else { off }).collect()
    }

    #[test]
    fn violations_that_only_large_faces_show_are_found() {
        // Every principal submatrix of order below k is positive definite.
        for k in 2..9 {
            let edge = -1.0 / (k as f64 - 1.0);
            assert!(matches!(test(&all_pairs(k, 1.01 * edge), k, 10_000), Verdict::Falls(s) if s.iter().all(|s| *s > 0.0)));
            assert_eq!(test(&all_pairs(k, 0.99 * edge), k, 10_000), Verdict::Copositive);
        }
    }

    #[test]
    fn horn_s_matrix_is_copositive_though_no_sum_of_a_definite_and_a_positive_one() {
        // M. Hall, M. Newman, "Copositive and completely positive quadratic forms", 1963.
        let horn = |i: usize, j: usize| if (i + 5 - j) % 5 == 1 || (j + 5 - i) % 5 == 1 { -1.0 } else { 1.0 };
        let mut matrix: Vec<f64> = (0..25).map(|at| horn(at / 5, at % 5)).collect();
        assert_eq!(test(&matrix, 5, 1000), Verdict::Copositive);
        for i in 0..5 {
            matrix[6 * i] = 0.999;
        }
        assert!(matches!(test(&matrix, 5, 1000), Verdict::Falls(_)));
    }

    #[test]
    fn zeros_on_the_diagonal_and_a_budget_of_none() {
        assert!(matches!(test(&[0.0, -1.0, -1.0, 4.0], 2, 100), Verdict::Falls(_)));
        assert_eq!(test(&[0.0, 1.0, 1.0, 0.0], 2, 100), Verdict::Copositive);
        assert_eq!(test(&[0.0; 9], 3, 100), Verdict::Copositive);
        assert_eq!(test(&[], 0, 0), Verdict::Copositive);
        let horn = |i: usize, j: usize| if (i + 5 - j) % 5 == 1 || (j + 5 - i) % 5 == 1 { -1.0 } else { 1.0 };
        let matrix: Vec<f64> = (0..25).map(|at| horn(at / 5, at % 5)).collect();
        assert_eq!(test(&matrix, 5, 0), Verdict::Undecided);
        assert!(matches!(test(&[-1.0], 1, 10), Verdict::Falls(_)));
    }

    /// The least value over a grid of the unit simplex.
    fn sampled(matrix: &[f64], k: usize) -> f64 {
        let steps = 12;
        let mut least = f64::INFINITY;
        let mut counts = vec![0; k];
        loop {
            let square: f64 = counts.iter().map(|&c| (c * c) as f64).sum();
            if square > 0.0 {
                let value: f64 = (0..k * k).map(|at| matrix[at] * (counts[at / k] * counts[at % k]) as f64).sum();
                least = least.min(value / square);
            }
            let Some(at) = counts.iter().position(|&c| c < steps) else { return least };
            counts[at] += 1;
            counts[..at].fill(0);
        }
    }

    proptest! {
        #![proptest_config(ProptestConfig::with_cases(300))]
        #[test]
        fn it_agrees_with_a_grid(entries in prop::collection::vec(-1.0f64..1.0, 10), shift in 0.0f64..1.5) {
            let k = 4;
            let mut matrix = vec![0.0; k * k];
            let mut next = entries.into_iter();
            for i in 0..k {
                for j in 0..=i {
                    let value = next.next().unwrap() + if i == j { shift } else { 0.0 };
                    (matrix[i * k + j], matrix[j * k + i]) = (value, value);
                }
            }
            let least = sampled(&matrix, k);
            match test(&matrix, k, 10_000) {
                Verdict::Falls(s) => {
                    let value: f64 = (0..k * k).map(|at| matrix[at] * s[at / k] * s[at % k]).sum();
                    prop_assert!(value < 0.0 && s.iter().all(|s| *s >= 0.0));
                }
                Verdict::Copositive => prop_assert!(least > -1e-12, "{least}"),
                Verdict::Undecided => prop_assert!(false),
            }
        }
    }
}
