//! The terms of rows that no variable can move, with fixed variables at their values: `a·(x² − 4)` has −4·a, and a fixed a makes no less of
//! a number of it than a written one.

use std::cell::OnceCell;

use super::dependence::Dependence;
use super::expression_graph::{Context, Item, Lowering, members};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::problem::Problem;
use crate::problem::formula::Formula;

/// A problem in which some variables are fixed.
pub(super) struct FixedTerms<'a> {
    problem: &'a Problem,
    facts: Dependence,
    /// Of each definition, once asked: they may share one another many times over.
    definitions: Vec<OnceCell<f64>>,
}

impl<'a> FixedTerms<'a> {
    /// `None` where no variable is fixed: the affine parts' constants say it all.
    pub fn of(problem: &'a Problem) -> Option<Self> {
        let variables = &problem.variables;
        let fixed: Vec<bool> = variables.lower.iter().zip(&variables.upper).map(|(lower, upper)| lower == upper).collect();
        fixed.contains(&true).then(|| FixedTerms {
            problem,
            facts: Dependence::beside(problem, fixed),
            definitions: vec![OnceCell::new(); problem.definitions.len()],
        })
    }

    /// The sum of the formula's terms without variables that can move; what is no sum and no multiple of one has none.
    pub fn term(&self, formula: &Formula, context: Context) -> f64 {
        if self.facts.is_constant(formula) {
            return self.value(formula, context);
        }
        match formula {
            Formula::Definition(definition) => {
                let formula = &self.problem.definitions[*definition as usize].1;
                *self.definitions[*definition as usize].get_or_init(|| self.term(formula, Context::GLOBAL))
            }
            Formula::Unary(Unary::Negate, inner) => -self.term(inner, context),
            Formula::Binary(Binary::Add, left, right) => self.term(left, context) + self.term(right, context),
            Formula::Binary(Binary::Subtract, left, right) => self.term(left, context) - self.term(right, context),
            Formula::Binary(Binary::Multiply, factor, other) | Formula::Binary(Binary::Multiply, other, factor)
                if self.facts.is_constant(factor) =>
            {
                self.value(factor, context) * self.term(other, context)
            }
            Formula::Binary(Binary::Divide, other, divisor) if self.facts.is_constant(divisor) => {
                self.term(other, context) / self.value(divisor, context)
            }
            Formula::Fold(Fold::Sum, list) => list.iter().map(|one| self.term(one, context)).sum(),
            Formula::Over { fold: Fold::Sum, collection, members: which, body } => {
                let items = members(self.problem, *collection, which, context).into_iter();
                items.map(|index| self.term(body, context.of(Item::of(*collection, index)))).sum()
            }
            _ => 0.0,
        }
    }

    /// The value of a formula whose variables are fixed.
    fn value(&self, formula: &Formula, context: Context) -> f64 {
        if let Formula::Constant(value) = formula {
            return *value;
        }
        let mut lowering = Lowering::new(self.problem);
        let root = lowering.formula(formula, context);
        let inputs: Vec<f64> = lowering.variables.iter().map(|&j| self.problem.variables.lower[j as usize]).collect();
        lowering.graph.evaluate(root, &inputs, &lowering.numbers)
    }
}
