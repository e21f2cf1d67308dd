//! How an operation rises or falls in an operand, by ranges.

use super::Restating;
use crate::expression::operators::{Binary, Unary};
use crate::expression::structure::{Interval, Slope};
use crate::problem::Formula;

impl Restating {
    /// How an operation changes in the operand at a place, its range given.
    pub(super) fn slope(&mut self, formula: &Formula, at: usize, range: Interval) -> Slope {
        match formula {
            Formula::Unary(op, _) => Slope::of_unary(*op, range),
            Formula::Binary(op, left, right) if at == 0 => {
                let other = self.range(right);
                Slope::in_left(*op, range, if left == right { range } else { other })
            }
            Formula::Binary(op, left, _) => Slope::in_right(*op, self.range(left), range),
            _ => Slope::Mixed,
        }
    }

    /// Whether the slope in an operand depends on nothing else that is restated.
    pub(super) fn is_alone(&self, formula: &Formula, at: usize) -> bool {
        match formula {
            Formula::Unary(..) | Formula::Binary(Binary::Add | Binary::Subtract, ..) => true,
            Formula::Binary(_, left, right) => !self.has_kinks(if at == 0 { right } else { left }),
            _ => false,
        }
    }

    /// Functions that rise or fall throughout a domain bounded from below: a bound below the argument that lies in the domain
    /// keeps the argument there too, whatever its range.
    pub(super) fn domain_slope(&mut self, formula: &Formula, upward: bool) -> Option<Slope> {
        match formula {
            Formula::Unary(Unary::Sqrt | Unary::Log | Unary::Log10, _) if !upward => Some(Slope::Rising),
            Formula::Binary(Binary::Power, _, exponent) => match exponent.as_constant() {
                Some(p) if p.fract() != 0.0 && p > 0.0 && !upward => Some(Slope::Rising),
                Some(p) if p.fract() != 0.0 && p < 0.0 && upward => Some(Slope::Falling),
                _ => None,
            },
            _ => None,
        }
    }

    /// Whether a formula is proved never negative (`true`), or never positive.
    pub(super) fn sign(&mut self, formula: &Formula) -> Option<bool> {
        match self.range(formula) {
            range if range.is_non_negative() => Some(true),
            range if range.is_non_positive() => Some(false),
            _ => None,
        }
    }

    pub(super) fn range(&mut self, formula: &Formula) -> Interval {
        let items = std::mem::take(&mut self.items);
        let range = items.iter().map(|&item| self.ranges.of(&self.problem, formula, item)).reduce(Interval::union);
        self.items = items;
        range.unwrap_or(Interval::WHOLE)
    }
}
