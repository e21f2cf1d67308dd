//! Text → tokens with their places.

use super::Span;
use super::SyntaxError;
use crate::units::{self, Unit};

/// One word of the language.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Word<'a> {
    Number(f64),
    /// The unit of the number before it.
    Unit(Unit, &'a str),
    /// A name with its dots: `support.Ix`.
    Name(&'a str),
    /// Text between quotes, without them.
    Text(&'a str),
    /// One of [`SYMBOLS`].
    Symbol(&'static str),
}

/// A word and its place.
#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    pub(super) kind: Word<'a>,
    pub(super) span: Span,
}

/// Longer ones first, so that `<=` is not read as `<`.
const SYMBOLS: [&str; 19] = ["..", "<=", ">=", "==", "!=", "<", ">", "=", "+", "-", "*", "/", "^", "(", ")", "[", "]", ",", ":"];

/// Signs other languages use, and what to write instead.
const FOREIGN: [(&str, &str); 20] = [
    ("°C", "K: temperatures are differences"),
    ("**", "^"),
    ("&&", "and"),
    ("||", "or"),
    ("≤", "<="),
    ("≥", ">="),
    ("≠", "!="),
    ("−", "-"),
    ("–", "-"),
    ("×", "*"),
    ("·", "*"),
    ("÷", "/"),
    ("²", "^2"),
    ("³", "^3"),
    ("π", "pi"),
    ("√", "sqrt(…)"),
    ("!", "not"),
    ("{", "("),
    ("}", ")"),
    (";", ","),
];

/// More mistakes than these help nobody.
const MISTAKES_SHOWN: usize = 10;

/// All tokens of a text, and what could not be read.
pub(super) fn tokens(text: &str) -> (Vec<Token<'_>>, Vec<SyntaxError>) {
    let mut lexer = Lexer { text, at: 0, tokens: Vec::new(), mistakes: Vec::new() };
    while lexer.at < text.len() && lexer.mistakes.len() < MISTAKES_SHOWN {
        lexer.step();
    }
    (lexer.tokens, lexer.mistakes)
}

struct Lexer<'a> {
    text: &'a str,
    at: usize,
    tokens: Vec<Token<'a>>,
    mistakes: Vec<SyntaxError>,
}

impl<'a> Lexer<'a> {
    fn rest(&self) -> &'a str {
        &self.text[self.at..]
    }

    fn step(&mut self) {
        let rest = self.rest();
        let space = rest.len() - rest.trim_start().len();
        if space > 0 {
            self.at += space;
        } else if begins_number(rest) {
            self.number();
        } else if rest.starts_with(is_letter) {
            self.name();
        } else if rest.starts_with(['"', '\'']) {
            self.quoted();
        } else if let Some((sign, instead)) = foreign(rest) {
            self.foreign(sign, instead);
        } else if let Some(symbol) = SYMBOLS.iter().find(|symbol| rest.starts_with(**symbol)) {
            self.push(Word::Symbol(symbol), symbol.len());
        } else {
            self.unknown();
        }
    }

    /// Takes `length` bytes and returns their place.
    fn take(&mut self, length: usize) -> Span {
        let start = self.at;
        self.at += length;
        Span { start, end: self.at }
    }

    fn push(&mut self, kind: Word<'a>, length: usize) {
        let span = self.take(length);
        self.tokens.push(Token { kind, span });
    }

    fn number(&mut self) {
        let rest = self.rest();
        let length = number_length(rest.as_bytes());
        match rest[..length].parse::<f64>() {
            Ok(value) if value.is_finite() => {
                self.push(Word::Number(value), length);
                self.unit();
            }
            _ => {
                let message = format!("the number `{}` is too large", &rest[..length]);
                let span = self.take(length);
                self.mistakes.push(SyntaxError::new(span, message).help("the largest number is about 1.8e308"));
            }
        }
    }

    /// The unit of the number just read, where one follows.
    fn unit(&mut self) {
        let rest = self.rest();
        let blanks = rest.len() - rest.trim_start().len();
        match units::scan(&rest[blanks..]) {
            Some(Ok((length, unit))) => {
                self.at += blanks;
                self.push(Word::Unit(unit, &rest[blanks..blanks + length]), length);
            }
            Some(Err(error)) => {
                self.at += blanks;
                let start = self.at;
                let span = Span { start: start + error.start, end: start + error.end };
                self.at = span.end;
                self.mistakes.push(SyntaxError::new(span, error.message).help(error.help));
            }
            None => {}
        }
    }

    fn name(&mut self) {
        let rest = self.rest();
        let mut length = word_length(rest);
        while rest[length..].starts_with('.') && rest[length + 1..].starts_with(is_letter) {
            length += 1 + word_length(&rest[length + 1..]);
        }
        let dot = self.at + length;
        self.push(Word::Name(&rest[..length]), length);
        if rest[length..].starts_with('.') && !rest[length..].starts_with("..") {
            let span = Span { start: dot, end: dot + 1 };
            self.at = dot + 1;
            self.mistakes.push(SyntaxError::new(span, "expected a name after the dot").help("as in support.Ix"));
        }
    }

    fn quoted(&mut self) {
        let rest = self.rest();
        let quote = &rest[..1];
        match rest[1..].find(quote) {
            Some(length) => self.push(Word::Text(&rest[1..=length]), length + 2),
            None => {
                let span = self.take(1);
                self.at = self.text.len();
                self.mistakes.push(SyntaxError::new(span, "this quotation mark is never closed"));
            }
        }
    }

    fn foreign(&mut self, sign: &str, instead: &str) {
        let span = self.take(sign.len());
        self.mistakes.push(SyntaxError::new(span, format!("`{sign}` is not known here")).help(said(instead)));
    }

    /// A run of characters that mean nothing, as one mistake.
    fn unknown(&mut self) {
        let rest = self.rest();
        let known = |c: char| c.is_whitespace() || c.is_ascii_alphanumeric() || "_.\"'<>=!+-*/^()[],:".contains(c);
        let first = rest.chars().next().map_or(0, char::len_utf8);
        let length = first + rest[first..].find(known).unwrap_or(rest.len() - first);
        let message = match rest.starts_with(char::is_control) {
            true => "a control character cannot be part of an expression".to_string(),
            false => format!("`{}` is not known here", &rest[..length]),
        };
        let span = self.take(length);
        self.mistakes.push(SyntaxError::new(span, message).help("names are made of A-Z, a-z, 0-9 and _"));
    }
}

/// The foreign sign a text begins with. Most signs of a large file stand for themselves, as their first byte and the one after tell.
fn foreign(text: &str) -> Option<&'static (&'static str, &'static str)> {
    let bytes = text.as_bytes();
    let may_be = match bytes.first()? {
        byte @ (b'*' | b'&' | b'|') => bytes.get(1) == Some(byte),
        b'!' => bytes.get(1) != Some(&b'='),
        byte => !byte.is_ascii() || matches!(byte, b'{' | b'}' | b';'),
    };
    if may_be { FOREIGN.iter().find(|(sign, _)| text.starts_with(sign)) } else { None }
}

/// The remedy for a foreign sign; what follows a colon is a reason.
fn said(instead: &str) -> String {
    match instead.split_once(": ") {
        Some((sign, reason)) => format!("write `{sign}`: {reason}"),
        None => format!("write `{instead}`"),
    }
}

fn is_letter(c: char) -> bool {
    c.is_ascii_alphabetic() || c == '_'
}

fn word_length(text: &str) -> usize {
    text.find(|c: char| !is_letter(c) && !c.is_ascii_digit()).unwrap_or(text.len())
}

fn begins_number(text: &str) -> bool {
    let digits = text.strip_prefix('.').unwrap_or(text);
    digits.starts_with(|c: char| c.is_ascii_digit())
}

/// The bytes of `12`, `1.`, `.5`, `1e-3` at the front.
fn number_length(bytes: &[u8]) -> usize {
    let digits = |from: usize| bytes[from..].iter().take_while(|byte| byte.is_ascii_digit()).count();
    let mut length = digits(0);
    // `1..N` is a range.
    if bytes.get(length) == Some(&b'.') && bytes.get(length + 1) != Some(&b'.') {
        length += 1 + digits(length + 1);
    }
    if let Some(b'e' | b'E') = bytes.get(length) {
        let sign = usize::from(matches!(bytes.get(length + 1), Some(b'+' | b'-')));
        let exponent = digits((length + 1 + sign).min(bytes.len()));
        if exponent > 0 {
            length += 1 + sign + exponent;
        }
    }
    length
}
