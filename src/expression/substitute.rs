//! Copies of nodes with other leaves: templates put in place, x = exp(y).

use std::collections::HashMap;

use super::graph::{Graph, Node, NodeId};

/// Copies a node from one graph into another, its inputs and data replaced. Both closures get the target graph.
///
/// ```
/// use ribopt::expression::{graph::{Graph, Node}, operators::Unary, substitute::substitute};
/// let (mut template, mut target) = (Graph::new(), Graph::new());
/// let (x, c) = (template.input(0), template.data(0));
/// let product = template.multiply(x, c);
/// let exponential = |graph: &mut Graph, slot| { let y = graph.input(slot); graph.unary(Unary::Exp, y) };
/// let copy = substitute(&template, product, &mut target, exponential, |graph, _| graph.constant(1.0));
/// assert!(matches!(target.node(copy), Node::Unary(Unary::Exp, _)));
/// ```
pub fn substitute(
    from: &Graph,
    root: NodeId,
    into: &mut Graph,
    mut input: impl FnMut(&mut Graph, u32) -> NodeId,
    mut data: impl FnMut(&mut Graph, u32) -> NodeId,
) -> NodeId {
    let mut copies: HashMap<NodeId, NodeId> = HashMap::new();
    for id in from.below(root) {
        let copy = match from.node(id) {
            Node::Constant(value) => into.constant(value),
            Node::Input(slot) => input(into, slot),
            Node::Data(slot) => data(into, slot),
            Node::Unary(op, operand) => into.unary(op, copies[&operand]), // operands come before uses
            Node::Binary(op, left, right) => into.binary(op, copies[&left], copies[&right]),
        };
        copies.insert(id, copy);
    }
    copies[&root]
}
