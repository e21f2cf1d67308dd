//! A bound below every design of bars that frequencies limit.
//!
//! Where K and M are affine in the design, K − ω²M ⪰ 0 (no mode below ω) is a convex constraint, and for any vector w the row
//! wᵀ(K − ω²M)w ≥ 0 holds wherever it does. A problem with such affine rows in the place of the limits is linear or convex, and its minimum lies below
//! every design. With the modes at the optimum for w it comes up to it: their multipliers make the positive semidefinite one that duality asks for. Where it does
//! not yet, the lowest modes at its own minimum are further w (Kelley's cutting planes, 1960).

use std::sync::atomic::AtomicBool;

use super::Subject;
use super::remaining::Remaining;
use super::unobserved::{by_interior_point, unobserved};
use crate::crosscheck::{Outcome, Task};
use crate::expression::operators::{Binary, Fold};
use crate::model::EvaluationError;
use crate::problem::modes::{Limited, Pencil, eigenvalues_in, limited, without};
use crate::problem::{Constraint, Dimension, Formula, Limit, Problem};

/// Rounds of cutting planes; each brings the bound up.
const ROUNDS: usize = 12;

/// Modes by which a limit is cut at a point: more of them may come together at an optimum, but rarely do.
const MODES: usize = 4;

/// The best relaxation found from the point of an outcome, solved; `None` where the limits are not of this kind. It stops where it comes up to
/// `objective` within `agreement`, relative.
pub(super) fn relaxed(
    subject: &Subject,
    (x, objective): (&[f64], f64),
    agreement: f64,
    remaining: &Remaining,
    interrupt: Option<&AtomicBool>,
) -> Option<Outcome> {
    let problem = subject.problem();
    let limits = limited(problem);
    let by_frequencies = limits.iter().all(|limit| limit.pencil == Pencil::Vibration);
    if limits.is_empty() || !by_frequencies || !is_affine(problem) {
        return None;
    }
    // Without what else is asked of eigenvalues, the bound lies below as well.
    let asks = |row: &Constraint| !eigenvalues_in(problem, row.formulas()).is_empty();
    let gone: Vec<usize> = (0..problem.constraints.len()).filter(|&at| asks(&problem.constraints[at])).collect();
    let mut rest = without(problem, &gone);
    let (mut point, mut best) = (x.to_vec(), None);
    for _ in 0..ROUNDS {
        for limit in limits.iter().filter(|limit| limit.number == 1) {
            rest.constraints.extend(cuts(subject, limit, &point).ok()?);
        }
        let relaxed = subject.with_problem(rest.clone()).ok().filter(|relaxed| relaxed.class().is_global())?;
        let Some(settings) = remaining.settings(&subject.settings) else { break };
        let start = relaxed.completed(point.clone());
        let task = Task { settings: &settings, ..relaxed.task(&start, interrupt) };
        let found = unobserved(&task, &[by_interior_point()]);
        let Some(bound) = found.lower_bound.or(found.objective) else { break };
        point = found.x[..point.len()].to_vec();
        best = Some(found);
        if objective - bound <= agreement * objective.abs() {
            break;
        }
    }
    best
}

/// Whether K and M are affine in the design: prismatic bars between nodes that stay, of one modulus, whose areas are variables themselves.
fn is_affine(problem: &Problem) -> bool {
    let (Some(structure), Some(statics)) = (problem.structure.as_deref(), problem.statics.as_deref()) else { return false };
    let given =
        |section: u32| matches!(problem.given_dimension(section, "A"), Some(Dimension::Variable(_) | Dimension::Constant(_)));
    structure.members.iter().zip(&statics.members).all(|(member, prepared)| {
        let [from, to] = [&problem.ribs.from, &problem.ribs.to].map(|ends| ends[member.rib as usize]);
        let young = structure.materials[member.material as usize].young;
        let area = from == to && given(from);
        member.absent || member.pinned && prepared.fixed && area && matches!(young, Dimension::Constant(_))
    })
}

/// Affine rows that hold wherever the limit does, by the lowest modes at a design.
fn cuts(subject: &Subject, limit: &Limited, x: &[f64]) -> Result<Vec<Constraint>, EvaluationError> {
    let Some(model) = subject.analysis() else { return Ok(Vec::new()) };
    let z = model.solved(x)?;
    let vectors = model.lifted().modes()?.spectrum(&z, limit.pencil, MODES)?.vectors;
    let mut rows = Vec::new();
    for w in vectors.iter().take(MODES) {
        let (slope, value) = model.lifted().modes()?.cut(&z, w, limit.pencil, limit.limit)?;
        rows.push(row(&subject.problem().constraints[limit.constraint], &slope[..x.len()], value, x));
    }
    Ok(rows)
}

/// value + slope·(x − at) ≥ 0
fn row(own: &Constraint, slope: &[f64], value: f64, at: &[f64]) -> Constraint {
    let constant = |value: f64| Box::new(Formula::Constant(value));
    let term =
        |(j, slope): (usize, &f64)| Formula::Binary(Binary::Multiply, constant(*slope), Box::new(Formula::Variable(j as u32)));
    let terms = slope.iter().enumerate().filter(|(_, slope)| **slope != 0.0).map(term).collect();
    let offset: f64 = slope.iter().zip(at).map(|(slope, x)| slope * x).sum();
    Constraint { left: Formula::Fold(Fold::Sum, terms), right: Limit::AtLeast(Formula::Constant(offset - value)), ..own.clone() }
}
