//! Formulas as users write them: parse, simplify, differentiate, evaluate.
//!
//! Text → [`ast::Ast`] (positions kept) → (names resolved elsewhere) → [`graph::Graph`] (hash-consed) → [`tape::Tape`]
//! (value, exact gradient and Hessian over a few inputs).

pub mod ast;
pub mod degree;
pub mod display;
pub mod graph;
pub mod kernel;
mod lexer;
pub mod operators;
pub mod parse;
pub mod structure;
pub mod substitute;
pub mod tape;
pub mod terms;

use thiserror::Error;

/// A range of bytes in the text of one expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}

/// What is wrong in a text, where, and what would be right.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{message}")]
pub struct SyntaxError {
    /// The bytes concerned; empty at the end of the text where something is missing.
    pub span: Span,
    /// What is wrong.
    pub message: String,
    /// What to write instead.
    pub help: Option<String>,
}

impl SyntaxError {
    fn new(span: Span, message: impl Into<String>) -> Self {
        SyntaxError { span, message: message.into(), help: None }
    }

    /// A remedy where there is none that fits better.
    fn or_help(self, help: &str) -> Self {
        match self.help {
            Some(_) => self,
            None => self.help(help),
        }
    }

    fn help(self, help: impl Into<String>) -> Self {
        SyntaxError { help: Some(help.into()), ..self }
    }
}
