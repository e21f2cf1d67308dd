//! Repeatable random numbers and starting points.

use crate::math::split_mix::SplitMix;
use crate::model::{Meta, domain};

/// A seeded stream of numbers and points.
pub(super) struct Seeds(SplitMix);

impl Seeds {
    pub(super) fn new(seed: u64) -> Self {
        Seeds(SplitMix::new(seed))
    }

    /// Uniform in [0, 1).
    pub(super) fn uniform(&mut self) -> f64 {
        self.0.uniform()
    }

    /// A point of the box: uniform between two bounds, in the logarithm where they are positive and far apart; elsewhere some
    /// way off the start.
    pub(super) fn point(&mut self, meta: &Meta) -> Vec<f64> {
        let mut one = |(start, (lower, upper)): (&f64, (&f64, &f64))| {
            let u = self.uniform();
            match (lower.is_finite(), upper.is_finite()) {
                (true, true) if *lower > 0.0 && upper / lower > 100.0 => lower * (upper / lower).powf(u),
                (true, true) => lower + u * (upper - lower),
                (true, false) => lower + 2.0 * u * (start - lower).max(1.0),
                (false, true) => upper - 2.0 * u * (upper - start).max(1.0),
                (false, false) => start + (2.0 * u - 1.0) * 3.0 * start.abs().max(1.0),
            }
        };
        meta.start.iter().zip(meta.lower.iter().zip(&meta.upper)).map(&mut one).collect()
    }
}

/// The middle of the bounds; where one is open, off the start.
pub(super) fn middle(meta: &Meta) -> Vec<f64> {
    (0..meta.variables()).map(|j| domain::middle(meta.start[j], meta.lower[j], meta.upper[j], j)).collect()
}

/// 0, or the bound that is nearest to it: a place no start decides.
pub(super) fn origin(meta: &Meta) -> Vec<f64> {
    let mut x = vec![0.0; meta.variables()];
    meta.clamp(&mut x);
    x
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn points_stay_in_the_box_and_repeat() {
        let (lower, upper) = (vec![1e-6, -2.0, 3.0, f64::NEG_INFINITY], vec![1e6, 2.0, f64::INFINITY, f64::INFINITY]);
        let meta = Meta { lower, upper, start: vec![1.0, 0.0, 4.0, 0.0], ..Meta::default() };
        let (mut a, mut b) = (Seeds::new(7), Seeds::new(7));
        for _ in 0..100 {
            let point = a.point(&meta);
            assert_eq!(point, b.point(&meta));
            for (x, (l, u)) in point.iter().zip(meta.lower.iter().zip(&meta.upper)) {
                assert!(x >= l && x <= u);
            }
        }
    }
}
