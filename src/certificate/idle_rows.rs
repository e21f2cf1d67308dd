//! Active rows that push nowhere: their gradients vanish at the point (x·y ≤ 0 at the origin), or rest on bounds alone. Stationarity
//! leaves their multipliers open: any of the right sign is as good, the bounds' taking up what they add, and one of them may bend
//! the Lagrangian up where 0 does not.

use super::multipliers::Multipliers;
use super::point::Point;
use crate::certificate::Side;
use crate::certificate::parameters::idle_rows::{MOST, TRIED};
use crate::model::{EvaluationError, Model};

/// A row and the sign its multiplier may have.
pub(super) type Idle = (usize, f64);

/// The rows, which bend although they do not push, with the signs that leave every bound's multiplier on its side.
pub(super) fn of(point: &Point<'_>, (rows, bounds): (&[Side], &[Side])) -> Vec<Idle> {
    let meta = point.meta();
    let rests = |i: usize, sign: f64| {
        meta.jacobian.range(i).all(|at| {
            let push = sign * point.jacobian[at];
            match bounds[meta.jacobian.columns[at] as usize] {
                _ if push == 0.0 => true,
                Side::None => false,
                Side::Lower => push > 0.0,
                Side::Upper => push < 0.0,
                Side::Equal => true,
            }
        })
    };
    let signs = |i: usize| match rows[i] {
        Side::None => &[][..],
        Side::Lower => &[-1.0],
        Side::Upper => &[1.0],
        Side::Equal => &[1.0, -1.0],
    };
    let bent = (0..rows.len()).filter(|&i| rows[i] != Side::None && !meta.is_row_linear(i));
    bent.flat_map(|i| signs(i).iter().map(move |&sign| (i, sign))).filter(|&(i, sign)| rests(i, sign)).collect()
}

/// Multipliers that differ in those of idle rows and of the bounds these rest on, all of them as strong as one another.
pub(super) fn choices(point: &Point<'_>, idle: &[Idle], multipliers: &Multipliers) -> Result<Vec<Multipliers>, EvaluationError> {
    if idle.len() > MOST {
        return Ok(Vec::new());
    }
    let mut units = Vec::new();
    for &(i, sign) in idle {
        let bend = sharpest(point, i)?;
        if bend > 0.0 {
            units.push((i, sign * point.scale() / bend));
        }
    }
    // Of an equality that may push both ways, one at a time.
    let ways = [1.0, -1.0].map(|way| {
        let is_alone = |i: usize| units.iter().filter(|unit| unit.0 == i).count() == 1;
        units.iter().copied().filter(|&(i, unit)| is_alone(i) || unit * way > 0.0).collect::<Vec<_>>()
    });
    let one = |factor: f64| ways.iter().filter(|way| !way.is_empty()).map(move |way| with(point, multipliers, way, factor));
    Ok(TRIED.into_iter().flat_map(one).collect())
}

fn with(point: &Point<'_>, multipliers: &Multipliers, units: &[(usize, f64)], factor: f64) -> Multipliers {
    let (mut rows, mut bounds) = (multipliers.rows.clone(), multipliers.bounds.clone());
    let pattern = &point.meta().jacobian;
    for &(i, unit) in units {
        let more = factor * unit;
        rows[i] += more;
        pattern.range(i).for_each(|at| bounds[pattern.columns[at] as usize] -= more * point.jacobian[at]);
    }
    Multipliers { rows, bounds }
}

/// The largest |∂²c_i/∂x_j∂x_k|·d_j·d_k over variables that can move.
fn sharpest(point: &Point<'_>, i: usize) -> Result<f64, EvaluationError> {
    let meta = point.meta();
    let (mut y, mut values) = (vec![0.0; meta.rows()], vec![0.0; meta.hessian.len()]);
    y[i] = 1.0;
    point.origin.model.hessian(point.x, 0.0, &y, &mut values)?;
    let bend = |((row, column), value): ((usize, usize), f64)| (value * point.sizes[row] * point.sizes[column]).abs();
    let moves = |&((row, column), _): &((usize, usize), f64)| !meta.is_fixed(row) && !meta.is_fixed(column);
    Ok(meta.hessian.iter().zip(values).filter(moves).map(bend).fold(0.0, f64::max))
}
