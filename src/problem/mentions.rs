//! Which names an expression mentions, for finding an order among definitions and links.

use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind, Condition};

/// One name in an expression.
#[derive(Debug, Clone, PartialEq)]
pub struct Mention<'a> {
    /// Its dotted parts.
    pub parts: &'a [String],
    /// Its index, where that is a number: 2 of `wall.thickness[2]`.
    pub index: Option<u32>,
    /// Where it stands.
    pub span: Span,
    /// True inside a fold over ribs or sections, where the items' names hold.
    pub in_fold: bool,
}

/// Every name mentioned, in the order of the text; and whether there is a fold over ribs or sections.
pub fn mentions(ast: &Ast) -> (Vec<Mention<'_>>, bool) {
    let mut found = Found { mentions: Vec::new(), depth: 0, folds: false };
    found.expression(ast);
    (found.mentions, found.folds)
}

struct Found<'a> {
    mentions: Vec<Mention<'a>>,
    depth: usize,
    folds: bool,
}

impl<'a> Found<'a> {
    fn expression(&mut self, ast: &'a Ast) {
        match &ast.kind {
            AstKind::Number(_) | AstKind::Quantity(..) | AstKind::Text(_) => {}
            AstKind::ValueIn(inner, _) | AstKind::OfUnit(inner, _) => self.expression(inner),
            AstKind::Name(parts) => self.name(parts, None, ast.span),
            AstKind::Unary(_, operand) => self.expression(operand),
            AstKind::Index(base, index) => match (&base.kind, &index.kind) {
                (AstKind::Name(parts), AstKind::Number(number)) => self.name(parts, Some(*number as u32), ast.span),
                _ => {
                    self.expression(base);
                    self.expression(index);
                }
            },
            AstKind::Slice(base, ends) => {
                self.expression(base);
                ends.iter().for_each(|end| self.expression(end));
            }
            // A profile's name is no name of the item's, whatever the item is.
            AstKind::Call(name, list) if name == "profile" => list.iter().skip(1).for_each(|part| self.expression(part)),
            AstKind::Binary(_, left, right) => {
                self.expression(left);
                self.expression(right);
            }
            AstKind::Fold(_, list) | AstKind::Call(_, list) => list.iter().for_each(|part| self.expression(part)),
            AstKind::OverRange { ends, body, .. } => {
                ends.iter().for_each(|end| self.expression(end));
                self.expression(body);
            }
            AstKind::Over { filter, body, .. } => {
                (self.folds, self.depth) = (true, self.depth + 1);
                if let Some(filter) = filter {
                    self.condition(filter);
                }
                self.expression(body);
                self.depth -= 1;
            }
        }
    }

    fn name(&mut self, parts: &'a [String], index: Option<u32>, span: Span) {
        self.mentions.push(Mention { parts, index, span, in_fold: self.depth > 0 });
    }

    fn condition(&mut self, condition: &'a Condition) {
        match condition {
            Condition::Compare(_, left, right) => {
                self.expression(left);
                self.expression(right);
            }
            Condition::And(left, right) | Condition::Or(left, right) => {
                self.condition(left);
                self.condition(right);
            }
            Condition::Not(inner) => self.condition(inner),
        }
    }
}
