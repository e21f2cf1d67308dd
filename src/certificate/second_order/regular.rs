//! A strict local minimum beside the point, by the theorem of Newton and Kantorovich.
//!
//! Let F be the gradient of the Lagrangian over the free variables, and how far the held limits are missed, as functions of these
//! variables and of the multipliers of the held limits. Where F' is regular and Newton's step from a point has the length η, F has a zero
//! within 2η of the point if h = ωη ≤ ½, ω being the Lipschitz constant of F'⁻¹F' (Kantorovich 1948; as here, Deuflhard 2004, "Newton
//! Methods for Nonlinear Problems", theorem 2.1). h is twice the ratio of a simplified Newton step, with the F' of the first one, to that
//! (Deuflhard, §2.2). If S is positive on the null space of the held limits, their multipliers are of the right sign and the other limits
//! are met, with a margin for all the way to the zero, that zero is a strict local minimum with strict complementarity: nothing is left
//! to be looked for along flat directions or on faces of a cone.
//!
//! The step is that from F with what rounding may make of each of its components put on it: what is proved is no accident of the last
//! digits. Lengths are measured by the curvature, √|vᵀSv|, as fits minima (Deuflhard, §3.1).

use super::by_component;
use super::kkt::{Kkt, scattered};
use super::system::Hessian;
use crate::certificate::multipliers::Multipliers;
use crate::certificate::parameters::higher_order::NOISE;
use crate::certificate::parameters::second_order::{CONTRACTION, REACH, ROUNDING, WEAK};
use crate::certificate::point::Point;
use crate::linear_algebra::Effort;
use crate::model::{EvaluationError, Model};

/// Whether one is proved. No means nothing; of a model of many components each is better looked at by itself.
pub(in crate::certificate) fn has_minimum_beside(point: &Point<'_>, multipliers: &Multipliers) -> bool {
    by_component::apart(point.meta()).is_none()
        && System::of(point, multipliers).is_some_and(|system| system.is_regular() == Some(true))
}

/// The limits held, and F there.
struct System<'a> {
    point: &'a Point<'a>,
    free: Vec<usize>,
    /// Variables held on a bound, but for fixed ones.
    bounded: Vec<usize>,
    /// Rows held at a limit, which that is.
    rows: Vec<usize>,
    limits: Vec<f64>,
    /// Of the held limits.
    multipliers: Multipliers,
}

/// ∇L over all variables, in their sizes and in units of σ, and the values of all rows.
struct Values {
    slopes: Vec<f64>,
    rows: Vec<f64>,
}

impl<'a> System<'a> {
    /// Limits are held whose multiplier outweighs their distance, both relative: the active ones, by strict complementarity. `None` where
    /// limits cannot but depend on one another.
    fn of(point: &'a Point<'a>, found: &Multipliers) -> Option<Self> {
        let (y, z) = (&found.rows, &found.bounds);
        let multipliers = Multipliers { rows: vec![0.0; y.len()], bounds: vec![0.0; z.len()] };
        let mut system =
            System { point, free: Vec::new(), bounded: Vec::new(), rows: Vec::new(), limits: Vec::new(), multipliers };
        system.hold_bounds(z);
        system.hold_rows(y);
        let are_movable = system.rows.iter().all(|&i| point.slopes[i] > 0.0);
        (are_movable && system.rows.len() <= system.free.len()).then_some(system)
    }

    /// A variable is held where it is: on its bound, or beside it by no more than what is put on F for rounding.
    fn hold_bounds(&mut self, z: &[f64]) {
        let point = self.point;
        for j in (0..z.len()).filter(|&j| !point.meta().is_fixed(j)) {
            let distance = (point.x[j] - point.bound(j, z[j])).abs() / point.sizes[j];
            let push = z[j].abs() * point.sizes[j] / point.scale();
            if push > distance && distance <= NOISE {
                self.bounded.push(j);
                self.multipliers.bounds[j] = z[j];
            } else {
                self.free.push(j);
            }
        }
    }

    fn hold_rows(&mut self, y: &[f64]) {
        let (point, meta) = (self.point, self.point.meta());
        for (i, &y) in y.iter().enumerate() {
            let (limit, slope) = (point.row_limit(i, y), point.slopes[i]);
            let outweighs = y.abs() * slope / point.scale() > (point.rows[i] - limit).abs() / slope;
            if meta.row_lower[i] == meta.row_upper[i] || outweighs {
                self.rows.push(i);
                self.limits.push(limit);
                self.multipliers.rows[i] = y;
            }
        }
    }

    /// Whether the point has a regular zero of F beside it; `None` where something has no value, or is singular.
    fn is_regular(&self) -> Option<bool> {
        let kkt = self.bent_up()?;
        let point = self.point;
        let here = Values { slopes: self.slopes(&point.row_gradient(&self.multipliers.rows)), rows: point.rows.clone() };
        let missed = self.residual(&here);
        let beyond_noise = |(k, value): (usize, &f64)| -(value + (NOISE * scattered(k)).copysign(*value));
        let right: Vec<f64> = missed.iter().enumerate().map(beyond_noise).collect();
        let step = kkt.solve(&right).ok()?;
        if !self.is_short(&step) {
            return None;
        }
        let there = self.values_beyond(&step).ok()?;
        // What F' does not explain of the way there.
        let (explained, change) = (kkt.product(&step), self.residual(&there));
        let bent: Vec<f64> = (0..step.len()).map(|k| missed[k] + explained[k] - change[k]).collect();
        let correction = kkt.solve(&bent).ok()?;
        let energy = |step: &[f64]| kkt.bend(&step[..self.free.len()]).abs();
        let contracts = energy(&correction) <= CONTRACTION * CONTRACTION * energy(&step);
        Some(contracts && self.keeps_limits(&step, &here, &there))
    }

    /// F', where it bends up on the null space of the held rows.
    fn bent_up(&self) -> Option<Kkt<'_>> {
        let hessian = Hessian::of(self.point, &self.multipliers).ok()?;
        let mut kkt = Kkt::new(self.point, &hessian, &self.free, &self.rows).ok()?;
        // Where quick factors cannot tell, F' is next to singular.
        (!kkt.has_negative_curvature(-ROUNDING, Effort::Quick).ok()?).then_some(kkt)
    }

    /// F: over the free variables, then the held rows over their slopes.
    fn residual(&self, values: &Values) -> Vec<f64> {
        let slopes = self.free.iter().map(|&j| values.slopes[j]);
        let missed = self.rows.iter().zip(&self.limits).map(|(&i, limit)| (values.rows[i] - limit) / self.point.slopes[i]);
        slopes.chain(missed).collect()
    }

    fn slopes(&self, gradient: &[f64]) -> Vec<f64> {
        let scale = self.point.scale();
        gradient.iter().zip(&self.point.sizes).map(|(slope, size)| slope * size / scale).collect()
    }

    /// Whether no variable moves farther than what is beside the point.
    fn is_short(&self, step: &[f64]) -> bool {
        step[..self.free.len()].iter().all(|step| step.abs() <= REACH)
    }

    /// At the end of a step.
    fn values_beyond(&self, step: &[f64]) -> Result<Values, EvaluationError> {
        let (point, meta) = (self.point, self.point.meta());
        let (mut x, mut y) = (point.x.to_vec(), self.multipliers.rows.clone());
        self.free.iter().zip(step).for_each(|(&j, step)| x[j] += step * point.sizes[j]);
        let changes = self.rows.iter().zip(&step[self.free.len()..]);
        changes.for_each(|(&i, change)| y[i] += change * point.scale() / point.slopes[i]);
        let (mut gradient, mut jacobian) = (vec![0.0; meta.variables()], vec![0.0; meta.jacobian.len()]);
        let mut rows = vec![0.0; meta.rows()];
        let mut at = point.origin.model.at(&x)?;
        at.gradient(&mut gradient)?;
        at.constraints(&mut rows)?;
        at.jacobian(&mut jacobian)?;
        meta.jacobian.add_transposed(&jacobian, &y, &mut gradient);
        Ok(Values { slopes: self.slopes(&gradient), rows })
    }

    /// Whether, within two steps, the held limits keep pushing and the others are met.
    fn keeps_limits(&self, step: &[f64], here: &Values, there: &Values) -> bool {
        let (point, meta) = (self.point, self.point.meta());
        // A weakly active limit's multiplier is 0, but for what the problem's own digits make of it.
        let push = |k: usize| {
            let i = self.rows[k];
            let multiplier = self.multipliers.rows[i].abs() * point.slopes[i] / point.scale();
            meta.row_lower[i] == meta.row_upper[i] || multiplier > WEAK + 2.0 * step[self.free.len() + k].abs()
        };
        let bound_pushes = |&j: &usize| {
            let change = (there.slopes[j] - here.slopes[j]).abs();
            here.slopes[j] * self.multipliers.bounds[j] < 0.0 && here.slopes[j].abs() > WEAK + 2.0 * change
        };
        let is_apart = |(&j, step): (&usize, &f64)| {
            let distance = (point.x[j] - meta.lower[j]).min(meta.upper[j] - point.x[j]);
            distance > 2.0 * (step * point.sizes[j]).abs()
        };
        let is_met = |i: usize| {
            let distance = (here.rows[i] - meta.row_lower[i]).min(meta.row_upper[i] - here.rows[i]);
            self.rows.binary_search(&i).is_ok() || distance > 2.0 * (there.rows[i] - here.rows[i]).abs()
        };
        (0..self.rows.len()).all(push)
            && self.bounded.iter().all(bound_pushes)
            && self.free.iter().zip(step).all(is_apart)
            && (0..meta.rows()).all(is_met)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::point::Origin;
    use crate::model::sample::{Sample, Value};

    /// What is said of x with these row multipliers, bounds taking up what is left.
    fn is_proved(model: &Sample, x: &[f64], y: &[f64]) -> bool {
        let origin = Origin::new(model);
        let mut point = Point::new(&origin, x).unwrap();
        point.add_curvature().unwrap();
        let meta = model.meta();
        let rests = |j: usize| x[j] == meta.lower[j] || x[j] == meta.upper[j];
        let left = point.row_gradient(y);
        let z = (0..x.len()).map(|j| if rests(j) { -left[j] } else { 0.0 }).collect();
        has_minimum_beside(&point, &Multipliers { rows: y.to_vec(), bounds: z })
    }

    const INF: f64 = f64::INFINITY;

    #[test]
    fn a_minimum_is_proved_and_a_saddle_is_not() {
        let bowl = Sample::new(&[1.0; 2], |x| (x[0] - 1.0) * (x[0] - 1.0) + x[1] * x[1] * x[1] - x[1] * 3.0);
        assert!(is_proved(&bowl, &[1.0, 1.0], &[]));
        assert!(is_proved(&bowl, &[1.0 + 1e-7, 1.0 - 1e-7], &[]), "beside it, too");
        assert!(!is_proved(&bowl, &[1.0, -1.0], &[]));
        let disc = Sample::new(&[0.5; 2], |x| x[0] + x[1]).row(-INF, 1.0, |x| x[0] * x[0] + x[1] * x[1]);
        let s = 0.5f64.sqrt();
        assert!(is_proved(&disc, &[-s, -s], &[s]));
    }

    #[test]
    fn an_inflection_beside_the_point_is_no_minimum() {
        // x³ and x³ + 1e-9·x bend up at 1e-4, where their slopes pass for 0; the zeros of those are double, or none.
        for tilt in [0.0, 1e-9] {
            let cubic = Sample::new(&[1.0; 2], move |x| x[0] * x[0] * x[0] + x[0] * tilt + x[1] * x[1]);
            assert!(!is_proved(&cubic, &[1e-4, 0.0], &[]));
        }
        // A fourth power has a minimum, but no regular one.
        let quartic = Sample::new(&[1.0], |x| x[0] * x[0] * x[0] * x[0]);
        assert!(!is_proved(&quartic, &[1e-3], &[]));
    }

    #[test]
    fn a_limit_that_hardly_pushes_proves_nothing() {
        let pushed = |slope: f64| {
            Sample::new(&[1.0; 2], move |x| x[0] * x[0] + x[0] * slope + (x[1] - 1.0) * (x[1] - 1.0)).bound(0, 0.0, 2.0)
        };
        assert!(is_proved(&pushed(1e-3), &[0.0, 1.0], &[]));
        assert!(!is_proved(&pushed(0.0), &[0.0, 1.0], &[]));
        // A row that the step to the minimum would violate.
        let beyond = pushed(1e-3).row(-INF, 1.0 + 1e-12, |x| x[1]);
        assert!(!is_proved(&beyond, &[0.0, 1.0], &[0.0]));
    }

    #[test]
    fn what_rows_leave_bends_or_not() {
        // x·y = 1: of x² + y² the minimum is (1, 1), of −x² − y² the maximum.
        let on_hyperbola = |sign: f64| {
            let objective = move |x: &[Value]| (x[0] * x[0] + x[1] * x[1]) * sign;
            Sample::new(&[1.0; 2], objective).row(1.0, 1.0, |x| x[0] * x[1])
        };
        assert!(is_proved(&on_hyperbola(1.0), &[1.0; 2], &[-2.0]));
        assert!(!is_proved(&on_hyperbola(-1.0), &[1.0; 2], &[2.0]));
    }
}
