//! Formulas and rows with something else in the place of an eigenvalue.

use std::sync::Arc;

use crate::problem::formula::Response;
use crate::problem::{Constraint, Formula, Problem};

/// Modes above a limited one that are followed with it: at an optimum they tend to come down to it.
pub(super) const FOLLOWED: u32 = 2;

/// Nodes of a formula with its definitions of eigenvalues written out; beyond this they stay as they are.
const MOST_WRITTEN: usize = 10_000;

/// A formula with others in the place of eigenvalues, definitions of them written out; `other` leaves alone what it answers `None` to. A formula
/// that would grow too large stays as it is.
pub(super) fn with_eigenvalues(problem: &Problem, formula: &Formula, other: &dyn Fn(&Formula) -> Option<Formula>) -> Formula {
    let mut known = vec![None; problem.definitions.len()];
    match written_size(problem, formula, &mut known) {
        1..=MOST_WRITTEN => written(problem, formula, other, &known),
        _ => formula.clone(),
    }
}

/// Its nodes, as above; 0 of what has no eigenvalue. `known` keeps those of definitions.
fn written_size(problem: &Problem, formula: &Formula, known: &mut [Option<usize>]) -> usize {
    match formula {
        Formula::Response(response) => usize::from(response.eigenvalue().is_some()),
        Formula::Definition(definition) => {
            let at = *definition as usize;
            if let Some(size) = known[at] {
                return size;
            }
            let size = written_size(problem, &problem.definitions[at].1, known);
            known[at] = Some(size);
            size
        }
        other => {
            let inner = other.children().fold(0_usize, |sum, one| sum.saturating_add(written_size(problem, one, known)));
            inner.saturating_add(usize::from(inner > 0))
        }
    }
}

fn written(
    problem: &Problem,
    formula: &Formula,
    other: &dyn Fn(&Formula) -> Option<Formula>,
    known: &[Option<usize>],
) -> Formula {
    if let Some(found) = other(formula) {
        return found;
    }
    match formula {
        Formula::Definition(definition) if known[*definition as usize] != Some(0) => {
            let opened = &problem.definitions[*definition as usize].1;
            let changed = written(problem, opened, other, known);
            if changed == *opened { formula.clone() } else { changed }
        }
        inner => inner.with_children(|one| written(problem, one, other, known)),
    }
}

/// A formula of one eigenvalue with another response in its place.
pub(super) fn with_response(problem: &Problem, formula: &Formula, response: Response) -> Formula {
    let put = Formula::Response(Arc::new(response));
    with_eigenvalues(problem, formula, &|formula| {
        matches!(formula, Formula::Response(own) if own.eigenvalue().is_some()).then(|| put.clone())
    })
}

/// Adds a row with the eigenvalue of this number in the place of another's.
pub(super) fn follow_row(problem: &mut Problem, constraint: usize, response: Response, number: u32) {
    let own = problem.constraints[constraint].clone();
    let left = with_response(problem, &own.left, response);
    problem.constraints.push(Constraint { detail: format!("mode {number}").into(), left, ..own });
}
