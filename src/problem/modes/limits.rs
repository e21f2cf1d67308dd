//! Limits from below on eigenvalues, by numbers.

use super::replaced::{FOLLOWED, follow_row};
use super::{Eigenvalue, Pencil};
use crate::expression::operators::{Binary, Unary};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};

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
    let constants = Evaluation::constants(problem);
    let of = |(at, constraint): (usize, &Constraint)| {
        let is_lower = match (&constraint.right, &constraint.scope) {
            (Limit::AtLeast(_), Scope::Once) => true,
            (Limit::AtMost(_), Scope::Once) => false,
            _ => return None,
        };
        of_side(problem, &constants, at, is_lower)
    };
    problem.constraints.iter().enumerate().filter_map(of).collect()
}

/// What a side of a constraint limits from below.
fn of_side(problem: &Problem, constants: &Evaluation<'_>, at: usize, is_lower: bool) -> Option<Limited> {
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
    let constants = Evaluation::constants(problem);
    let split = |(at, constraint): (usize, &Constraint)| {
        let (Scope::Once, Limit::Between(lower, upper)) = (&constraint.scope, &constraint.right) else { return None };
        let sides = (Limit::AtLeast(lower.clone()), Limit::AtMost(upper.clone()));
        match [true, false].map(|is_lower| of_side(problem, &constants, at, is_lower)) {
            [Some(_), _] => Some((at, sides.0, sides.1)),
            [None, Some(_)] => Some((at, sides.1, sides.0)),
            [None, None] => None,
        }
    };
    let ranges: Vec<(usize, Limit, Limit)> = problem.constraints.iter().enumerate().filter_map(split).collect();
    for (at, own, other) in ranges {
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
