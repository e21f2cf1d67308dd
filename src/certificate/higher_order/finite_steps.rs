//! Beyond second order: where the Lagrangian hardly bends along a direction, only steps of finite length tell a minimum from an
//! inflection (x³), a monkey saddle or a bent valley that leads down.
//!
//! Each flat direction is followed both ways over growing steps. Every point is drawn back to the active limits and down the
//! directions that do bend, by chord steps with [D∇²L D/σ + |…| + I, Aᵀ; A, −δI]; the first change of the objective that rounding
//! and the point's own slope do not explain decides.

use rayon::prelude::*;

use super::slopes::{flatness, slopes};
use super::trial_point::{Trial, Values};
use crate::certificate::Tolerances;
use crate::certificate::multipliers::Multipliers;
use crate::certificate::parameters::higher_order::{
    BESIDE, BEYOND_A_LIMIT, CORRECTIONS, DIRECTIONS, NEAR, NOISE, SETTLED, SHRINKING, STEPS, STRETCH, WORK,
};
use crate::certificate::point::Point;
use crate::certificate::residuals::worst_complementarity;
use crate::certificate::second_order::{Active, Choice, Hessian, Kkt};
use crate::linear_algebra::FactorizationError;
use crate::math::within;
use crate::model::Model;

/// A direction along which a stationary point is no minimum although no curvature shows it; in the user's variables, ten times
/// the way to a feasible point that is lower. Of curvature: `inwards`, flat directions that leave weakly active limits, and whether the
/// gradients of active rows depend on one another.
pub(in crate::certificate) fn find(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    tolerances: &Tolerances,
    (inwards, dependent): (&[Vec<f64>], bool),
) -> Result<Option<Vec<f64>>, FactorizationError> {
    let choice = Choice::relaxed_all(point, active, hessian);
    let (free, strict) = (choice.loose_variables(), choice.strict_rows());
    let most = DIRECTIONS.min(WORK / (free.len() + strict.len() + 1));
    if free.is_empty() || most == 0 {
        return Ok(None);
    }
    let mut kkt = Kkt::new(point, hessian, &free, &strict)?;
    let flatness = flatness(point, active, &choice, tolerances.optimality);
    let flat = if kkt.is_flat(flatness)? { kkt.flat_directions(most, flatness)? } else { Vec::new() };
    if flat.is_empty() && inwards.is_empty() {
        return Ok(None);
    }
    let mut walk = Walk::from(point, active, hessian, tolerances, &choice)?;
    let found = walk.lower_point(inwards.iter().take(most).chain(&flat));
    // Bent rows whose gradients depend on one another may have no point in common but this one; independent ones meet on a surface, by the
    // theorem of implicit functions.
    if found.is_some() || strict.is_empty() || !dependent {
        return Ok(found);
    }
    walk.may_be_left.fill(true);
    Ok(walk.lower_point(inwards.iter().take(most).chain(&flat)))
}

/// The same along one direction: whether it leads to a lower point indeed.
pub(in crate::certificate) fn confirm(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    tolerances: &Tolerances,
    direction: &[f64],
) -> bool {
    let size = |(step, size): (&f64, &f64)| (step / size).abs();
    let largest = direction.iter().zip(&point.sizes).map(size).fold(f64::MIN_POSITIVE, f64::max);
    let unit: Vec<f64> = direction.iter().map(|step| step / largest).collect();
    let walk = Walk::from(point, active, hessian, tolerances, &Choice::relaxed_all(point, active, hessian));
    walk.is_ok_and(|walk| walk.lower_point(std::iter::once(&unit)).is_some())
}

/// Where growing steps along a direction lead.
enum Way {
    /// To a lower point: ten times the way there.
    Lower(Vec<f64>),
    /// Up, or nowhere.
    Ends,
    /// Away from the limits, however short.
    Barred,
}

struct Walk<'w, 'p> {
    point: &'w Point<'p>,
    multipliers: &'w Multipliers,
    hessian: &'w Hessian,
    tolerances: &'w Tolerances,
    /// Free variables; with those on weakly active bounds, which corrections leave where a step has put them.
    free: Vec<usize>,
    loose: Vec<usize>,
    /// Variables beside a bound that is strictly active, with that bound: rows that depend on it are met where they are on it.
    resting: Vec<(usize, f64)>,
    /// Rows near a limit, and which of them are not strictly active: these may be left, and are only gone back to.
    held: Vec<usize>,
    may_be_left: Vec<bool>,
    kkt: Kkt<'w>,
    /// The objective at the point, or its Lagrangian (bounds included) where that is lower, and the objective with what all distances to limits are
    /// worth: going to a limit that is missed by a little is neither a fall nor a rise.
    here: (f64, f64),
    /// See [`slopes`].
    slopes: [Vec<f64>; 2],
}

impl<'w, 'p> Walk<'w, 'p> {
    fn from(
        point: &'w Point<'p>,
        active: &Active<'w>,
        hessian: &'w Hessian,
        tolerances: &'w Tolerances,
        choice: &Choice,
    ) -> Result<Self, FactorizationError> {
        let (meta, strict) = (point.meta(), choice.strict_rows());
        let is_apart = |&j: &usize| (point.x[j] - meta.lower[j]).min(meta.upper[j] - point.x[j]) > BESIDE * point.sizes[j];
        let free: Vec<usize> = choice.free.iter().copied().filter(is_apart).collect();
        let mut is_loose = vec![false; point.x.len()];
        choice.loose_variables().into_iter().for_each(|j| is_loose[j] = true);
        let pushes = active.multipliers.bounds.iter().enumerate().filter(|&(j, z)| *z != 0.0 && !is_loose[j]);
        let beside = pushes.map(|(j, &z)| (j, point.bound(j, z)));
        let resting = beside.filter(|&(j, bound)| (point.x[j] - bound).abs() <= tolerances.optimality * point.sizes[j]).collect();
        let distance = |i: usize| (point.rows[i] - meta.row_lower[i]).min(meta.row_upper[i] - point.rows[i]);
        let is_near = |&i: &usize| point.slopes[i] > 0.0 && distance(i) <= BESIDE * point.slopes[i];
        let held: Vec<usize> = (0..meta.rows()).filter(is_near).collect();
        let may_be_left = held.iter().map(|i| strict.binary_search(i).is_err()).collect();
        let mut kkt = Kkt::new(point, hessian, &free, &held)?;
        kkt.factor_proximal()?;
        let multipliers = active.multipliers;
        // Rows within their limits, and variables within their bounds, are a fall that first order has accepted.
        let pushes = multipliers.bounds.iter().enumerate().filter(|(_, z)| **z != 0.0);
        let of_bounds: f64 = pushes.map(|(j, &z)| z * (point.x[j] - point.bound(j, z))).sum();
        let balanced =
            Trial::at(point, point.x).map_or(point.objective, |trial| trial.values.lagrangian(point, multipliers)) + of_bounds;
        let worth = worst_complementarity(point, multipliers).1 * point.scale();
        let here = (point.objective.min(balanced), point.objective.max(balanced) + worth);
        Ok(Walk {
            point,
            multipliers,
            hessian,
            tolerances,
            free,
            loose: choice.loose_variables(),
            resting,
            held,
            may_be_left,
            kkt,
            here,
            slopes: slopes(point, multipliers, choice),
        })
    }

    /// Where the first of the directions that leads to a lower point does, each both ways, side by side.
    fn lower_point<'d>(&self, directions: impl Iterator<Item = &'d Vec<f64>>) -> Option<Vec<f64>> {
        let directions: Vec<&Vec<f64>> = directions.collect();
        directions.into_par_iter().find_map_first(|direction| match self.along(direction, 1.0) {
            Way::Lower(way) => Some(way),
            // Rows bend by vᵀCv whichever way v is followed.
            Way::Barred if self.is_two_sided(direction) => None,
            Way::Barred | Way::Ends => match self.along(direction, -1.0) {
                Way::Lower(way) => Some(way),
                Way::Barred | Way::Ends => None,
            },
        })
    }

    /// Whether a direction leads along all limits that a step may leave, so that the shortest step is within tolerance of each both ways.
    fn is_two_sided(&self, direction: &[f64]) -> bool {
        let (point, most) = (self.point, self.tolerances.constraint / STEPS[0]);
        let relative = |j: usize| direction[j] / point.sizes[j];
        let is_along = |row: usize| point.row_in_sizes(row).map(|(j, slope)| slope * relative(j)).sum::<f64>().abs() <= most;
        let beside = self.loose.iter().filter(|j| self.free.binary_search(j).is_err());
        let mut left = self.held.iter().zip(&self.may_be_left).filter(|(_, may_be_left)| **may_be_left);
        beside.copied().all(|j| relative(j).abs() <= most) && left.all(|(&row, _)| is_along(row))
    }

    /// Growing steps until the objective changes.
    fn along(&self, direction: &[f64], sign: f64) -> Way {
        let point = self.point;
        let curvature = self.hessian.bend(point, direction);
        let along = |slopes: &Vec<f64>| slopes.iter().zip(direction).map(|(slope, v)| slope * v).sum::<f64>().abs();
        let slope = self.slopes.iter().map(along).fold(f64::INFINITY, f64::min) / point.scale();
        // ∂L/∂x_j·d_j is accepted up to optimality·σ, each.
        let accepted = self.tolerances.optimality * direction.iter().zip(&point.sizes).map(|(v, d)| (v / d).abs()).sum::<f64>();
        let longest = if slope > accepted { BEYOND_A_LIMIT } else { f64::INFINITY };
        let is_near = |step: &f64| *step <= STEPS[0] || (*step <= longest && curvature * step <= NEAR * accepted);
        for step in STEPS.into_iter().take_while(is_near) {
            if point.is_over() {
                return Way::Ends;
            }
            let far: Vec<f64> = point.x.iter().zip(direction).map(|(x, v)| x + sign * step * v).collect();
            let Some(x) = self.corrected(far, step) else { return Way::Ends };
            let Some(trial) = Trial::at(point, &x) else { return Way::Ends };
            if !trial.is_feasible(point, self.tolerances.constraint) {
                // To first order what is feasible is a cone: where the shortest step cannot be drawn back to the limits no longer one can. Where
                // a longer one is the first that cannot, what lies beyond is another valley's.
                return if step == STEPS[0] { Way::Barred } else { Way::Ends };
            }
            let (value, explained) = self.height(&x, &trial.values);
            if value < self.here.0 - explained {
                return Way::Lower(x.iter().zip(point.x).map(|(to, from)| STRETCH * (to - from)).collect());
            }
            if value > self.here.1 + explained {
                return Way::Ends;
            }
        }
        Way::Ends
    }

    /// The objective, with what violations gain taken off, and by how much it may differ from that at the point and yet be level.
    fn height(&self, x: &[f64], values: &Values) -> (f64, f64) {
        let explained = self.explained(x) + values.rounding(self.point, self.multipliers);
        (values.penalised(self.point, self.multipliers), explained)
    }

    /// What the point's own slope may make of the way to x (of a convex function no fall is deeper), and rounding.
    fn explained(&self, x: &[f64]) -> f64 {
        let explained = |slopes: &Vec<f64>| self.loose.iter().map(|&j| slopes[j] * (x[j] - self.point.x[j])).sum::<f64>().abs();
        2.0 * self.slopes.iter().map(explained).fold(f64::INFINITY, f64::min) + NOISE * self.point.scale()
    }

    /// Keeps x no farther away than twice the step, relative to the variables' sizes: what is farther is another valley's.
    fn keep_beside(&self, x: &mut [f64], step: f64) {
        let point = self.point;
        for &j in &self.free {
            let reach = 2.0 * step * point.sizes[j];
            x[j] = x[j].max(point.x[j] - reach).min(point.x[j] + reach);
        }
    }

    /// The share of a correction that keeps x beside the point.
    fn share_beside(&self, x: &[f64], correction: &[f64], step: f64) -> f64 {
        let point = self.point;
        let share = |(&j, correction): (&usize, &f64)| {
            let gone = (x[j] - point.x[j]) / point.sizes[j] * correction.signum();
            (2.0 * step - gone).max(0.0) / correction.abs()
        };
        self.free.iter().zip(correction).map(share).fold(1.0, f64::min)
    }

    /// Chord steps towards the active limits and down the directions that bend, inside the bounds. Where the way down leads off,
    /// from there on towards the limits alone. `None` where the model has no values, and where the end of the way is higher than the point:
    /// as steps shrink by half, all that follow change the objective by no more than the last one.
    fn corrected(&self, mut x: Vec<f64>, length: f64) -> Option<Vec<f64>> {
        let (point, meta) = (self.point, self.point.meta());
        let (mut descends, mut last, mut before) = (true, f64::INFINITY, f64::NAN);
        meta.clamp(&mut x);
        self.resting.iter().for_each(|&(j, bound)| x[j] = bound);
        for _ in 0..CORRECTIONS {
            let (mut right, values) = self.residual(&x)?;
            let (value, explained) = self.height(&x, &values);
            if value - self.here.1 - explained > (value - before).abs() {
                return None;
            }
            before = value;
            if !descends {
                right[..self.free.len()].fill(0.0);
            }
            let step = self.kkt.chord_step(&right).ok()?;
            let share = if descends { self.share_beside(&x, &step[..self.free.len()], length) } else { 1.0 };
            descends &= share == 1.0;
            let mut longest = 0.0f64;
            for (&j, step) in self.free.iter().zip(&step) {
                x[j] += share * step * point.sizes[j];
                longest = longest.max(step.abs());
            }
            self.keep_beside(&mut x, length);
            meta.clamp(&mut x);
            if !longest.is_finite() {
                return None;
            }
            // Steps that do not shrink by half are pulled to and fro by limits that depend on one another.
            if longest < SETTLED || longest > SHRINKING * last {
                break;
            }
            last = longest;
        }
        Some(x)
    }

    /// [−D∇L/σ over the free variables; limit − c over the held rows, each over its slope]
    fn residual(&self, x: &[f64]) -> Option<(Vec<f64>, Values)> {
        let (point, meta, model) = (self.point, self.point.meta(), &self.point.origin.model);
        let (mut total, mut rows, mut jacobian) =
            (vec![0.0; meta.variables()], vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
        let mut at = model.at(x).ok()?;
        let objective = at.gradient(&mut total).ok()?;
        at.constraints(&mut rows).ok()?;
        at.jacobian(&mut jacobian).ok()?;
        meta.jacobian.add_transposed(&jacobian, &self.multipliers.rows, &mut total);
        let slopes = self.free.iter().map(|&j| -total[j] * point.sizes[j] / point.scale());
        let lack = |(k, &i): (usize, &usize)| {
            let inside = within(rows[i], meta.row_lower[i], meta.row_upper[i]);
            let to = if self.may_be_left[k] { inside } else { point.row_limit(i, self.multipliers.rows[i]) };
            (to - rows[i]) / self.kkt.slope(k)
        };
        let lacks = self.held.iter().enumerate().map(lack);
        let right = slopes.chain(lacks).collect();
        Some((right, Values { objective, rows }))
    }
}
