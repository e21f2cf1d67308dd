//! Eigenvalues that coincide at their limit: as a rule they do at an optimum. A single one of them has no derivative there.
//!
//! The limit on coinciding modes says that a small matrix T over them is positive semidefinite ([`Cut`]). Every direction v among them
//! gives the smooth row vᵀ·T·v ≥ 0. Designs that meet the limit meet all of these rows; so a minimum of the problem with some of them that meets
//! the limit is one of the problem itself, and the rows' multipliers y_i make the positive semidefinite multiplier Σ y_i·v_i·v_iᵀ.
//! Directions are added where T is found to be negative, as semi-infinite programs are solved by exchange (Hettich and Kortanek, *SIAM Review*
//! 35, 1993); whether the limit is met is counted by the inertia of one factorisation.

use super::Subject;
use super::settled::Settled;
use crate::certificate::Extent;
use crate::crosscheck::{Outcome, Status};
use crate::model::EvaluationError;
use crate::problem::modes::{Cut, Limited, Pencil, limited, with_cuts};

/// Modes whose eigenvalue is this near their limit, relative, are taken as coinciding with it: further away, rows of single modes tell more.
const NEAR: f64 = 1e-2;

/// Modes further apart than this, relative, are told apart by their own rows.
const APART: f64 = 1e-4;

/// Rounds of exchange: each adds the directions in which T is negative at the last point.
const ROUNDS: usize = 8;

/// Modes that come together at a limit.
struct Cluster {
    limit: Limited,
    /// Their numbers.
    modes: std::ops::RangeInclusive<u32>,
    /// K·φ of each.
    basis: Vec<Vec<f64>>,
    /// Whether some are so near one another that single rows say nothing.
    is_tight: bool,
}

/// Judges coinciding eigenvalues by all their combinations: solves again, by `again`, from the point of an outcome; `None` where none
/// coincide there.
pub(super) fn settle(
    subject: &Subject,
    outcome: &Outcome,
    again: impl Fn(&Subject, &[f64]) -> Option<Outcome>,
) -> Option<Settled> {
    if !matches!(outcome.status, Status::Certified | Status::Uncertified | Status::LimitReached) || outcome.objective.is_none() {
        return None;
    }
    let mut clusters = clusters(subject, &outcome.x).ok()?;
    let told_apart = outcome.status == Status::Certified && clusters.iter().all(|cluster| !cluster.is_tight);
    if clusters.is_empty() || told_apart {
        return None;
    }
    let (mut cuts, mut replaced) = (Vec::new(), Vec::new());
    let mut last = None;
    for _ in 0..ROUNDS {
        for cluster in &clusters {
            if !replaced.contains(&cluster.limit) {
                replaced.push(cluster.limit);
            }
            cuts.extend(cuts_of(cluster));
        }
        let refined = subject.with_problem(with_cuts(subject.problem(), &replaced, cuts.clone())).ok()?;
        let x = last.as_ref().map_or(&outcome.x, |settled: &Settled| &settled.outcome.x);
        let Some(found) = again(&refined, x) else { break };
        if found.objective.is_none() {
            break;
        }
        let met = meets_limits(subject, &found.x).unwrap_or(false);
        let next = self::clusters(subject, &found.x).unwrap_or_default();
        let ended = met && found.status == Status::Certified;
        let words = words(&clusters);
        last = Some(Settled { subject: refined, outcome: found });
        if ended {
            let mut settled = last?;
            settled.outcome.scope = Extent::Local;
            settled.outcome.message = format!("{words} {}", settled.outcome.message);
            return Some(settled);
        }
        if next.is_empty() {
            break;
        }
        clusters = next;
    }
    // Nothing is proved where single rows have no derivative.
    let mut settled = last.filter(|settled| meets_limits(subject, &settled.outcome.x).unwrap_or(false))?;
    settled.outcome.status = Status::Uncertified;
    Some(settled)
}

/// What `verify` judges a point by where eigenvalues coincide there; `None` where none do.
pub(super) fn refined(subject: &Subject, x: &[f64]) -> Option<(Subject, String)> {
    let clusters = clusters(subject, x).ok()?;
    if clusters.iter().all(|cluster| !cluster.is_tight) || !meets_limits(subject, x).unwrap_or(false) {
        return None;
    }
    let replaced: Vec<Limited> = clusters.iter().map(|cluster| cluster.limit).collect();
    let cuts = clusters.iter().flat_map(cuts_of).collect();
    let refined = subject.with_problem(with_cuts(subject.problem(), &replaced, cuts)).ok()?;
    Some((refined, words(&clusters)))
}

/// The modes that come together at limits, at a design.
fn clusters(subject: &Subject, x: &[f64]) -> Result<Vec<Cluster>, EvaluationError> {
    let Some(model) = subject.analysis() else { return Ok(Vec::new()) };
    let z = model.solved(x)?;
    let mut clusters: Vec<Cluster> = Vec::new();
    let mut limits = limited(subject.problem());
    limits.sort_by_key(|limit| limit.number);
    for limit in limits {
        if clusters.iter().any(|cluster| limit.follows_from(&cluster.limit)) {
            continue;
        }
        let spectrum = model.lifted().modes()?.spectrum(&z, limit.pencil)?;
        let shown = |mode: u32| {
            let mu = spectrum.values.get(mode as usize - 1).copied().filter(|mu| *mu > 0.0);
            mu.map_or(f64::INFINITY, |mu| limit.pencil.shown(mu))
        };
        let near = |mode: u32| (shown(mode) / limit.limit - 1.0).abs() <= NEAR;
        let last = (limit.number..=spectrum.values.len() as u32).take_while(|&mode| near(mode)).last();
        // Modes below a limited one that come up to it, too, make no convex limit.
        let Some(last) = last.filter(|&last| last > limit.number && (limit.number == 1 || !near(limit.number - 1))) else {
            continue;
        };
        let vectors = &spectrum.vectors[limit.number as usize - 1..last as usize];
        let basis = model.lifted().modes()?.stiffness_times(&z, limit.pencil, vectors)?;
        let is_tight = (limit.number..last).any(|mode| (shown(mode + 1) / shown(mode) - 1.0).abs() <= APART);
        clusters.push(Cluster { limit, modes: limit.number..=last, basis, is_tight });
    }
    Ok(clusters)
}

/// Rows for the modes of a cluster, and for the sum and difference of every two.
fn cuts_of(cluster: &Cluster) -> Vec<(usize, Box<str>, Cut)> {
    let count = cluster.basis.len();
    let basis = std::sync::Arc::new(cluster.basis.clone());
    let number = |at: usize| cluster.modes.start() + at as u32;
    let cut = |detail: String, entries: &[(usize, f64)]| {
        let mut direction = vec![0.0; count];
        entries.iter().for_each(|&(at, value)| direction[at] = value);
        let Limited { pencil, limit, constraint, .. } = cluster.limit;
        (constraint, detail.into(), Cut { pencil, limit, basis: std::sync::Arc::clone(&basis), direction })
    };
    let mut cuts: Vec<_> = (0..count).map(|at| cut(format!("mode {}", number(at)), &[(at, 1.0)])).collect();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    for i in 0..count {
        for j in 0..i {
            for (sign, word) in [(half, '+'), (-half, '−')] {
                cuts.push(cut(format!("modes {} {word} {}", number(j), number(i)), &[(j, half), (i, sign)]));
            }
        }
    }
    cuts
}

/// Whether every limit on an eigenvalue is met, by the number of negative eigenvalues of K − B/μ at the limit.
fn meets_limits(subject: &Subject, x: &[f64]) -> Result<bool, EvaluationError> {
    let Some(model) = subject.analysis() else { return Ok(true) };
    let (z, tolerance) = (model.solved(x)?, subject.settings.constraint_tolerance);
    for limit in limited(subject.problem()) {
        let below = model.lifted().modes()?.below(&z, limit.pencil, limit.limit * (1.0 - tolerance))?;
        if below >= limit.number as usize {
            return Ok(false);
        }
    }
    Ok(true)
}

fn words(clusters: &[Cluster]) -> String {
    let of = |cluster: &Cluster| {
        let numbers: Vec<String> = cluster.modes.clone().map(|mode| mode.to_string()).collect();
        let what = if cluster.limit.pencil == Pencil::Vibration { "vibration" } else { "buckling" };
        format!(
            "Modes {} of {what} coincide at their limit: the point is judged by all their combinations.",
            numbers.join(" and ")
        )
    };
    clusters.iter().map(of).collect::<Vec<_>>().join(" ")
}
