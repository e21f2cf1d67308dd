//! What the tests of this folder work on: the scaled Hessian, the active set, and which variables and rows are looked at.

use crate::certificate::Side;
use crate::certificate::multipliers::Multipliers;
use crate::certificate::point::Point;
use crate::model::{EvaluationError, Model};

/// Shift of the test, relative to the magnitudes S is summed from: curvature less than this is rounding.
pub(in crate::certificate) const ROUNDING: f64 = 1e-7;
/// Yardstick where nothing bends, in units of σ.
const FLOOR: f64 = 1e-5;

/// The active set at the point.
pub(in crate::certificate) struct Active<'a> {
    pub(in crate::certificate) rows: &'a [Side],
    pub(in crate::certificate) bounds: &'a [Side],
    pub(in crate::certificate) multipliers: &'a Multipliers,
}

/// Which variables and rows are looked at.
#[derive(Default)]
pub(in crate::certificate) struct Choice {
    /// Free variables.
    pub(in crate::certificate) free: Vec<usize>,
    /// Active rows.
    pub(in crate::certificate) held: Vec<usize>,
    /// Variables on bounds with hardly a multiplier.
    pub(in crate::certificate) weak_bounds: Vec<usize>,
    /// Active rows with hardly a multiplier.
    pub(in crate::certificate) weak_rows: Vec<usize>,
}

impl Choice {
    pub(in crate::certificate) fn all(point: &Point<'_>, active: &Active<'_>) -> Choice {
        let mut choice = Choice::default();
        choice.choose(point, active, 0..active.bounds.len(), 0..active.rows.len());
        choice
    }

    /// Free variables and those on bounds that hardly push, ascending.
    pub(in crate::certificate) fn loose_variables(&self) -> Vec<usize> {
        let mut loose = [&self.free[..], &self.weak_bounds].concat();
        loose.sort_unstable();
        loose
    }

    /// Equalities and active rows that push.
    pub(in crate::certificate) fn strict_rows(&self) -> Vec<usize> {
        self.held.iter().copied().filter(|i| self.weak_rows.binary_search(i).is_err()).collect()
    }

    /// Sorts some variables and rows, given ascending.
    pub(in crate::certificate) fn choose(
        &mut self,
        point: &Point<'_>,
        active: &Active<'_>,
        variables: impl Iterator<Item = usize>,
        rows: impl Iterator<Item = usize>,
    ) {
        [&mut self.free, &mut self.held, &mut self.weak_bounds, &mut self.weak_rows].into_iter().for_each(Vec::clear);
        let weak = 1e-6 * point.scale();
        for j in variables {
            match active.bounds[j] {
                Side::None => self.free.push(j),
                Side::Lower | Side::Upper if (active.multipliers.bounds[j] * point.sizes[j]).abs() <= weak => {
                    self.weak_bounds.push(j);
                }
                _ => {}
            }
        }
        for i in rows.filter(|&i| active.rows[i] != Side::None && point.slopes[i] > 0.0) {
            self.held.push(i);
            if active.rows[i] != Side::Equal && (active.multipliers.rows[i] * point.slopes[i]).abs() <= weak {
                self.weak_rows.push(i);
            }
        }
    }
}

/// S = D∇²L D/σ along the model's pattern, and row by row the sum of the magnitudes it is made of.
pub(in crate::certificate) struct Hessian {
    pub(in crate::certificate) values: Vec<f64>,
    pub(in crate::certificate) size: Vec<f64>,
}

impl Hessian {
    /// The diagonal of S, length n.
    pub(in crate::certificate) fn diagonal(&self, point: &Point<'_>) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.size.len()];
        let entries = point.meta().hessian.iter().zip(&self.values);
        entries.filter(|((row, column), _)| row == column).for_each(|((row, _), value)| diagonal[row] += value);
        diagonal
    }

    pub(in crate::certificate) fn of(point: &Point<'_>, multipliers: &Multipliers) -> Result<Hessian, EvaluationError> {
        let (pattern, y) = (&point.meta().hessian, &multipliers.rows);
        let mut hessian = Hessian { values: vec![0.0; pattern.len()], size: vec![0.0; pattern.rows()] };
        let mut part = vec![0.0; pattern.len()];
        let is_linear = &point.meta().row_is_linear;
        // The objective, rows at their upper and rows at their lower limits.
        for (weight, sign) in [(1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let chosen: Vec<f64> = y.iter().map(|&y| if y * sign > 0.0 { y } else { 0.0 }).collect();
            // All entries would be zero where no row bends.
            if weight == 0.0 && chosen.iter().zip(is_linear).all(|(&y, &is_linear)| is_linear || y == 0.0) {
                continue;
            }
            point.origin.model.hessian(point.x, weight, &chosen, &mut part)?;
            for (at, (row, column)) in pattern.iter().enumerate() {
                // In this order: the square of a size far out overflows by itself.
                let entry = part[at] * point.sizes[row] / point.scale() * point.sizes[column];
                hessian.values[at] += entry;
                hessian.size[row] += entry.abs();
                if row != column {
                    hessian.size[column] += entry.abs();
                }
            }
        }
        Ok(hessian)
    }
}

/// The yardstick of a row of S.
pub(in crate::certificate) fn weight(size: f64) -> f64 {
    size + FLOOR
}

/// Where each variable stands among the free ones; `u32::MAX` for the others.
pub(in crate::certificate) fn places(variables: usize, free: &[usize]) -> Vec<u32> {
    let mut place = vec![u32::MAX; variables];
    for (k, &j) in free.iter().enumerate() {
        place[j] = k as u32;
    }
    place
}
