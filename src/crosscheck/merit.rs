//! Which of two points is better, when is a difference one.

use super::Answer;
use super::session::Session;
use crate::certificate::Certificate;

/// Objectives this close, in units of σ, are the same.
const AGREEMENT: f64 = 1e-6;
/// A point that is above an infimum by REACHED·AGREEMENT·σ has not reached it.
const REACHED: f64 = 1e-2;
/// Roundings of an objective's terms.
const ROUNDINGS: f64 = 64.0;

/// σ beside an infinite slope says nothing of the objective's size: so many times the values at the point and the start at most.
const STEEPEST: f64 = 1e3;

/// Whether the gap a judged point leaves to its limits, Σ|multiplier|·distance, is worth more than the agreement of its own objective.
pub(super) fn is_coarse(certificate: &Certificate) -> bool {
    certificate.complementarity * certificate.sigma > AGREEMENT * certificate.objective.abs()
}

/// Below which objectives do not differ from that of a judged point: the agreement, or the rounding of the objective's terms.
pub(super) fn level(session: &Session<'_>, x: &[f64], certificate: &Certificate) -> f64 {
    within(AGREEMENT, session, x, certificate)
}

/// Within which a minimum is reached that is attained: solvers end well inside what is accepted, also where there is no more below than that.
pub(super) fn reached(session: &Session<'_>, x: &[f64], certificate: &Certificate) -> f64 {
    within(REACHED * AGREEMENT, session, x, certificate)
}

/// So many σ, or the rounding of the objective's terms.
fn within(share: f64, session: &Session<'_>, x: &[f64], certificate: &Certificate) -> f64 {
    let begun = session.task.model.objective(session.task.start).map_or(0.0, f64::abs);
    let sigma = certificate.sigma.min(STEEPEST * (certificate.objective.abs() + begun));
    (share * sigma).max(rounding(session, x, certificate.objective))
}

/// Roundings of f's terms at x; where they are not known, |f| and |∂f/∂x_j·x_j| stand for them.
fn rounding(session: &Session<'_>, x: &[f64], objective: f64) -> f64 {
    let mut gradient = vec![0.0; x.len()];
    let known = session.task.model.gradient(x, &mut gradient).is_ok();
    let terms: f64 = if known { x.iter().zip(&gradient).map(|(x, g)| (x * g).abs()).sum() } else { 0.0 };
    ROUNDINGS * f64::EPSILON * (objective.abs() + terms)
}

/// The largest of a judged point's residuals, each in units of what is accepted.
pub(super) fn inexactness(session: &Session<'_>, answer: &Answer) -> f64 {
    let accepted = session.tolerances;
    let worst = |own: &Certificate| {
        let optimality = own.dual_infeasibility.max(own.complementarity) / accepted.optimality;
        optimality.max(own.primal_infeasibility / accepted.constraint)
    };
    answer.certificate.as_ref().map_or(f64::INFINITY, worst)
}

/// f + Σ|multiplier|·violation: what the answer's objective is worth once its violation is paid for at the prices of a certified
/// point. To first order no point is below that point's objective by violating limits.
pub(super) fn priced(session: &Session<'_>, answer: &Answer, prices: &Certificate) -> Option<f64> {
    let (meta, x) = (session.task.model.meta(), &answer.solution.x);
    let mut rows = vec![0.0; meta.rows()];
    session.task.model.constraints(x, &mut rows).ok()?;
    let violation = |value: f64, lower: f64, upper: f64| (lower - value).max(value - upper).max(0.0);
    let of_rows =
        (0..rows.len()).map(|i| prices.row_multipliers[i].abs() * violation(rows[i], meta.row_lower[i], meta.row_upper[i]));
    let of_bounds = (0..x.len()).map(|j| prices.bound_multipliers[j].abs() * violation(x[j], meta.lower[j], meta.upper[j]));
    Some(answer.objective? + of_rows.sum::<f64>() + of_bounds.sum::<f64>())
}

/// Whether a feasible answer is lower than a certified one beyond agreement, rounding, and what its violation is worth.
pub(super) fn is_lower(session: &Session<'_>, answer: &Answer, best: &Answer) -> bool {
    let Some(certificate) = &best.certificate else { return false };
    answer.feasible
        && answer.objective.is_some_and(|objective| objective < certificate.objective)
        && priced(session, answer, certificate)
            .is_some_and(|value| value < certificate.objective - level(session, &best.solution.x, certificate))
}
