//! Splits a formula into the terms of a sum.

use std::collections::BTreeMap;

use super::degree::{Degree, Degrees};
use super::graph::{Graph, Node, NodeId};
use super::operators::{Binary, Unary};

/// `constant + Σ coefficient·term`.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Terms {
    /// Coefficients, free of inputs, and terms, each an input or a nonlinear node; every term once, the newest node first.
    pub terms: Vec<(NodeId, NodeId)>,
    /// Free of inputs.
    pub constant: NodeId,
}

/// Splits a node at sums, differences, signs, and products and quotients with what is free of inputs.
///
/// A node reached along several ways is split once, with the sum of its coefficients, so that the work is bounded by the
/// number of nodes whatever they share. `degrees` is brought up to date.
pub fn split(graph: &mut Graph, degrees: &mut Degrees, root: NodeId) -> Terms {
    degrees.extend(graph);
    let one = graph.constant(1.0);
    let mut constants = Vec::new();
    let mut terms = Vec::new();
    let mut open = BTreeMap::from([(root, one)]);
    // The newest node first: all its uses are done, so its coefficient is complete.
    while let Some((node, coefficient)) = open.pop_last() {
        if degrees.is_free(node) {
            constants.push(graph.multiply(coefficient, node));
            continue;
        }
        let parts = parts(graph, degrees, node, coefficient);
        if parts.is_empty() {
            terms.push((coefficient, node));
        }
        for (part, coefficient) in parts {
            let total = match open.get(&part) {
                Some(&other) => graph.add(other, coefficient),
                None => coefficient,
            };
            open.insert(part, total);
        }
    }
    let constant = graph.sum(&constants);
    degrees.extend(graph);
    Terms { terms, constant }
}

/// The operands of a linear operation, with their coefficients; none for any other.
fn parts(graph: &mut Graph, degrees: &Degrees, node: NodeId, coefficient: NodeId) -> Vec<(NodeId, NodeId)> {
    let Node::Binary(op, left, right) = graph.node(node) else {
        return match graph.node(node) {
            Node::Unary(Unary::Negate, operand) => vec![(operand, graph.unary(Unary::Negate, coefficient))],
            _ => Vec::new(),
        };
    };
    match op {
        Binary::Add => vec![(left, coefficient), (right, coefficient)],
        Binary::Subtract => vec![(left, coefficient), (right, graph.unary(Unary::Negate, coefficient))],
        Binary::Multiply if degrees.is_free(left) => vec![(right, graph.multiply(coefficient, left))],
        Binary::Multiply if degrees.is_free(right) => vec![(left, graph.multiply(coefficient, right))],
        Binary::Divide if degrees.is_free(right) => vec![(left, graph.divide(coefficient, right))],
        _ => Vec::new(),
    }
}

impl Degrees {
    fn is_free(&self, node: NodeId) -> bool {
        self.of(node) == Degree::Constant
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn collects_coefficients_through_signs_and_factors() {
        let mut graph = Graph::new();
        let (x, d) = (graph.input(0), graph.data(0));
        let square = graph.power(x, 2.0);
        let quotient = graph.divide(square, d);
        let inner = graph.subtract(quotient, x);
        let three = graph.constant(3.0);
        let inner = graph.add(inner, three);
        let root = graph.scale(-2.0, inner);
        let terms = split(&mut graph, &mut Degrees::default(), root);
        let minus_two = graph.constant(-2.0);
        let two = graph.constant(2.0);
        let over = graph.divide(minus_two, d);
        assert_eq!(terms.terms, [(over, square), (two, x)]);
        assert_eq!(graph.as_constant(terms.constant), Some(-6.0));
    }

    #[test]
    fn shared_sums_do_not_blow_up() {
        let mut graph = Graph::new();
        let mut node = graph.input(0);
        let other = graph.input(1);
        for _ in 0..100 {
            let double = graph.add(node, node);
            node = graph.add(double, other);
        }
        let terms = split(&mut graph, &mut Degrees::default(), node);
        assert_eq!(terms.terms.len(), 2);
        assert_eq!(graph.as_constant(terms.terms[1].0), Some(2.0_f64.powi(100)));
    }
}
