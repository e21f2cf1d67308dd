//! Eigenvalues that nothing but a number limits: in objectives, and in rows beside variables.
//!
//! Where a lower one can only make things worse, the least of it and the next ones, which is itself, takes its place: a minimum like any other
//! (docs/expressions-and-classes.md), which has a variable of its own below all of them. Solvers see the next modes come, and where modes
//! coincide, smooth functions take the place of single ones ([`super::Cut`]).

use std::sync::Arc;

use super::limits::{FOLLOWED, limited, with_eigenvalues};
use super::{Eigenvalue, Pencil};
use crate::expression::operators::Fold;
use crate::problem::{Formula, Limit, Problem};

/// The least of an eigenvalue and the next ones.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Least {
    /// Whose eigenvalue.
    pub pencil: Pencil,
    /// Its number.
    pub number: u32,
}

/// The one that a formula is.
pub(super) fn least_of(formula: &Formula) -> Option<Least> {
    let Formula::Fold(Fold::Min, list) = formula else { return None };
    let number = |formula: &Formula| match formula {
        Formula::Response(response) => match response.eigenvalue()? {
            Eigenvalue::Number(pencil, number) => Some(Least { pencil, number }),
            Eigenvalue::Cut(_) => None,
        },
        _ => None,
    };
    let first = number(list.first()?)?;
    let follows = |(at, formula): (usize, &Formula)| number(formula) == Some(Least { number: first.number + at as u32, ..first });
    list.iter().enumerate().all(follows).then_some(first)
}

/// Those of a problem's objective and rows, each once.
pub(super) fn leasts(problem: &Problem) -> Vec<Least> {
    let mut found = Vec::new();
    let lefts = problem.constraints.iter().map(|constraint| &constraint.left);
    for formula in std::iter::once(&problem.objective).chain(lefts) {
        collect(formula, &mut found);
    }
    found
}

fn collect(formula: &Formula, found: &mut Vec<Least>) {
    if let Some(least) = least_of(formula) {
        if !found.contains(&least) {
            found.push(least);
        }
        return;
    }
    formula.children().for_each(|inner| collect(inner, found));
}

/// Puts them in, wherever that leaves no kink: in objectives and in rows that are no limits by a number.
pub(super) fn follow_elsewhere(problem: &mut Problem) {
    let limited: Vec<usize> = limited(problem).iter().map(|limit| limit.constraint).collect();
    let least = |formula: &Formula| {
        let Formula::Response(response) = formula else { return None };
        let Eigenvalue::Number(pencil, number) = response.eigenvalue()? else { return None };
        let one = |number| Formula::Response(Arc::new(pencil.response(number)));
        Some(Formula::Fold(Fold::Min, (number..=number + FOLLOWED).map(one).collect()))
    };
    let objective = with_eigenvalues(problem, &problem.objective, &least);
    if objective != problem.objective {
        let trial = Problem { objective, constraints: Vec::new(), ..problem.clone() };
        if has_no_kinks(&trial) {
            problem.objective = trial.objective;
        }
    }
    for at in (0..problem.constraints.len()).filter(|at| !limited.contains(at)) {
        let own = &problem.constraints[at];
        let left = with_eigenvalues(problem, &own.left, &least);
        if left == own.left || matches!(own.right, Limit::Equal(_) | Limit::Between(..)) {
            continue;
        }
        let constraint = crate::problem::Constraint { left, ..own.clone() };
        let trial = Problem { objective: Formula::default(), constraints: vec![constraint], ..problem.clone() };
        if has_no_kinks(&trial) {
            problem.constraints[at].left = trial.constraints[0].left.clone();
        }
    }
}

fn has_no_kinks(trial: &Problem) -> bool {
    trial.clone().without_kinks().kinks().is_empty()
}
