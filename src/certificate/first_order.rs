//! The first-order test: multipliers, the three residuals they leave, and the active sides.

use super::feasibility::Feasibility;
use super::multipliers::{self, Multipliers, Taken};
use super::point::{self, Point};
use super::residuals::{self, worst_slope};
use super::types::{Certificate, Tolerances};
use crate::certificate::parameters::multipliers::REFINABLE;

/// Multipliers and first-order residuals: a witness that passes, refined where that helps, spares the search.
pub(super) fn found(
    point: &mut Point<'_>,
    witness: Option<&[f64]>,
    feasibility: &Feasibility,
    tolerances: &Tolerances,
) -> (Multipliers, Certificate) {
    let usable = witness.filter(|_| feasibility.infeasibility <= tolerances.constraint);
    if let Some(passed) = usable.and_then(|witness| offered(point, witness, feasibility, tolerances)) {
        return passed;
    }
    let mut found = multipliers::find(point, witness);
    let mut certificate = of(point, &found, feasibility, tolerances);
    if witness.is_some() && certificate.is_feasible(tolerances) && !is_stationary(&certificate, tolerances) {
        // A guess decides where the search begins, and may lead it astray where limits depend on one another.
        let unguided = multipliers::find(point, None);
        let own = of(point, &unguided, feasibility, tolerances);
        if is_stationary(&own, tolerances) {
            (found, certificate) = (unguided, own);
        }
    }
    if certificate.is_feasible(tolerances)
        && !is_stationary(&certificate, tolerances)
        && let Some(refined) = multipliers::refined(point, &found)
    {
        // Beside columns nearly parallel (a fixed variable's) normal equations leave multipliers right to half their digits.
        let own = of(point, &refined, feasibility, tolerances);
        if is_stationary(&own, tolerances) {
            (found, certificate) = (refined, own);
        }
    }
    if certificate.is_feasible(tolerances) && !is_stationary(&certificate, tolerances) {
        // Without second derivatives the slope alone has to do.
        point.add_curvature().unwrap_or_default();
        point.relies_on_curvature = true;
        certificate = of(point, &found, feasibility, tolerances);
    }
    (found, certificate)
}

/// What a witness offers, with the residuals it leaves, if they pass: as it is before what only passes when it is refined.
fn offered(
    point: &Point<'_>,
    witness: &[f64],
    feasibility: &Feasibility,
    tolerances: &Tolerances,
) -> Option<(Multipliers, Certificate)> {
    let offers = [Taken::Active, Taken::Near].into_iter().filter_map(|taken| multipliers::from_witness(point, witness, taken));
    let with_residuals = |offer: Multipliers| {
        let certificate = of(point, &offer, feasibility, tolerances);
        (offer, certificate)
    };
    let (passed, others): (Vec<_>, Vec<_>) =
        offers.map(with_residuals).partition(|(_, certificate)| is_stationary(certificate, tolerances));
    passed.into_iter().chain(others).find_map(|offer| refined(point, offer, feasibility, tolerances))
}

/// Multipliers as they are, or refined where that leaves less, if they pass.
fn refined(
    point: &Point<'_>,
    offer: (Multipliers, Certificate),
    feasibility: &Feasibility,
    tolerances: &Tolerances,
) -> Option<(Multipliers, Certificate)> {
    let residual = |certificate: &Certificate| certificate.dual_infeasibility + certificate.complementarity;
    if residual(&offer.1) > REFINABLE {
        return None;
    }
    let refined = multipliers::refined(point, &offer.0).map(|refined| {
        let certificate = of(point, &refined, feasibility, tolerances);
        (refined, certificate)
    });
    let best = match refined {
        Some(refined) if residual(&refined.1) <= residual(&offer.1) => refined,
        _ => offer,
    };
    is_stationary(&best.1, tolerances).then_some(best)
}

/// The three residuals and the active sides.
pub(super) fn of(
    point: &Point<'_>,
    multipliers: &Multipliers,
    feasibility: &Feasibility,
    tolerances: &Tolerances,
) -> Certificate {
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
        primal_infeasibility: feasibility.infeasibility,
        feasible_only_at_infinity: feasibility.only_far_away,
        dual_infeasibility: worst_slope(point, multipliers, None).1,
        complementarity: residuals::complementarity(point, multipliers, tolerances.optimality),
        row_sides: (0..meta.rows()).map(row_side).collect(),
        bound_sides: (0..meta.variables()).map(bound_side).collect(),
        sigma: point.sigma,
        ..Certificate::default()
    }
}

/// Whether the three residuals pass.
pub(super) fn is_stationary(certificate: &Certificate, tolerances: &Tolerances) -> bool {
    let accepted = tolerances.optimality;
    certificate.is_feasible(tolerances) && certificate.dual_infeasibility <= accepted && certificate.complementarity <= accepted
}
