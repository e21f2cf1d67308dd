//! Beyond second order: where the Lagrangian hardly bends along a direction, only steps of finite length tell a minimum from an
//! inflection (x³), a monkey saddle or a bent valley that leads down.
//!
//! Each flat direction is followed both ways over growing steps. Every point is drawn back to the active limits and down the
//! directions that do bend, by chord steps with [D∇²L D/σ + |…| + I, Aᵀ; A, −δI]; the first change of the objective that rounding
//! and the accepted slope do not explain decides.

use super::trial_point::Trial;
use crate::certificate::Tolerances;
use crate::certificate::multipliers::Multipliers;
use crate::certificate::point::Point;
use crate::certificate::second_order::{Active, Choice, Hessian, Kkt};
use crate::linear_algebra::FactorizationError;
use crate::model::Model;

/// Directions bending less than this, in units of σ, are followed: an inflection may hide as near as the slope test allows.
const FLAT: f64 = 1e-2;
/// Lengths, relative to the variables' sizes.
const STEPS: [f64; 7] = [1e-4, 1e-3, 1e-2, 3e-2, 0.1, 0.3, 1.0];
const CORRECTIONS: usize = 8;
/// Directions followed at the most, and the sum of orders of the systems solved for them.
const DIRECTIONS: usize = 24;
const WORK: usize = 20_000;
/// `escape` is stretched by this: second tries start at a tenth of it.
const STRETCH: f64 = 10.0;

/// A direction along which a stationary point is no minimum although no curvature shows it; in the user's variables, ten times
/// the way to a feasible point that is lower.
pub(in crate::certificate) fn find(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    tolerances: &Tolerances,
) -> Result<Option<Vec<f64>>, FactorizationError> {
    let choice = Choice::all(point, active);
    let (free, held) = (choice.loose_variables(), choice.strict_rows());
    let most = DIRECTIONS.min(WORK / (free.len() + held.len() + 1));
    if free.is_empty() || most == 0 {
        return Ok(None);
    }
    let mut kkt = Kkt::new(point, hessian, &free, &held)?;
    if !kkt.is_flat(FLAT)? {
        return Ok(None);
    }
    let directions = kkt.flat_directions(most, FLAT)?;
    kkt.factor_proximal()?;
    let walk = Walk { point, multipliers: active.multipliers, tolerances, free: &free, held: &held, kkt: &kkt };
    Ok(directions.iter().find_map(|direction| walk.along(direction, 1.0).or_else(|| walk.along(direction, -1.0))))
}

struct Walk<'w, 'p> {
    point: &'w Point<'p>,
    multipliers: &'w Multipliers,
    tolerances: &'w Tolerances,
    free: &'w [usize],
    held: &'w [usize],
    kkt: &'w Kkt<'w>,
}

impl Walk<'_, '_> {
    /// Growing steps until the objective changes: the way to a lower point, `None` where it rises first.
    fn along(&self, direction: &[f64], sign: f64) -> Option<Vec<f64>> {
        let point = self.point;
        for step in STEPS {
            let far: Vec<f64> = point.x.iter().zip(direction).map(|(x, v)| x + sign * step * v).collect();
            let Some(x) = self.corrected(far) else { continue };
            let Some(trial) = Trial::at(point, &x).filter(|trial| trial.is_feasible(point, self.tolerances.constraint)) else {
                continue;
            };
            let change = trial.penalised(point, self.multipliers) - point.objective;
            let explained = 2.0 * self.tolerances.optimality * point.sigma * step + trial.rounding(point, self.multipliers);
            if change < -explained {
                return Some(x.iter().zip(point.x).map(|(to, from)| STRETCH * (to - from)).collect());
            }
            if change > explained {
                return None;
            }
        }
        None
    }

    /// Chord steps towards the active limits and down the directions that bend, inside the bounds.
    fn corrected(&self, mut x: Vec<f64>) -> Option<Vec<f64>> {
        let (point, meta) = (self.point, self.point.meta());
        meta.clamp(&mut x);
        for _ in 0..CORRECTIONS {
            let right = self.residual(&x)?;
            let step = self.kkt.solve(&right).ok()?;
            let mut longest = 0.0f64;
            for (&j, step) in self.free.iter().zip(&step) {
                x[j] += step * point.sizes[j];
                longest = longest.max(step.abs());
            }
            meta.clamp(&mut x);
            if !longest.is_finite() {
                return None;
            }
            if longest < 1e-12 {
                break;
            }
        }
        Some(x)
    }

    /// [−D∇L/σ over the free variables; limit − c over the held rows, each over its slope]
    fn residual(&self, x: &[f64]) -> Option<Vec<f64>> {
        let (point, meta, model) = (self.point, self.point.meta(), &self.point.origin.model);
        let (mut total, mut rows, mut jacobian) =
            (vec![0.0; meta.variables()], vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
        model.gradient(x, &mut total).ok()?;
        model.constraints(x, &mut rows).ok()?;
        model.jacobian(x, &mut jacobian).ok()?;
        meta.jacobian.add_transposed(&jacobian, &self.multipliers.rows, &mut total);
        let slopes = self.free.iter().map(|&j| -total[j] * point.sizes[j] / point.scale());
        let lack = |(k, &i): (usize, &usize)| (point.row_limit(i, self.multipliers.rows[i]) - rows[i]) / self.kkt.slope(k);
        let lacks = self.held.iter().enumerate().map(lack);
        Some(slopes.chain(lacks).collect())
    }
}
