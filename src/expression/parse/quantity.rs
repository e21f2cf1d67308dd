//! `value(x, "MPa")` and `quantity(x, "MPa")`.

use super::cursor::Cursor;
use super::expression::expression;
use super::{Parsed, SyntaxError};
use crate::expression::Span;
use crate::expression::ast::AstKind;
use crate::expression::lexer::Word;
use crate::units::Unit;

/// `value(x, "MPa")`, `quantity(x, "MPa")`; the parenthesis is read.
pub(super) fn measured(cursor: &mut Cursor, value: bool) -> Parsed<AstKind> {
    let inner = Box::new(cursor.nested(expression)?);
    cursor.expect(",")?;
    let (Some(Word::Text(text)), span) = (cursor.peek(), cursor.span()) else {
        return Err(cursor.unexpected("a unit in quotes"));
    };
    cursor.advance();
    cursor.expect(")")?;
    match Unit::parse(text) {
        Ok(unit) if value => Ok(AstKind::ValueIn(inner, Box::new(unit))),
        Ok(unit) => Ok(AstKind::OfUnit(inner, Box::new(unit))),
        Err(error) => {
            // The quotation mark comes first.
            let span = Span { start: span.start + 1 + error.start, end: span.start + 1 + error.end };
            Err(SyntaxError::new(span, error.message).help(error.help))
        }
    }
}
