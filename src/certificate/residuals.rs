//! How far a point is from first order: slopes, complementarity, and what rounding makes of them.

use super::known_sizes;
use super::multipliers::Multipliers;
use super::point::Point;
use super::second_order;
use crate::certificate::parameters::higher_order::NOISE;
use crate::certificate::parameters::newton::LOWER;
use crate::certificate::parameters::rounding::DIGITS;
use crate::certificate::parameters::runaway::FAR;
use crate::certificate::parameters::second_order::{CONDITION, NEARLY_WEAK};
use crate::linear_algebra::Partition;
use crate::model::{EvaluationError, Model};
use crate::recession;

/// Where something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Place {
    Row(usize),
    Variable(usize),
}

pub(super) type Worst = (Option<Place>, f64);

pub(super) fn worse(worst: Worst, next: (Place, f64)) -> Worst {
    if next.1 > worst.1 { (Some(next.0), next.1) } else { worst }
}

/// max |∂L/∂x_j|·d_j/σ and where, less what rounding explains.
pub(super) fn worst_slope(point: &Point<'_>, multipliers: &Multipliers, rounding: Option<&[f64]>) -> Worst {
    if point.sigma == 0.0 {
        return (None, 0.0);
    }
    let rest = point.row_gradient(&multipliers.rows);
    let slope = |j: usize| {
        let slope = ((rest[j] + multipliers.bounds[j]) * point.sizes[j]).abs();
        let explained = rounding.map_or(0.0, |rounding| rounding[j] * point.sigma);
        (slope - explained).max(0.0) / point.scale_of(j)
    };
    (0..rest.len()).map(|j| (Place::Variable(j), slope(j))).fold((None, 0.0), worse)
}

/// Dual infeasibility where σ itself may be rounding (a start that is stationary, or the minimum): what the last digits of x make
/// of ∂L/∂x_j, through the Hessian, does not count.
pub(super) fn beyond_rounding(point: &Point<'_>, multipliers: &Multipliers) -> Result<f64, EvaluationError> {
    let rounding: Vec<f64> =
        second_order::magnitudes(point, multipliers)?.iter().map(|size| 32.0 * f64::EPSILON * size).collect();
    Ok(worst_slope(point, multipliers, Some(&rounding)).1)
}

/// What rounding may hide in max |∂L/∂x_j|·d_j/σ: ε times the magnitudes it is summed from.
pub(super) fn lost_in_rounding(point: &Point<'_>, multipliers: &Multipliers) -> f64 {
    if point.sigma == 0.0 {
        return 0.0;
    }
    let mut total: Vec<f64> = point.gradient.iter().map(|g| g.abs()).collect();
    let magnitudes: Vec<f64> = point.jacobian.iter().map(|a| a.abs()).collect();
    let weights: Vec<f64> = multipliers.rows.iter().map(|y| y.abs()).collect();
    point.meta().jacobian.add_transposed(&magnitudes, &weights, &mut total);
    let free = (0..total.len()).filter(|&j| !point.meta().is_fixed(j));
    free.fold(0.0, |most: f64, j| most.max(f64::EPSILON * total[j] * point.sizes[j] / point.sigma))
}

/// What the last digits of x make of the objective, in units of σ, beyond rounding of its value: where that is more than what is
/// accepted of a slope, its terms cancel one another and its derivatives may be anything.
pub(super) fn objective_lost(point: &Point<'_>) -> f64 {
    ((last_digits(point) - 64.0 * f64::EPSILON * point.objective.abs()) / point.scale()).max(0.0)
}

/// What the last digits of x make of the objective; those of fixed variables are given. Where it has no value there, a variable that is far from
/// where it comes from has left it none (exponents that cancel one another overflow); elsewhere an edge of the domain is as near, and says nothing.
pub(super) fn last_digits(point: &Point<'_>) -> f64 {
    let nothing = if is_far_out(point) { f64::INFINITY } else { 0.0 };
    let change = |digits: f64| {
        let x = recession::with_digits_moved(point.meta(), point.x, digits);
        point.origin.model.objective(&x).map_or(nothing, |there| (there - point.objective).abs())
    };
    DIGITS.into_iter().map(change).fold(0.0, f64::max)
}

/// Whether a variable is thousands of its sizes from where it comes from.
pub(super) fn is_far_out(point: &Point<'_>) -> bool {
    point.x.iter().zip(&point.meta().start).any(|(&x, &start)| recession::is_farther(x, start, FAR))
}

/// The slope beside the variables' known sizes, where only curvature makes it a small one and the last digits of x make more of the
/// objective than a share of it: far down a tail all is small beside variables that have grown large, and Newton's steps, a few last
/// digits long, tell nothing. 0 elsewhere.
pub(super) fn slope_far_out(point: &Point<'_>, multipliers: &Multipliers) -> Result<f64, EvaluationError> {
    let near = known_sizes::near_sizes(point);
    let is_far = near.iter().zip(&point.sizes).any(|(near, size)| near < size);
    if !point.relies_on_curvature || !is_far || last_digits(point) <= LOWER * point.objective.abs() {
        return Ok(0.0);
    }
    let mut beside = point.in_sizes(near)?;
    beside.add_curvature()?;
    Ok(worst_slope(&beside, multipliers, None).1)
}

/// |multiplier|·|distance to its limit|/σ, limit by limit.
fn complementarity_terms<'a>(point: &'a Point<'_>, multipliers: &'a Multipliers) -> impl Iterator<Item = (Place, f64)> + 'a {
    let term = |multiplier: f64, value: f64, limit: f64| {
        if multiplier == 0.0 { 0.0 } else { multiplier.abs() * (value - limit).abs() / point.scale() }
    };
    let rows = multipliers.rows.iter().enumerate();
    let rows = rows.map(move |(i, &y)| (Place::Row(i), term(y, point.rows[i], point.row_limit(i, y))));
    let bounds = multipliers.bounds.iter().enumerate();
    rows.chain(bounds.map(move |(j, &z)| (Place::Variable(j), term(z, point.x[j], point.bound(j, z)))))
}

/// Scaled multipliers up to which a limit is nearly weakly active, for want of a better solution: what a slope that is left makes of a multiplier that is
/// 0 in truth depends on the conditioning; and one may be as large as its limit is far away.
pub(super) fn nearly_weak(point: &Point<'_>, multipliers: &Multipliers, slope: f64) -> f64 {
    let largest = complementarity_terms(point, multipliers).map(|term| term.1).fold(0.0, f64::max);
    NEARLY_WEAK.min((CONDITION * slope.max(NOISE)).max(largest.sqrt()))
}

/// Their sum, and the largest of them.
pub(super) fn worst_complementarity(point: &Point<'_>, multipliers: &Multipliers) -> Worst {
    let add = |(worst, sum): (Worst, f64), next: (Place, f64)| (worse(worst, next), sum + next.1);
    let (worst, sum) = complementarity_terms(point, multipliers).fold(((None, 0.0), 0.0), add);
    (worst.0, sum)
}

/// Σ|multiplier|·|distance|/σ; where that is not accepted and the model decomposes, of the worst part: many parts that each pass
/// are no fault together.
pub(super) fn complementarity(point: &Point<'_>, multipliers: &Multipliers, accepted: f64) -> f64 {
    let (sum, meta) = (worst_complementarity(point, multipliers).1, point.meta());
    if sum <= accepted {
        return sum;
    }
    let Some(parts) = Partition::of_patterns(&meta.jacobian, &meta.hessian) else { return sum };
    let mut sums = vec![0.0; parts.len()];
    for (place, term) in complementarity_terms(point, multipliers) {
        let variable = match place {
            Place::Row(i) => meta.jacobian.row(i).first().copied(),
            Place::Variable(j) => Some(j as u32),
        };
        // A row without variables is no part's.
        let Some(variable) = variable else { return sum };
        sums[parts.component(variable) as usize] += term;
    }
    sums.into_iter().fold(0.0, f64::max)
}
