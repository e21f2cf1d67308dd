//! Problems whose responses are written as formulas of what they follow from.

use super::formula::Response;
use super::{Constraint, Formula, Limit, Problem};
use crate::expression::operators::{Binary, Fold, Unary};

/// Writes formulas without the responses they ask for.
pub(super) trait Rewriting {
    /// The problem they belong to.
    fn problem(&self) -> &Problem;

    /// A response of one item; `None` where it follows from more.
    fn response(&self, response: &Response) -> Option<Formula>;

    /// The rows of a constraint, item by item where it asks for responses; `None` where it asks for one that has no formula.
    fn rows(&self, constraint: &Constraint) -> Option<Vec<Constraint>> {
        let problem = self.problem();
        let mut known = vec![Some(false); problem.definitions.len()];
        let asks = [&constraint.left].into_iter().chain(constraint.right.formulas()).any(|one| one.analyses(problem, &mut known));
        if !asks {
            return Some(vec![constraint.clone()]);
        }
        let one = |at: usize| {
            let one = problem.one_row(constraint, at)?;
            let right = match &one.right {
                Limit::AtMost(limit) => Limit::AtMost(self.formula(limit)?),
                Limit::AtLeast(limit) => Limit::AtLeast(self.formula(limit)?),
                Limit::Equal(value) => Limit::Equal(self.formula(value)?),
                Limit::Between(lower, upper) => Limit::Between(self.formula(lower)?, self.formula(upper)?),
            };
            let asked = one.formulas().cloned().collect();
            Some(Constraint { right, left: self.formula(&one.left)?, asked, ..one })
        };
        let rows: Vec<Constraint> = (0..constraint.scope.rows()).map(one).collect::<Option<_>>()?;
        // A row that speaks of no variable holds, and says nothing then, or never does, and the analysis tells.
        let idle = rows.iter().filter(|row| row.left.as_constant().is_some());
        let holds = idle.map(holds).collect::<Option<Vec<bool>>>()?.iter().all(|&holds| holds);
        holds.then(|| rows.into_iter().filter(|row| row.left.as_constant().is_none()).collect())
    }

    /// A formula; `None` where it asks for a response that has none.
    fn formula(&self, formula: &Formula) -> Option<Formula> {
        let problem = self.problem();
        let boxed = |inner: &Formula| self.formula(inner).map(Box::new);
        Some(match formula {
            Formula::Response(response) => self.response(response)?,
            Formula::Unary(op, inner) => unary(*op, boxed(inner)?),
            Formula::Binary(op, left, right) => binary(*op, boxed(left)?, boxed(right)?),
            Formula::Fold(Fold::Sum, list) => total(list.iter().map(|one| self.formula(one)).collect::<Option<Vec<_>>>()?),
            Formula::Fold(fold, list) => Formula::Fold(*fold, list.iter().map(|one| self.formula(one)).collect::<Option<_>>()?),
            Formula::Over { fold, collection, members, body } => {
                let mut known = vec![Some(false); problem.definitions.len()];
                if !body.analyses(problem, &mut known) {
                    return Some(formula.clone());
                }
                let parts = problem.instances(*collection, members, body)?;
                Formula::Fold(*fold, parts.iter().map(|one| self.formula(one)).collect::<Option<_>>()?)
            }
            other => other.clone(),
        })
    }
}

/// An operation; its value where it is one on a number.
fn unary(op: Unary, inner: Box<Formula>) -> Formula {
    match inner.as_constant() {
        Some(value) => Formula::Constant(op.evaluate(value)),
        None => Formula::Unary(op, inner),
    }
}

/// The same of two.
fn binary(op: Binary, left: Box<Formula>, right: Box<Formula>) -> Formula {
    match (op, left.as_constant(), right.as_constant()) {
        (_, Some(left), Some(right)) => Formula::Constant(op.evaluate(left, right)),
        (Binary::Multiply | Binary::Divide, Some(0.0), None) | (Binary::Multiply, None, Some(0.0)) => Formula::Constant(0.0),
        _ => Formula::Binary(op, left, right),
    }
}

/// Whether a row without variables is met; `None` where its limit is no number.
fn holds(row: &Constraint) -> Option<bool> {
    let value = row.left.as_constant()?;
    let [lower, upper] = row.right.sides().map(|side| side.map(|limit| limit.as_constant()));
    let above = lower.map_or(Some(true), |lower| lower.map(|lower| value >= lower));
    let below = upper.map_or(Some(true), |upper| upper.map(|upper| value <= upper));
    Some(above? && below?)
}

/// A quotient; 0 where its numerator is.
pub(super) fn over(numerator: Formula, denominator: Formula) -> Formula {
    if numerator.as_constant() == Some(0.0) {
        return numerator;
    }
    Formula::Binary(Binary::Divide, Box::new(numerator), Box::new(denominator))
}

/// factor · formula
pub(super) fn scaled(factor: f64, formula: Formula) -> Formula {
    match formula {
        Formula::Constant(value) => Formula::Constant(factor * value),
        other => Formula::Binary(Binary::Multiply, Box::new(Formula::Constant(factor)), Box::new(other)),
    }
}

/// A sum without its zeros.
pub(super) fn total(terms: impl IntoIterator<Item = Formula>) -> Formula {
    let mut terms: Vec<Formula> = terms.into_iter().filter(|term| term.as_constant() != Some(0.0)).collect();
    match terms.len() {
        0 => Formula::Constant(0.0),
        1 => terms.remove(0),
        _ => Formula::Fold(Fold::Sum, terms),
    }
}
