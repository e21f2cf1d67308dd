//! Whether rounding can have changed an inertia.
//!
//! Factors found in rounding are those of B = A + E. Where A + tE is singular for a t in [0, 1], (1 − t)·EB⁻¹ has the eigenvalue 1; where
//! ‖EB⁻¹‖ < 1 in any norm, no eigenvalue passes through zero on the way from B to A, and both have the same inertia. The residual of a
//! solution by these factors is b − AB⁻¹b = EB⁻¹b, which shows the norm: for b of independent components, uniform and of variance one,
//! it is shorter than t·‖EB⁻¹‖ with a probability of no more than √(2/3)·t, as no section of a cube is larger than √2 of a face (Ball,
//! "Cube slicing in Rⁿ", Proc. AMS 97, 1986). Lengths are measured in units of the rows' largest entries.

use crate::math::split_mix::SplitMix;

/// Right-hand sides that are tried,
const PROBES: u64 = 2;
/// and the residual allowed: an inertia that is wrong passes with a probability of (√(2/3)·0.01)² < 1e-4.
const LARGEST: f64 = 1e-2;

/// Whether the factors of a matrix of this order tell its inertia. `entries` are those of its lower triangle, row, column and value; `solve` takes b
/// to B⁻¹b.
pub(super) fn is_certain<E: Iterator<Item = (usize, usize, f64)>>(
    order: usize,
    entries: impl Fn() -> E,
    solve: impl Fn(&[f64]) -> Option<Vec<f64>>,
) -> bool {
    let mut units = vec![0.0; order];
    for (i, j, value) in entries() {
        units[i] = value.abs().max(units[i]);
        units[j] = value.abs().max(units[j]);
    }
    units.iter_mut().filter(|unit| **unit == 0.0).for_each(|unit| *unit = 1.0);
    (0..PROBES).all(|probe| {
        let mut numbers = SplitMix::new(probe);
        let right: Vec<f64> = units.iter().map(|unit| unit * 3.0f64.sqrt() * (2.0 * numbers.uniform() - 1.0)).collect();
        let Some(x) = solve(&right) else { return false };
        let mut left = right;
        for (i, j, value) in entries() {
            left[i] -= value * x[j];
            if i != j {
                left[j] -= value * x[i];
            }
        }
        // A comparison with NaN is false.
        left.iter().zip(&units).map(|(left, unit)| (left / unit).powi(2)).sum::<f64>() <= LARGEST * LARGEST
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of a diagonal matrix, one of its factors being off by `error`.
    fn is_certain_of(diagonal: [f64; 3], error: f64) -> bool {
        let factor = |k: usize| diagonal[k] + if k == 1 { error } else { 0.0 };
        is_certain(3, || (0..3).map(|k| (k, k, diagonal[k])), |right| Some((0..3).map(|k| right[k] / factor(k)).collect()))
    }

    #[test]
    fn errors_beside_the_smallest_eigenvalue_count_in_any_unit() {
        for unit in [1e-150, 1.0, 1e150] {
            assert!(is_certain_of([unit, -1e-11 * unit, 3.0 * unit], 1e-15 * unit));
            assert!(!is_certain_of([unit, -1e-11 * unit, 3.0 * unit], 3e-11 * unit));
            assert!(!is_certain_of([unit, -1e-11 * unit, 3.0 * unit], 1e-11 * unit), "a pivot of zero");
        }
        assert!(!is_certain(1, || std::iter::once((0, 0, 1.0)), |_| None));
    }
}
