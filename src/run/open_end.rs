//! Variables declared `positive` that end at 0: a point that comes near to it is always bettered by one that comes nearer.

use super::Subject;
use crate::certificate::{Certificate, Side};
use crate::crosscheck::{Outcome, Status};

/// Variables named one by one.
const NAMED: usize = 5;

/// A minimum that rests on such an end is not attained: says so of the outcome and of every answer.
pub(super) fn judge(subject: &Subject, outcome: &mut Outcome) {
    let positive = &subject.problem().variables.positive;
    if positive.is_empty() {
        return;
    }
    for answer in &mut outcome.answers {
        let (x, certificate) = (&answer.solution.x, &mut answer.certificate);
        let ends = at_end(positive, x, certificate.as_ref());
        refuse(certificate, &ends);
    }
    let ends = at_end(positive, &outcome.x, outcome.certificate.as_ref());
    if ends.is_empty() || !matches!(outcome.status, Status::Certified | Status::Uncertified) {
        return;
    }
    refuse(&mut outcome.certificate, &ends);
    let names: Vec<String> = ends.iter().take(NAMED).map(|&j| subject.problem().variable_name(j)).collect();
    let more = if ends.len() > NAMED { format!(" and {} more", ends.len() - NAMED) } else { String::new() };
    let verb = if ends.len() == 1 { "tends" } else { "tend" };
    outcome.status = Status::NotAttained;
    outcome.message =
        format!("The minimum is not attained: {}{more} {verb} to 0, which `positive` leaves out.", names.join(", "));
    outcome.remedy = Some("give the least size, or let it be 0: lower = 0 in place of positive".into());
    outcome.runaway = ends;
}

/// The positive variables that are 0, or rest there as far as can be told.
fn at_end(positive: &[u32], x: &[f64], certificate: Option<&Certificate>) -> Vec<usize> {
    let rests = |j: usize| certificate.is_some_and(|certificate| certificate.bound_sides.get(j) == Some(&Side::Lower));
    let ends = positive.iter().map(|&j| j as usize).filter(|&j| x.get(j).is_some_and(|x| *x <= 0.0) || rests(j));
    ends.collect()
}

fn refuse(certificate: &mut Option<Certificate>, ends: &[usize]) {
    if let Some(certificate) = certificate.as_mut().filter(|_| !ends.is_empty()) {
        certificate.certified = false;
        certificate.messages.push("a variable declared positive is 0".into());
    }
}
