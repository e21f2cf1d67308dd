//! Values with what rounding may make of them, and what a row of them says of the way they lie along.

use super::parameters::height::{DIGITS, EVEN, LAST};
use crate::math::split_mix::SplitMix;
use crate::model::Meta;

/// How the objective behaves along a feasible way that goes on for ever.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fall {
    /// Every tenfold distance brings at least as much again: −∞.
    Endless,
    /// Every tenfold distance brings less: it settles.
    Settling,
}

/// A value with what rounding may make of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Height {
    pub(super) value: f64,
    pub(super) noise: f64,
}

impl Height {
    pub(super) fn rises_above(self, base: Height) -> bool {
        self.value > base.value + 4.0 * (base.noise + self.noise)
    }
}

/// What the last digits of x, and of where the variables come from, make of a function: `change(x')` is by how much its value at x' differs
/// from that at x. A variable next to 0 has all its digits; what a model makes of it, (x + 16) − 16, has those of the start alone.
pub fn last_digits(meta: &Meta, x: &[f64], change: impl Fn(&[f64]) -> Option<f64>) -> f64 {
    let begun = |(x, start): (&f64, &f64)| if start.abs() > x.abs() { *start } else { *x };
    let sizes: Vec<f64> = x.iter().zip(meta.typical.iter().chain(std::iter::repeat(&0.0))).map(begun).collect();
    let noise_of = |digits: f64, sizes: &[f64]| change(&moved(meta, x, sizes, digits)).unwrap_or(0.0);
    let worst = |sizes: &[f64]| DIGITS.into_iter().map(|digits| noise_of(digits, sizes)).fold(0.0, f64::max);
    if sizes == x { worst(x) } else { worst(x).max(worst(&sizes)) }
}

/// x with each variable moved by up to so many of its last digits, fixed ones left.
pub fn with_digits_moved(meta: &Meta, x: &[f64], digits: f64) -> Vec<f64> {
    moved(meta, x, x, digits)
}

/// x with each variable moved by up to so many last digits of its size, fixed ones left; each by its own: moved alike they would keep their
/// differences.
fn moved(meta: &Meta, x: &[f64], sizes: &[f64], digits: f64) -> Vec<f64> {
    let moved = |(j, (x, size)): (usize, (&f64, &f64))| match meta.is_fixed(j) {
        true => *x,
        false => x + digits * SplitMix::signed(j as u64) * f64::EPSILON * size,
    };
    x.iter().zip(sizes).enumerate().map(moved).collect()
}

/// Whether heights at places each some eight or ten times as far as the one before fall without end: the last falls are beyond
/// rounding, and none is smaller than the one before.
pub(super) fn is_endless(heights: &[Height]) -> bool {
    if heights.len() <= LAST {
        return false;
    }
    let last = &heights[heights.len() - LAST - 1..];
    let falls: Vec<f64> = last.windows(2).map(|pair| pair[0].value - pair[1].value).collect();
    let is_seen = last.windows(2).zip(&falls).all(|(pair, &fall)| fall > pair[0].noise + pair[1].noise);
    is_seen && falls.windows(2).all(|pair| pair[1] >= EVEN * pair[0])
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::recession::parameters::height::ROUNDINGS;

    fn heights(f: impl Fn(f64) -> f64) -> Vec<Height> {
        let places = std::iter::once(0.0).chain((0..30).map(|k| 10f64.powi(k)));
        places.map(f).map(|value| Height { value, noise: ROUNDINGS * value.abs() }).collect()
    }

    #[test]
    fn endless_and_settling_falls_are_told_apart() {
        assert!(is_endless(&heights(|t| -t)));
        assert!(is_endless(&heights(|t| -(1.0 + t).ln())));
        assert!(!is_endless(&heights(|t| 1.0 / (1.0 + t))));
        assert!(!is_endless(&heights(|t| (-t).exp())));
        assert!(!is_endless(&heights(|_| 1.0)));
        // Falls until far out.
        assert!(!is_endless(&heights(|t| -t + 1e-12 * t * t)));
    }
}
