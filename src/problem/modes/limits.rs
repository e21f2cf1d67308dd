//! Limits from below on eigenvalues, and what takes their place where modes coincide.

use std::sync::Arc;

use super::{Cut, Eigenvalue, Pencil};
use crate::expression::operators::{Binary, Unary};
use crate::problem::evaluate::{Evaluation, Item};
use crate::problem::formula::{Response, What};
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
    let number = |formula: &Formula| constants.value(formula, Item::None).filter(|value| value.is_finite());
    let of = |(at, constraint): (usize, &Constraint)| {
        let (limit, is_lower) = match (&constraint.right, &constraint.scope) {
            (Limit::AtLeast(limit), Scope::Once) => (limit, true),
            (Limit::AtMost(limit), Scope::Once) => (limit, false),
            _ => return None,
        };
        let (eigenvalue, limit) = solved_for(problem, &constraint.left, (number(limit)?, is_lower), &number)?;
        let Eigenvalue::Number(pencil, number) = eigenvalue else { return None };
        Some(Limited { constraint: at, pencil, number, limit })
    };
    problem.constraints.iter().enumerate().filter_map(of).collect()
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

/// A formula of one eigenvalue with another response in its place.
fn with_response(problem: &Problem, formula: &Formula, other: &Arc<Response>) -> Formula {
    let go = |inner: &Formula| with_response(problem, inner, other);
    match formula {
        Formula::Response(response) if response.eigenvalue().is_some() => Formula::Response(Arc::clone(other)),
        Formula::Definition(definition) => {
            let opened = &problem.definitions[*definition as usize].1;
            let changed = go(opened);
            if changed == *opened { formula.clone() } else { changed }
        }
        Formula::Unary(op, inner) => Formula::Unary(*op, Box::new(go(inner))),
        Formula::Binary(op, left, right) => Formula::Binary(*op, Box::new(go(left)), Box::new(go(right))),
        other => other.clone(),
    }
}

/// Modes above a limited one that are followed with it: at an optimum they tend to come down to it.
const FOLLOWED: u32 = 2;

/// Limits the next modes likewise wherever an eigenvalue is limited from below: redundant, as they are no lower, but solvers see them come.
pub fn follow(problem: &mut Problem) {
    let all = limited(problem);
    for limit in &all {
        for number in limit.number + 1..=limit.number + FOLLOWED {
            let next = Limited { number, ..*limit };
            if all.iter().any(|other| other.number == number && next.follows_from(other)) {
                continue;
            }
            let own = problem.constraints[limit.constraint].clone();
            let detail = format!("mode {number}").into();
            let left = with_response(problem, &own.left, &Arc::new(limit.pencil.response(number)));
            problem.constraints.push(Constraint { detail, left, ..own });
        }
    }
}

/// The problem with cuts in the place of limits: those at `replaced` and what follows from them go, each cut is a row named like the
/// constraint it stands for.
pub fn with_cuts(problem: &Problem, replaced: &[Limited], cuts: Vec<(usize, Box<str>, Cut)>) -> Problem {
    let gone: Vec<usize> = limited(problem)
        .iter()
        .filter(|limit| replaced.iter().any(|other| limit.follows_from(other)))
        .map(|limit| limit.constraint)
        .collect();
    let mut cut = without(problem, &gone);
    for (number, (constraint, detail, _)) in cuts.iter().enumerate() {
        let own = problem.constraints[*constraint].clone();
        let response = Response { what: What::Cut(number as u32), ..cuts[number].2.pencil.response(1) };
        let left = with_response(problem, &own.left, &Arc::new(response));
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
