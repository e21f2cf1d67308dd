//! What a certificate found, in plain sentences.

use super::multipliers::Multipliers;
use super::point::Point;
use super::residuals::{Place, lost_in_rounding, worst_slope};
use super::{Certificate, Tolerances, worst_violation};
use crate::expression::display::plain;

/// Variables that change by less than this share of the largest relative change are not named, nor more than so many.
const NAMED: f64 = 0.01;
const MOST_NAMED: usize = 6;

/// One sentence per failed test, naming the variable or row; then remarks.
pub(super) fn sentences(
    point: &Point<'_>,
    multipliers: &Multipliers,
    certificate: &Certificate,
    tolerances: &Tolerances,
) -> Vec<String> {
    let mut all = Vec::new();
    if certificate.feasible_only_at_infinity {
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
    let along = certificate.escape.as_ref().map_or(String::new(), |escape| format!(" ({})", direction(point, escape)));
    if certificate.negative_curvature {
        all.push(format!(
            "the point is stationary, but no minimum: along a direction the limits allow{along}, the curvature is negative"
        ));
    }
    if certificate.descends_at_higher_order {
        all.push(format!("the point is stationary, but no minimum: flat to second order, the objective falls further along a direction the limits allow{along}"));
    }
    match certificate.undecided {
        Some(0) => all.push("second-order conditions are not proved: the multipliers found bend the Lagrangian down, but they are one choice of many, and no lower point was found".into()),
        Some(limits) => all.push(format!("second-order conditions hold as far as tested, not proved at {limits} weakly active limits")),
        None => {}
    }
    if !certificate.runaway.is_empty() {
        let names = list(certificate.runaway.iter().map(|&j| point.variable(j)));
        all.push(match certificate.falls_without_end {
            true => format!("the objective falls without end as {names} runs away"),
            false => format!("the minimum is not attained: the objective keeps falling, ever more slowly, as {names} runs away"),
        });
    }
    if certificate.cut_short {
        all.push("the time limit ended the search for lower points beside and beyond the point".into());
    }
    if certificate.led_on {
        all.push(format!("nothing tells how large some variables are, and the slope is small only beside the size 1: Newton's steps lead on, to another point{along}"));
    }
    if certificate.falls_far_away {
        all.push(format!("a slope that is small beside the variables' sizes leads to a lower point far away{along}"));
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
    let (value, limit, accepted) = (plain(value), plain(limit), tolerances.constraint);
    format!("{what} is {value}, {word} its limit {limit} by {size:.1e} of its scale (accepted {accepted:.1e})")
}

fn slope(point: &Point<'_>, multipliers: &Multipliers, certificate: &Certificate, tolerances: &Tolerances) -> String {
    let sizes =
        format!("({:.1e} of the objective's scale, accepted {:.1e})", certificate.dual_infeasibility, tolerances.optimality);
    if lost_in_rounding(point, multipliers) > tolerances.optimality && certificate.is_feasible(tolerances) {
        return "only multipliers so large that their balance is lost in rounding would hold the point: the gradients of the active \
                limits depend on one another, so no multipliers may exist here although the point may be a minimum"
            .into();
    }
    let place = worst_slope(point, multipliers, None).0;
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

/// The largest entries of a direction of length one: `x +0.71, y −0.71`.
fn direction(point: &Point<'_>, direction: &[f64]) -> String {
    let length = direction.iter().map(|v| v * v).sum::<f64>().sqrt();
    let relative = |j: usize| (direction[j] / point.sizes[j]).abs();
    let mut largest: Vec<usize> = (0..direction.len()).filter(|&j| direction[j] != 0.0).collect();
    largest.sort_by(|&a, &b| relative(b).total_cmp(&relative(a)).then(a.cmp(&b)));
    let most = largest.first().map_or(0.0, |&j| relative(j));
    largest.retain(|&j| relative(j) >= NAMED * most);
    let more = if largest.len() > MOST_NAMED { ", …" } else { "" };
    let entry = |&j: &usize| format!("{} {:+.2}", point.variable(j), direction[j] / length);
    largest.iter().take(MOST_NAMED).map(entry).collect::<Vec<_>>().join(", ") + more
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
