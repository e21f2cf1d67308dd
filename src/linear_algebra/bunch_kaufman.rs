//! LDLᵀ of small dense symmetric indefinite matrices, in place and without allocation, with the inertia.
//!
//! Bunch and Kaufman, "Some stable methods for calculating inertia and solving symmetric linear systems", Math. Comp. 31
//! (1977): the partial pivoting of LAPACK's dsytf2, lower triangle.

use super::Inertia;

/// (1 + √17)/8
const ALPHA: f64 = 0.640_388_203_202_208;

/// A pivot: where row and column k were taken from, and whether it is the first of a 2×2 block (its second follows).
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct Pivot {
    from: u32,
    pair: bool,
}

/// Overwrites the lower triangle (order n = pivots.len(), row by row) by L and D. Zero pivots are counted and left.
///
/// ```
/// use ribopt::linear_algebra::bunch_kaufman::{Pivot, factor, solve};
/// let (mut matrix, mut pivots) = ([0.0, 0.0, 1.0, 0.0], [Pivot::default(); 2]);
/// let inertia = factor(&mut matrix, &mut pivots);
/// assert_eq!((inertia.positive, inertia.negative), (1, 1));
/// let mut x = [3.0, 5.0];
/// solve(&matrix, &pivots, &mut x);
/// assert_eq!(x, [5.0, 3.0]);
/// ```
pub fn factor(matrix: &mut [f64], pivots: &mut [Pivot]) -> Inertia {
    let n = pivots.len();
    let mut inertia = Inertia { positive: 0, negative: 0, zero: 0 };
    let mut k = 0;
    while k < n {
        let (from, pair) = choose(matrix, n, k);
        let target = k + usize::from(pair);
        swap(matrix, n, target, from, k);
        pivots[k] = Pivot { from: from as u32, pair };
        if pair {
            pivots[k + 1] = pivots[k];
            eliminate_pair(matrix, n, k);
            // The pivoting rule makes the block's determinant negative.
            inertia.positive += 1;
            inertia.negative += 1;
            k += 2;
        } else {
            let d = matrix[k * n + k];
            eliminate_one(matrix, n, k);
            match d {
                d if d > 0.0 => inertia.positive += 1,
                d if d < 0.0 => inertia.negative += 1,
                _ => inertia.zero += 1,
            }
            k += 1;
        }
    }
    inertia
}

/// x = A⁻¹·right, refined once: `matrix` is the lower triangle of A, `factors` and `pivots` what [`factor`] made of it.
pub fn solve_refined(
    matrix: &[f64],
    factors: &[f64],
    pivots: &[Pivot],
    right: &[f64],
    x: &mut Vec<f64>,
    residual: &mut Vec<f64>,
) {
    let n = pivots.len();
    x.clear();
    x.extend_from_slice(right);
    solve(factors, pivots, x);
    residual.clear();
    residual.extend_from_slice(right);
    for i in 0..n {
        for j in 0..=i {
            residual[i] -= matrix[i * n + j] * x[j];
            if j < i {
                residual[j] -= matrix[i * n + j] * x[i];
            }
        }
    }
    solve(factors, pivots, residual);
    x.iter_mut().zip(residual).for_each(|(value, correction)| *value += *correction);
}

/// The row to bring forward, and whether a 2×2 block is needed.
fn choose(matrix: &[f64], n: usize, k: usize) -> (usize, bool) {
    let own = matrix[k * n + k].abs();
    let (mut row, mut column_most) = (k, 0.0);
    for i in k + 1..n {
        let entry = matrix[i * n + k].abs();
        if entry > column_most {
            (row, column_most) = (i, entry);
        }
    }
    if own >= ALPHA * column_most {
        return (k, false);
    }
    let left = matrix[row * n + k..row * n + row].iter().fold(0.0, |most: f64, v| most.max(v.abs()));
    let row_most = (row + 1..n).fold(left, |most, i| most.max(matrix[i * n + row].abs()));
    if own * row_most >= ALPHA * column_most * column_most {
        (k, false)
    } else {
        (row, matrix[row * n + row].abs() < ALPHA * row_most)
    }
}

/// Exchanges rows and columns a ≤ b of the part that is not yet eliminated (from column k on).
fn swap(matrix: &mut [f64], n: usize, a: usize, b: usize, k: usize) {
    if a == b {
        return;
    }
    for j in k..a {
        matrix.swap(a * n + j, b * n + j);
    }
    for i in a + 1..b {
        matrix.swap(i * n + a, b * n + i);
    }
    for i in b + 1..n {
        matrix.swap(i * n + a, i * n + b);
    }
    matrix.swap(a * n + a, b * n + b);
}

fn eliminate_one(matrix: &mut [f64], n: usize, k: usize) {
    let d = matrix[k * n + k];
    if d == 0.0 {
        return;
    }
    for i in k + 1..n {
        let factor = matrix[i * n + k] / d;
        if factor != 0.0 {
            for j in k + 1..=i {
                // Column k of earlier rows holds L already: times d is what it was.
                let other = if j == i { matrix[i * n + k] } else { matrix[j * n + k] * d };
                matrix[i * n + j] -= factor * other;
            }
        }
        matrix[i * n + k] = factor;
    }
}

fn eliminate_pair(matrix: &mut [f64], n: usize, k: usize) {
    let (a, b, c) = (matrix[k * n + k], matrix[(k + 1) * n + k], matrix[(k + 1) * n + k + 1]);
    for i in k + 2..n {
        let (u, v) = (matrix[i * n + k], matrix[i * n + k + 1]);
        let (p, q) = solve_pair(a, b, c, u, v);
        for j in k + 2..=i {
            let (other_u, other_v) = if j == i {
                (u, v)
            } else {
                let (p, q) = (matrix[j * n + k], matrix[j * n + k + 1]);
                (a * p + b * q, b * p + c * q)
            };
            matrix[i * n + j] -= p * other_u + q * other_v;
        }
        (matrix[i * n + k], matrix[i * n + k + 1]) = (p, q);
    }
}

/// Solves [a b; b c]·(p, q) = (u, v), scaled by b, the largest entry.
fn solve_pair(a: f64, b: f64, c: f64, u: f64, v: f64) -> (f64, f64) {
    let (a, c, u, v) = (a / b, c / b, u / b, v / b);
    let determinant = a * c - 1.0;
    ((c * u - v) / determinant, (a * v - u) / determinant)
}

/// Overwrites the right-hand side by the solution. Zero pivots give zeros.
pub fn solve(factors: &[f64], pivots: &[Pivot], x: &mut [f64]) {
    let n = pivots.len();
    let mut k = 0;
    while k < n {
        let Pivot { from, pair } = pivots[k];
        let width = 1 + usize::from(pair);
        x.swap(k + width - 1, from as usize);
        for i in k + width..n {
            x[i] -= factors[i * n + k..i * n + k + width].iter().zip(&x[k..k + width]).map(|(l, x)| l * x).sum::<f64>();
        }
        if pair {
            let (a, b, c) = (factors[k * n + k], factors[(k + 1) * n + k], factors[(k + 1) * n + k + 1]);
            (x[k], x[k + 1]) = solve_pair(a, b, c, x[k], x[k + 1]);
        } else {
            let d = factors[k * n + k];
            x[k] = if d == 0.0 { 0.0 } else { x[k] / d };
        }
        k += width;
    }
    while k > 0 {
        let width = 1 + usize::from(pivots[k - 1].pair);
        k -= width;
        for at in k..k + width {
            x[at] -= (k + width..n).map(|i| factors[i * n + at] * x[i]).sum::<f64>();
        }
        x.swap(k + width - 1, pivots[k].from as usize);
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn check(n: usize, lower: &[f64]) {
        let entry = |i: usize, j: usize| lower[i.max(j) * (i.max(j) + 1) / 2 + i.min(j)];
        let mut matrix: Vec<f64> = (0..n * n).map(|at| entry(at / n, at % n)).collect();
        let mut pivots = vec![Pivot::default(); n];
        let inertia = factor(&mut matrix, &mut pivots);
        let dense = nalgebra::DMatrix::from_fn(n, n, entry);
        let eigenvalues = dense.clone().symmetric_eigenvalues();
        let largest = eigenvalues.amax();
        if eigenvalues.iter().any(|value| value.abs() <= 1e-6 * largest) {
            return;
        }
        assert_eq!(inertia.positive, eigenvalues.iter().filter(|value| **value > 0.0).count());
        assert_eq!(inertia.positive + inertia.negative, n);
        let expected = nalgebra::DVector::from_fn(n, |k, _| k as f64 - 1.0);
        let mut x: Vec<f64> = (&dense * &expected).iter().copied().collect();
        solve(&matrix, &pivots, &mut x);
        assert!(x.iter().zip(&expected).all(|(a, b)| (a - b).abs() < 1e-6), "{x:?}");
    }

    proptest! {
        #[test]
        fn inertia_and_solution_agree_with_eigenvalues(n in 1_usize..9, lower in prop::collection::vec(-1.0..1.0_f64, 36)) {
            check(n, &lower);
        }

        #[test]
        fn matrices_with_many_zeros_too(n in 1_usize..9, lower in prop::collection::vec(-1_i8..=1, 36)) {
            let lower: Vec<f64> = lower.into_iter().map(f64::from).collect();
            check(n, &lower);
        }
    }

    #[test]
    fn zero_pivots_are_counted() {
        let mut pivots = [Pivot::default(); 2];
        assert_eq!(factor(&mut [0.0, 0.0, 0.0, 3.0], &mut pivots), Inertia { positive: 1, negative: 0, zero: 1 });
    }
}
