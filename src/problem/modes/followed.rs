//! What stands for several eigenvalues, and what takes its place where they coincide.

use std::sync::Arc;

use super::least::{Helped, Least, helped, least_of, leasts};
use super::limits::{Limited, limited};
use super::replaced::{with_eigenvalues, with_response};
use super::{Cut, Pencil, eigenvalues};
use crate::expression::operators::Fold;
use crate::problem::formula::{Response, What};
use crate::problem::{Constraint, Formula, Problem};

/// Whether two rows differ in their eigenvalues only.
fn are_alike(problem: &Problem, one: usize, other: usize) -> bool {
    let plain = |at: usize| {
        let own = &problem.constraints[at];
        (with_response(problem, &own.left, Pencil::Vibration.response(1)), own.right.clone())
    };
    plain(one) == plain(other)
}

/// What a cut stands for.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Followed {
    /// A limit: the cut is a row in its place.
    Limit(Limited),
    /// A row that an eigenvalue helps: the cut makes one in its place.
    Row(Helped),
    /// The least of an eigenvalue and the next ones: the cut is one of those whose least takes its place.
    Least(Least),
}

impl Followed {
    /// Whose eigenvalue it is about, and the number of the lowest.
    pub fn eigenvalue(&self) -> Least {
        match self {
            Followed::Limit(limit) => Least { pencil: limit.pencil, number: limit.number },
            Followed::Row(helped) => helped.eigenvalue,
            Followed::Least(least) => *least,
        }
    }

    /// Whether what is done for another does for this.
    pub fn follows_from(&self, problem: &Problem, other: &Followed) -> bool {
        match (self, other) {
            (Followed::Limit(limit), Followed::Limit(other)) => limit.follows_from(other),
            (Followed::Row(row), Followed::Row(other)) => {
                let (own, others) = (row.eigenvalue, other.eigenvalue);
                own.pencil == others.pencil && own.number >= others.number && are_alike(problem, row.constraint, other.constraint)
            }
            _ => self == other,
        }
    }

    /// The row whose place a cut takes; `None` where it stands within formulas.
    fn row(&self) -> Option<usize> {
        match self {
            Followed::Limit(limit) => Some(limit.constraint),
            Followed::Row(helped) => Some(helped.constraint),
            Followed::Least(_) => None,
        }
    }
}

/// All that a problem has of them.
pub fn followed(problem: &Problem) -> Vec<Followed> {
    if eigenvalues(problem).is_empty() {
        return Vec::new();
    }
    let limits = limited(problem).into_iter().map(Followed::Limit);
    let rows = helped(problem).into_iter().map(Followed::Row);
    limits.chain(rows).chain(leasts(problem).into_iter().map(Followed::Least)).collect()
}

/// The problem with cuts in the place of what they stand for. Of rows, those that follow from a cut one go, too; each cut of a row is one named
/// like the constraint.
pub fn with_cuts(problem: &Problem, cuts: Vec<(Followed, Box<str>, Cut)>) -> Problem {
    let is_gone = |one: &Followed| cuts.iter().any(|(of, ..)| one.follows_from(problem, of));
    let gone: Vec<usize> = followed(problem).iter().filter(|one| is_gone(one)).filter_map(Followed::row).collect();
    let mut cut = without(problem, &gone);
    let response = |number: usize| Response { what: What::Cut(number as u32), ..cuts[number].2.pencil.response(1) };
    let least = |formula: &Formula| {
        let least = Followed::Least(least_of(formula)?);
        let own = cuts.iter().enumerate().filter(|(_, (of, ..))| *of == least);
        let list: Vec<Formula> = own.map(|(number, _)| Formula::Response(Arc::new(response(number)))).collect();
        (!list.is_empty()).then_some(Formula::Fold(Fold::Min, list))
    };
    cut.objective = with_eigenvalues(problem, &cut.objective, &least);
    for constraint in &mut cut.constraints {
        constraint.left = with_eigenvalues(problem, &constraint.left, &least);
    }
    for (number, (of, detail, _)) in cuts.iter().enumerate() {
        let Some(row) = of.row() else { continue };
        let own = problem.constraints[row].clone();
        let left = with_response(problem, &own.left, response(number));
        cut.constraints.push(Constraint { detail: detail.clone(), left, ..own });
    }
    cut.cuts = Arc::new(cuts.into_iter().map(|(.., cut)| cut).collect());
    cut
}

/// The problem without the constraints at these places.
pub fn without(problem: &Problem, gone: &[usize]) -> Problem {
    let kept = problem.constraints.iter().enumerate().filter(|(at, _)| !gone.contains(at));
    Problem { constraints: kept.map(|(_, constraint)| constraint.clone()).collect(), ..problem.clone() }
}
