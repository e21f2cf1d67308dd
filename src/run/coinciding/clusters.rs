//! Which modes come together at limits.

use super::super::Subject;
use crate::linear_algebra::pencil::Spectrum;
use crate::model::{EvaluationError, Lifted, Reduced};
use crate::problem::modes::{Cut, Limited, Pencil, limited};

/// Modes whose eigenvalue is this near their limit, relative, are taken as coinciding with it: further away, rows of single modes tell more.
const NEAR: f64 = 1e-2;

/// Modes further apart than this, relative, are told apart by their own rows.
const APART: f64 = 1e-4;

/// Modes that come together at a limit.
pub(super) struct Cluster {
    pub limit: Limited,
    /// Their numbers.
    modes: std::ops::RangeInclusive<u32>,
    /// K·φ of each.
    basis: Vec<Vec<f64>>,
    /// Whether some are so near one another that single rows say nothing.
    pub is_tight: bool,
}

/// The modes that come together at limits, at a design.
pub(super) fn clusters(subject: &Subject, x: &[f64]) -> Result<Vec<Cluster>, EvaluationError> {
    let Some(model) = subject.analysis() else { return Ok(Vec::new()) };
    let z = model.solved(x)?;
    let mut clusters: Vec<Cluster> = Vec::new();
    let mut limits = limited(subject.problem());
    limits.sort_by_key(|limit| limit.number);
    for limit in limits {
        if clusters.iter().any(|cluster| limit.follows_from(&cluster.limit)) {
            continue;
        }
        let spectrum = up_to_limit(model, &z, &limit)?;
        let shown = |mode: u32| shown(&spectrum, &limit, mode);
        let near = |mode: u32| is_near(shown(mode), &limit);
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

/// Modes up to one that is not near the limit.
fn up_to_limit(model: &Reduced<Lifted>, z: &[f64], limit: &Limited) -> Result<Spectrum, EvaluationError> {
    let mut count = limit.number as usize + 1;
    loop {
        let spectrum = model.lifted().modes()?.spectrum(z, limit.pencil, count)?;
        let found = spectrum.values.len();
        if found < count || !is_near(shown(&spectrum, limit, found as u32), limit) {
            return Ok(spectrum);
        }
        count = 2 * found;
    }
}

fn is_near(shown: f64, limit: &Limited) -> bool {
    (shown / limit.limit - 1.0).abs() <= NEAR
}

/// The eigenvalue of a mode; infinite where there is none.
fn shown(spectrum: &Spectrum, limit: &Limited, mode: u32) -> f64 {
    spectrum.values.get(mode as usize - 1).map_or(f64::INFINITY, |&mu| limit.pencil.shown(mu))
}

/// Rows for the modes of a cluster, and for the sum and difference of every two.
pub(super) fn cuts_of(cluster: &Cluster) -> Vec<(usize, Box<str>, Cut)> {
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
pub(super) fn meets_limits(subject: &Subject, x: &[f64]) -> Result<bool, EvaluationError> {
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

/// What reports say of them.
pub(super) fn words(clusters: &[Cluster]) -> String {
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
