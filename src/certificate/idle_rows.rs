//! Active rows whose gradient vanishes at the point (x·y ≤ 0 at the origin). They push nowhere, so stationarity leaves their
//! multipliers open: any of the right sign is as good, and one of them may bend the Lagrangian up where 0 does not.

use super::multipliers::Multipliers;
use super::point::Point;
use crate::certificate::Side;
use crate::model::{EvaluationError, Model};

/// Such rows looked at.
const MOST: usize = 8;
/// Multipliers tried, in units of what bends the row as much as the objective: −4xy beside xy ≤ 0 needs one of 2 such units.
const TRIED: [f64; 4] = [1.0, 4.0, 16.0, 256.0];

/// The rows, which bend although they do not push.
pub(super) fn of(point: &Point<'_>, sides: &[Side]) -> Vec<usize> {
    let is_idle = |&i: &usize| sides[i] != Side::None && point.slopes[i] == 0.0 && !point.meta().is_row_linear(i);
    (0..sides.len()).filter(is_idle).collect()
}

/// Multipliers that differ in those of idle rows alone, all of them as strong as one another.
pub(super) fn choices(
    point: &Point<'_>,
    (rows, sides): (&[usize], &[Side]),
    multipliers: &Multipliers,
) -> Result<Vec<Multipliers>, EvaluationError> {
    if rows.len() > MOST {
        return Ok(Vec::new());
    }
    let mut units = Vec::new();
    for &i in rows {
        let bend = sharpest(point, i)?;
        let sign = if sides[i] == Side::Lower { -1.0 } else { 1.0 };
        if bend > 0.0 {
            units.push((i, sign * point.scale() / bend));
        }
    }
    let is_two_sided = rows.iter().any(|&i| sides[i] == Side::Equal);
    let signs: &[f64] = if is_two_sided { &[1.0, -1.0] } else { &[1.0] };
    let choice = |factor: f64, sign: f64| {
        let mut rows = multipliers.rows.clone();
        units.iter().for_each(|&(i, unit)| rows[i] = factor * unit * if sides[i] == Side::Equal { sign } else { 1.0 });
        Multipliers { rows, bounds: multipliers.bounds.clone() }
    };
    let one = |factor: f64| signs.iter().map(move |&sign| choice(factor, sign)).collect::<Vec<_>>();
    Ok(TRIED.into_iter().flat_map(one).collect())
}

/// The largest |∂²c_i/∂x_j∂x_k|·d_j·d_k.
fn sharpest(point: &Point<'_>, i: usize) -> Result<f64, EvaluationError> {
    let meta = point.meta();
    let (mut y, mut values) = (vec![0.0; meta.rows()], vec![0.0; meta.hessian.len()]);
    y[i] = 1.0;
    point.origin.model.hessian(point.x, 0.0, &y, &mut values)?;
    let bend = |((row, column), value): ((usize, usize), f64)| (value * point.sizes[row] * point.sizes[column]).abs();
    Ok(meta.hessian.iter().zip(values).map(bend).fold(0.0, f64::max))
}
