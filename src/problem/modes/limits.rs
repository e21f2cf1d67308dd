//! Limits from below on eigenvalues, and what takes their place where modes coincide.

use super::least::{Helped, Least, helped, least_of, leasts};
use super::{Cut, Eigenvalue, Pencil};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::formula::{Response, What};
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};
use std::sync::Arc;

/// A constraint that limits an eigenvalue from below by a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limited {
    /// Which constraint.
    pub constraint: usize,
    /// Whose eigenvalue.
    pub pencil: Pencil,
    /// Its number.
    pub number: u32,
    /// The limit.
    pub limit: f64,
}

impl Limited {
    /// Whether this limit holds wherever another does.
    pub fn follows_from(&self, other: &Limited) -> bool {
        self.pencil == other.pencil && self.number >= other.number && self.limit <= other.limit
    }
}

/// The constraints that limit an eigenvalue from below: `frequency(2) >= 8`, and what comes to the same, as `1/frequency(2)^2 <= 1/64` or
/// a definition in its place.
pub fn limited(problem: &Problem) -> Vec<Limited> {
    let of = |(at, constraint): (usize, &Constraint)| {
        let is_lower = match (&constraint.right, &constraint.scope) {
            (Limit::AtLeast(_), Scope::Once) => true,
            (Limit::AtMost(_), Scope::Once) => false,
            _ => return None,
        };
        of_side(problem, at, is_lower)
    };
    problem.constraints.iter().enumerate().filter_map(of).collect()
}

/// What a side of a constraint limits from below.
fn of_side(problem: &Problem, at: usize, is_lower: bool) -> Option<Limited> {
    let constants = Evaluation::constants(problem);
    let number = |formula: &Formula| constants.value(formula, Item::None).filter(|value| value.is_finite());
    let constraint = &problem.constraints[at];
    let [lower, upper] = constraint.right.sides();
    let limit = number(if is_lower { lower } else { upper }?)?;
    let (eigenvalue, limit) = solved_for(problem, &constraint.left, (limit, is_lower), &number)?;
    let Eigenvalue::Number(pencil, number) = eigenvalue else { return None };
    Some(Limited { constraint: at, pencil, number, limit })
}

/// Two rows for a range: the side that limits an eigenvalue from below, and the other.
pub(super) fn split_ranges(problem: &mut Problem) {
    for at in 0..problem.constraints.len() {
        let Constraint { scope: Scope::Once, right: Limit::Between(lower, upper), .. } = &problem.constraints[at] else {
            continue;
        };
        let sides = [Limit::AtLeast(lower.clone()), Limit::AtMost(upper.clone())];
        let [own, other] = match (of_side(problem, at, true), of_side(problem, at, false)) {
            (Some(_), _) => sides,
            (None, Some(_)) => {
                let [lower, upper] = sides;
                [upper, lower]
            }
            (None, None) => continue,
        };
        problem.constraints[at].right = own;
        let other = Constraint { detail: "other side".into(), right: other, ..problem.constraints[at].clone() };
        problem.constraints.push(other);
    }
}

/// The eigenvalue that a formula of it and of numbers limits, and from which value on it is met; `None` where it is no limit from below.
/// Eigenvalues are positive: powers and quotients rise or fall.
fn solved_for(
    problem: &Problem,
    formula: &Formula,
    (limit, is_lower): (f64, bool),
    number: &dyn Fn(&Formula) -> Option<f64>,
) -> Option<(Eigenvalue, f64)> {
    let go = |inner: &Formula, limit: f64, is_lower: bool| solved_for(problem, inner, (limit, is_lower), number);
    match formula {
        Formula::Response(response) => {
            let eigenvalue = response.eigenvalue()?;
            (is_lower && limit > 0.0 && limit.is_finite()).then_some((eigenvalue, limit))
        }
        Formula::Definition(definition) => go(&problem.definitions[*definition as usize].1, limit, is_lower),
        Formula::Unary(Unary::Negate, inner) => go(inner, -limit, !is_lower),
        Formula::Binary(op, left, right) => match (op, number(left), number(right)) {
            (Binary::Add, Some(c), None) => go(right, limit - c, is_lower),
            (Binary::Add, None, Some(c)) => go(left, limit - c, is_lower),
            (Binary::Subtract, Some(c), None) => go(right, c - limit, !is_lower),
            (Binary::Subtract, None, Some(c)) => go(left, limit + c, is_lower),
            (Binary::Multiply, Some(c), None) if c != 0.0 => go(right, limit / c, is_lower == (c > 0.0)),
            (Binary::Multiply, None, Some(c)) if c != 0.0 => go(left, limit / c, is_lower == (c > 0.0)),
            (Binary::Divide, None, Some(c)) if c != 0.0 => go(left, limit * c, is_lower == (c > 0.0)),
            (Binary::Divide, Some(c), None) if c > 0.0 && limit > 0.0 => go(right, c / limit, !is_lower),
            (Binary::Power, None, Some(p)) if p != 0.0 && limit > 0.0 => go(left, limit.powf(1.0 / p), is_lower == (p > 0.0)),
            _ => None,
        },
        _ => None,
    }
}

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
fn with_response(problem: &Problem, formula: &Formula, response: Response) -> Formula {
    let put = Formula::Response(Arc::new(response));
    with_eigenvalues(problem, formula, &|formula| {
        matches!(formula, Formula::Response(own) if own.eigenvalue().is_some()).then(|| put.clone())
    })
}

/// Modes above a limited one that are followed with it: at an optimum they tend to come down to it.
pub(super) const FOLLOWED: u32 = 2;

/// Limits the next modes likewise wherever an eigenvalue is limited from below: redundant, as they are no lower, but solvers see them come.
pub(super) fn follow_limits(problem: &mut Problem) {
    let all = limited(problem);
    for limit in &all {
        for number in limit.number + 1..=limit.number + FOLLOWED {
            let next = Limited { number, ..*limit };
            if !all.iter().any(|other| other.number == number && next.follows_from(other)) {
                follow_row(problem, limit.constraint, limit.pencil.response(number), number);
            }
        }
    }
}

/// Adds a row with the eigenvalue of this number in the place of another's.
pub(super) fn follow_row(problem: &mut Problem, constraint: usize, response: Response, number: u32) {
    let own = problem.constraints[constraint].clone();
    let left = with_response(problem, &own.left, response);
    problem.constraints.push(Constraint { detail: format!("mode {number}").into(), left, ..own });
}

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
