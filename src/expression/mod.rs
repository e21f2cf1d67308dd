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

/// A range of bytes in the text of one expression.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Span {
    /// First byte.
    pub start: usize,
    /// One past the last byte.
    pub end: usize,
}
