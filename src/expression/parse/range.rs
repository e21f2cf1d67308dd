//! `i in 1..N`: a name for the whole numbers of a range.

use super::cursor::Cursor;
use super::expression::expression;
use super::{Parsed, SyntaxError};
use crate::expression::ast::{Ast, AstKind};
use crate::expression::lexer::Word;
use crate::expression::operators::Fold;

/// `i in 1..N: body)`; the parenthesis before it is read.
pub(super) fn over(cursor: &mut Cursor, fold: Fold, index: &str) -> Parsed<AstKind> {
    let ends = ends(cursor)?;
    if !cursor.accept(":") {
        return Err(cursor.unexpected("an operator or `:`").or_help("as in sum(i in 1..N: c[i]*x[i])"));
    }
    let body = Box::new(cursor.nested(expression)?);
    cursor.expect(")")?;
    Ok(AstKind::OverRange { fold, index: index.to_owned(), ends: Box::new(ends), body })
}

/// The whole of a `for`.
pub(super) fn range(cursor: &mut Cursor) -> Parsed<(String, [Ast; 2])> {
    let (Some(Word::Name(index)), Some(Word::Name("in"))) = (cursor.peek(), cursor.ahead(1)) else {
        return Err(cursor.unexpected("a name and `in`").or_help("as in i in 1..N"));
    };
    if index.contains('.') {
        return Err(SyntaxError::new(cursor.span(), "an index is a plain name").help("as in i in 1..N"));
    }
    Ok((index.to_owned(), ends(cursor)?))
}

/// `i in 1..N`, from the name on.
fn ends(cursor: &mut Cursor) -> Parsed<[Ast; 2]> {
    cursor.advance();
    cursor.advance();
    let first = cursor.nested(expression)?;
    if !cursor.accept("..") {
        return Err(cursor.unexpected("an operator or `..`").or_help("as in i in 1..N"));
    }
    Ok([first, cursor.nested(expression)?])
}
