//! Seeded multi-start on all cores: distinct minima with values and counts.

use rayon::prelude::*;

use super::diverging;
use super::ledger::Ledger;
use super::seeds::{self, Seeds};
use super::session::{Session, Solver};
use super::{Answer, Minimum, merit, work};
use crate::certificate::Certificate;

/// Relative distance within which two minima of equal value are one.
const SAME: f64 = 1e-4;
/// Starts tried before a minimum is said not to be attained.
const FEW: u64 = 4;

/// A winning start: the backend's place, where it began, what came of it.
pub(super) struct Found {
    pub(super) solver: usize,
    pub(super) start: Vec<f64>,
    pub(super) answer: Answer,
}

/// Runs `count` seeded starts. The order of the results is the order of the seeds, whatever thread finished first.
pub(super) fn run(session: &Session<'_>, solvers: &[Solver<'_>], order: &[usize], count: usize) -> Vec<Found> {
    let start = |index: usize| Seeds::new(index as u64 + 3).point(session.task.model.meta());
    let one = |index: usize| from_start(session, solvers, order, start(index), f64::INFINITY);
    (0..count).into_par_iter().map(one).collect::<Vec<_>>().into_iter().flatten().collect()
}

/// A certified answer not above `value` from the origin, from dips beside the start that leads to `far`, or
/// from one of a few seeded starts, where one is found soon: what runs off from one start may be attained from another. Not in the
/// same tail.
pub(super) fn attained(ledger: &Ledger<'_, '_>, (value, far): (f64, &[f64])) -> Option<Found> {
    let session = ledger.session;
    let is_attained = |answer: &Answer| {
        let reaches = |own: &Certificate| own.objective <= value + merit::reached(session, &answer.solution.x, own);
        // What is flat at the same value is as likely another place in the tail.
        let is_elsewhere = |own: &Certificate| {
            !own.minimiser_may_not_be_unique && !diverging::is_in_tail(session, &answer.solution.x, (own, far))
        };
        answer.certificate.as_ref().is_some_and(|own| own.certified && reaches(own) && is_elsewhere(own))
    };
    let allowed = work::further_run(0.0) / FEW as f64;
    let meta = session.task.model.meta();
    let dips = seeds::dips(session.task.model, session.task.start, far);
    let starts = std::iter::once(seeds::origin(meta)).chain(dips).chain((0..FEW).map(|index| Seeds::new(index + 3).point(meta)));
    let from = |start| from_start(session, ledger.solvers, &ledger.order(), start, allowed);
    starts.into_iter().find_map(|start| from(start).filter(|found| is_attained(&found.answer)))
}

/// The backends in turn from one start, until an answer is certified; the best of them.
fn from_start(session: &Session<'_>, solvers: &[Solver<'_>], order: &[usize], start: Vec<f64>, allowed: f64) -> Option<Found> {
    let mut best: Option<Found> = None;
    for &k in order {
        if session.clock.is_over() {
            break;
        }
        let budget = session.budget(solvers[k], session.task.model_for(solvers[k].backend), allowed);
        let answer = session.attempt(solvers[k], &start, None, budget, &mut |_| {});
        let certified = answer.is_certified();
        if best.as_ref().is_none_or(|best| session.is_better(&answer, &best.answer)) {
            best = Some(Found { solver: k, start: start.clone(), answer });
        }
        if certified {
            break;
        }
    }
    best
}

/// The distinct certified minima, best first.
pub(super) fn minima<'a>(answers: impl Iterator<Item = &'a Answer>) -> Vec<Minimum> {
    let mut minima: Vec<Minimum> = Vec::new();
    for answer in answers {
        let Some(certificate) = answer.certificate.as_ref().filter(|certificate| certificate.certified) else { continue };
        let x = &answer.solution.x;
        let same = |minimum: &&mut Minimum| {
            let close =
                (minimum.objective - certificate.objective).abs() <= 1e-6 * certificate.sigma.max(certificate.objective.abs());
            let place = x.iter().zip(&minimum.x).zip(&certificate.variable_scales).all(|((a, b), d)| (a - b).abs() <= SAME * d);
            close && (place || certificate.minimiser_may_not_be_unique)
        };
        match minima.iter_mut().find(same) {
            Some(minimum) => minimum.count += 1,
            None => minima.push(Minimum { x: x.clone(), objective: certificate.objective, count: 1 }),
        }
    }
    minima.sort_by(|a, b| a.objective.total_cmp(&b.objective));
    minima
}
