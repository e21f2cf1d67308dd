//! Chains of operators of one rank, as trees of little depth.

use crate::expression::Span;
use crate::expression::ast::{Ast, AstKind};
use crate::expression::operators::Binary;

/// Chains up to this length are joined from left to right, as written.
const LEFT_TO_RIGHT: usize = 8;

/// One link: whether it is taken away (subtracted, divided by) instead of joined, and its value.
pub(super) type Link = (bool, Ast);

/// The operators of a chain.
#[derive(Clone, Copy)]
pub(super) struct Rank {
    /// `+` or `*`
    pub(super) join: Binary,
    /// `-` or `/`
    pub(super) take: Binary,
}

/// `first ± second ± …`: left to right where short; else halved, `a − b − c − d` as `(a − b) − (c + d)`.
pub(super) fn tree(rank: Rank, first: Ast, mut links: Vec<Link>) -> Ast {
    if links.len() < LEFT_TO_RIGHT {
        return links.into_iter().fold(first, |left, (taken, right)| join(rank, taken, left, right));
    }
    let mut tail = links.split_off(links.len() / 2).into_iter();
    let left = tree(rank, first, links);
    let Some((taken, head)) = tail.next() else { return left };
    let right = tree(rank, head, tail.map(|(other, link)| (other != taken, link)).collect());
    join(rank, taken, left, right)
}

fn join(rank: Rank, taken: bool, left: Ast, right: Ast) -> Ast {
    let span = Span { start: left.span.start, end: right.span.end };
    let op = if taken { rank.take } else { rank.join };
    Ast { kind: AstKind::Binary(op, Box::new(left), Box::new(right)), span }
}
