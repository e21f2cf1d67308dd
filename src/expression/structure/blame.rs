//! Which part of a formula stands in the way of a property.

use super::{Curvature, Interval, Structure};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// A property one would like a node to have.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Wanted {
    Convex,
    Concave,
    LogConvex,
    LogConcave,
}

impl Wanted {
    /// Whether a node has it.
    pub fn holds(self, structure: Structure) -> bool {
        match self {
            Wanted::Convex => structure.curvature.is_convex(),
            Wanted::Concave => structure.curvature.is_concave(),
            Wanted::LogConvex => structure.log_curvature.is_convex(),
            Wanted::LogConcave => structure.log_curvature.is_concave(),
        }
    }

    fn opposite(self) -> Self {
        match self {
            Wanted::Convex => Wanted::Concave,
            Wanted::Concave => Wanted::Convex,
            Wanted::LogConvex => Wanted::LogConcave,
            Wanted::LogConcave => Wanted::LogConvex,
        }
    }

    fn in_logarithms(self) -> bool {
        matches!(self, Wanted::LogConvex | Wanted::LogConcave)
    }

    fn curvature(self, structure: Structure) -> Curvature {
        if self.in_logarithms() { structure.log_curvature } else { structure.curvature }
    }
}

/// The deepest node that stands in the way; `None` where the property holds.
pub fn blame(graph: &Graph, structures: &[Structure], root: NodeId, wanted: Wanted) -> Option<NodeId> {
    let of = |id: NodeId| structures[id as usize];
    if wanted.holds(of(root)) {
        return None;
    }
    let (mut node, mut wanted) = (root, wanted);
    loop {
        let culprit = needs(graph.node(node), wanted, structures).into_iter().find(|&(part, need)| match need {
            Some(need) => !need.holds(of(part)),
            None => wanted.curvature(of(part)) == Curvature::Unknown,
        });
        match culprit {
            Some((part, need)) => (node, wanted) = (part, need.unwrap_or(wanted)),
            None => return Some(node),
        }
    }
}

/// What the operands of a node must have for the node to have `wanted`; `None`: some known curvature.
fn needs(node: Node, wanted: Wanted, structures: &[Structure]) -> Vec<(NodeId, Option<Wanted>)> {
    let logarithms = wanted.in_logarithms();
    let value = |id: NodeId| structures[id as usize].interval;
    match node {
        Node::Unary(Unary::Negate, a) if !logarithms => vec![(a, Some(wanted.opposite()))],
        Node::Binary(Binary::Add, a, b) => vec![(a, Some(wanted)), (b, Some(wanted))],
        Node::Binary(Binary::Subtract, a, b) if !logarithms => vec![(a, Some(wanted)), (b, Some(wanted.opposite()))],
        Node::Binary(Binary::Multiply, a, b) if logarithms => vec![(a, Some(wanted)), (b, Some(wanted))],
        Node::Binary(Binary::Divide, a, b) if logarithms => vec![(a, Some(wanted)), (b, Some(wanted.opposite()))],
        Node::Binary(Binary::Multiply, a, b) => match (factor(structures, a), factor(structures, b)) {
            (Some(_), _) => vec![(b, signed(wanted, value(a)))],
            (_, Some(_)) => vec![(a, signed(wanted, value(b)))],
            _ => Vec::new(), // the product itself
        },
        Node::Binary(Binary::Divide, a, b) if factor(structures, b).is_some() => vec![(a, signed(wanted, value(b)))],
        other => other.operands().map(|operand| (operand, None)).collect(),
    }
}

fn factor(structures: &[Structure], id: NodeId) -> Option<()> {
    (structures[id as usize].curvature == Curvature::Constant).then_some(())
}

/// What f must have for c·f to have `wanted`.
fn signed(wanted: Wanted, factor: Interval) -> Option<Wanted> {
    match factor {
        _ if factor.is_non_negative() => Some(wanted),
        _ if factor.is_non_positive() => Some(wanted.opposite()),
        _ => None,
    }
}
