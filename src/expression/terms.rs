//! temp
use super::graph::{Graph, Node, NodeId};
use super::operators::{Binary, Unary};
pub struct Terms {
    pub constant: NodeId,
    pub terms: Vec<(NodeId, NodeId)>,
}
fn free(g: &Graph, id: NodeId) -> bool {
    match g.node(id) {
        Node::Constant(_) | Node::Data(_) => true,
        Node::Input(_) => false,
        Node::Unary(_, a) => free(g, a),
        Node::Binary(_, a, b) => free(g, a) && free(g, b),
    }
}
pub fn split(g: &mut Graph, root: NodeId) -> Terms {
    let one = g.constant(1.0);
    let zero = g.constant(0.0);
    let mut t = Terms { constant: zero, terms: vec![] };
    let mut stack = vec![(one, root)];
    while let Some((c, n)) = stack.pop() {
        if free(g, n) {
            let p = g.multiply(c, n);
            t.constant = g.add(t.constant, p);
            continue;
        }
        match g.node(n) {
            Node::Unary(Unary::Negate, a) => {
                let c = g.unary(Unary::Negate, c);
                stack.push((c, a));
            }
            Node::Binary(Binary::Add, a, b) => {
                stack.push((c, b));
                stack.push((c, a));
            }
            Node::Binary(Binary::Subtract, a, b) => {
                let m = g.unary(Unary::Negate, c);
                stack.push((m, b));
                stack.push((c, a));
            }
            Node::Binary(Binary::Multiply, a, b) if free(g, a) => {
                let c = g.multiply(c, a);
                stack.push((c, b));
            }
            Node::Binary(Binary::Multiply, a, b) if free(g, b) => {
                let c = g.multiply(c, b);
                stack.push((c, a));
            }
            Node::Binary(Binary::Divide, a, b) if free(g, b) => {
                let c = g.divide(c, b);
                stack.push((c, a));
            }
            _ => t.terms.push((c, n)),
        }
    }
    t
}
