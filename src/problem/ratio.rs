//! Rows as geometric programs state them: what is added up on one side over what is added up on the other, against 1.
//!
//! `h <= 8*b` becomes `h/(8*b) <= 1`, `Ix >= I_req` becomes `I_req/Ix <= 1`. Whether numerator and denominator are of the
//! kind that makes the row convex in logarithms is not decided here.

use super::formula::Formula;
use super::{Limit, Problem};
use crate::expression::operators::{Binary, Fold, Unary};

/// Definitions seen through one inside another.
const DEPTH: usize = 64;

/// Terms of one row at which definitions stay closed: they may share one another many times over.
const MOST_TERMS: usize = 10_000;

impl Problem {
    /// The row as a ratio; `None` where one side is empty (a sum of positive terms is never below zero).
    pub fn ratio(&self, left: &Formula, right: &Limit) -> Option<(Formula, Limit)> {
        let one = || Formula::Constant(1.0);
        match right {
            Limit::AtMost(limit) => Some((self.quotient(left, limit)?, Limit::AtMost(one()))),
            Limit::AtLeast(limit) => Some((self.quotient(limit, left)?, Limit::AtMost(one()))),
            Limit::Equal(limit) => Some((self.quotient(left, limit)?, Limit::Equal(one()))),
            Limit::Between(..) => Some((left.clone(), right.clone())),
        }
    }

    /// `small ≤ large` as the quotient that must not exceed 1.
    fn quotient(&self, small: &Formula, large: &Formula) -> Option<Formula> {
        let mut sides = Sides::default();
        self.collect(small, 1.0, DEPTH, &mut sides);
        self.collect(large, -1.0, DEPTH, &mut sides);
        let Sides { positive, negative } = sides;
        match (positive.is_empty(), negative.is_empty()) {
            (_, true) => None,
            (true, false) => Some(Formula::Constant(0.0)),
            (false, false) => Some(Formula::Binary(Binary::Divide, Box::new(total(positive)), Box::new(total(negative)))),
        }
    }

    /// Sorts the additive terms of `factor · formula` by the sign they stand with.
    fn collect(&self, formula: &Formula, factor: f64, depth: usize, sides: &mut Sides) {
        if depth == 0 {
            return sides.push(formula, factor);
        }
        let terms = sides.terms();
        let mut go = |formula: &Formula, factor: f64| self.collect(formula, factor, depth - 1, sides);
        match formula {
            Formula::Constant(value) => sides.push(&Formula::Constant(value.abs()), factor * sign(*value)),
            Formula::Unary(Unary::Negate, inner) => go(inner, -factor),
            Formula::Binary(Binary::Add, left, right) => {
                go(left, factor);
                go(right, factor);
            }
            Formula::Binary(Binary::Subtract, left, right) => {
                go(left, factor);
                go(right, -factor);
            }
            Formula::Fold(Fold::Sum, list) => list.iter().for_each(|one| go(one, factor)),
            Formula::Binary(Binary::Multiply, number, other) | Formula::Binary(Binary::Multiply, other, number)
                if number.as_constant().is_some() =>
            {
                go(other, factor * number.as_constant().unwrap_or(1.0));
            }
            Formula::Binary(Binary::Divide, other, number) if number.as_constant().is_some() => {
                go(other, factor / number.as_constant().unwrap_or(1.0));
            }
            Formula::Definition(definition) if self.has_signs(*definition) && terms < MOST_TERMS => {
                go(&self.definitions[*definition as usize].1, factor);
            }
            other => sides.push(other, factor),
        }
    }

    /// Whether a definition is worth opening: its outermost operation has terms of either sign.
    fn has_signs(&self, definition: u32) -> bool {
        let opened = &self.definitions[definition as usize].1;
        matches!(
            opened,
            Formula::Unary(Unary::Negate, _) | Formula::Binary(Binary::Subtract | Binary::Add, ..) | Formula::Constant(_)
        )
    }
}

/// 1, −1, or 0.
fn sign(value: f64) -> f64 {
    if value == 0.0 { 0.0 } else { value.signum() }
}

#[derive(Default)]
struct Sides {
    positive: Vec<Formula>,
    negative: Vec<Formula>,
}

impl Sides {
    fn terms(&self) -> usize {
        self.positive.len() + self.negative.len()
    }

    fn push(&mut self, formula: &Formula, factor: f64) {
        let weight = factor.abs();
        let term = match formula {
            _ if weight == 0.0 => return,
            Formula::Constant(value) => Formula::Constant(value * weight),
            other if weight == 1.0 => other.clone(),
            other => Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(weight)), Box::new(other.clone())),
        };
        if factor > 0.0 { self.positive.push(term) } else { self.negative.push(term) }
    }
}

fn total(mut terms: Vec<Formula>) -> Formula {
    match (terms.len(), terms.pop()) {
        (1, Some(only)) => only,
        (_, last) => Formula::Fold(Fold::Sum, terms.into_iter().chain(last).collect()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn variable(index: u32) -> Box<Formula> {
        Box::new(Formula::Variable(index))
    }

    fn number(value: f64) -> Formula {
        Formula::Constant(value)
    }

    #[test]
    fn negative_terms_change_sides() {
        let difference = Formula::Binary(
            Binary::Subtract,
            variable(0),
            Box::new(Formula::Binary(Binary::Multiply, Box::new(number(8.0)), variable(1))),
        );
        let (ratio, limit) = Problem::default().ratio(&difference, &Limit::AtMost(number(0.0))).unwrap();
        let eight = Formula::Binary(Binary::Multiply, Box::new(number(8.0)), variable(1));
        assert_eq!(ratio, Formula::Binary(Binary::Divide, variable(0), Box::new(eight)));
        assert!(matches!(limit, Limit::AtMost(Formula::Constant(1.0))));
    }

    #[test]
    fn a_lower_limit_stands_above_the_line() {
        let (ratio, _) = Problem::default().ratio(&Formula::Variable(0), &Limit::AtLeast(number(3.0))).unwrap();
        assert_eq!(ratio, Formula::Binary(Binary::Divide, Box::new(number(3.0)), variable(0)));
        assert!(Problem::default().ratio(&Formula::Variable(0), &Limit::AtMost(number(-1.0))).is_none());
    }
}
