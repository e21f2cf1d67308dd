//! The slopes that are left at a point, and which directions count as flat beside them.

use crate::certificate::multipliers::Multipliers;
use crate::certificate::parameters::higher_order::{FLAT, NOISE};
use crate::certificate::point::Point;
use crate::certificate::second_order::{Active, Choice};

/// Up to which curvature a direction counts as flat. Where f falls by a slope r along one and bends up by κ, there is a minimum ahead if κ² ≥ 2·f'''·r;
/// FLAT is κ for the largest third derivative that is thought of and the largest accepted r, and less is enough for the slope that is left of ∇L: what
/// a multiplier takes up falls no farther than to its limit.
pub(super) fn flatness(point: &Point<'_>, active: &Active<'_>, choice: &Choice, accepted: f64) -> f64 {
    let slopes = point.row_gradient(&active.multipliers.rows);
    let left = |j: usize| (slopes[j] + active.multipliers.bounds[j]).abs() * point.sizes[j] / point.scale();
    let fall = choice.loose_variables().into_iter().map(left).fold(NOISE, f64::max);
    FLAT * (fall / accepted).sqrt().min(1.0)
}

/// ∇f + Jᵀy, with all multipliers and without those of rows that are weakly active, or nearly: these cannot be told from 0.
pub(super) fn slopes(point: &Point<'_>, multipliers: &Multipliers, choice: &Choice) -> [Vec<f64>; 2] {
    [&multipliers.rows, &without_weak(choice, multipliers)].map(|y| point.row_gradient(y))
}

/// The row multipliers but for those of weakly active rows.
fn without_weak(choice: &Choice, multipliers: &Multipliers) -> Vec<f64> {
    let mut y = multipliers.rows.clone();
    choice.weak_rows.iter().for_each(|&i| y[i] = 0.0);
    y
}
