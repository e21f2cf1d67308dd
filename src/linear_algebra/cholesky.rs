//! LLᵀ of small dense matrices, in place and without allocation.

/// Pivots below this share of their diagonal are no evidence of positive definiteness.
const SMALLEST_PIVOT: f64 = 1e-14;

/// Overwrites the lower triangle (order n, row by row) by L. `false`: not positive definite beyond rounding; the matrix is
/// then half overwritten.
///
/// ```
/// use ribopt::linear_algebra::cholesky::{factor, solve};
/// let mut matrix = [4.0, 0.0, 2.0, 3.0];
/// assert!(factor(&mut matrix, 2));
/// let mut x = [8.0, 7.0];
/// solve(&matrix, &mut x);
/// assert!((x[0] - 1.25f64).abs() < 1e-15 && (x[1] - 1.5f64).abs() < 1e-15);
/// ```
pub fn factor(matrix: &mut [f64], n: usize) -> bool {
    for i in 0..n {
        let (above, rest) = matrix.split_at_mut(i * n);
        let row = &mut rest[..=i];
        for j in 0..i {
            let other = &above[j * n..j * n + j + 1];
            row[j] = (row[j] - dot(&row[..j], &other[..j])) / other[j];
        }
        let diagonal = row[i];
        let pivot = diagonal - dot(&row[..i], &row[..i]);
        // A comparison with NaN is false, so no NaN passes.
        if !(pivot > SMALLEST_PIVOT * diagonal.abs() && pivot.is_finite()) {
            return false;
        }
        row[i] = pivot.sqrt();
    }
    true
}

/// Overwrites the right-hand side by the solution; the matrix holds L.
pub fn solve(factor: &[f64], x: &mut [f64]) {
    let n = x.len();
    for i in 0..n {
        let row = &factor[i * n..i * n + i + 1];
        x[i] = (x[i] - dot(&row[..i], &x[..i])) / row[i];
    }
    for i in (0..n).rev() {
        let row = &factor[i * n..i * n + i + 1];
        let value = x[i] / row[i];
        x[i] = value;
        for (x, l) in x[..i].iter_mut().zip(row) {
            *x -= l * value;
        }
    }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn indefinite_and_singular_matrices_are_refused() {
        assert!(!factor(&mut [1.0, 0.0, 2.0, 1.0], 2));
        assert!(!factor(&mut [1.0, 0.0, 1.0, 1.0], 2));
        assert!(!factor(&mut [f64::NAN], 1));
        assert!(factor(&mut [], 0));
    }

    #[test]
    fn it_solves_what_it_factorised() {
        let n = 5;
        // The Hilbert matrix plus the identity.
        let entry = |i: usize, j: usize| 1.0 / (i + j + 1) as f64 + f64::from(u8::from(i == j));
        let mut matrix: Vec<f64> = (0..n * n).map(|at| entry(at / n, at % n)).collect();
        let expected: Vec<f64> = (0..n).map(|k| k as f64 - 1.5).collect();
        let mut x: Vec<f64> = (0..n).map(|i| (0..n).map(|j| entry(i, j) * expected[j]).sum()).collect();
        assert!(factor(&mut matrix, n));
        solve(&matrix, &mut x);
        assert!(x.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-14), "{x:?}");
    }
}
