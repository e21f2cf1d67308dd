//! What the certificate measures by (docs/certificate.md, «Measures»): sizes of variables, terms of rows, and how steep the
//! objective is about a point. Nothing here looks at a start the program has invented, nor at values or derivatives at a start.
//! Sizes that are not seen at the point: `known_sizes`.

use super::point::{Origin, Point};
use crate::certificate::parameters::sizes::ABOUT;
use crate::math::split_mix::SplitMix;
use crate::model::{Meta, Model};

/// Which variables have no size but the 1 that stands for want of anything better: none at the point, no start, no bound and no
/// row's limit tells.
pub(super) fn invented(meta: &Meta, x: &[f64], jacobian: &[f64]) -> Vec<bool> {
    let is_number = |size: &f64| *size > 0.0 && size.is_finite();
    let is_open = |j: usize| {
        let bounds = [meta.lower[j].abs(), meta.upper[j].abs()];
        x[j].abs() < 1.0 && !meta.typical.get(j).is_some_and(is_number) && !bounds.iter().any(is_number)
    };
    let mut invented: Vec<bool> = (0..x.len()).map(is_open).collect();
    for i in (0..meta.rows()).filter(|&i| largest_limit(meta, i) > 0.0) {
        let limits = meta.jacobian.range(i).filter(|&at| jacobian[at] != 0.0);
        limits.for_each(|at| invented[meta.jacobian.columns[at] as usize] = false);
    }
    invented
}

/// The larger magnitude of row i's finite limits, less the row's constant term; 0 where it has none. On which side of a row a constant
/// is written makes no difference.
pub(super) fn largest_limit(meta: &Meta, i: usize) -> f64 {
    let constant = meta.row_constants.get(i).copied().unwrap_or(0.0);
    [meta.row_lower[i], meta.row_upper[i]]
        .into_iter()
        .filter(|limit| limit.is_finite())
        .fold(0.0, |most, limit| (limit - constant).abs().max(most))
}

/// The largest terms |∂c_i/∂x_j·x_j| row by row: for linear rows their terms, for others those of their first-order form.
#[derive(Clone)]
pub(super) struct RowTerms {
    /// Over the variables that can move (over all, where none of a row's can): what a violation is measured by. A fixed variable's
    /// term is a constant, and says nothing of how near the others bring the row to its limit.
    pub(super) moving: Vec<f64>,
    /// Over all variables: what rounding is measured by.
    pub(super) all: Vec<f64>,
}

/// The terms of every row at x.
pub(super) fn row_terms(meta: &Meta, x: &[f64], jacobian: &[f64]) -> RowTerms {
    let largest = |i: usize, counts: &dyn Fn(usize) -> bool| {
        let entries = meta.jacobian.range(i).map(|at| (at, meta.jacobian.columns[at] as usize));
        entries.filter(|&(_, j)| counts(j)).map(|(at, j)| (jacobian[at] * x[j]).abs()).fold(0.0, f64::max)
    };
    let can_move = |j: usize| !meta.is_fixed(j);
    let moves = |i: usize| meta.jacobian.row(i).iter().any(|&j| can_move(j as usize));
    RowTerms {
        moving: (0..meta.rows()).map(|i| largest(i, &|j| can_move(j) || !moves(i))).collect(),
        all: (0..meta.rows()).map(|i| largest(i, &|_| true)).collect(),
    }
}

/// Row by row the mean slope over a relative step of all variables, |c_i(x') − c_i(x)| over the step, the larger of both ways:
/// where a derivative has no end, this has. `None` where the model has no value about x.
pub(super) fn mean_slopes(origin: &Origin<'_>, x: &[f64], rows: &[f64]) -> Option<Vec<f64>> {
    ABOUT.into_iter().find_map(|step| {
        let ways = [step, -step].map(|way| {
            let mut values = vec![0.0; rows.len()];
            origin.model.constraints(&moved(origin.meta(), x, x, way), &mut values).ok().map(|()| values)
        });
        let mut largest: Option<Vec<f64>> = None;
        for values in ways.into_iter().flatten() {
            let slopes = values.iter().zip(rows).map(|(there, here)| (there - here).abs() / step);
            largest = Some(match largest {
                Some(known) => known.iter().zip(slopes).map(|(known, slope)| known.max(slope)).collect(),
                None => slopes.collect(),
            });
        }
        largest
    })
}

/// The largest slope |∂f/∂x_j|·d_j at the less steep of two places about x, each variable moved by up to a tenth of its size: how
/// steep the objective is where it is stationary at x itself. 0 where it has no slope about x.
pub(super) fn slope_about(origin: &Origin<'_>, x: &[f64], sizes: &[f64]) -> f64 {
    let slope = |way: f64| {
        let mut gradient = vec![0.0; x.len()];
        origin.model.gradient(&moved(origin.meta(), x, sizes, way), &mut gradient).ok()?;
        let free = (0..x.len()).filter(|&j| !origin.meta().is_fixed(j));
        Some(free.map(|j| (gradient[j] * sizes[j]).abs()).fold(0.0, f64::max)).filter(|slope| slope.is_finite())
    };
    let less_steep = |step: f64| match (slope(step), slope(-step)) {
        (Some(a), Some(b)) => Some(a.min(b)),
        (one, other) => one.or(other),
    };
    ABOUT.into_iter().find_map(less_steep).unwrap_or(0.0)
}

/// Whether over a step of a tenth of its size in variable j alone ∂f/∂x_j changes by what a second derivative of this magnitude
/// says, within a factor of two.
pub(super) fn is_quadratic(point: &Point<'_>, j: usize, second: f64) -> bool {
    let size = point.sizes[j];
    let step = ABOUT[0] * size;
    let (mut there, mut gradient) = (point.x.to_vec(), vec![0.0; point.x.len()]);
    there[j] += step;
    let said = second * step / size;
    point.origin.model.gradient(&there, &mut gradient).is_ok_and(|_| {
        let change = (gradient[j] - point.gradient[j]).abs();
        change > 0.5 * said && change < 2.0 * said
    })
}

/// x + way·u∘sizes, u in [½, 1] without a pattern, so that sums and differences of variables move, too. A variable that a bound
/// would stop goes the other way: where nothing moves, nothing is learnt.
pub(super) fn moved(meta: &Meta, x: &[f64], sizes: &[f64], way: f64) -> Vec<f64> {
    let share = |j: usize| 0.5 + 0.5 * SplitMix::share(j as u64);
    let there = |j: usize| {
        let (step, lower, upper) = (way * share(j) * sizes[j].abs(), meta.lower[j], meta.upper[j]);
        let ahead = x[j] + step;
        let target = if ahead < lower || ahead > upper { x[j] - step } else { ahead };
        target.max(lower).min(upper)
    };
    (0..x.len()).map(there).collect()
}
