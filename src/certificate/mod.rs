//! The proof at a point, by code that knows no solver: it depends on the problem and the point alone (SPEC §4).
//!
//! [`Certifier`] holds a model ready to judge many points; [`certify`] judges one.

mod active_set;
mod bordered;
mod candidates;
mod curvature;
mod descent;
mod farkas;
mod implied_box;
mod kkt;
mod least_squares;
mod lower_bound;
mod matrix;
mod multipliers;
mod narrow;
mod normal_equations;
mod outward;
mod pieces;
mod point;
mod propagation;
mod reach;
mod runaway;
mod small_kkt;
#[cfg(test)]
mod tests;
mod trial;
mod types;
mod words;

use curvature::{Active, Curvature, Hessian};
use multipliers::Multipliers;
use point::{Origin, Point};

use crate::model::{Class, EvaluationError, Model};
pub use farkas::{Contradiction, contradiction};
pub use lower_bound::lower_bound;
pub use propagation::impossible_row;
pub use types::{Certificate, Scope, Side, Tolerances};

/// Certifies `x`. `guess`, a solver's row multipliers, is a first guess and never evidence.
///
/// # Errors
/// The model has no value or derivative at `x`.
pub fn certify(
    model: &dyn Model,
    class: Class,
    x: &[f64],
    guess: Option<&[f64]>,
    tolerances: Tolerances,
) -> Result<Certificate, EvaluationError> {
    Certifier::new(model, class, tolerances).certify(x, guess)
}

/// A model ready to have points judged.
pub struct Certifier<'a> {
    origin: Origin<'a>,
    class: Class,
    tolerances: Tolerances,
}

impl<'a> Certifier<'a> {
    /// Evaluates the gradient at the model's start, once.
    pub fn new(model: &'a dyn Model, class: Class, tolerances: Tolerances) -> Self {
        Certifier { origin: Origin::new(model), class, tolerances }
    }

    /// The row multipliers that make `x` as stationary as it allows, without judging it.
    ///
    /// # Errors
    /// The model has no value or derivative at `x`.
    pub fn row_multipliers(&self, x: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        Ok(multipliers::find(&Point::new(&self.origin, x)?, None).rows)
    }

    /// Whether `x` passes; cheap where it is far from feasible. A stop test for solvers.
    pub fn accepts(&self, x: &[f64]) -> bool {
        self.primal_infeasibility(x).is_some_and(|worst| worst <= self.tolerances.constraint)
            && self.certify(x, None).is_ok_and(|certificate| certificate.certified)
    }

    /// max violation_i/s_i over rows and bounds, or what is left of it in the start's measure where it only passes because
    /// variables have run away; `None` where the model has no value.
    pub fn primal_infeasibility(&self, x: &[f64]) -> Option<f64> {
        let point = Point::new(&self.origin, x).ok()?;
        let worst = worst_violation(&point).1;
        let accepted = self.tolerances.constraint;
        if worst > accepted { Some(worst) } else { Some(reach::out_of_reach(&point, accepted).unwrap_or(worst)) }
    }

    /// Judges `x`; see [`certify`].
    ///
    /// # Errors
    /// The model has no value or derivative at `x`.
    pub fn certify(&self, x: &[f64], guess: Option<&[f64]>) -> Result<Certificate, EvaluationError> {
        let point = Point::new(&self.origin, x)?;
        let multipliers = multipliers::find(&point, guess);
        let mut certificate = first_order(&point, &multipliers, &self.tolerances);
        if certificate.dual_infeasibility > self.tolerances.optimality && certificate.is_feasible(&self.tolerances) {
            certificate.dual_infeasibility = beyond_rounding(&point, &multipliers)?;
        }
        // Multipliers so large that their balance is lost in rounding prove nothing (where none exist, as in HS13, ever larger
        // ones seem to do).
        let lost = lost_in_rounding(&point, &multipliers);
        if lost > self.tolerances.optimality {
            certificate.dual_infeasibility = certificate.dual_infeasibility.max(lost);
        }
        certificate.scope = Scope::of(self.class);
        if certificate.is_feasible(&self.tolerances)
            && let Some(worst) = reach::out_of_reach(&point, self.tolerances.constraint)
        {
            (certificate.primal_infeasibility, certificate.met_only_far_away) = (worst, true);
        }
        self.second_order(&point, &multipliers, &mut certificate)?;
        certificate.messages = words::messages(&point, &multipliers, &certificate, &self.tolerances);
        certificate.row_multipliers = multipliers.rows;
        certificate.bound_multipliers = multipliers.bounds;
        certificate.row_values = point.rows;
        certificate.variable_scales = point.d;
        Ok(certificate)
    }

    /// What first order leaves open: curvature, what lies beyond it, and variables that have run away.
    fn second_order(
        &self,
        point: &Point<'_>,
        multipliers: &Multipliers,
        certificate: &mut Certificate,
    ) -> Result<(), EvaluationError> {
        let active = Active { rows: &certificate.row_sides, bounds: &certificate.bound_sides, multipliers };
        if !self.is_stationary(certificate) {
            if certificate.is_feasible(&self.tolerances) {
                certificate.multipliers_not_unique = curvature::is_dependent(point, &active);
            }
            return Ok(());
        }
        let hessian = Hessian::of(point, multipliers)?;
        let Curvature { escape, singular, dependent } = curvature::examine(point, &active, &hessian);
        let bends_down = escape.is_some();
        // Convex problems have no inflections.
        let descent = match bends_down || self.class.is_global() {
            true => None,
            false => descent::find(point, &active, &hessian, &self.tolerances).unwrap_or_default(),
        };
        let falls_further = descent.is_some();
        let runaway = match bends_down || falls_further {
            true => Vec::new(),
            false => runaway::variables(point, &active, &self.tolerances),
        };
        certificate.certified = !bends_down && !falls_further && runaway.is_empty();
        certificate.escape = escape.or(descent);
        (certificate.negative_curvature, certificate.falls_further, certificate.runaway) = (bends_down, falls_further, runaway);
        (certificate.minimiser_may_not_be_unique, certificate.multipliers_not_unique) = (singular, dependent);
        Ok(())
    }

    fn is_stationary(&self, certificate: &Certificate) -> bool {
        let accepted = self.tolerances.optimality;
        certificate.is_feasible(&self.tolerances)
            && certificate.dual_infeasibility <= accepted
            && certificate.complementarity <= accepted
    }
}

/// The three residuals of SPEC §4 and the active sides.
fn first_order(point: &Point<'_>, multipliers: &Multipliers, tolerances: &Tolerances) -> Certificate {
    let (meta, sigma) = (point.meta(), point.scale());
    let (y, z) = (&multipliers.rows, &multipliers.bounds);
    let touch = tolerances.constraint;
    let row_side = |i: usize| {
        let (lower, upper) = (meta.row_lower[i], meta.row_upper[i]);
        let limit = if (point.rows[i] - lower).abs() < (point.rows[i] - upper).abs() { lower } else { upper };
        let near = touch * limit.abs().max(point.slopes[i]);
        point::side(point.rows[i], lower, upper, y[i] * point.slopes[i] / sigma, near, point.slopes[i])
    };
    let bound_side = |j: usize| {
        let d = point.sizes[j];
        point::side(point.x[j], meta.lower[j], meta.upper[j], z[j] * d / sigma, touch * d, d)
    };
    Certificate {
        objective: point.objective,
        primal_infeasibility: worst_violation(point).1,
        dual_infeasibility: worst_slope(point, multipliers, None).1,
        complementarity: worst_complementarity(point, multipliers).1,
        row_sides: (0..meta.rows()).map(row_side).collect(),
        bound_sides: (0..meta.variables()).map(bound_side).collect(),
        sigma: point.sigma,
        ..Certificate::default()
    }
}

/// Where something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    Row(usize),
    Variable(usize),
}

type Worst = (Option<Place>, f64);

fn worse(worst: Worst, next: (Place, f64)) -> Worst {
    if next.1 > worst.1 { (Some(next.0), next.1) } else { worst }
}

/// The worst relative violation and where.
fn worst_violation(point: &Point<'_>) -> Worst {
    let rows = (0..point.rows.len()).map(|i| (Place::Row(i), point.row_violation(i)));
    let bounds = (0..point.x.len()).map(|j| (Place::Variable(j), point.bound_violation(j)));
    rows.chain(bounds).fold((None, 0.0), worse)
}

/// max |∂L/∂x_j|·d_j/σ and where, less what rounding explains.
fn worst_slope(point: &Point<'_>, multipliers: &Multipliers, rounding: Option<&[f64]>) -> Worst {
    if point.sigma == 0.0 {
        return (None, 0.0);
    }
    let rest = point.row_gradient(&multipliers.rows);
    let slope = |j: usize| {
        let slope = ((rest[j] + multipliers.bounds[j]) * point.sizes[j] / point.sigma).abs();
        (slope - rounding.map_or(0.0, |rounding| rounding[j])).max(0.0)
    };
    (0..rest.len()).map(|j| (Place::Variable(j), slope(j))).fold((None, 0.0), worse)
}

/// Dual infeasibility where σ itself may be rounding (a start that is stationary, or the minimum): what the last digits of x make
/// of ∂L/∂x_j, through the Hessian, does not count.
fn beyond_rounding(point: &Point<'_>, multipliers: &Multipliers) -> Result<f64, EvaluationError> {
    let rounding: Vec<f64> = curvature::magnitudes(point, multipliers)?.iter().map(|size| 32.0 * f64::EPSILON * size).collect();
    Ok(worst_slope(point, multipliers, Some(&rounding)).1)
}

/// What rounding may hide in max |∂L/∂x_j|·d_j/σ: ε times the magnitudes it is summed from.
fn lost_in_rounding(point: &Point<'_>, multipliers: &Multipliers) -> f64 {
    if point.sigma == 0.0 {
        return 0.0;
    }
    let mut total: Vec<f64> = point.gradient.iter().map(|g| g.abs()).collect();
    let magnitudes: Vec<f64> = point.jacobian.iter().map(|a| a.abs()).collect();
    let weights: Vec<f64> = multipliers.rows.iter().map(|y| y.abs()).collect();
    point.meta().jacobian.add_transposed(&magnitudes, &weights, &mut total);
    total.iter().zip(&point.sizes).fold(0.0, |most: f64, (sum, &d)| most.max(f64::EPSILON * sum * d / point.sigma))
}

/// Σ|multiplier|·|distance to its limit|/σ, and its largest term.
fn worst_complementarity(point: &Point<'_>, multipliers: &Multipliers) -> Worst {
    let term = |multiplier: f64, value: f64, limit: f64| {
        if multiplier == 0.0 { 0.0 } else { multiplier.abs() * (value - limit).abs() / point.scale() }
    };
    let rows = multipliers.rows.iter().enumerate().map(|(i, &y)| (Place::Row(i), term(y, point.rows[i], point.row_limit(i, y))));
    let bounds = multipliers.bounds.iter().enumerate();
    let bounds = bounds.map(|(j, &z)| (Place::Variable(j), term(z, point.x[j], point.bound(j, z))));
    let add = |(worst, sum): (Worst, f64), next: (Place, f64)| (worse(worst, next), sum + next.1);
    let (worst, sum) = rows.chain(bounds).fold(((None, 0.0), 0.0), add);
    (worst.0, sum)
}
