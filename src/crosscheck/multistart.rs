//! Seeded multi-start on all cores: distinct minima with values and counts.

use rayon::prelude::*;

use super::attempt::{Contestant, Referee};
use super::seeds::Seeds;
use super::{Answer, Minimum};

/// Relative distance within which two minima of equal value are one.
const SAME: f64 = 1e-4;

/// Runs `count` seeded starts. Each is solved by the backends in turn until one answer is certified. The order of the results is
/// the order of the seeds, whatever thread finished first.
pub(super) fn run(referee: &Referee<'_>, contestants: &[Contestant<'_>], count: usize) -> Vec<(usize, Answer)> {
    let one = |index: usize| {
        let start = Seeds::new(index as u64 + 3).point(referee.task.model.meta());
        let mut best: Option<(usize, Answer)> = None;
        for (k, &contestant) in contestants.iter().enumerate() {
            if referee.clock.is_over() {
                break;
            }
            let answer = referee.attempt(contestant, &start, None, referee.clock.share(0.5, f64::INFINITY), &mut |_| {});
            let certified = answer.certificate.as_ref().is_some_and(|certificate| certificate.certified);
            if best.as_ref().is_none_or(|(_, best)| referee.is_better(&answer, best)) {
                best = Some((k, answer));
            }
            if certified {
                break;
            }
        }
        best
    };
    (0..count).into_par_iter().map(one).collect::<Vec<_>>().into_iter().flatten().collect()
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
