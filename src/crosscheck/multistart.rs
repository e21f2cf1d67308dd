//! Seeded multi-start on all cores: distinct minima with values and counts.

use std::time::Instant;

use rayon::prelude::*;

use super::attempt::{Contestant, Referee};
use super::seeds::Seeds;
use super::{Answer, Minimum};
use crate::model::Budget;

/// Relative distance within which two minima of equal value are one.
const SAME: f64 = 1e-4;
/// Starts tried, and seconds in all, before a minimum is said not to be attained.
const FEW: u64 = 4;
const SOON: f64 = 2.0;

/// Runs `count` seeded starts. The order of the results is the order of the seeds, whatever thread finished first.
pub(super) fn run(referee: &Referee<'_>, contestants: &[Contestant<'_>], count: usize) -> Vec<(usize, Answer)> {
    let one = |index: usize| from_seed(referee, contestants, index as u64 + 3, &|| referee.clock.share(0.5, f64::INFINITY));
    (0..count).into_par_iter().map(one).collect::<Vec<_>>().into_iter().flatten().collect()
}

/// A certified answer not above `value` from one of a few seeded starts, where one is found soon: what runs off from one start may
/// be attained from another.
pub(super) fn attained(referee: &Referee<'_>, contestants: &[Contestant<'_>], value: f64) -> Option<(usize, Answer)> {
    let whole = referee.clock.share(0.1, SOON);
    let left = |deadline: Instant| deadline.saturating_duration_since(Instant::now()).as_secs_f64();
    let budget = || referee.clock.share(1.0, whole.deadline.map_or(SOON, left));
    let is_attained = |answer: &Answer| {
        answer.certificate.as_ref().is_some_and(|certificate| certificate.certified && certificate.objective <= value)
    };
    (0..FEW).find_map(|index| from_seed(referee, contestants, index + 3, &budget).filter(|(_, answer)| is_attained(answer)))
}

/// The backends in turn from one seeded start, until an answer is certified; the best with its backend's place.
fn from_seed<'b>(
    referee: &Referee<'_>,
    contestants: &[Contestant<'_>],
    seed: u64,
    budget: &dyn Fn() -> Budget<'b>,
) -> Option<(usize, Answer)> {
    let start = Seeds::new(seed).point(referee.task.model.meta());
    let mut best: Option<(usize, Answer)> = None;
    for (k, &contestant) in contestants.iter().enumerate() {
        if referee.clock.is_over() {
            break;
        }
        let answer = referee.attempt(contestant, &start, None, budget(), &mut |_| {});
        let certified = answer.is_certified();
        if best.as_ref().is_none_or(|(_, best)| referee.is_better(&answer, best)) {
            best = Some((k, answer));
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
