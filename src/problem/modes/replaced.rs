//! Formulas and rows with something else in the place of an eigenvalue.

use std::sync::Arc;

use crate::problem::formula::Response;
use crate::problem::{Constraint, Formula, Problem};

/// Modes above a limited one that are followed with it: at an optimum they tend to come down to it.
pub(super) const FOLLOWED: u32 = 2;

/// A formula with others in the place of eigenvalues, definitions of them written out; `other` leaves alone what it answers `None` to.
pub(super) fn with_eigenvalues(problem: &Problem, formula: &Formula, other: &dyn Fn(&Formula) -> Option<Formula>) -> Formula {
    let go = |inner: &Formula| with_eigenvalues(problem, inner, other);
    if let Some(found) = other(formula) {
        return found;
    }
    match formula {
        Formula::Definition(definition) => {
            let opened = &problem.definitions[*definition as usize].1;
            let changed = go(opened);
            if changed == *opened { formula.clone() } else { changed }
        }
        other => other.with_children(go),
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
