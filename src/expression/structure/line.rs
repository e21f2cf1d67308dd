//! Whether a node depends on one input alone, and whether it rises or falls in it.

use super::{Interval, Slope, Structure};
use crate::expression::graph::{Node, NodeId};

/// On which inputs a node depends.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Line {
    /// On none.
    Free,
    /// On one alone.
    One(u32, Slope),
    /// On several.
    Many,
}

/// Of a node whose operands are known.
pub(super) fn line(node: Node, interval: Interval, known: &[Structure]) -> Line {
    let of = |id: NodeId| known[id as usize];
    match node {
        Node::Constant(_) | Node::Data(_) => Line::Free,
        Node::Input(_) if interval.as_point().is_some() => Line::Free,
        Node::Input(slot) => Line::One(slot, Slope::Rising),
        Node::Unary(op, a) => through(of(a).line, Slope::of_unary(op, of(a).interval)),
        Node::Binary(op, a, b) => {
            let (left, right) = (of(a).interval, of(b).interval);
            let (first, second) = (Slope::in_left(op, left, right), Slope::in_right(op, left, right));
            both(through(of(a).line, first), through(of(b).line, second))
        }
    }
}

fn through(inner: Line, outer: Slope) -> Line {
    match (inner, outer) {
        (Line::One(slot, slope), Slope::Rising) => Line::One(slot, slope),
        (Line::One(slot, slope), Slope::Falling) => Line::One(slot, slope.turned()),
        (Line::One(slot, _), Slope::Mixed) => Line::One(slot, Slope::Mixed),
        (other, _) => other,
    }
}

fn both(left: Line, right: Line) -> Line {
    match (left, right) {
        (Line::Free, other) | (other, Line::Free) => other,
        (Line::One(a, s), Line::One(b, t)) if a == b => Line::One(a, if s == t { s } else { Slope::Mixed }),
        _ => Line::Many,
    }
}
