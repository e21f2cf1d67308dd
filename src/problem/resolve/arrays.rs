//! Parts of arrays, and quadratic forms.

use super::{Resolver, Value, binary, join};
use crate::expression::Span;
use crate::expression::ast::Ast;
use crate::expression::operators::{Binary, Fold};
use crate::problem::Formula;
use crate::problem::mistake_code::MistakeCode;

impl Resolver<'_, '_> {
    /// `x[2..N]`: the elements from one to another, both included.
    pub(super) fn slice(&mut self, base: &Ast, ends: &[Ast; 2], span: Span) -> Option<Value> {
        let (array, numbers) = (self.value(base), self.range(ends, span));
        let (Value::Array(list), numbers) = (array?, numbers?) else {
            let help = Some("leave the brackets out".into());
            return self.mistake(MistakeCode::ArraySize, base.span, "this is one number, not an array", help);
        };
        let (first, last) = (*numbers.start(), *numbers.end());
        if first < 1 || last > list.len() as i64 || first > last {
            let message = format!("there are no elements {first} to {last}");
            let help = format!("elements are counted from 1 to {}, and a part has one at least", list.len());
            return self.mistake(MistakeCode::ArraySize, span, message, Some(help));
        }
        Some(Value::Array(list[first as usize - 1..last as usize].to_vec()))
    }

    /// `quadratic(Q, x)` = Σᵢⱼ Qᵢⱼ·xᵢ·xⱼ of n·n numbers, row by row, and n elements.
    pub(super) fn quadratic(&mut self, arguments: &[Ast], span: Span) -> Option<Formula> {
        let [matrix, vector] = arguments else { return None }; // the parser has told it
        let (matrix, vector) = (self.value(matrix), self.value(vector));
        let (matrix, vector) = (matrix?.into_list(), vector?.into_list());
        let n = vector.len();
        if matrix.len() != n * n {
            let message = format!("a matrix of {} numbers does not go with {n} elements", matrix.len());
            return self.mistake(MistakeCode::ArraySize, span, message, Some(format!("expected {n} rows of {n} numbers")));
        }
        let mut terms = Vec::new();
        for i in 0..n {
            for j in 0..=i {
                // Both places of a product together: it occurs once.
                let factor = match i == j {
                    true => matrix[i * n + i].clone(),
                    false => binary(Binary::Add, matrix[i * n + j].clone(), matrix[j * n + i].clone()),
                };
                if factor != Formula::Constant(0.0) {
                    let product = match i == j {
                        true => binary(Binary::Power, vector[i].clone(), Formula::Constant(2.0)),
                        false => binary(Binary::Multiply, vector[i].clone(), vector[j].clone()),
                    };
                    terms.push(binary(Binary::Multiply, factor, product));
                }
            }
        }
        if terms.is_empty() {
            return Some(Formula::Constant(0.0));
        }
        self.known(join(Fold::Sum, terms), span)
    }
}
