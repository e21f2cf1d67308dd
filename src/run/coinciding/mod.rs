//! Eigenvalues that coincide at their limit, or where the lowest is to rise: as a rule they do at an optimum. A single one of them has no
//! derivative there.
//!
//! The limit on coinciding modes says that a small matrix T over them is positive semidefinite ([`Cut`]). Every direction v among them
//! gives the smooth row vᵀ·T·v ≥ 0. Designs that meet the limit meet all of these rows; so a minimum of the problem with some of them that meets
//! the limit is one of the problem itself, and the rows' multipliers y_i make the positive semidefinite multiplier Σ y_i·v_i·v_iᵀ.
//! Directions are added where T is found to be negative, as semi-infinite programs are solved by exchange (Hettich and Kortanek, *SIAM Review*
//! 35, 1993); whether the limit is met is counted by the inertia of one factorisation. Where there is no limit, but an objective or a row looks
//! at the lowest of the modes, that is the least of smooth functions by direction in the same way.

mod clusters;
#[cfg(test)]
mod tests;
mod undecided;

use super::Subject;
use super::settled::Settled;
use crate::certificate::Extent;
use crate::crosscheck::{Outcome, Status};
use crate::problem::Settings;
use crate::problem::modes::{Cut, Followed, followed, with_cuts};
use clusters::{Cluster, clusters, come_down, cuts_of, meets_limits, words};
use undecided::refuse;
pub(super) use undecided::unless_undecided;

/// Rounds of exchange: each adds the directions in which T is negative at the last point.
const ROUNDS: usize = 8;

/// Iterations after which the interior point is at a minimum that has derivatives (it takes tens of them on every problem file), and near one
/// that has none: at a kink of single modes it would go on without end.
const ITERATIONS: u64 = 100;

/// The same for backends that count no iterations, with as many evaluations to one as line searches take at the most.
const EVALUATIONS: u64 = 10 * ITERATIONS;

/// A problem with rows for modes that come together, and what it came to.
pub(super) struct Coinciding {
    /// The problem.
    pub subject: Subject,
    /// Its last outcome.
    pub outcome: Outcome,
    /// What each cut of the problem is for.
    cuts: Vec<Followed>,
    words: String,
}

/// Cuts, what for, and what rows of them are called.
type Cuts = Vec<(Followed, Box<str>, Cut)>;

/// A run from a point; `None` where no time is left for it.
type Again<'a> = &'a dyn Fn(&Subject, &Settings, &[f64]) -> Option<Outcome>;

/// Comes to the optimum before anything is logged, where eigenvalues are limited and come together there: near the best one by `from_all`, all
/// backends from all starting points, and on by `again`. `None` where nothing is certified so.
pub(super) fn foresee(
    subject: &Subject,
    settings: &Settings,
    x: &[f64],
    from_all: Again<'_>,
    again: Again<'_>,
) -> Option<Coinciding> {
    if followed(subject.problem()).is_empty() {
        return None;
    }
    let few = Settings {
        max_iterations: settings.max_iterations.min(ITERATIONS),
        max_evaluations: settings.max_evaluations.min(EVALUATIONS),
        ..settings.clone()
    };
    let near = from_all(subject, &few, x)?;
    exchange(subject, settings, &near, again).filter(|found| found.is_certified(subject))
}

/// Solves again from the point of an outcome with rows for all combinations of modes that coincide there; `None` where none do.
pub(super) fn exchange(subject: &Subject, settings: &Settings, outcome: &Outcome, again: Again<'_>) -> Option<Coinciding> {
    if !matches!(outcome.status, Status::Certified | Status::Uncertified | Status::LimitReached) || outcome.objective.is_none() {
        return None;
    }
    let mut clusters = clusters(subject, &outcome.x).ok()?;
    let told_apart = outcome.status == Status::Certified && clusters.iter().all(|cluster| !cluster.is_tight);
    if clusters.is_empty() || told_apart {
        return None;
    }
    let mut cuts = Cuts::new();
    let mut last: Option<Coinciding> = None;
    for _ in 0..ROUNDS {
        let refined = refined_by(subject, &clusters, &mut cuts)?;
        let x = last.as_ref().map_or(&outcome.x, |found| &found.outcome.x);
        let Some(found) = again(&refined, settings, x).filter(|found| found.objective.is_some()) else { break };
        let next = self::clusters(subject, &found.x).unwrap_or_default();
        let of = cuts.iter().map(|(of, ..)| *of).collect();
        let coinciding = last.insert(Coinciding { subject: refined, outcome: found, cuts: of, words: words(&clusters) });
        if next.is_empty() || coinciding.is_certified(subject) {
            break;
        }
        clusters = next;
    }
    last
}

impl Coinciding {
    /// Whether its point is a certified one of the subject's.
    fn is_certified(&self, subject: &Subject) -> bool {
        self.certifies(subject, &self.outcome)
    }

    /// Whether an outcome of the problem with cuts is a certified one of the subject's.
    fn certifies(&self, subject: &Subject, outcome: &Outcome) -> bool {
        let comes_down = || come_down(&self.subject, &self.cuts, &outcome.x).unwrap_or(false);
        outcome.status == Status::Certified && meets_limits(subject, &outcome.x).unwrap_or(false) && comes_down()
    }

    /// With the outcome of all backends from its point, where that is no worse; `None` where nothing is known of the point.
    pub fn compared(self, subject: &Subject, all: Option<Outcome>) -> Option<Settled> {
        let chosen = all.filter(|all| self.certifies(subject, all));
        let mut outcome = chosen.unwrap_or_else(|| self.outcome.clone());
        if self.certifies(subject, &outcome) {
            outcome.scope = Extent::Local;
            outcome.message = format!("{} {}", self.words, outcome.message);
        } else if meets_limits(subject, &outcome.x).unwrap_or(false) {
            refuse(&mut outcome, "modes coincide, and not all of their combinations are met as they should be");
        } else {
            return None;
        }
        Some(Settled { subject: self.subject, outcome })
    }
}

/// The problem with rows for these clusters beside those there are.
fn refined_by(subject: &Subject, clusters: &[Cluster], cuts: &mut Cuts) -> Option<Subject> {
    clusters.iter().for_each(|cluster| cuts.extend(cuts_of(cluster)));
    subject.with_problem(with_cuts(subject.problem(), cuts.clone())).ok()
}

/// What `verify` judges a point by where eigenvalues coincide there; `None` where none do.
pub(super) fn refined(subject: &Subject, x: &[f64]) -> Option<(Subject, String)> {
    let clusters = clusters(subject, x).ok()?;
    if clusters.iter().all(|cluster| !cluster.is_tight) || !meets_limits(subject, x).unwrap_or(false) {
        return None;
    }
    let refined = refined_by(subject, &clusters, &mut Cuts::new())?;
    Some((refined, words(&clusters)))
}
