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

/// What the last digits of x make of a function: `change(x')` is by how much its value at x' differs from that at x. Those of fixed variables
/// are given.
pub(super) fn last_digits(meta: &Meta, x: &[f64], change: impl Fn(&[f64]) -> Option<f64>) -> f64 {
    let noise_of = |digits: f64| change(&with_digits_moved(meta, x, digits)).unwrap_or(0.0);
    DIGITS.into_iter().map(noise_of).fold(0.0, f64::max)
}

/// x with each variable moved by up to so many of its last digits, fixed ones left; each by its own: moved alike they would keep their
/// differences.
pub fn with_digits_moved(meta: &Meta, x: &[f64], digits: f64) -> Vec<f64> {
    let moved = |(j, x): (usize, &f64)| match meta.is_fixed(j) {
        true => *x,
        false => x * (1.0 + digits * SplitMix::signed(j as u64) * f64::EPSILON),
    };
    x.iter().enumerate().map(moved).collect()
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
