//! The few vector operations the interior point needs.

/// Largest magnitude, 0 for none.
pub(super) fn norm_max(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

/// Sum of magnitudes.
pub(super) fn norm_sum(values: &[f64]) -> f64 {
    values.iter().map(|value| value.abs()).sum()
}

/// target = point + length·step
pub(super) fn moved(point: &[f64], length: f64, step: &[f64], target: &mut [f64]) {
    for ((target, point), step) in target.iter_mut().zip(point).zip(step) {
        *target = point + length * step;
    }
}

/// The nearest power of two: scaling by it is free of rounding.
pub(super) fn power_of_two(value: f64) -> f64 {
    2f64.powi(value.log2().round().clamp(-1000.0, 1000.0) as i32)
}
