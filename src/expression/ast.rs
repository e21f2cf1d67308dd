//! The syntax tree, every node with its place in the text. Names are not resolved here.

use super::Span;
use super::operators::{Binary, Comparison, Fold, Unary};
use crate::units::Unit;

/// One node and where it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct Ast {
    /// What it is.
    pub kind: AstKind,
    /// Where it stands.
    pub span: Span,
}

/// The shapes a node takes.
#[derive(Debug, Clone, PartialEq)]
pub enum AstKind {
    /// A literal number (finite).
    Number(f64),
    /// `12 kN/m`: a number, the unit, and the unit as it is written.
    Quantity(f64, Box<Unit>, Box<str>),
    /// `value(fck, "MPa")`: how many of a unit something is.
    ValueIn(Box<Ast>, Box<Unit>),
    /// `quantity(0.3*x, "MPa")`: as many of a unit as a plain number says.
    OfUnit(Box<Ast>, Box<Unit>),
    /// `"L0"`: text, in conditions only.
    Text(String),
    /// `depth`, `support.Ix`, `from.b`, `pi`: the dotted parts.
    Name(Vec<String>),
    /// `x[3]`, `x[n - 1]`: an array and its index, counted from 1.
    Index(Box<Ast>, Box<Ast>),
    /// `x[2..N]`: the elements of an array from one to another.
    Slice(Box<Ast>, Box<[Ast; 2]>),
    /// A function of one argument or a minus sign.
    Unary(Unary, Box<Ast>),
    /// An operator, or `atan2(y, x)`. (`min` and `max` parse to [`AstKind::Fold`].)
    Binary(Binary, Box<Ast>, Box<Ast>),
    /// `sum(c/x^3)`, `max(a, b)`: over the elements of arrays and over the arguments.
    Fold(Fold, Vec<Ast>),
    /// `sum(ribs where line == "L0": c*length)`: once per item of a collection.
    Over {
        /// How the items' values are joined.
        fold: Fold,
        /// Ribs or sections.
        collection: Collection,
        /// Which items; all when left out.
        filter: Option<Box<Condition>>,
        /// The value of one item.
        body: Box<Ast>,
    },
    /// `sum(i in 1..N: c[i]*x[i])`: once per whole number of a range.
    OverRange {
        /// How the values are joined.
        fold: Fold,
        /// The name that stands for the number.
        index: String,
        /// The first and the last number.
        ends: Box<[Ast; 2]>,
        /// The value at one number.
        body: Box<Ast>,
    },
    /// Any other call, by name (`profile(depth, 0.25)`): resolved later.
    Call(String, Vec<Ast>),
}

/// What a fold runs over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Collection {
    Ribs,
    Sections,
    Nodes,
}

/// `line == "L0"`, `h > 0.2`, joined by `and`, `or`, `not`: a choice among items, by data and parameters.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs)]
pub enum Condition {
    Compare(Comparison, Ast, Ast),
    And(Box<Condition>, Box<Condition>),
    Or(Box<Condition>, Box<Condition>),
    Not(Box<Condition>),
}

/// A `require`: `a <= b`, `a >= b`, `a == b` or `lo <= a <= hi`.
#[derive(Debug, Clone, PartialEq)]
#[allow(missing_docs)]
pub enum Requirement {
    /// `left (<=|>=|==) right`
    Two { comparison: Comparison, left: Ast, right: Ast },
    /// `lower <= middle <= upper` (or written with `>=` the other way round, already turned).
    Range { lower: Ast, middle: Ast, upper: Ast },
}
