//! What is known of the variables' sizes (docs/certificate.md, «Measures»): at the point, or, where a variable is smaller than that,
//! from limits of rows, starts and bounds.

use super::point::{Origin, Point};
use super::scales::{largest_limit, moved};
use crate::certificate::parameters::feasibility::FAR;
use crate::certificate::parameters::sizes::{BENT, SHRINKINGS, SHRUNK, UNTOLD};
use crate::model::{Meta, Model};

/// d_j: |x_j|, or, where the bounds allow 0 and x_j is smaller than that, the size that is known of the variable otherwise: the
/// least of what a row's limit says (|limit|/|∂c_i/∂x_j|), of the start that was given (where none was: of a bound), and of
/// bounds on both sides; 1 where none of these tells. A size that is too small makes a test stricter, never laxer.
pub(super) fn variable_sizes(origin: &Origin<'_>, x: &[f64], jacobian: &[f64]) -> Vec<f64> {
    let (meta, known) = (origin.meta(), known_sizes(origin, x, jacobian));
    let size = |(j, &x): (usize, &f64)| {
        let size = if may_be_zero(meta, j) { x.abs().max(known[j]) } else { x.abs() };
        // Neither lost in an underflow nor, for an infeasible 0, nothing at all.
        if size > f64::MIN_POSITIVE { size } else { known[j].max(f64::MIN_POSITIVE) }
    };
    x.iter().enumerate().map(size).collect()
}

fn may_be_zero(meta: &Meta, j: usize) -> bool {
    meta.lower[j] <= 0.0 && meta.upper[j] >= 0.0
}

/// What is known of the variables' sizes but for the point itself, see [`variable_sizes`]. What bent rows' limits tell is what
/// they tell of all their variables together: x·y ≤ 1 beside (1e−8, 1e−8) says neither that x is 1e8 nor that y is, and x² ≤ 1
/// tells a size also beside 0, where it has no slope.
pub(super) fn known_sizes(origin: &Origin<'_>, x: &[f64], jacobian: &[f64]) -> Vec<f64> {
    told_sizes(origin, x, jacobian).into_iter().map(or_one).collect()
}

/// What is known of the variables' sizes where a model starts; `None` where it has no derivatives there.
pub fn sizes_at_start(model: &dyn Model) -> Option<Vec<f64>> {
    sizes_known_at(model, &model.meta().start)
}

/// The same at any point x, whose own magnitude tells nothing.
pub fn sizes_known_at(model: &dyn Model, x: &[f64]) -> Option<Vec<f64>> {
    let mut jacobian = vec![0.0; model.meta().jacobian.len()];
    model.jacobian(x, &mut jacobian).ok()?;
    Some(known_sizes(&Origin::new(model), x, &jacobian))
}

/// Whether the terms of a row with one of these variables (ascending) are more than `most` times what its limit, or its terms where the model
/// starts, amount to: what is accepted of a violation is relative to a row's terms, and may hide a contradiction where they have grown.
pub fn have_rows_grown(model: &dyn Model, x: &[f64], variables: &[usize], most: f64) -> bool {
    let meta = model.meta();
    let jacobian = |x: &[f64]| {
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        model.jacobian(x, &mut jacobian).map(|()| jacobian)
    };
    // Where there are no derivatives nothing speaks against it.
    let (Ok(before), Ok(now)) = (jacobian(&meta.start), jacobian(x)) else { return true };
    let sizes = known_sizes(&Origin::new(model), &meta.start, &before);
    let largest = |i: usize, jacobian: &[f64], size: &dyn Fn(usize) -> f64| {
        let term = |at: usize| (jacobian[at] * size(meta.jacobian.columns[at] as usize)).abs();
        meta.jacobian.range(i).map(term).fold(0.0, f64::max)
    };
    let has_grown = |i: usize| {
        let at_start = largest(i, &before, &|j| meta.start[j].abs().max(sizes[j]));
        largest(i, &now, &|j| x[j]) > most * at_start.max(largest_limit(meta, i))
    };
    let is_one = |at: usize| variables.binary_search(&(meta.jacobian.columns[at] as usize)).is_ok();
    let has_one = |i: &usize| meta.jacobian.range(*i).any(|at| is_one(at) && (before[at] != 0.0 || now[at] != 0.0));
    (0..meta.rows()).filter(has_one).any(has_grown)
}

/// The sizes of the variables with those far away held back to [`FAR`] times what is known of them.
pub(super) fn near_sizes(point: &Point<'_>) -> Vec<f64> {
    let known = known_sizes(point.origin, point.x, &point.jacobian);
    point.sizes.iter().zip(known).map(|(d, known)| d.min(FAR * known)).collect()
}

/// The same, infinite where nothing tells.
pub(super) fn told_sizes(origin: &Origin<'_>, x: &[f64], jacobian: &[f64]) -> Vec<f64> {
    let meta = origin.meta();
    let mut told = Told::by_slopes(meta, jacobian);
    let doubted = told.doubted(meta, x);
    let (tries, length) = if doubted.is_empty() { (0, 0) } else { (SHRINKINGS, jacobian.len()) };
    doubted.iter().for_each(|&(.., j)| told.known[j] = told.known[j].min(UNTOLD));
    let mut there = vec![0.0; length];
    for _ in 0..tries {
        let sizes: Vec<f64> = told.known.iter().zip(x).map(|(&known, x)| or_one(known).max(x.abs())).collect();
        let has_value = origin.model.jacobian(&moved(meta, x, &sizes, 1.0), &mut there).is_ok();
        let mut excess = vec![0.0f64; x.len()];
        for &(at, limit, j) in &doubted {
            let slope = if has_value { there[at].abs() } else { f64::INFINITY };
            excess[j] = excess[j].max(slope * told.known[j] / limit);
        }
        let shrunk = (0..x.len()).filter(|&j| excess[j] > BENT);
        if shrunk.map(|j| told.known[j] *= excess[j].powf(-0.25).max(SHRUNK)).count() == 0 {
            break;
        }
    }
    doubted.iter().for_each(|&(.., j)| {
        if told.known[j] == UNTOLD {
            told.known[j] = f64::INFINITY;
        }
    });
    told.known
}

/// A size, or 1 for want of anything better.
fn or_one(size: f64) -> f64 {
    if size.is_finite() { size } else { 1.0 }
}

/// Sizes, and which of them a row's slope at the point has told; infinite where nothing tells.
struct Told {
    known: Vec<f64>,
    by_row: Vec<Option<usize>>,
}

impl Told {
    fn by_slopes(meta: &Meta, jacobian: &[f64]) -> Told {
        let known: Vec<f64> = (0..meta.variables()).map(|j| declared_size(meta, j).unwrap_or(f64::INFINITY)).collect();
        let mut told = Told { by_row: vec![None; known.len()], known };
        for (i, limit) in limited(meta) {
            for at in meta.jacobian.range(i) {
                let (j, slope) = (meta.jacobian.columns[at] as usize, jacobian[at].abs());
                if slope > 0.0 && limit / slope < told.known[j] {
                    told.known[j] = limit / slope;
                    told.by_row[j] = Some(i);
                }
            }
        }
        told
    }

    /// Where bent rows have a say in sizes that count and that nothing else has told: (place in the Jacobian, the row's limit, variable).
    fn doubted(&self, meta: &Meta, x: &[f64]) -> Vec<(usize, f64, usize)> {
        let is_doubted = |j: usize| {
            let counts = may_be_zero(meta, j) && self.known[j] > x[j].abs();
            counts && self.by_row[j].map_or(self.known[j].is_infinite() && x[j].abs() < 1.0, |i| !meta.is_row_linear(i))
        };
        let bent = limited(meta).filter(|&(i, _)| !meta.is_row_linear(i));
        let places = bent.flat_map(|(i, limit)| meta.jacobian.range(i).map(move |at| (at, limit)));
        let places = places.map(|(at, limit)| (at, limit, meta.jacobian.columns[at] as usize));
        places.filter(|&(.., j)| is_doubted(j)).collect()
    }
}

/// Rows with a limit that is not 0, and its magnitude.
fn limited(meta: &Meta) -> impl Iterator<Item = (usize, f64)> {
    (0..meta.rows()).map(|i| (i, largest_limit(meta, i))).filter(|&(_, limit)| limit > 0.0)
}

/// The magnitude of the start that was given, else of a bound; at the most that of bounds on both sides.
fn declared_size(meta: &Meta, j: usize) -> Option<f64> {
    let is_size = |size: &f64| *size > 0.0 && size.is_finite();
    let bounds = [meta.lower[j].abs(), meta.upper[j].abs()];
    let given = meta.typical.get(j).copied().filter(is_size);
    let size = given.or_else(|| bounds.into_iter().filter(is_size).reduce(f64::min))?;
    let within = bounds[0].max(bounds[1]);
    Some(if within > 0.0 { size.min(within) } else { size })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::sample::Sample;

    fn sizes(model: &Sample, x: &[f64]) -> Vec<f64> {
        let origin = Origin::new(model);
        Point::new(&origin, x).unwrap().sizes
    }

    fn is_about(size: f64, expected: f64) -> bool {
        size > expected / 8.0 && size < expected * 8.0
    }

    #[test]
    fn bent_rows_tell_sizes_that_hold_together() {
        for unit in [1e-6, 1.0, 1e6] {
            let inf = f64::INFINITY;
            // At (1e-8, 1e-8) in its own units each slope says 4e8.
            let product = Sample::new(&[0.0, 0.0], |x| x[0] + x[1]).bounds(&[0.0, 0.0], &[inf, inf]);
            let product = product.row(-inf, 4.0, move |x| x[0] * x[1] * unit * unit);
            let at = 1e-8 / unit;
            assert!(sizes(&product, &[at, at]).iter().all(|&size| is_about(size * unit, 2.0)), "{unit}");
            // At 0 the slope says nothing.
            let square = Sample::new(&[0.0, 0.0], |x| x[0] + x[1]).bounds(&[-inf, -inf], &[inf, inf]);
            let square = square.row(-inf, 4.0, move |x| x[0] * x[0] * unit * unit + x[1]);
            let found = sizes(&square, &[0.0, 0.0]);
            assert!(is_about(found[0] * unit, 2.0) && is_about(found[1], 4.0), "{unit}: {found:?}");
        }
    }

    #[test]
    fn rows_grow_beyond_their_limits_and_not_beside_them() {
        // A displacement that is next to nothing where the model starts; its stress limit tells what it may become.
        let strained = Sample::new(&[1e-7, 1e-7], |x| x[0]).row(-10.0, 10.0, |x| (x[0] - x[1]) * 1e4);
        assert!(!have_rows_grown(&strained, &[2e-3, 1.9e-3], &[0], 1e4));
        assert!(have_rows_grown(&strained, &[2e3, 2e3], &[0], 1e4));
        // Of rows of other variables nothing is asked.
        let other = Sample::new(&[0.0, 0.0], |x| x[0]).row(0.0, 1.0, |x| x[1]);
        assert!(!have_rows_grown(&other, &[0.0, 1e9], &[0], 1e4));
        assert!(have_rows_grown(&other, &[0.0, 1e9], &[1], 1e4));
    }

    #[test]
    fn what_nothing_tells_is_one() {
        let free = Sample::new(&[0.0], |x| x[0] * x[0]);
        assert_eq!(sizes(&free, &[0.0]), [1.0]);
        assert_eq!(sizes(&free, &[3.0]), [3.0]);
    }
}
