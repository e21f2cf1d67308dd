//! The tokens being read: where we are, what is next, what was found wrong.

use super::{Parsed, SyntaxError};
use crate::expression::Span;
use crate::expression::lexer::{self, Token, Word};

/// Levels of nesting (parentheses, calls, signs, powers) that are still read.
const NESTING_LIMIT: usize = 128;

/// A place in the token list.
pub(super) struct Cursor<'a> {
    text: &'a str,
    tokens: Vec<Token<'a>>,
    /// For an opening bracket, the index of its partner.
    partner: Vec<usize>,
    at: usize,
    nesting: usize,
    /// Mistakes after which reading goes on.
    pub(super) mistakes: Vec<SyntaxError>,
}

impl<'a> Cursor<'a> {
    /// The start of a text; brackets are matched here, so that an unclosed one is reported where it opens.
    pub(super) fn new(text: &'a str) -> Result<Self, Vec<SyntaxError>> {
        let (tokens, mut mistakes) = lexer::tokens(text);
        let partner = match_brackets(&tokens, &mut mistakes);
        mistakes.sort_by_key(|mistake| mistake.span.start);
        match mistakes.is_empty() {
            true => Ok(Cursor { text, tokens, partner, at: 0, nesting: 0, mistakes }),
            false => Err(mistakes),
        }
    }

    /// The next token's kind.
    pub(super) fn peek(&self) -> Option<Word<'a>> {
        self.ahead(0)
    }

    /// The kind of the token `distance` further on.
    pub(super) fn ahead(&self, distance: usize) -> Option<Word<'a>> {
        self.tokens.get(self.at + distance).map(|token| token.kind)
    }

    /// Whether the call that was just opened ends with a text.
    pub(super) fn is_before_text(&self) -> bool {
        let closing = self.at.checked_sub(1).and_then(|open| self.partner.get(open));
        let last = closing.and_then(|&closing| self.tokens.get(closing.checked_sub(1)?));
        last.is_some_and(|token| matches!(token.kind, Word::Text(_)))
    }

    /// The token after the partner of the bracket that comes next.
    pub(super) fn after_partner(&self) -> Option<Word<'a>> {
        let partner = self.partner.get(self.at)?;
        self.tokens.get(partner + 1).map(|token| token.kind)
    }

    /// The place of the next token, or the end of the text.
    pub(super) fn span(&self) -> Span {
        let end = self.text.len();
        self.tokens.get(self.at).map_or(Span { start: end, end }, |token| token.span)
    }

    /// From `start` to the end of the last token read.
    pub(super) fn since(&self, start: usize) -> Span {
        let end = self.at.checked_sub(1).and_then(|last| self.tokens.get(last)).map_or(start, |token| token.span.end);
        Span { start, end: end.max(start) }
    }

    /// Goes past the next token.
    pub(super) fn advance(&mut self) {
        self.at += 1;
    }

    /// Goes past `symbol` if it is next.
    pub(super) fn accept(&mut self, symbol: &str) -> bool {
        let found = matches!(self.peek(), Some(Word::Symbol(next)) if next == symbol);
        self.at += usize::from(found);
        found
    }

    /// Goes past `word` if it is next.
    pub(super) fn accept_word(&mut self, word: &str) -> bool {
        let found = self.peek() == Some(Word::Name(word));
        self.at += usize::from(found);
        found
    }

    /// Goes past `symbol`, which must be next.
    pub(super) fn expect(&mut self, symbol: &str) -> Parsed<()> {
        if self.accept(symbol) { Ok(()) } else { Err(self.unexpected(&format!("an operator or `{symbol}`"))) }
    }

    /// The text up to the comma or closing bracket that ends an argument, taken as it stands; `None` where there is none.
    pub(super) fn raw_argument(&mut self) -> Option<(&'a str, Span)> {
        let (mut at, mut depth) = (self.at, 0usize);
        loop {
            match self.tokens.get(at)?.kind {
                Word::Symbol("," | ")") if depth == 0 => break,
                Word::Symbol("(") => depth += 1,
                Word::Symbol(")") => depth -= 1,
                _ => {}
            }
            at += 1;
        }
        let (first, last) =
            (self.tokens.get(self.at)?.span, self.tokens[at.checked_sub(1).filter(|&last| last >= self.at)?].span);
        self.at = at;
        let span = Span { start: first.start, end: last.end };
        Some((&self.text[span.start..span.end], span))
    }

    /// The text must end here.
    pub(super) fn finish(&self) -> Parsed<()> {
        if self.at >= self.tokens.len() { Ok(()) } else { Err(self.unexpected("an operator or the end")) }
    }

    /// Runs `rule` one level deeper.
    pub(super) fn nested<T>(&mut self, rule: impl FnOnce(&mut Self) -> Parsed<T>) -> Parsed<T> {
        if self.nesting >= NESTING_LIMIT {
            let message = format!("more than {NESTING_LIMIT} levels of nesting");
            return Err(SyntaxError::new(self.span(), message).help("name a part of it in [definitions]"));
        }
        self.nesting += 1;
        let outcome = rule(self);
        self.nesting -= 1;
        outcome
    }

    /// The mistake of finding the next token where `wanted` should stand.
    pub(super) fn unexpected(&self, wanted: &str) -> SyntaxError {
        let span = self.span();
        let Some(found) = self.peek() else {
            let what = if self.tokens.is_empty() { "the text is empty" } else { "the text ends here" };
            return SyntaxError::new(span, format!("expected {wanted}, but {what}"));
        };
        let error = SyntaxError::new(span, format!("expected {wanted}, found `{}`", &self.text[span.start..span.end]));
        let operator = wanted.contains("operator");
        let after_number = self.tokens[..self.at].last().is_some_and(|token| matches!(token.kind, Word::Number(_)));
        match found {
            Word::Name(_) if operator && after_number => {
                error.help("a product is written with `*`; this is no unit (known: mm, m, kN, MPa, kN/m, kg/m^3, …)")
            }
            Word::Number(_) | Word::Name(_) | Word::Symbol("(") if operator => error.help("a product is written with `*`"),
            Word::Symbol(",") if operator => error.help("a decimal is written with a point: 0.5"),
            Word::Symbol("<" | ">" | "<=" | ">=" | "==" | "!=" | "=") => error.help("a comparison cannot stand here"),
            Word::Symbol("[") => error.help("an index follows a name, as in x[3]"),
            _ => error,
        }
    }
}

fn match_brackets(tokens: &[Token], mistakes: &mut Vec<SyntaxError>) -> Vec<usize> {
    let mut partner = vec![0; tokens.len()];
    let mut open: Vec<(usize, &str)> = Vec::new();
    for (index, token) in tokens.iter().enumerate() {
        match token.kind {
            Word::Symbol("(") => open.push((index, ")")),
            Word::Symbol("[") => open.push((index, "]")),
            Word::Symbol(sign @ (")" | "]")) => match open.pop() {
                Some((start, wanted)) if wanted == sign => partner[start] = index,
                Some((start, wanted)) => {
                    let message = format!("expected `{wanted}`, found `{sign}`");
                    mistakes.push(SyntaxError::new(token.span, message).help(opened_at(tokens[start].span)));
                    return partner;
                }
                None => mistakes.push(SyntaxError::new(token.span, format!("this `{sign}` closes nothing"))),
            },
            _ => {}
        }
    }
    for (index, wanted) in open {
        mistakes.push(SyntaxError::new(tokens[index].span, format!("this bracket is never closed: expected `{wanted}`")));
    }
    partner
}

fn opened_at(span: Span) -> String {
    format!("the bracket was opened at character {}", span.start + 1)
}
