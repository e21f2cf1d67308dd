//! Proofs that no point meets the rows, by multipliers (Farkas' lemma; for convex rows by their tangents).
//!
//! For y with y_i ≥ 0 on upper limits and ≤ 0 on lower ones, every feasible v has Σ y_i·(c_i(v) − limit_i) ≤ 0. Convex y_i·c_i
//! lie above their tangents at x, so that Σ y_i·(c_i(x) − limit_i) + Σ_j min s_j·(v_j − x_j) > 0 over the box, with
//! s = Σ y_i ∇c_i(x), contradicts that: no such v exists. Whoever offers y proves nothing; the sums do, rounded outwards.

use super::point::{Origin, Point};
use super::scales;
use crate::certificate::parameters::infeasibility::{REACH, STEPS, TOUCH};
use crate::model::{EvaluationError, Model};

/// Multipliers whose combination of rows no point of the box can meet.
#[derive(Debug, Clone, PartialEq)]
pub struct Contradiction {
    /// Length m; 0 for rows that take no part.
    pub multipliers: Vec<f64>,
    /// By how much the combination is above 0 at least, over Σ|y_i|·(size of row i's terms at x).
    pub gap: f64,
}

/// Whether `y` proves that no point of the box within reach of `x` meets the rows, by more than `tolerance` of the rows' terms.
/// Rows that are not linear take part only where `convex` says that they are convex in the direction of their multipliers.
///
/// # Errors
/// The model has no value or derivative at `x`.
pub fn contradiction(
    model: &dyn Model,
    x: &[f64],
    y: &[f64],
    convex: bool,
    tolerance: f64,
) -> Result<Option<Contradiction>, EvaluationError> {
    let origin = Origin::new(model);
    let mut inside = x.to_vec();
    model.meta().clamp(&mut inside);
    let point = Point::new(&origin, &inside)?;
    let rows = Rows::new(&point, y, convex);
    let mut best: Option<Contradiction> = None;
    let given = rows.usable(y);
    for multipliers in [rows.balanced(&given), given] {
        let gap = rows.gap(&multipliers);
        if gap > tolerance && best.as_ref().is_none_or(|best| best.gap < gap) {
            best = Some(Contradiction { multipliers, gap });
        }
    }
    Ok(best)
}

struct Rows<'p, 'a> {
    point: &'p Point<'a>,
    convex: bool,
    /// The larger of |x_j| and what row terms there are would make of it; 1 where neither tells.
    size: Vec<f64>,
    /// max(|limit|, max_j |∂c_i/∂x_j·x_j|)
    terms: Vec<f64>,
}

impl<'p, 'a> Rows<'p, 'a> {
    fn new(point: &'p Point<'a>, y: &[f64], convex: bool) -> Self {
        let term = |i: usize| point.terms.all[i].max(scales::largest_limit(point.meta(), i)).max(f64::MIN_POSITIVE);
        let terms: Vec<f64> = (0..point.rows.len()).map(term).collect();
        let mut told = vec![f64::INFINITY; point.x.len()];
        for (i, _) in y.iter().enumerate().filter(|(_, y)| **y != 0.0) {
            for at in point.meta().jacobian.range(i).filter(|&at| point.jacobian[at] != 0.0) {
                let j = point.meta().jacobian.columns[at] as usize;
                told[j] = told[j].min(terms[i] / point.jacobian[at].abs());
            }
        }
        let own = |x: f64| if x == 0.0 { 1.0 } else { x.abs() };
        let size = point.x.iter().zip(told).map(|(&x, told)| if told.is_finite() { told.max(x.abs()) } else { own(x) });
        Rows { point, convex, size: size.collect(), terms }
    }

    /// `y` without what has no limit on its side or is not known to be convex.
    fn usable(&self, y: &[f64]) -> Vec<f64> {
        let meta = self.point.meta();
        let keep = |(i, &y): (usize, &f64)| {
            let counts = self.convex || meta.is_row_linear(i);
            if counts && y.is_finite() && self.point.row_limit(i, y).is_finite() { y } else { 0.0 }
        };
        y.iter().enumerate().map(keep).collect()
    }

    /// s = Σ y_i ∇c_i
    fn slopes(&self, y: &[f64]) -> Vec<f64> {
        let meta = self.point.meta();
        let mut slopes = vec![0.0; meta.variables()];
        meta.jacobian.add_transposed(&self.point.jacobian, y, &mut slopes);
        slopes
    }

    /// How far variable j can go against a slope: towards its lower bound where the slope is positive.
    fn way(&self, j: usize, slope: f64) -> f64 {
        let (meta, x) = (self.point.meta(), self.point.x[j]);
        let way = if slope > 0.0 { x - meta.lower[j] } else { meta.upper[j] - x };
        way.min(REACH * self.size[j]).max(0.0)
    }

    /// `y` moved as little as possible until the slopes of variables that rest on no bound vanish (conjugate gradients on the
    /// least squares in rows and variables scaled by their sizes).
    fn balanced(&self, y: &[f64]) -> Vec<f64> {
        let slopes = self.slopes(y);
        let weight = |j: usize| if self.way(j, slopes[j]) > TOUCH * self.size[j] { self.size[j] } else { 0.0 };
        let weights: Vec<f64> = (0..slopes.len()).map(weight).collect();
        let support: Vec<f64> = y.iter().zip(&self.terms).map(|(y, t)| if *y == 0.0 { 0.0 } else { 1.0 / t }).collect();
        let mut y = y.to_vec();
        let residual = |y: &[f64]| self.slopes(y).iter().zip(&weights).map(|(s, w)| -s * w).collect::<Vec<_>>();
        let mut rest = residual(&y);
        let mut towards = self.pulled(&rest, &weights, &support);
        let (mut direction, mut length) = (towards.clone(), square(&towards));
        for _ in 0..STEPS {
            let step: Vec<f64> = direction.iter().zip(&support).map(|(d, s)| d * s).collect();
            let image: Vec<f64> = self.slopes(&step).iter().zip(&weights).map(|(s, w)| s * w).collect();
            let size = square(&image);
            if !(size > 0.0 && length > 0.0 && size.is_finite()) {
                break;
            }
            let alpha = length / size;
            y.iter_mut().zip(&step).for_each(|(y, step)| *y += alpha * step);
            rest.iter_mut().zip(&image).for_each(|(rest, image)| *rest -= alpha * image);
            towards = self.pulled(&rest, &weights, &support);
            let next = square(&towards);
            direction.iter_mut().zip(&towards).for_each(|(d, t)| *d = t + next / length * *d);
            length = next;
        }
        self.usable(&y)
    }

    /// support·J·(weights·rest)
    fn pulled(&self, rest: &[f64], weights: &[f64], support: &[f64]) -> Vec<f64> {
        let pattern = &self.point.meta().jacobian;
        let entry = |at: usize| {
            let j = pattern.columns[at] as usize;
            self.point.jacobian[at] * weights[j] * rest[j]
        };
        support
            .iter()
            .enumerate()
            .map(|(i, s)| if *s == 0.0 { 0.0 } else { s * pattern.range(i).map(entry).sum::<f64>() })
            .collect()
    }

    /// The least the combination can be over the box, rounded outwards, over the size of its terms; −∞ where there is none.
    fn gap(&self, y: &[f64]) -> f64 {
        let (meta, point) = (self.point.meta(), self.point);
        let (mut sum, mut magnitude, mut count, mut size) = (0.0, 0.0, 16.0, 0.0);
        for (i, &y) in y.iter().enumerate().filter(|(_, y)| **y != 0.0) {
            let limit = point.row_limit(i, y);
            let entries = meta.jacobian.range(i);
            sum += y * (point.rows[i] - limit);
            let terms = entries.len() as f64 * self.terms[i];
            (magnitude, count, size) =
                (magnitude + y.abs() * (point.rows[i].abs() + limit.abs() + terms), count + 2.0, size + y.abs() * self.terms[i]);
        }
        let mut totals = vec![(0.0, 0.0); meta.variables()];
        for (i, &y) in y.iter().enumerate().filter(|(_, y)| **y != 0.0) {
            for at in meta.jacobian.range(i) {
                let total = &mut totals[meta.jacobian.columns[at] as usize];
                *total = (total.0 + (y * point.jacobian[at]).abs(), total.1 + 1.0);
            }
        }
        for (j, slope) in self.slopes(y).into_iter().enumerate() {
            // Rounding of the slope's sum may have turned its sign.
            let error = totals[j].1 * f64::EPSILON * totals[j].0;
            let down = (slope + error).max(0.0) * self.way(j, 1.0);
            let up = (error - slope).max(0.0) * self.way(j, -1.0);
            sum -= down.max(up);
            (magnitude, count) = (magnitude + down.max(up), count + 1.0);
        }
        let least = sum - count * f64::EPSILON * magnitude;
        if size > 0.0 && least.is_finite() { least / size } else { f64::NEG_INFINITY }
    }
}

fn square(values: &[f64]) -> f64 {
    values.iter().map(|value| value * value).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::sample::Sample;

    const INF: f64 = f64::INFINITY;

    #[test]
    fn parallel_lines_contradict_one_another() {
        let model = Sample::new(&[1.0, 1.0], |x| x[0])
            .row(7.0, 7.0, |x| x[0] * 0.3 + x[1] * 0.7)
            .row(2.0, 2.0, |x| x[0] * 0.3 + x[1] * 0.7);
        // Multipliers as a solver gives them, good to six digits.
        let found = contradiction(&model, &[4.0, 5.0], &[-1.000_001, 0.999_999], true, 1e-8).unwrap();
        assert!(found.is_some_and(|found| (found.gap - 5.0 / 10.5).abs() < 1e-3));
        assert_eq!(contradiction(&model, &[4.0, 5.0], &[1.0, -1.0], true, 1e-8).unwrap(), None, "wrong signs");
        assert_eq!(contradiction(&model, &[4.0, 5.0], &[-1.0, 1.0], false, 1e-8).unwrap(), None, "rows not known as linear");
    }

    #[test]
    fn a_row_against_the_box_needs_its_bounds() {
        let row = |x: &[crate::model::sample::Value]| x[0] * 2.0 + x[1] * 3.0;
        let closed = Sample::new(&[0.0, 0.0], |x| x[0]).bounds(&[0.0; 2], &[1.0; 2]).row(5.001, INF, row);
        assert!(contradiction(&closed, &[1.0, 1.0], &[-1.0], true, 1e-8).unwrap().is_some());
        let open = Sample::new(&[0.0, 0.0], |x| x[0]).bounds(&[0.0; 2], &[1.0, INF]).row(5.001, INF, row);
        assert_eq!(contradiction(&open, &[1.0, 1.0], &[-1.0], true, 1e-8).unwrap(), None);
        let met = Sample::new(&[0.0, 0.0], |x| x[0]).bounds(&[0.0; 2], &[1.0; 2]).row(5.0, INF, row);
        assert_eq!(contradiction(&met, &[1.0, 1.0], &[-1.0], true, 1e-8).unwrap(), None);
    }

    #[test]
    fn a_disc_and_a_half_plane_apart_are_told_by_the_tangent() {
        let model =
            Sample::new(&[0.0, 0.0], |x| x[0]).row(-INF, 1.0, |x| x[0] * x[0] + x[1] * x[1]).row(1.5, INF, |x| x[0] + x[1]);
        let x = [0.74, 0.74];
        let found = contradiction(&model, &x, &[1.0, -1.48], true, 1e-8).unwrap();
        assert!(found.is_some(), "{found:?}");
        let touching =
            Sample::new(&[0.0, 0.0], |x| x[0]).row(-INF, 1.0, |x| x[0] * x[0] + x[1] * x[1]).row(1.4, INF, |x| x[0] + x[1]);
        assert_eq!(contradiction(&touching, &[0.7, 0.7], &[1.0, -1.4], true, 1e-8).unwrap(), None);
    }
}
