//! From judged answers to the outcome.

use super::diverging;
use super::merit;
use super::messages;
use super::session::Session;
use super::{Agreement, Answer, Conflict, Outcome, Status};
use crate::backends::Termination;
use crate::certificate::{Certifier, Extent, lower_bound};
use crate::recession::{Fall, Ray};

/// Certified points of equal value this far apart, relative, are two minimisers.
const APART: f64 = 1e-3;

/// The best answer's place: of certified ones that agree the most exact, not the one that used up what its rows tolerate.
pub(super) fn best(session: &Session<'_>, answers: &[Answer]) -> Option<usize> {
    let best = (0..answers.len()).reduce(|best, k| if session.is_better(&answers[k], &answers[best]) { k } else { best })?;
    let certified: Vec<usize> = (0..answers.len()).filter(|&k| answers[k].is_certified()).collect();
    let Some(lowest) = answers[best].certificate.as_ref().filter(|_| certified.len() > 1) else { return Some(best) };
    let highest = lowest.objective + merit::level(session, &answers[best].solution.x, lowest);
    let agree = certified.into_iter().filter(|&k| answers[k].objective <= Some(highest));
    agree.min_by(|&a, &b| merit::inexactness(session, &answers[a]).total_cmp(&merit::inexactness(session, &answers[b])))
}

/// An answer that is feasible and better than the best by more than what counts as agreement; none where a rigorous bound says
/// that there is no such point.
pub(super) fn better_elsewhere(session: &Session<'_>, answers: &[Answer], best: &Answer) -> Option<usize> {
    let lowest = |a: usize, b: usize| if answers[b].objective < answers[a].objective { b } else { a };
    let found = (0..answers.len()).filter(|&k| merit::is_lower(session, &answers[k], best)).reduce(lowest)?;
    let certificate = best.certificate.as_ref()?;
    let level = certificate.objective - merit::level(session, &best.solution.x, certificate);
    let is_proved = session.task.class.is_global() && bound_at(session, &best.solution.x).is_some_and(|bound| bound >= level);
    (!is_proved).then_some(found)
}

/// At least one answer is certified.
pub(super) fn certified(session: &Session<'_>, mut answers: Vec<Answer>) -> Outcome {
    if session.task.class.is_global() {
        withdraw(session, &mut answers);
    }
    let mut outcome = standing(session, answers, Status::Certified);
    outcome.scope = Extent::of(session.task.class);
    outcome.agreement = agreement(session, &outcome);
    outcome.minimiser_is_not_unique = outcome.agreement.is_some_and(|found| found.agree && found.variable_difference > APART);
    if let Some(best) = outcome.best {
        outcome.better_point_elsewhere = better_elsewhere(session, &outcome.answers, &outcome.answers[best]).is_some();
    }
    if outcome.scope == Extent::Global {
        outcome.lower_bound = bound(session, &outcome);
    }
    messages::certified(&mut outcome);
    outcome
}

/// Global minima of one problem have one value: where the best answer is lower than another beyond agreement, what was accepted of the
/// other's slope was too much, and it is certified no more.
fn withdraw(session: &Session<'_>, answers: &mut [Answer]) {
    let Some(best) = best(session, answers).map(|best| answers[best].clone()) else { return };
    for answer in answers.iter_mut().filter(|answer| answer.is_certified() && merit::is_lower(session, &best, answer)) {
        take_away(answer, format!("{} holds a lower point, and a convex problem has one minimum", best.backend));
    }
}

/// Of a problem whose minima are global, points far out lose their certificate to feasible ones that are lower and nearer.
pub(super) fn withdraw_far(session: &Session<'_>, answers: &mut [Answer]) {
    let is_beaten = |answer: &Answer| {
        let own = answer.certificate.as_ref().filter(|own| own.certified);
        own.is_some_and(|own| answers.iter().any(|rival| diverging::is_lower_nearer(session, rival, (own, &answer.solution.x))))
    };
    let beaten: Vec<bool> = answers.iter().map(|answer| session.task.class.is_global() && is_beaten(answer)).collect();
    for (answer, _) in answers.iter_mut().zip(beaten).filter(|(_, is_beaten)| *is_beaten) {
        take_away(
            answer,
            "nearer to where the variables come from there is a lower point, by more than half of the objective".to_owned(),
        );
    }
}

fn take_away(answer: &mut Answer, why: String) {
    if let Some(certificate) = &mut answer.certificate {
        (certificate.certified, certificate.scope) = (false, Extent::Local);
        certificate.messages.push(why);
    }
}

/// A ray shows that the objective has no minimum.
pub(super) fn diverging(session: &Session<'_>, answers: Vec<Answer>, ray: Ray) -> Outcome {
    let status = if ray.fall == Fall::Endless { Status::Unbounded } else { Status::NotAttained };
    let mut outcome = standing(session, answers, status);
    if !outcome.best.is_some_and(|best| outcome.answers[best].feasible) {
        outcome.objective = session.task.model.objective(&ray.from).ok();
        outcome.certificate = session.judge.certify(&ray.from, None).ok();
        outcome.x = ray.from;
    }
    outcome.runaway = (0..ray.direction.len()).filter(|&j| ray.direction[j] != 0.0).collect();
    outcome.direction = Some(ray.direction);
    messages::diverging(session, &mut outcome);
    outcome
}

/// The elastic phase showed that no nearby point is feasible or, proved, that none is.
pub(super) fn infeasible(
    session: &Session<'_>,
    answers: Vec<Answer>,
    x: Vec<f64>,
    (mut conflict, proved): (Conflict, bool),
) -> Outcome {
    conflict.keep_own(session.task.model.own());
    let mut outcome = at(session, answers, x, Status::Infeasible);
    outcome.scope = if proved { Extent::Global } else { Extent::Local };
    messages::infeasible(session, &mut outcome, &conflict);
    outcome.conflict = Some(conflict);
    outcome
}

/// No feasible point was found, and nothing is proved.
pub(super) fn no_feasible_point(session: &Session<'_>, answers: Vec<Answer>, x: Vec<f64>) -> Outcome {
    let mut outcome = at(session, answers, x, Status::Uncertified);
    messages::no_feasible_point(&mut outcome);
    outcome
}

/// Nothing passed, and no reason was found in the problem: why the backends stopped is what can be said.
pub(super) fn undecided(session: &Session<'_>, answers: Vec<Answer>) -> Outcome {
    // An answer that gave way met no limit the user knows.
    let ended = |termination| answers.iter().any(|answer| answer.solution.termination == termination && !answer.gave_way);
    let runs_away = |answer: &Answer| answer.certificate.as_ref().is_some_and(|certificate| !certificate.runaway.is_empty());
    let status = if session.clock.is_interrupted() || ended(Termination::Interrupted) {
        Status::Interrupted
    } else if answers.iter().any(runs_away) {
        Status::NotAttained
    } else if session.clock.is_over() || (ended(Termination::LimitReached) && !ended(Termination::Converged)) {
        Status::LimitReached
    } else if answers.iter().all(|answer| answer.objective.is_none() || answer.solution.invalid.is_some()) && !answers.is_empty()
    {
        Status::InvalidValue
    } else {
        Status::Uncertified
    };
    let mut outcome = standing(session, answers, status);
    outcome.runaway = outcome.certificate.as_ref().map(|certificate| certificate.runaway.clone()).unwrap_or_default();
    messages::undecided(session, &mut outcome);
    outcome
}

/// An outcome that shows the best answer.
fn standing(session: &Session<'_>, answers: Vec<Answer>, status: Status) -> Outcome {
    let best = best(session, &answers);
    let shown = best.map(|best| &answers[best]).filter(|answer| answer.objective.is_some());
    Outcome {
        status,
        x: shown.map_or_else(|| session.task.start.to_vec(), |answer| answer.solution.x.clone()),
        objective: shown.and_then(|answer| answer.objective),
        certificate: shown.and_then(|answer| answer.certificate.clone()),
        best,
        answers,
        ..Outcome::default()
    }
}

/// An outcome that shows a point of its own.
fn at(session: &Session<'_>, answers: Vec<Answer>, mut x: Vec<f64>, status: Status) -> Outcome {
    session.task.model.complete(&mut x);
    let certificate = session.judge.certify(&x, None).ok();
    let objective = certificate.as_ref().map(|certificate| certificate.objective);
    Outcome { status, x, objective, certificate, answers, ..Outcome::default() }
}

fn agreement(session: &Session<'_>, outcome: &Outcome) -> Option<Agreement> {
    let best = &outcome.answers[outcome.best?];
    let reference = best.certificate.as_ref()?;
    let ran: Vec<_> = outcome.answers.iter().filter(|answer| answer.solution.termination != Termination::Refused).collect();
    if ran.len() < 2 {
        return None;
    }
    let (mut objective_difference, mut variable_difference, mut certified) = (0f64, 0f64, true);
    for answer in ran {
        certified &= answer.is_certified();
        let Some(objective) = answer.objective else { continue };
        objective_difference = objective_difference.max((objective - reference.objective).abs());
        let pairs = answer.solution.x.iter().zip(&best.solution.x).zip(&reference.variable_scales);
        variable_difference = pairs.fold(variable_difference, |most, ((a, b), d)| most.max((a - b).abs() / d));
    }
    let agree = certified && objective_difference <= merit::level(session, &best.solution.x, reference);
    Some(Agreement { agree, objective_difference, variable_difference })
}

/// The best rigorous bound any certified answer's multipliers give.
fn bound(session: &Session<'_>, outcome: &Outcome) -> Option<f64> {
    let certified = |answer: &&Answer| answer.is_certified();
    let bounds = outcome.answers.iter().filter(certified).flat_map(|answer| {
        let judged = answer.certificate.as_ref().filter(|_| session.task.substitution.is_none());
        let own = judged.and_then(|judged| lower_bound(session.task.model, &answer.solution.x, &judged.row_multipliers).ok()?);
        [own, bound_at(session, &answer.solution.x)]
    });
    bounds.flatten().reduce(f64::max)
}

/// The rigorous bound of a convex class, in the variables in which it is convex, rounded outwards.
fn bound_at(session: &Session<'_>, x: &[f64]) -> Option<f64> {
    let task = session.task;
    let Some(other) = task.substitution else {
        return lower_bound(task.model, x, &session.judge.row_multipliers(x).ok()?).ok()?;
    };
    let z = other.inward(x);
    let judge = Certifier::new(other.model(), task.class, session.tolerances);
    let bound = lower_bound(other.model(), &z, &judge.row_multipliers(&z).ok()?).ok()??;
    let outward = other.outward_objective(bound);
    // The way back is a library function: a few last digits are given away.
    Some(if outward == bound { bound } else { outward - 8.0 * f64::EPSILON * outward.abs() })
}
