//! Eigenvalues that nothing but a number limits: in objectives, and in rows beside variables.
//!
//! Where a lower one can only make things worse, the least of it and the next ones, which is itself, takes its place: a minimum like any other
//! (docs/expressions-and-classes.md), which has a variable of its own below all of them. Solvers see the next modes come, and where modes
//! coincide, smooth functions take the place of single ones ([`super::Cut`]).

use std::sync::Arc;

use super::limits::limited;
use super::replaced::{FOLLOWED, follow_row, with_eigenvalues};
use super::{Eigenvalue, Pencil};
use crate::expression::operators::{Binary, Fold};
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};

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
    let first = lowest_of(list.first()?)?;
    let follows =
        |(at, formula): (usize, &Formula)| lowest_of(formula) == Some(Least { number: first.number + at as u32, ..first });
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

/// A row that an eigenvalue and variables are in, and that a higher eigenvalue can only help: `frequency(1) >= x`.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Helped {
    /// Which constraint.
    pub constraint: usize,
    /// The eigenvalue.
    pub eigenvalue: Least,
}

/// Those of a problem.
pub(super) fn helped(problem: &Problem) -> Vec<Helped> {
    let limited: Vec<usize> = limited(problem).iter().map(|limit| limit.constraint).collect();
    let others = (0..problem.constraints.len()).filter(|at| !limited.contains(at));
    let of = |constraint: usize| {
        let Restated::Rows(eigenvalue) = restated(problem, &problem.constraints[constraint])? else { return None };
        Some(Helped { constraint, eigenvalue })
    };
    others.filter_map(of).collect()
}

/// What a row with the least of eigenvalues in their place is, once its kinks are taken out.
enum Restated {
    /// As many rows, each with one of them: this is the first.
    Rows(Least),
    /// One with a variable below them.
    Bounded(Formula),
}

/// `None` where there is no eigenvalue, or kinks stay: a lower one would help.
fn restated(problem: &Problem, constraint: &Constraint) -> Option<Restated> {
    if !matches!((&constraint.scope, &constraint.right), (Scope::Once, Limit::AtLeast(_) | Limit::AtMost(_))) {
        return None;
    }
    let left = with_leasts(problem, &constraint.left)?;
    let row = Constraint { left, ..constraint.clone() };
    let trial = Problem { objective: Formula::default(), constraints: vec![row], ..problem.clone() };
    let restated = without_kinks(&trial)?;
    let left = trial.constraints.into_iter().next()?.left;
    if !restated.auxiliaries.is_empty() {
        return Some(Restated::Bounded(left));
    }
    let mut found = Vec::new();
    collect(&left, &mut found);
    let [only] = found[..] else { return None };
    (restated.constraints.len() == 1 + FOLLOWED as usize).then_some(Restated::Rows(only))
}

/// A formula with the least of an eigenvalue and the next ones in the place of each; `None` where there is none.
fn with_leasts(problem: &Problem, formula: &Formula) -> Option<Formula> {
    let least = |formula: &Formula| {
        let Least { pencil, number } = lowest_of(formula)?;
        let one = |number| Formula::Response(Arc::new(pencil.response(number)));
        Some(Formula::Fold(Fold::Min, (number..=number + FOLLOWED).map(one).collect()))
    };
    let found = with_eigenvalues(problem, formula, &least);
    (found != *formula).then_some(found)
}

/// The eigenvalue that a formula is, be it as the least of several of one pencil.
fn lowest_of(formula: &Formula) -> Option<Least> {
    match formula {
        Formula::Response(response) => match response.eigenvalue()? {
            Eigenvalue::Number(pencil, number) => Some(Least { pencil, number }),
            Eigenvalue::Cut(_) => None,
        },
        Formula::Binary(Binary::Min, ..) | Formula::Fold(Fold::Min, _) => {
            let all: Option<Vec<Least>> = formula.children().map(lowest_of).collect();
            let all = all?;
            let lowest = all.iter().min_by_key(|one| one.number)?;
            all.iter().all(|one| one.pencil == lowest.pencil).then_some(*lowest)
        }
        _ => None,
    }
}

/// The problem restated; `None` where kinks stay.
fn without_kinks(trial: &Problem) -> Option<Problem> {
    Some(trial.clone().without_kinks()).filter(|restated| restated.kinks().is_empty())
}

/// Puts the least of several in the place of eigenvalues, wherever that leaves no kink: in objectives, and in rows that are no limits by a number.
pub(super) fn follow_elsewhere(problem: &mut Problem) {
    if let Some(objective) = with_leasts(problem, &problem.objective) {
        let trial = Problem { objective, constraints: Vec::new(), ..problem.clone() };
        if without_kinks(&trial).is_some() {
            problem.objective = trial.objective;
        }
    }
    let limited: Vec<usize> = limited(problem).iter().map(|limit| limit.constraint).collect();
    for at in (0..problem.constraints.len()).filter(|at| !limited.contains(at)) {
        match restated(problem, &problem.constraints[at]) {
            Some(Restated::Rows(Least { pencil, number })) => {
                (number + 1..=number + FOLLOWED).for_each(|next| follow_row(problem, at, pencil.response(next), next));
            }
            Some(Restated::Bounded(left)) => problem.constraints[at].left = left,
            None => {}
        }
    }
}
