//! Tokens → [`Ast`]: a recursive-descent parser that knows where everything stands.
//!
//! `^` binds tighter than the minus sign before it and to the right: `-2^2` = −4, `2^3^2` = 512, `2^-3` = 1/8.
//! Chains such as `a + b − c + …` become balanced trees, so that no tree is deep: the stack needed by whoever walks an
//! [`Ast`] stays bounded, however long the text.

mod chain;
mod condition;
mod cursor;
mod expression;
mod quantity;
mod range;
pub(crate) use expression::RESPONSES;
mod requirement;
#[cfg(test)]
mod tests;

pub use super::SyntaxError;
use super::ast::{Ast, Condition, Requirement};
use cursor::Cursor;

/// Where one rule of the grammar gets to: what it read, or the mistake after which nothing sensible follows.
type Parsed<T> = Result<T, SyntaxError>;

/// Parses an expression.
///
/// # Errors
/// Every mistake that could be told apart, at least one, in the order of the text.
///
/// ```
/// use ribopt::expression::parse::parse;
/// assert!(parse("b*h^3/12").is_ok());
/// let mistakes = parse("sqrt(b*h").unwrap_err();
/// assert_eq!(mistakes[0].span.start, 4);
/// ```
pub fn parse(text: &str) -> Result<Ast, Vec<SyntaxError>> {
    whole(text, expression::expression)
}

/// Parses a `require`: `a <= b`, `a >= b`, `a == b` or `lo <= a <= hi`.
///
/// # Errors
/// As [`parse`]; other comparisons and longer chains are mistakes.
pub fn parse_requirement(text: &str) -> Result<Requirement, Vec<SyntaxError>> {
    whole(text, requirement::requirement)
}

/// Parses a `where`: comparisons joined by `and`, `or`, `not`.
///
/// # Errors
/// As [`parse`].
pub fn parse_condition(text: &str) -> Result<Condition, Vec<SyntaxError>> {
    whole(text, condition::condition)
}

/// Parses a range such as `i in 1..N`: the name and its ends.
///
/// # Errors
/// As [`parse`].
pub fn parse_range(text: &str) -> Result<(String, [Ast; 2]), Vec<SyntaxError>> {
    whole(text, range::range)
}

fn whole<'a, T>(text: &'a str, rule: fn(&mut Cursor<'a>) -> Parsed<T>) -> Result<T, Vec<SyntaxError>> {
    let mut cursor = Cursor::new(text)?;
    let outcome = rule(&mut cursor).and_then(|tree| cursor.finish().map(|()| tree));
    let mut mistakes = cursor.mistakes;
    match outcome {
        Ok(tree) if mistakes.is_empty() => return Ok(tree),
        Ok(_) => {}
        Err(last) => mistakes.push(last),
    }
    mistakes.sort_by_key(|mistake| mistake.span.start);
    Err(mistakes)
}
