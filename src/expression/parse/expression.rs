//! Sums, products, powers, names, calls.

use super::chain::{self, Rank};
use super::condition::condition;
use super::cursor::Cursor;
use super::{Parsed, SyntaxError, quantity, range};
use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Collection};
use crate::expression::lexer::Word;
use crate::expression::operators::{Binary, Fold, Unary};

const SUM: Rank = Rank { join: Binary::Add, take: Binary::Subtract };
const PRODUCT: Rank = Rank { join: Binary::Multiply, take: Binary::Divide };

/// Words of conditions, which cannot be names.
const KEYWORDS: [&str; 4] = ["where", "and", "or", "not"];

/// `term ± term ± …`
pub(super) fn expression(cursor: &mut Cursor) -> Parsed<Ast> {
    let first = product(cursor)?;
    let mut links = Vec::new();
    loop {
        let taken = cursor.accept("-");
        if !taken && !cursor.accept("+") {
            return Ok(chain::tree(SUM, first, links));
        }
        links.push((taken, product(cursor)?));
    }
}

/// `factor * factor / …`
fn product(cursor: &mut Cursor) -> Parsed<Ast> {
    let first = signed(cursor)?;
    let mut links = Vec::new();
    loop {
        let taken = cursor.accept("/");
        if !taken && !cursor.accept("*") {
            return Ok(chain::tree(PRODUCT, first, links));
        }
        links.push((taken, signed(cursor)?));
    }
}

/// `-x`, `+x`, or a power.
fn signed(cursor: &mut Cursor) -> Parsed<Ast> {
    let start = cursor.span().start;
    if cursor.accept("-") {
        let operand = cursor.nested(signed)?;
        return Ok(Ast { kind: AstKind::Unary(Unary::Negate, Box::new(operand)), span: cursor.since(start) });
    }
    if cursor.accept("+") {
        return cursor.nested(signed);
    }
    power(cursor)
}

/// `base ^ exponent`; the exponent may have a sign and a power of its own.
fn power(cursor: &mut Cursor) -> Parsed<Ast> {
    let start = cursor.span().start;
    let base = atom(cursor)?;
    if !cursor.accept("^") {
        return Ok(base);
    }
    let exponent = cursor.nested(signed)?;
    Ok(Ast { kind: AstKind::Binary(Binary::Power, Box::new(base), Box::new(exponent)), span: cursor.since(start) })
}

fn atom(cursor: &mut Cursor) -> Parsed<Ast> {
    let start = cursor.span().start;
    let kind = match cursor.peek() {
        Some(Word::Number(value)) => {
            cursor.advance();
            match cursor.peek() {
                Some(Word::Unit(unit, text)) => {
                    cursor.advance();
                    AstKind::Quantity(value, Box::new(unit), text.into())
                }
                _ => AstKind::Number(value),
            }
        }
        Some(Word::Symbol("(")) => {
            cursor.advance();
            let inner = cursor.nested(expression)?;
            cursor.expect(")")?;
            inner.kind
        }
        Some(Word::Name(name)) if !KEYWORDS.contains(&name) => named(cursor, name)?,
        Some(Word::Text(_)) => {
            let error = SyntaxError::new(cursor.span(), "text is no number");
            return Err(error.help("text stands in conditions only: line == \"L0\""));
        }
        _ => return Err(cursor.unexpected("a number, a name or `(`")),
    };
    Ok(Ast { kind, span: cursor.since(start) })
}

/// A name, its index, or its arguments.
fn named(cursor: &mut Cursor, name: &str) -> Parsed<AstKind> {
    let span = cursor.span();
    cursor.advance();
    let parts = || AstKind::Name(name.split('.').map(str::to_string).collect());
    match cursor.peek() {
        Some(Word::Symbol("(")) => call(cursor, name, span),
        Some(Word::Symbol("[")) => {
            cursor.advance();
            let (base, index) = (Box::new(Ast { kind: parts(), span }), cursor.nested(expression)?);
            let last = if cursor.accept("..") { Some(cursor.nested(expression)?) } else { None };
            cursor.expect("]")?;
            Ok(match last {
                Some(last) => AstKind::Slice(base, Box::new([index, last])),
                None => AstKind::Index(base, Box::new(index)),
            })
        }
        _ => Ok(parts()),
    }
}

/// `name(arguments)`, or a fold over ribs or sections; the parenthesis is next.
fn call(cursor: &mut Cursor, name: &str, place: Span) -> Parsed<AstKind> {
    cursor.advance();
    let fold = fold(name);
    if let (Some(fold), Some(collection)) = (fold, collection_ahead(cursor)) {
        return over(cursor, fold, collection);
    }
    if let (Some(fold), Some(Word::Name(index)), Some(Word::Name("in"))) = (fold, cursor.peek(), cursor.ahead(1)) {
        return range::over(cursor, fold, index);
    }
    if matches!(name, "value" | "quantity") && cursor.is_before_text() {
        return quantity::measured(cursor, name == "value");
    }
    let arguments =
        if RESPONSES.contains(&name) { words_or_expressions(cursor, name != "frequency")? } else { arguments(cursor)? };
    let span = cursor.since(place.start);
    if let Some(fold) = fold {
        check_arity(cursor, name, span, arguments.len(), 1, usize::MAX);
        return Ok(AstKind::Fold(fold, arguments));
    }
    if matches!(name, "atan2" | "dot") {
        check_arity(cursor, name, span, arguments.len(), 2, 2);
        let mut given = arguments.into_iter();
        return Ok(match (given.next(), given.next()) {
            (Some(y), Some(x)) if name == "atan2" => AstKind::Binary(Binary::Atan2, Box::new(y), Box::new(x)),
            (Some(a), Some(b)) => {
                let product = AstKind::Binary(Binary::Multiply, Box::new(a), Box::new(b));
                AstKind::Fold(Fold::Sum, vec![Ast { kind: product, span }])
            }
            _ => AstKind::Number(0.0), // the mistake is noted
        });
    }
    if name == "quadratic" {
        check_arity(cursor, name, span, arguments.len(), 2, 2);
    }
    if let Some(function) = unary(name) {
        check_arity(cursor, name, span, arguments.len(), 1, 1);
        return Ok(match arguments.into_iter().next() {
            Some(argument) => AstKind::Unary(function, Box::new(argument)),
            None => AstKind::Number(0.0), // the mistake is noted
        });
    }
    if name.contains('.') {
        let error = SyntaxError::new(place, format!("`{name}` is no function"));
        cursor.mistakes.push(error.help("a product is written with `*`"));
    }
    Ok(AstKind::Call(name.to_string(), arguments))
}

/// Functions whose arguments may be words: names of cases, ribs, nodes and points, which may hold a hyphen or stand in quotes.
pub(crate) const RESPONSES: [&str; 10] =
    ["disp", "deflection", "sag", "force", "stress", "vonmises", "reaction", "compliance", "buckling", "frequency"];

/// The arguments of a response.
fn words_or_expressions(cursor: &mut Cursor, case_first: bool) -> Parsed<Vec<Ast>> {
    let mut list = Vec::new();
    if cursor.accept(")") {
        return Ok(list);
    }
    loop {
        let case = if case_first && list.is_empty() { case(cursor) } else { None };
        list.push(match case.or_else(|| word(cursor)) {
            Some(word) => word,
            None => cursor.nested(expression)?,
        });
        if cursor.accept(")") {
            return Ok(list);
        }
        if !cursor.accept(",") {
            return Err(cursor.unexpected("an operator, `,` or `)`"));
        }
    }
}

/// The name of a case or combination, as it stands: `ULS`, `1.35G+1.5Q`, or anything in quotes.
fn case(cursor: &mut Cursor) -> Option<Ast> {
    if matches!(cursor.peek(), Some(Word::Text(_))) {
        return None;
    }
    let (text, span) = cursor.raw_argument()?;
    Some(Ast { kind: AstKind::Text(text.to_string()), span })
}

/// Text in quotes, or names and numbers joined by hyphens (`top-left`, `web-centre`) that end the argument.
fn word(cursor: &mut Cursor) -> Option<Ast> {
    let start = cursor.span().start;
    if let Some(Word::Text(text)) = cursor.peek() {
        let text = text.to_string();
        cursor.advance();
        return Some(Ast { kind: AstKind::Text(text), span: cursor.since(start) });
    }
    let mut ahead = 0;
    let mut parts: Vec<String> = Vec::new();
    loop {
        match cursor.ahead(ahead)? {
            Word::Name(name) if !name.contains('.') => parts.push(name.to_string()),
            Word::Number(number) if ahead > 0 => parts.push(number.to_string()),
            _ => return None,
        }
        match cursor.ahead(ahead + 1)? {
            Word::Symbol("-") => ahead += 2,
            Word::Symbol("," | ")") if ahead > 0 => break,
            _ => return None,
        }
    }
    (0..=ahead).for_each(|_| cursor.advance());
    Some(Ast { kind: AstKind::Text(parts.join("-")), span: cursor.since(start) })
}

/// The arguments up to and with the closing parenthesis.
fn arguments(cursor: &mut Cursor) -> Parsed<Vec<Ast>> {
    let mut list = Vec::new();
    if cursor.accept(")") {
        return Ok(list);
    }
    loop {
        list.push(cursor.nested(expression)?);
        if cursor.accept(")") {
            return Ok(list);
        }
        if !cursor.accept(",") {
            return Err(cursor.unexpected("an operator, `,` or `)`"));
        }
    }
}

fn check_arity(cursor: &mut Cursor, name: &str, span: Span, given: usize, least: usize, most: usize) {
    if (least..=most).contains(&given) {
        return;
    }
    let plural = if least == 1 { "" } else { "s" };
    let at_least = if most == usize::MAX { "at least " } else { "" };
    let message = format!("`{name}` takes {at_least}{least} argument{plural}, not {given}");
    cursor.mistakes.push(SyntaxError::new(span, message));
}

/// `ribs`, `sections` or `nodes`, where a colon or a filter follows.
fn collection_ahead(cursor: &Cursor) -> Option<Collection> {
    let collection = match cursor.peek() {
        Some(Word::Name("ribs")) => Collection::Ribs,
        Some(Word::Name("sections")) => Collection::Sections,
        Some(Word::Name("nodes")) => Collection::Nodes,
        _ => return None,
    };
    matches!(cursor.ahead(1), Some(Word::Symbol(":") | Word::Name("where"))).then_some(collection)
}

/// `ribs where condition: body)`
fn over(cursor: &mut Cursor, fold: Fold, collection: Collection) -> Parsed<AstKind> {
    cursor.advance();
    let filter = match cursor.accept_word("where") {
        true => Some(Box::new(cursor.nested(condition)?)),
        false => None,
    };
    if !cursor.accept(":") {
        return Err(cursor.unexpected("an operator or `:`").help("as in sum(ribs where line == \"L0\": length)"));
    }
    let body = Box::new(cursor.nested(expression)?);
    cursor.expect(")")?;
    Ok(AstKind::Over { fold, collection, filter, body })
}

fn fold(name: &str) -> Option<Fold> {
    match name {
        "sum" => Some(Fold::Sum),
        "min" => Some(Fold::Min),
        "max" => Some(Fold::Max),
        _ => None,
    }
}

fn unary(name: &str) -> Option<Unary> {
    Unary::NAMED.iter().find(|(known, _)| *known == name).map(|&(_, function)| function)
}
