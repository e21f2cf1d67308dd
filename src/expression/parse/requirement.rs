//! `require`: one comparison, or a range.

use super::condition::comparison_sign;
use super::cursor::Cursor;
use super::expression::expression;
use super::{Parsed, SyntaxError};
use crate::expression::Span;
use crate::expression::ast::{Ast, Requirement};
use crate::expression::operators::Comparison;

const FORMS: &str = "write a <= b, a >= b, a == b or lo <= a <= hi";

/// `a <= b`, `a >= b`, `a == b`, `lo <= a <= hi`, `hi >= a >= lo`
pub(super) fn requirement(cursor: &mut Cursor) -> Parsed<Requirement> {
    let first = expression(cursor)?;
    let Some((sign, place, second)) = comparison(cursor)? else {
        return Err(cursor.unexpected("an operator or a comparison").or_help(FORMS));
    };
    let Some((next, next_place, third)) = comparison(cursor)? else {
        return Ok(Requirement::Two { comparison: sign, left: first, right: second });
    };
    if comparison(cursor)?.is_some() {
        let error = SyntaxError::new(next_place, "more than two comparisons in a row");
        return Err(error.help(FORMS));
    }
    match (sign, next) {
        (Comparison::LessOrEqual, Comparison::LessOrEqual) => {
            Ok(Requirement::Range { lower: first, middle: second, upper: third })
        }
        (Comparison::GreaterOrEqual, Comparison::GreaterOrEqual) => {
            Ok(Requirement::Range { lower: third, middle: second, upper: first })
        }
        _ => {
            let place = if sign == Comparison::Equal { place } else { next_place };
            Err(SyntaxError::new(place, "these two comparisons make no range").help("write lo <= a <= hi"))
        }
    }
}

/// A sign a `require` may have, its place, and the side after it.
fn comparison(cursor: &mut Cursor) -> Parsed<Option<(Comparison, Span, Ast)>> {
    let place = cursor.span();
    let Some(sign) = comparison_sign(cursor)? else { return Ok(None) };
    let instead = match sign {
        Comparison::Less => Some(("<", "`<=`: an optimum may lie on the limit itself")),
        Comparison::Greater => Some((">", "`>=`: an optimum may lie on the limit itself")),
        Comparison::NotEqual => Some(("!=", "`<=`, `>=` or `==`")),
        Comparison::LessOrEqual | Comparison::GreaterOrEqual | Comparison::Equal => None,
    };
    if let Some((wrong, right)) = instead {
        let error = SyntaxError::new(place, format!("`{wrong}` cannot be required"));
        cursor.mistakes.push(error.help(format!("expected {right}")));
    }
    Ok(Some((sign, place, expression(cursor)?)))
}
