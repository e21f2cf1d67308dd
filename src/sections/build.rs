//! Shorthand for the nodes of section formulas.

use super::{Given, Kind};
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::{Binary, Unary};

/// factor·Π node^exponent; a node that comes twice is raised once.
pub(super) fn monomial(graph: &mut Graph, factor: f64, powers: &[(NodeId, f64)]) -> NodeId {
    let mut merged: Vec<(NodeId, f64)> = Vec::with_capacity(powers.len());
    for (node, exponent) in powers {
        match merged.iter_mut().find(|(known, _)| known == node) {
            Some((_, sum)) => *sum += exponent,
            None => merged.push((*node, *exponent)),
        }
    }
    let product = merged.iter().map(|(node, exponent)| graph.power(*node, *exponent)).collect::<Vec<_>>();
    let product = product.into_iter().reduce(|left, right| graph.multiply(left, right));
    match product {
        Some(product) => graph.scale(factor, product),
        None => graph.constant(factor),
    }
}

/// `ix`, `iy`, `imin`: the radius of gyration √(I/A) of the moment named alike.
pub(super) fn radius(kind: &dyn Kind, graph: &mut Graph, given: &Given, name: &str) -> Option<NodeId> {
    let moment = match name {
        "ix" => "Ix",
        "iy" => "Iy",
        "imin" => "Imin",
        _ => return None,
    };
    let (moment, area) = (kind.property(graph, given, moment)?, kind.property(graph, given, "A")?);
    let square = graph.divide(moment, area);
    Some(graph.unary(Unary::Sqrt, square))
}

/// The smallest or largest of some nodes, balanced; `None` of none.
pub(super) fn extreme(graph: &mut Graph, op: Binary, nodes: &[NodeId]) -> Option<NodeId> {
    match nodes {
        [] => None,
        [one] => Some(*one),
        _ => {
            let (left, right) = nodes.split_at(nodes.len() / 2);
            let (left, right) = (extreme(graph, op, left)?, extreme(graph, op, right)?);
            Some(graph.binary(op, left, right))
        }
    }
}

/// 2·moment/extent: the elastic modulus of a section that is symmetric about the axis.
pub(super) fn symmetric_modulus(graph: &mut Graph, moment: NodeId, extent: NodeId) -> NodeId {
    let double = graph.scale(2.0, moment);
    graph.divide(double, extent)
}
