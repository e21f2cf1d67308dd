//! Rows and terms as they are written here: their signs, and what of them holds anyway.

use crate::expression::operators::{Binary, Fold};
use crate::problem::{Constraint, Formula, Limit};

/// Whether a row without variables is met; `None` where its limit is no number.
pub(super) fn holds(row: &Constraint) -> Option<bool> {
    let value = row.left.as_constant()?;
    let [lower, upper] = row.right.sides().map(|side| side.map(|limit| limit.as_constant()));
    let above = lower.map_or(Some(true), |lower| lower.map(|lower| value >= lower));
    let below = upper.map_or(Some(true), |upper| upper.map(|upper| value <= upper));
    Some(above? && below?)
}

/// A range around zero, of a left side that is never on one side of it, is one limit.
pub(super) fn one_sided(left: &Formula, limit: Limit) -> Limit {
    match limit {
        Limit::Between(lower, upper) => match (sign(left), lower.as_constant(), upper.as_constant()) {
            (Some(sign), Some(least), _) if sign > 0.0 && least <= 0.0 => Limit::AtMost(upper),
            (Some(sign), _, Some(most)) if sign < 0.0 && most >= 0.0 => Limit::AtLeast(lower),
            _ => Limit::Between(lower, upper),
        },
        other => other,
    }
}

/// ±1 where a formula of numbers and areas, as they are written here, has one sign whatever the areas are.
fn sign(formula: &Formula) -> Option<f64> {
    match formula {
        Formula::Constant(value) if *value != 0.0 => Some(value.signum()),
        Formula::SectionProperty(..) => Some(1.0),
        Formula::Binary(Binary::Multiply | Binary::Divide, left, right) => Some(sign(left)? * sign(right)?),
        Formula::Fold(Fold::Sum, list) => {
            let first = sign(list.first()?)?;
            list.iter().all(|part| sign(part) == Some(first)).then_some(first)
        }
        _ => None,
    }
}

pub(super) fn over(numerator: Formula, denominator: Formula) -> Formula {
    if numerator.as_constant() == Some(0.0) {
        return numerator;
    }
    Formula::Binary(Binary::Divide, Box::new(numerator), Box::new(denominator))
}

pub(super) fn scaled(factor: f64, formula: Formula) -> Formula {
    match formula {
        Formula::Constant(value) => Formula::Constant(factor * value),
        other => Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(factor)), Box::new(other)),
    }
}
