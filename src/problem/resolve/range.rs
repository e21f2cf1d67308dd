//! `sum(i in 1..N: …)`: folds over the whole numbers of a range.

use super::{Resolver, join};
use crate::expression::Span;
use crate::expression::ast::Ast;
use crate::expression::operators::Fold;
use crate::problem::Formula;
use crate::problem::mistake_code::MistakeCode;

/// Numbers of one range: a term is written out for each.
pub const MOST_NUMBERS: f64 = 1e6;

impl Resolver<'_, '_> {
    /// The fold, a term per number.
    pub(super) fn over_range(&mut self, fold: Fold, index: &str, ends: &[Ast; 2], body: &Ast, span: Span) -> Option<Formula> {
        let numbers = self.range(ends, span)?;
        let mut list = Vec::new();
        for number in numbers {
            self.indices.push((index.to_owned(), number as f64));
            let value = self.scalar(body);
            self.indices.pop();
            list.push(value?);
        }
        if list.is_empty() {
            return match fold {
                Fold::Sum => Some(Formula::Constant(0.0)),
                _ => self.mistake(
                    MistakeCode::NumberRange,
                    span,
                    "a range without numbers has no least and no largest one",
                    Some("its first number comes first".into()),
                ),
            };
        }
        self.known(join(fold, list), span)
    }

    /// The numbers between two constant ends, none where the first is above the last.
    pub fn range(&mut self, ends: &[Ast; 2], span: Span) -> Option<std::ops::RangeInclusive<i64>> {
        let mut numbers = [0_i64; 2];
        for (end, number) in ends.iter().zip(&mut numbers) {
            let formula = self.scalar(end)?;
            let Formula::Constant(value) = formula else {
                return self.mistake(
                    MistakeCode::NotConstant,
                    end.span,
                    "this end of the range is not constant",
                    Some("numbers and parameters may occur here".into()),
                );
            };
            if value.fract() != 0.0 || value.abs() > MOST_NUMBERS {
                let message = format!("a range cannot end at {}", crate::problem::words::brief(value));
                return self.mistake(
                    MistakeCode::NumberRange,
                    end.span,
                    message,
                    Some(format!("expected a whole number of at most {MOST_NUMBERS}")),
                );
            }
            *number = value as i64;
        }
        let [first, last] = numbers;
        if (last - first) as f64 >= MOST_NUMBERS {
            return self.mistake(
                MistakeCode::NumberRange,
                span,
                "this range is too long",
                Some(format!("expected at most {MOST_NUMBERS} numbers")),
            );
        }
        Some(first..=last)
    }
}
