//! Repeatable random numbers and starting points.

use crate::math::split_mix::SplitMix;
use crate::model::{Meta, Model, domain};
use crate::recession::size;

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

/// Places per doubling of the distance behind a start, and doublings, in units of the start's own size.
const PLACES: i32 = 24;
const DOUBLINGS: std::ops::Range<i32> = -12..10;

/// The first dips on the line from a start to where runs lead from it, behind the start and before it: what slopes away from a start on one
/// side may rise to a hill on the other, with a valley beyond it.
pub(super) fn dips(model: &dyn Model, start: &[f64], far: &[f64]) -> impl Iterator<Item = Vec<f64>> {
    [-1.0, 1.0].into_iter().filter_map(|way| dip(model, start, far, way))
}

fn dip(model: &dyn Model, start: &[f64], far: &[f64], way: f64) -> Option<Vec<f64>> {
    let place = |step: i32| {
        let distance = (f64::from(step) / f64::from(PLACES)).exp2();
        let one = |(start, far): (&f64, &f64)| {
            if far == start { *start } else { start + way * (far - start).signum() * distance * size(*start) }
        };
        let mut x: Vec<f64> = start.iter().zip(far).map(one).collect();
        model.meta().clamp(&mut x);
        let height = model.objective(&x).unwrap_or(f64::INFINITY);
        (x, height)
    };
    let mut places = (DOUBLINGS.start * PLACES..DOUBLINGS.end * PLACES).map(place);
    let (mut before, mut here) = (places.next()?, places.next()?);
    for next in places {
        if here.1 < before.1 && here.1 < next.1 {
            return Some(here.0);
        }
        (before, here) = (here, next);
    }
    None
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::sample::Sample;

    #[test]
    fn the_dip_behind_a_hill_is_found_wherever_the_origin_is() {
        for origin in [0.0, 4.0, -300.0] {
            let hill = Sample::new(&[origin + 3.0], move |x| {
                let square = (x[0] - origin).powi(2);
                square / (square + 1.0).powi(2)
            });
            let dip = dips(&hill, &[origin + 3.0], &[1e9]).next().unwrap();
            assert!((dip[0] - origin).abs() < 1.0, "{dip:?} beside {origin}");
        }
    }

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
