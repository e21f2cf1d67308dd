//! Which modes come together: at limits, or at the least of them that an objective or row looks at.

use super::super::Subject;
use crate::linear_algebra::pencil::Spectrum;
use crate::model::{EvaluationError, Lifted, Reduced};
use crate::problem::modes::{Cut, Eigenvalue, Followed, Least, Level, Pencil, eigenvalues, followed, limited};

/// Modes whose eigenvalue is this near their limit, or the lowest of them, relative, are taken as coinciding with it: further away, rows of single modes tell more.
const NEAR: f64 = 1e-2;

/// Modes further apart than this, relative, are told apart by their own rows.
const APART: f64 = 1e-4;

/// Modes that come together.
pub(super) struct Cluster {
    /// At what.
    pub at: Followed,
    /// Their numbers.
    modes: std::ops::RangeInclusive<u32>,
    /// The lowest of them.
    lowest: f64,
    /// K·φ of each.
    basis: Vec<Vec<f64>>,
    /// Whether some are so near one another that single rows say nothing.
    pub is_tight: bool,
}

/// The modes that come together, at a design.
pub(super) fn clusters(subject: &Subject, x: &[f64]) -> Result<Vec<Cluster>, EvaluationError> {
    let Some(model) = subject.analysis() else { return Ok(Vec::new()) };
    let z = model.solved(x)?;
    let mut clusters: Vec<Cluster> = Vec::new();
    let mut all = followed(subject.problem());
    all.sort_by_key(|one| one.eigenvalue().number);
    for at in all {
        if clusters.iter().any(|cluster| at.follows_from(subject.problem(), &cluster.at)) {
            continue;
        }
        let (spectrum, level) = up_to_level(model, &z, &at)?;
        let Least { pencil, number } = at.eigenvalue();
        let shown = |mode: u32| shown(&spectrum, pencil, mode);
        let near = |mode: u32| is_near(shown(mode), level);
        let last = (number..=spectrum.values.len() as u32).take_while(|&mode| near(mode)).last();
        // Modes below that come up to it, too, make nothing convex.
        let Some(last) = last.filter(|&last| last > number && (number == 1 || !near(number - 1))) else {
            continue;
        };
        let vectors = &spectrum.vectors[number as usize - 1..last as usize];
        let basis = model.lifted().modes()?.stiffness_times(&z, pencil, vectors)?;
        let is_tight = (number..last).any(|mode| is_tight(shown(mode), shown(mode + 1)));
        clusters.push(Cluster { at, modes: number..=last, lowest: shown(number), basis, is_tight });
    }
    Ok(clusters)
}

/// Modes up to one that is not near the limit, or else the lowest looked at; and that level.
fn up_to_level(model: &Reduced<Lifted>, z: &[f64], at: &Followed) -> Result<(Spectrum, f64), EvaluationError> {
    let Least { pencil, number } = at.eigenvalue();
    let mut count = number as usize + 1;
    loop {
        let spectrum = model.lifted().modes()?.spectrum(z, pencil, count)?;
        let level = match at {
            Followed::Limit(limit) => limit.limit,
            Followed::Row(_) | Followed::Least(_) => shown(&spectrum, pencil, number),
        };
        let found = spectrum.values.len();
        if found < count || !is_near(shown(&spectrum, pencil, found as u32), level) {
            return Ok((spectrum, level));
        }
        count = 2 * found;
    }
}

fn is_near(shown: f64, level: f64) -> bool {
    (shown / level - 1.0).abs() <= NEAR
}

/// The eigenvalue of a mode; infinite where there is none.
fn shown(spectrum: &Spectrum, pencil: Pencil, mode: u32) -> f64 {
    spectrum.values.get(mode as usize - 1).map_or(f64::INFINITY, |&mu| pencil.shown(mu))
}

/// Rows for the modes of a cluster, and for the sum and difference of every two.
pub(super) fn cuts_of(cluster: &Cluster) -> Vec<(Followed, Box<str>, Cut)> {
    let count = cluster.basis.len();
    let basis = std::sync::Arc::new(cluster.basis.clone());
    let number = |at: usize| cluster.modes.start() + at as u32;
    let level = match cluster.at {
        Followed::Limit(limit) => Level::Limit(limit.limit),
        Followed::Row(_) | Followed::Least(_) => Level::Itself(cluster.lowest),
    };
    let cut = |detail: String, entries: &[(usize, f64)]| {
        let mut direction = vec![0.0; count];
        entries.iter().for_each(|&(at, value)| direction[at] = value);
        let cut = Cut { pencil: cluster.at.eigenvalue().pencil, level, basis: std::sync::Arc::clone(&basis), direction };
        (cluster.at, detail.into(), cut)
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

/// Whether cuts in the place of eigenvalues without a limit come down to them at a point: `of` says what each cut of the problem is for.
pub(super) fn come_down(cut: &Subject, of: &[Followed], x: &[f64]) -> Result<bool, EvaluationError> {
    let Some(model) = cut.analysis() else { return Ok(true) };
    let (z, tolerance) = (model.solved(x)?, cut.settings.constraint_tolerance);
    let (modes, wanted) = (model.lifted().modes()?, eigenvalues(cut.problem()));
    let values = modes.values(&z)?;
    let is_first = |(at, one): &(usize, &Followed)| !of[..*at].contains(one);
    let without_limit = of.iter().enumerate().filter(is_first).filter(|(_, one)| !matches!(one, Followed::Limit(_)));
    for (_, followed) in without_limit {
        let own = |one: &Eigenvalue| matches!(*one, Eigenvalue::Cut(cut) if of[cut as usize] == *followed);
        let seen = wanted.iter().zip(&values).filter(|(one, _)| own(one)).map(|(_, value)| *value).fold(f64::INFINITY, f64::min);
        let Least { pencil, number } = followed.eigenvalue();
        if modes.below(&z, pencil, seen * (1.0 - tolerance))? >= number as usize {
            return Ok(false);
        }
    }
    Ok(true)
}

/// The first of two modes that cannot be told apart, one of which is this: with the one below it, or with the one above.
pub(super) fn tight_pair(model: &Reduced<Lifted>, z: &[f64], pencil: Pencil, mode: u32) -> Result<Option<u32>, EvaluationError> {
    let spectrum = model.lifted().modes()?.spectrum(z, pencil, mode as usize + 1)?;
    let shown = |mode: u32| shown(&spectrum, pencil, mode);
    Ok((mode.saturating_sub(1).max(1)..=mode).find(|&first| shown(first).is_finite() && is_tight(shown(first), shown(first + 1))))
}

fn is_tight(own: f64, next: f64) -> bool {
    (next / own - 1.0).abs() <= APART
}

/// What reports say of them.
pub(super) fn words(clusters: &[Cluster]) -> String {
    let of = |cluster: &Cluster| {
        let numbers: Vec<String> = cluster.modes.clone().map(|mode| mode.to_string()).collect();
        let what = cluster.at.eigenvalue().pencil.name();
        let place = if matches!(cluster.at, Followed::Limit(_)) { " at their limit" } else { "" };
        format!("Modes {} of {what} coincide{place}: the point is judged by all their combinations.", numbers.join(" and "))
    };
    clusters.iter().map(of).collect::<Vec<_>>().join(" ")
}
