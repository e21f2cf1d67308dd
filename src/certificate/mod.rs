//! The proof at a point, by code that knows no solver: it depends on the problem and the point alone (docs/certificate.md).
//!
//! [`Certifier`] holds a model ready to judge many points; [`certify`] judges one.

mod alternative;
mod asymptote;
mod bounded;
mod candidates;
mod elsewhere;
mod every_test;
mod far_slopes;
mod farkas;
mod feasibility;
mod first_order;
mod gap;
mod higher_order;
mod idle_rows;
mod implied_box;
mod known_sizes;
mod linear_rows;
mod lower_bound;
mod messages;
mod multipliers;
mod newton;
mod parallel_rows;
pub mod parameters;
mod point;
mod propagation;
mod residuals;
mod row_range;
mod runaway;
mod scales;
mod second_order;
#[cfg(test)]
mod tests;
mod types;

use elsewhere::Elsewhere;
use feasibility::worst_violation;
use first_order::is_stationary;
use std::time::Instant;

use multipliers::Multipliers;
use parameters::sizes::PROPORTION;
use point::{Origin, Point};
use residuals::{beyond_rounding, lost_in_rounding, objective_lost, slope_far_out};
use runaway::Runaway;
use second_order::{Active, Curvature, Hessian};

use crate::model::{Class, EvaluationError, Model};
use crate::recession::Ray;
pub use alternative::contradicting;
pub use farkas::{Contradiction, contradiction};
pub use known_sizes::{have_rows_grown, sizes_at_start, sizes_known_at};
pub use lower_bound::lower_bound;
pub use propagation::impossible_row;
pub use second_order::SecondOrder;
pub use types::{Certificate, Extent, Side, Tolerances};

/// Certifies `x`. `guess`, a solver's row multipliers, is a witness: tried first, and worth what the residuals computed from it
/// say.
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
    /// Nothing is evaluated yet.
    pub fn new(model: &'a dyn Model, class: Class, tolerances: Tolerances) -> Self {
        Certifier { origin: Origin::new(model), class, tolerances }
    }

    /// Searches (for multipliers, for directions) end at that moment, with what they have; a point that would need more is not
    /// certified.
    pub fn with_deadline(mut self, until: Option<Instant>) -> Self {
        self.origin.until = until;
        self
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
        self.passed(x).is_some()
    }

    /// The certificate of an `x` that passes; cheap where it is far from feasible.
    pub fn passed(&self, x: &[f64]) -> Option<Certificate> {
        let is_feasible = self.primal_infeasibility(x).is_some_and(|worst| worst <= self.tolerances.constraint);
        is_feasible.then(|| self.certify(x, None).ok()).flatten().filter(|certificate| certificate.certified)
    }

    /// The primal infeasibility of a certificate at `x`; `None` where the model has no value or derivative.
    pub fn primal_infeasibility(&self, x: &[f64]) -> Option<f64> {
        let point = Point::new(&self.origin, x).ok()?;
        Some(feasibility::of(&point, self.tolerances.constraint).infeasibility)
    }

    /// A way along which the objective falls for ever from a feasible point, stationary or not: outwards from where the variables
    /// come from, the others led along the floor of the Lagrangian.
    pub fn way_beyond(&self, x: &[f64]) -> Option<Ray> {
        let mut point = Point::new(&self.origin, x).ok()?;
        let feasibility = feasibility::of(&point, self.tolerances.constraint);
        let (multipliers, found) = first_order::found(&mut point, None, &feasibility, &self.tolerances);
        let nearly_weak = residuals::nearly_weak(&point, &multipliers, found.dual_infeasibility);
        let active = Active { rows: &found.row_sides, bounds: &found.bound_sides, multipliers: &multipliers, nearly_weak };
        let is_feasible = found.is_feasible(&self.tolerances);
        is_feasible.then(|| runaway::beyond(&point, &active, self.class, &self.tolerances)).flatten()
    }

    /// `x` where it meets every limit, else a point that does within `reach` of the variables' sizes there, by Newton's steps.
    pub fn nearest_feasible(&self, x: &[f64], reach: f64) -> Option<Vec<f64>> {
        feasibility::nearest(&self.origin, x, reach, self.tolerances.constraint)
    }

    /// A point within `reach` of the variables' sizes that meets the rows to this tolerance, relative to their terms: where there is one, what `x`
    /// misses them by is a solver's rounding, not a contradiction of theirs.
    pub fn met_beside(&self, x: &[f64], reach: f64, tolerance: f64) -> Option<Vec<f64>> {
        feasibility::met_beside(&self.origin, x, reach, tolerance)
    }

    /// Judges `x`; see [`certify`].
    ///
    /// # Errors
    /// The model has no value or derivative at `x`.
    pub fn certify(&self, x: &[f64], guess: Option<&[f64]>) -> Result<Certificate, EvaluationError> {
        let mut point = Point::new(&self.origin, x)?;
        let feasibility = feasibility::of(&point, self.tolerances.constraint);
        let (multipliers, mut certificate) = first_order::found(&mut point, guess, &feasibility, &self.tolerances);
        if certificate.dual_infeasibility > self.tolerances.optimality && certificate.is_feasible(&self.tolerances) {
            certificate.dual_infeasibility = beyond_rounding(&point, &multipliers)?;
        }
        // Multipliers so large that their balance is lost in rounding prove nothing (where none exist, as in HS13, ever larger
        // ones seem to do).
        let lost = lost_in_rounding(&point, &multipliers);
        if lost > self.tolerances.optimality {
            certificate.dual_infeasibility = certificate.dual_infeasibility.max(lost);
        }
        if is_stationary(&certificate, &self.tolerances)
            && let Some(gain) = gap::beyond_the_slope(&point, &multipliers)
        {
            certificate.complementarity = certificate.complementarity.max(gain);
        }
        if is_stationary(&certificate, &self.tolerances) && !point.meta().objective_is_linear {
            if point.sigma == 0.0 {
                point.add_curvature()?;
                point.relies_on_curvature = true;
            }
            let lost = objective_lost(&point).max(slope_far_out(&point, &multipliers)?);
            certificate.dual_infeasibility = certificate.dual_infeasibility.max(lost);
        }
        certificate.scope = Extent::of(self.class);
        let multipliers = self.with_idle_rows(&mut point, multipliers, &certificate)?;
        self.second_order(&mut point, &multipliers, &mut certificate)?;
        certificate.messages = messages::sentences(&point, &multipliers, &certificate, &self.tolerances);
        certificate.row_multipliers = multipliers.rows;
        certificate.bound_multipliers = multipliers.bounds;
        certificate.variable_scales = point.plain_sizes().to_vec();
        certificate.row_values = point.rows;
        Ok(certificate)
    }

    /// Multipliers that prove where those found do not: rows that push nowhere leave theirs open.
    fn with_idle_rows(
        &self,
        point: &mut Point<'_>,
        multipliers: Multipliers,
        certificate: &Certificate,
    ) -> Result<Multipliers, EvaluationError> {
        let (rows, bounds) = (&certificate.row_sides, &certificate.bound_sides);
        let idle = idle_rows::of(point, (rows, bounds));
        if idle.is_empty() || self.class.is_global() || !is_stationary(certificate, &self.tolerances) {
            return Ok(multipliers);
        }
        self.hessian(point, &multipliers)?;
        for choice in idle_rows::choices(point, &idle, &multipliers)? {
            let nearly_weak = residuals::nearly_weak(point, &choice, certificate.dual_infeasibility);
            let active = Active { rows, bounds, multipliers: &choice, nearly_weak };
            if residuals::complementarity(point, &choice, self.tolerances.optimality) > self.tolerances.optimality {
                break;
            }
            let curvature = second_order::examine(point, &active, &Hessian::of(point, &choice)?, false);
            if curvature.escape.is_none() && curvature.undecided.is_none() && !curvature.singular {
                return Ok(choice);
            }
        }
        Ok(multipliers)
    }

    /// What first order leaves open: curvature, what lies beyond it, and variables that have run away.
    fn second_order(
        &self,
        point: &mut Point<'_>,
        multipliers: &Multipliers,
        certificate: &mut Certificate,
    ) -> Result<(), EvaluationError> {
        let nearly_weak = residuals::nearly_weak(point, multipliers, certificate.dual_infeasibility);
        let active = Active { rows: &certificate.row_sides, bounds: &certificate.bound_sides, multipliers, nearly_weak };
        if !is_stationary(certificate, &self.tolerances) {
            if certificate.is_feasible(&self.tolerances) {
                certificate.multipliers_not_unique = second_order::is_dependent(point, &active);
            }
            return Ok(());
        }
        let hessian = self.hessian(point, multipliers)?;
        let point = &*point;
        let is_global = self.class.is_global();
        let is_regular = !is_global && second_order::has_minimum_beside(point, multipliers);
        let Curvature { escape, singular, dependent, undecided, flat } =
            if is_regular { Curvature::default() } else { self.curvature(point, &active, &hessian) };
        let has_idle_rows = !idle_rows::of(point, (active.rows, active.bounds)).is_empty();
        let dependent = dependent || has_idle_rows;
        // Other multipliers may bend the Lagrangian up along a direction where these bend it down: then only a lower point proves.
        let is_proof = |direction: &Vec<f64>| {
            !(dependent && (has_idle_rows || self.bends_by_choice(point, multipliers)))
                || higher_order::confirm(point, &active, &hessian, &self.tolerances, direction)
        };
        let has_negative_curvature = escape.as_ref().is_some_and(is_proof);
        let undecided = if escape.is_some() && !has_negative_curvature { Some(0) } else { undecided };
        // Convex problems have no inflections, and need no second order: the first proves.
        let undecided = undecided.filter(|_| !is_global);
        let further = || higher_order::find(point, &active, &hessian, &self.tolerances, (&flat, dependent)).unwrap_or_default();
        let descent = if escape.is_some() || is_regular || is_global { None } else { further() };
        let descends_at_higher_order = descent.is_some();
        let runaway = match has_negative_curvature || descends_at_higher_order {
            true => Runaway::default(),
            false => runaway::find(point, &active, &hessian, (self.class, dependent), &self.tolerances),
        };
        let may_deceive = !has_negative_curvature && !descends_at_higher_order && runaway.variables.is_empty();
        let look = || elsewhere::look(point, &active, self.class, &self.tolerances);
        let elsewhere = if may_deceive { look() } else { Elsewhere::Nowhere };
        (certificate.led_on, certificate.falls_far_away) =
            (matches!(elsewhere, Elsewhere::LedOn(_)), matches!(elsewhere, Elsewhere::FarAway(_)));
        certificate.cut_short = point.is_cut_short();
        let goes_on = !runaway.variables.is_empty() || elsewhere != Elsewhere::Nowhere || certificate.cut_short;
        let runaway = elsewhere.runaway().unwrap_or(runaway);
        certificate.certified = !has_negative_curvature && !descends_at_higher_order && undecided.is_none() && !goes_on;
        certificate.escape = escape.or(descent).or(elsewhere.way());
        (certificate.negative_curvature, certificate.descends_at_higher_order) =
            (has_negative_curvature, descends_at_higher_order);
        (certificate.falls_without_end, certificate.runaway) = (runaway.is_endless, runaway.variables);
        certificate.undecided = undecided.filter(|_| !descends_at_higher_order);
        (certificate.minimiser_may_not_be_unique, certificate.multipliers_not_unique) = (singular, dependent);
        Ok(())
    }

    /// What second derivatives say; after the deadline nothing of a global class, of which first order proves.
    fn curvature(&self, point: &Point<'_>, active: &Active<'_>, hessian: &Hessian) -> Curvature {
        match self.class.is_global() {
            true if point.is_late() => Curvature::default(),
            is_global => second_order::examine(point, active, hessian, is_global),
        }
    }

    /// The scaled Hessian of the Lagrangian, in sizes that curvature and the slope about the point have a say in.
    fn hessian(&self, point: &mut Point<'_>, multipliers: &Multipliers) -> Result<Hessian, EvaluationError> {
        if self.class.is_global() {
            return Hessian::of(point, multipliers);
        }
        point.add_curvature()?;
        let (about, scale) = (point.slope_about(), point.scale());
        if about > 0.0 && (0..point.x.len()).any(|j| point.is_size_known_otherwise(j)) {
            let diagonal = Hessian::of(point, multipliers)?.diagonal(point);
            point.resize_by_curvature(|j| diagonal[j] * scale, about);
            point.add_curvature()?;
        }
        // Beside an inflection the curvature is as small as the slope: what is steep about the point shows how flat that is.
        let most = if point.sigma > 0.0 { PROPORTION * point.sigma } else { f64::INFINITY };
        point.sigma = point.sigma.max(about.min(most));
        Hessian::of(point, multipliers)
    }

    /// Whether ∇²L depends on the multipliers.
    fn bends_by_choice(&self, point: &Point<'_>, multipliers: &Multipliers) -> bool {
        multipliers.rows.iter().zip(&point.meta().row_is_linear).any(|(y, is_linear)| *y != 0.0 && !is_linear)
    }
}
