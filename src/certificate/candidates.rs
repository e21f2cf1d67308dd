//! Limits close enough to carry a multiplier.

use super::point::Point;
use crate::certificate::parameters::multipliers::REACH;

/// What a multiplier belongs to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Owner {
    Row(usize),
    Bound(usize),
}

/// One multiplier to be found: which limit, which sign, how far the point is from it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Candidate {
    pub(super) owner: Owner,
    /// +1: must be ≥ 0 (an upper side); −1: ≤ 0 (a lower side); 0: an equality, any sign.
    pub(super) sign: f64,
    /// Distance to the limit over the row's slope ‖D∇c_i‖∞ (bounds: over d_j): what one unit of scaled multiplier costs in
    /// complementarity.
    pub(super) distance: f64,
}

impl Candidate {
    /// Whether its multiplier may have this sign.
    pub(super) fn carries(&self, multiplier: f64) -> bool {
        self.sign == 0.0 || self.sign * multiplier > 0.0
    }
}

/// The rows with a side within reach, ascending. Rows whose gradient vanishes push nowhere and are left out.
pub(super) fn near_rows(point: &Point<'_>) -> Vec<usize> {
    (0..point.meta().rows()).filter(|&i| point.slopes[i] > 0.0 && row(point, i).next().is_some()).collect()
}

/// The sides of row i within reach.
pub(super) fn row(point: &Point<'_>, i: usize) -> impl Iterator<Item = Candidate> {
    let meta = point.meta();
    sides(Owner::Row(i), point.rows[i], meta.row_lower[i], meta.row_upper[i], point.slopes[i])
}

/// The bounds of variable j within reach.
pub(super) fn bounds(point: &Point<'_>, j: usize) -> impl Iterator<Item = Candidate> {
    let meta = point.meta();
    sides(Owner::Bound(j), point.x[j], meta.lower[j], meta.upper[j], point.sizes[j])
}

fn sides(owner: Owner, value: f64, lower: f64, upper: f64, scale: f64) -> impl Iterator<Item = Candidate> {
    let all = if lower == upper { [(0.0, lower), (f64::NAN, 0.0)] } else { [(-1.0, lower), (1.0, upper)] };
    let candidate = move |(sign, limit): (f64, f64)| Candidate { owner, sign, distance: (value - limit).abs() / scale };
    // A comparison with NaN is false, so the second place of an equality drops out here.
    let near = |c: &Candidate| c.sign == 0.0 || (c.sign.abs() == 1.0 && c.distance <= REACH);
    all.into_iter().map(candidate).filter(near)
}
