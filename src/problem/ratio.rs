//! Rows as geometric programs state them: what is added up on one side over what is added up on the other, against 1.
//!
//! `h <= 8*b` becomes `h/(8*b) <= 1`, `Ix >= I_req` becomes `I_req/Ix <= 1`. The two forms say the same only where both sides are
//! positive; whether they are, and whether they are of the kind that makes the row convex in logarithms, is not decided here:
//! terms are sorted by how they are written, which proves nothing about their signs.

use super::formula::Formula;
use super::{Limit, Problem};
use crate::expression::operators::{Binary, Fold, Unary};

/// Definitions seen through one inside another.
const DEPTH: usize = 64;

/// The same within a factor: each level is looked at for both factors of a product.
const SPREAD: usize = 8;

/// Terms of one row at which definitions stay closed: they may share one another many times over.
const MOST_TERMS: usize = 10_000;

/// A row as geometric programs state it.
#[derive(Debug)]
pub enum Ratio {
    /// A quotient (or, between two limits, the formula itself) against a limit.
    Row(Formula, Limit),
    /// The row says that this formula is not negative: no ratio says that.
    NotNegative(Formula),
    /// No ratio of positive sums says what the row says.
    None,
}

impl Problem {
    /// The row as a ratio, where both sides have terms.
    pub fn ratio(&self, left: &Formula, right: &Limit) -> Ratio {
        let one = || Formula::Constant(1.0);
        match right {
            Limit::AtMost(limit) => self.quotient(left, limit, Limit::AtMost(one())),
            Limit::AtLeast(limit) => self.quotient(limit, left, Limit::AtMost(one())),
            Limit::Equal(limit) => self.quotient(left, limit, Limit::Equal(one())),
            Limit::Between(..) => Ratio::Row(left.clone(), right.clone()),
        }
    }

    /// `small ≤ large`, or `small == large`, as the quotient held against 1.
    fn quotient(&self, small: &Formula, large: &Formula, limit: Limit) -> Ratio {
        let mut sides = Sides::default();
        self.collect(small, 1.0, DEPTH, &mut sides);
        self.collect(large, -1.0, DEPTH, &mut sides);
        let Sides { positive, negative } = sides;
        match (positive.is_empty(), negative.is_empty()) {
            (_, true) => Ratio::None,
            (true, false) if matches!(limit, Limit::AtMost(_)) => Ratio::NotNegative(total(negative)),
            (true, false) => Ratio::None,
            (false, false) => {
                Ratio::Row(Formula::Binary(Binary::Divide, Box::new(total(positive)), Box::new(total(negative))), limit)
            }
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
            Formula::Binary(Binary::Multiply | Binary::Divide, ..) => match coefficient(formula) {
                (number, Some(rest)) if is_product(&rest) => match self.spread(&rest, depth.min(SPREAD) - 1) {
                    Some(spread) if terms < MOST_TERMS => sides.add(spread, factor * number),
                    _ => sides.push(&rest, factor * number),
                },
                (number, Some(rest)) => go(&rest, factor * number),
                (number, None) => sides.push(&Formula::Constant(number.abs()), factor * sign(number)),
            },
            Formula::Definition(definition) if self.has_signs(*definition) && terms < MOST_TERMS => {
                go(&self.definitions[*definition as usize].1, factor);
            }
            other => sides.push(other, factor),
        }
    }

    /// A product one factor of which has terms of both signs, term by term: `a*(x − y)` is `a*x − a*y`.
    fn spread(&self, product: &Formula, depth: usize) -> Option<Sides> {
        let Formula::Binary(op, left, right) = product else { return None };
        let mixed = |factor: &Formula| {
            let mut sides = Sides::default();
            self.collect(factor, 1.0, depth, &mut sides);
            (!sides.positive.is_empty() && !sides.negative.is_empty()).then_some(sides)
        };
        if let Some(sides) = mixed(left) {
            return Some(sides.map(|term| joined(*op, term, (**right).clone())));
        }
        let sides = if *op == Binary::Multiply { mixed(right) } else { None };
        Some(sides?.map(|term| joined(*op, (**left).clone(), term)))
    }

    /// Whether a definition is worth opening: its outermost operation has terms of either sign.
    fn has_signs(&self, definition: u32) -> bool {
        let opened = &self.definitions[definition as usize].1;
        matches!(
            opened,
            Formula::Unary(Unary::Negate, _)
                | Formula::Binary(Binary::Subtract | Binary::Add | Binary::Multiply | Binary::Divide, ..)
                | Formula::Constant(_)
        )
    }
}

/// The number a product is multiplied by, and the rest: `-x*y/2` is −½·(x·y).
fn coefficient(formula: &Formula) -> (f64, Option<Formula>) {
    match formula {
        Formula::Constant(value) => (*value, None),
        Formula::Unary(Unary::Negate, inner) => {
            let (number, rest) = coefficient(inner);
            (-number, rest)
        }
        Formula::Binary(Binary::Multiply, left, right) => match (coefficient(left), coefficient(right)) {
            ((a, Some(left)), (b, Some(right))) => (a * b, Some(joined(Binary::Multiply, left, right))),
            ((a, rest), (b, None)) | ((a, None), (b, rest)) => (a * b, rest),
        },
        Formula::Binary(Binary::Divide, left, right) => match (coefficient(left), coefficient(right)) {
            ((a, rest), (b, None)) => (a / b, rest),
            ((a, left), (b, Some(right))) => (a / b, Some(joined(Binary::Divide, left.unwrap_or(Formula::Constant(1.0)), right))),
        },
        other => (1.0, Some(other.clone())),
    }
}

fn joined(op: Binary, left: Formula, right: Formula) -> Formula {
    Formula::Binary(op, Box::new(left), Box::new(right))
}

fn is_product(formula: &Formula) -> bool {
    matches!(formula, Formula::Binary(Binary::Multiply | Binary::Divide, ..))
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

    fn map(self, change: impl Fn(Formula) -> Formula) -> Sides {
        Sides {
            positive: self.positive.into_iter().map(&change).collect(),
            negative: self.negative.into_iter().map(&change).collect(),
        }
    }

    /// Adds `factor` times the terms of both sides.
    fn add(&mut self, other: Sides, factor: f64) {
        other.positive.iter().for_each(|term| self.push(term, factor));
        other.negative.iter().for_each(|term| self.push(term, -factor));
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
        let Ratio::Row(ratio, limit) = Problem::default().ratio(&difference, &Limit::AtMost(number(0.0))) else { panic!() };
        let eight = Formula::Binary(Binary::Multiply, Box::new(number(8.0)), variable(1));
        assert_eq!(ratio, Formula::Binary(Binary::Divide, variable(0), Box::new(eight)));
        assert!(matches!(limit, Limit::AtMost(Formula::Constant(1.0))));
    }

    #[test]
    fn a_lower_limit_stands_above_the_line() {
        let Ratio::Row(ratio, _) = Problem::default().ratio(&Formula::Variable(0), &Limit::AtLeast(number(3.0))) else {
            panic!()
        };
        assert_eq!(ratio, Formula::Binary(Binary::Divide, Box::new(number(3.0)), variable(0)));
        assert!(matches!(Problem::default().ratio(&Formula::Variable(0), &Limit::AtMost(number(-1.0))), Ratio::None));
    }

    #[test]
    fn signs_are_found_inside_products() {
        let product = |left, right| Formula::Binary(Binary::Multiply, Box::new(left), Box::new(right));
        let negated = product(Formula::Unary(Unary::Negate, variable(0)), *variable(1));
        let Ratio::Row(ratio, _) = Problem::default().ratio(&negated, &Limit::AtLeast(number(-2.0))) else { panic!() };
        let expected = product(*variable(0), *variable(1));
        assert_eq!(ratio, Formula::Binary(Binary::Divide, Box::new(expected), Box::new(number(2.0))));
    }

    #[test]
    fn a_factor_stands_before_every_term_of_a_difference() {
        let product = |left, right| Formula::Binary(Binary::Multiply, Box::new(left), Box::new(right));
        let difference = Formula::Binary(Binary::Subtract, variable(1), variable(2));
        let row = product(*variable(0), difference);
        let Ratio::Row(ratio, _) = Problem::default().ratio(&row, &Limit::AtMost(number(0.0))) else { panic!() };
        let (above, below) = (product(*variable(0), *variable(1)), product(*variable(0), *variable(2)));
        assert_eq!(ratio, Formula::Binary(Binary::Divide, Box::new(above), Box::new(below)));
    }

    #[test]
    fn a_row_without_a_small_side_is_no_ratio() {
        let power = Formula::Binary(Binary::Power, variable(0), Box::new(number(3.0)));
        let ratio = Problem::default().ratio(&power, &Limit::AtLeast(number(-2.0)));
        assert!(matches!(ratio, Ratio::NotNegative(_)), "{ratio:?}");
        assert!(matches!(Problem::default().ratio(&power, &Limit::AtMost(number(0.0))), Ratio::None));
    }
}
