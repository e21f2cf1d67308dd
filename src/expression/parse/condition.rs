//! `where`: comparisons joined by `and`, `or`, `not`.

use super::cursor::Cursor;
use super::expression::expression;
use super::{Parsed, SyntaxError};
use crate::expression::ast::{Ast, AstKind, Condition};
use crate::expression::lexer::Word;
use crate::expression::operators::Comparison;

/// `a or b or …`
pub(super) fn condition(cursor: &mut Cursor) -> Parsed<Condition> {
    let mut parts = vec![conjunction(cursor)?];
    while cursor.accept_word("or") {
        parts.push(conjunction(cursor)?);
    }
    Ok(balanced(parts, Condition::Or))
}

/// `a and b and …`
fn conjunction(cursor: &mut Cursor) -> Parsed<Condition> {
    let mut parts = vec![negation(cursor)?];
    while cursor.accept_word("and") {
        parts.push(negation(cursor)?);
    }
    Ok(balanced(parts, Condition::And))
}

fn negation(cursor: &mut Cursor) -> Parsed<Condition> {
    if cursor.accept_word("not") {
        return Ok(Condition::Not(Box::new(cursor.nested(negation)?)));
    }
    if !parenthesised(cursor) {
        return comparison(cursor);
    }
    cursor.advance();
    let inner = cursor.nested(condition)?;
    cursor.expect(")")?;
    Ok(inner)
}

/// Whether the parenthesis that comes next holds a condition, not the beginning of a number: told by what follows it.
fn parenthesised(cursor: &Cursor) -> bool {
    cursor.peek() == Some(Word::Symbol("("))
        && matches!(cursor.after_partner(), None | Some(Word::Name("and" | "or") | Word::Symbol(")" | ":")))
}

fn comparison(cursor: &mut Cursor) -> Parsed<Condition> {
    let left = operand(cursor)?;
    let Some(sign) = comparison_sign(cursor)? else {
        return Err(cursor.unexpected("an operator or a comparison").or_help("as in h > 0.2 or line == \"L0\""));
    };
    let right = operand(cursor)?;
    let span = cursor.span();
    if comparison_sign(cursor)?.is_some() {
        let error = SyntaxError::new(span, "a second comparison cannot follow");
        return Err(error.help("join two with `and`: 0.1 < h and h < 0.3"));
    }
    Ok(Condition::Compare(sign, left, right))
}

fn operand(cursor: &mut Cursor) -> Parsed<Ast> {
    let span = cursor.span();
    match cursor.peek() {
        Some(Word::Text(text)) => {
            cursor.advance();
            Ok(Ast { kind: AstKind::Text(text.to_string()), span })
        }
        _ => cursor.nested(expression),
    }
}

/// Goes past a comparison sign, if one is next.
pub(super) fn comparison_sign(cursor: &mut Cursor) -> Parsed<Option<Comparison>> {
    let sign = match cursor.peek() {
        Some(Word::Symbol("<=")) => Comparison::LessOrEqual,
        Some(Word::Symbol(">=")) => Comparison::GreaterOrEqual,
        Some(Word::Symbol("==")) => Comparison::Equal,
        Some(Word::Symbol("!=")) => Comparison::NotEqual,
        Some(Word::Symbol("<")) => Comparison::Less,
        Some(Word::Symbol(">")) => Comparison::Greater,
        Some(Word::Symbol("=")) => {
            return Err(SyntaxError::new(cursor.span(), "`=` is no comparison").help("equality is written `==`"));
        }
        _ => return Ok(None),
    };
    cursor.advance();
    Ok(Some(sign))
}

/// Joins the parts in halves, so that a long list makes no deep tree.
fn balanced(mut parts: Vec<Condition>, join: fn(Box<Condition>, Box<Condition>) -> Condition) -> Condition {
    while parts.len() > 1 {
        let mut pairs = parts.into_iter();
        let mut joined = Vec::with_capacity(pairs.len().div_ceil(2));
        while let Some(left) = pairs.next() {
            joined.push(match pairs.next() {
                Some(right) => join(Box::new(left), Box::new(right)),
                None => left,
            });
        }
        parts = joined;
    }
    parts.swap_remove(0) // callers give at least one part
}
