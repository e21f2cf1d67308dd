//! What a certificate found, in plain sentences.

use super::multipliers::Multipliers;
use super::point::Point;
use super::{Certificate, Place, Tolerances, worst_violation};

/// One sentence per failed test, naming the variable or row; then remarks.
pub(super) fn messages(
    point: &Point<'_>,
    multipliers: &Multipliers,
    certificate: &Certificate,
    tolerances: &Tolerances,
) -> Vec<String> {
    let mut all = Vec::new();
    if certificate.met_only_far_away {
        all.push(format!(
            "the rows are met only because variables are so large that the violation is lost beside them ({:.1e} of the start's scale, accepted {:.1e})",
            certificate.primal_infeasibility, tolerances.constraint
        ));
    } else if !certificate.is_feasible(tolerances) {
        all.push(violation(point, tolerances));
    }
    if certificate.dual_infeasibility > tolerances.optimality {
        all.push(slope(point, multipliers, certificate, tolerances));
    }
    if certificate.complementarity > tolerances.optimality {
        all.push(format!(
            "the multipliers that balance the objective belong to limits the point does not touch (complementarity {:.1e}, accepted {:.1e})",
            certificate.complementarity, tolerances.optimality
        ));
    }
    if certificate.negative_curvature {
        all.push("the point is stationary, but no minimum: along a direction the limits allow, the objective bends down".into());
    }
    if certificate.falls_further {
        all.push("the point is stationary, but no minimum: flat to second order, the objective falls further along a direction the limits allow".into());
    }
    if !certificate.runaway.is_empty() {
        let names = list(certificate.runaway.iter().map(|&j| point.variable(j)));
        all.push(format!("the minimum is not attained: the objective keeps falling, ever more slowly, as {names} runs away"));
    }
    if certificate.certified {
        all.extend(remarks(certificate));
    }
    all
}

fn remarks(certificate: &Certificate) -> impl Iterator<Item = String> {
    let multipliers = "the active limits depend on one another: the multipliers shown are one choice of many";
    let minimiser = "the objective is flat to second order along a direction the limits allow: the minimiser may not be unique";
    let all = [(certificate.multipliers_not_unique, multipliers), (certificate.minimiser_may_not_be_unique, minimiser)];
    all.into_iter().filter(|(holds, _)| *holds).map(|(_, text)| text.to_string())
}

fn violation(point: &Point<'_>, tolerances: &Tolerances) -> String {
    let (place, size) = worst_violation(point);
    let (what, value, lower, upper) = match place {
        Some(Place::Row(i)) => {
            (format!("row {}", point.row(i)), point.rows[i], point.meta().row_lower[i], point.meta().row_upper[i])
        }
        Some(Place::Variable(j)) => (point.variable(j), point.x[j], point.meta().lower[j], point.meta().upper[j]),
        None => return "the point is not feasible".into(),
    };
    let (word, limit) = if value < lower { ("below", lower) } else { ("above", upper) };
    format!("{what} is {value}, {word} its limit {limit} by {size:.1e} of its scale (accepted {:.1e})", tolerances.constraint)
}

fn slope(point: &Point<'_>, multipliers: &Multipliers, certificate: &Certificate, tolerances: &Tolerances) -> String {
    let sizes =
        format!("({:.1e} of the objective's scale, accepted {:.1e})", certificate.dual_infeasibility, tolerances.optimality);
    if super::lost_in_rounding(point, multipliers) > tolerances.optimality && certificate.is_feasible(tolerances) {
        return "only multipliers so large that their balance is lost in rounding would hold the point: the gradients of the active \
                limits depend on one another, so no multipliers may exist here although the point may be a minimum"
            .into();
    }
    let place = super::worst_slope(point, multipliers, None).0;
    let name = match place {
        Some(Place::Variable(j)) => point.variable(j),
        _ => "a variable".into(),
    };
    let mut text = format!("the objective still falls along {name} {sizes}");
    if certificate.multipliers_not_unique && certificate.is_feasible(tolerances) {
        text.push_str(
            "; the gradients of the active limits depend on one another, so no multipliers may exist here although the point may be a minimum",
        );
    }
    text
}

/// `a`, `a and b`, `a, b and c`; long lists are cut.
pub(super) fn list(names: impl ExactSizeIterator<Item = String>) -> String {
    let (total, mut shown): (usize, Vec<String>) = (names.len(), names.take(6).collect());
    if total > shown.len() {
        shown.push(format!("{} others", total - shown.len()));
    }
    match shown.split_last() {
        None => String::new(),
        Some((only, [])) => only.clone(),
        Some((last, others)) => format!("{} and {last}", others.join(", ")),
    }
}
