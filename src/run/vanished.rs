//! Bars that have vanished: the structure without them, solved and judged anew.

use super::Subject;
use super::settled::Settled;
use crate::certificate::{Certificate, Extent, Side};
use crate::crosscheck::{Outcome, Status};
use crate::model::Meta;
use crate::model::remainder::remainder;

/// The structure without the bars that have vanished at a point, and the point in it; `None` where none has.
pub(super) fn without_vanished(subject: &Subject, x: &[f64]) -> Option<(Subject, Vec<f64>, String)> {
    let rest = remainder(subject.problem(), x).ok()??;
    let names = |ribs: &[u32]| {
        ribs.iter().map(|&rib| subject.problem().ribs.names[rib as usize].to_string()).collect::<Vec<_>>().join(", ")
    };
    let mut remark = format!("Bars that have vanished: {}", names(&rest.gone));
    if !rest.needed.is_empty() {
        remark += &format!(" ({} are needed: without them something would move without resistance)", names(&rest.needed));
    }
    let reduced = subject.with_problem(rest.problem).ok()?;
    let mut x = x.to_vec();
    reduced.shown().meta().clamp(&mut x);
    Some((reduced, x, remark))
}

/// Solves anew, by `again`, without the bars that have vanished at the point of an outcome; `None` where none has, or where nothing
/// better is known of the rest.
pub(super) fn settle(
    subject: &Subject,
    outcome: &Outcome,
    again: impl FnOnce(&Subject, &[f64]) -> Option<Outcome>,
) -> Option<Settled> {
    if matches!(outcome.status, Status::Infeasible | Status::Unbounded | Status::Interrupted) || outcome.objective.is_none() {
        return None;
    }
    let (rest, x, remark) = without_vanished(subject, &outcome.x)?;
    let mut found = again(&rest, &x)?;
    if found.status != Status::Certified {
        return None;
    }
    // What is proved of the rest is not proved of designs with these bars.
    (found.scope, found.lower_bound) = (Extent::Local, None);
    found.message = format!("{remark}. Of the structure without them: {}", found.message);
    let bounds = (subject.shown().meta(), rest.shown().meta());
    let judged = found.answers.iter_mut().filter_map(|answer| answer.certificate.as_mut()).chain(found.certificate.as_mut());
    judged.for_each(|certificate| at_lower_bounds(certificate, bounds));
    Some(Settled { subject: rest, outcome: found })
}

/// Variables of what has vanished are held where they are: in the user's words they lie on their lower bounds.
fn at_lower_bounds(certificate: &mut Certificate, (own, rest): (&Meta, &Meta)) {
    for (j, side) in certificate.bound_sides.iter_mut().enumerate() {
        if rest.lower[j] == rest.upper[j] && own.lower[j] < own.upper[j] {
            *side = Side::Lower;
        }
    }
}
