//! Copositivity: whether sᵀMs ≥ 0 for all s ≥ 0.
//!
//! Theorem (W. Kaplan, "A test for copositive matrices", Linear Algebra and its Applications 313, 2000): M is copositive exactly
//! where no principal submatrix has an eigenvector with positive entries to a negative eigenvalue. Such a vector of a least
//! support minimises sᵀMs over the unit vectors of its face, so it belongs to the submatrix's *lowest* eigenvalue; and where
//! that is not negative, also where it is not once some matrix without negative entries is taken off, no submatrix of it need be looked at. Indices that no negative entry ties together are tested apart,
//! which is exact: what stands between them only adds.
//!
//! The work doubles with every index in the worst case: faces are counted, and `Undecided` is an answer.

mod scaled;

use scaled::Scaled;
/// λ < −TOLERANCE·k is negative, the diagonal being 1: rounding of an eigenvalue of a matrix of order k.
const TOLERANCE: f64 = 1e-13;
/// |M_ij| ≤ TIE ties nothing: dropping it moves an eigenvalue by less than TOLERANCE·k.
const TIE: f64 = 1e-14;
/// Entries of an eigenvector of unit length above −ZERO count as not negative: the value is computed anew without them.
const ZERO: f64 = 1e-9;
/// Supports are sets of at most this many indices.
const WIDEST: usize = 64;
/// Steps towards a sum of a definite matrix and one without negative entries: the distance to one falls with their square.
const STEPS: usize = 16;
/// They aim at this lowest eigenvalue, the diagonal being 1: at 0 they would need steps without end.
const BEYOND: f64 = 1e-3;
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

    #[test]
    fn a_sum_of_a_definite_and_a_positive_matrix_needs_few_faces() {
        // Positive entries beside the negative ones of a path: neither M nor its negative part is definite.
        let k = 40;
        let entry = |i: usize, j: usize| match i.abs_diff(j) {
            0 => 1.0,
            1 => -0.62,
            2 => 0.5,
            _ => 0.0,
        };
        let matrix: Vec<f64> = (0..k * k).map(|at| entry(at / k, at % k)).collect();
        assert_eq!(test(&matrix, k, 100), Verdict::Copositive);
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
