//! How a node depends on the inputs: not at all, affinely, by squares and products, or otherwise.

use super::graph::{Graph, Node, NodeId};
use super::operators::{Binary, Unary};

/// The least class a node's form shows it to be in, in ascending order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Degree {
    /// Free of inputs; data may occur.
    Constant,
    /// A sum of inputs with input-free factors.
    Affine,
    /// With squares and products of two.
    Quadratic,
    /// Anything else.
    Nonlinear,
}

/// Degrees of the nodes of one graph, worked out once per node as the graph grows.
#[derive(Debug, Clone, Default)]
pub struct Degrees(Vec<Degree>);

impl Degrees {
    /// Of a graph as it is now.
    pub fn new(graph: &Graph) -> Self {
        let mut degrees = Degrees::default();
        degrees.extend(graph);
        degrees
    }

    /// Takes in the nodes added since.
    pub fn extend(&mut self, graph: &Graph) {
        for id in self.0.len()..graph.len() {
            let degree = self.degree(graph, graph.node(id as NodeId));
            self.0.push(degree);
        }
    }

    /// The degree of a node.
    ///
    /// # Panics
    /// On a node added since the last [`Degrees::extend`].
    pub fn of(&self, node: NodeId) -> Degree {
        self.0[node as usize]
    }

    fn degree(&self, graph: &Graph, node: Node) -> Degree {
        match node {
            Node::Constant(_) | Node::Data(_) => Degree::Constant,
            Node::Input(_) => Degree::Affine,
            Node::Unary(op, operand) => match (op, self.of(operand)) {
                (Unary::Negate, degree) => degree,
                (_, Degree::Constant) => Degree::Constant,
                _ => Degree::Nonlinear,
            },
            Node::Binary(op, left, right) => match (op, self.of(left), self.of(right)) {
                (_, Degree::Constant, Degree::Constant) => Degree::Constant,
                (Binary::Add | Binary::Subtract, left, right) => left.max(right),
                (Binary::Multiply, Degree::Constant, other) => other,
                (Binary::Multiply | Binary::Divide, other, Degree::Constant) => other,
                (Binary::Multiply, Degree::Affine, Degree::Affine) => Degree::Quadratic,
                (Binary::Power, Degree::Affine, _) if graph.as_constant(right) == Some(2.0) => Degree::Quadratic,
                _ => Degree::Nonlinear,
            },
        }
    }
}

/// The slots of the inputs a node depends on, ascending.
pub fn inputs_of(graph: &Graph, root: NodeId) -> Vec<u32> {
    let slot = |id| match graph.node(id) {
        Node::Input(slot) => Some(slot),
        _ => None,
    };
    let mut slots: Vec<u32> = graph.below(root).into_iter().filter_map(slot).collect();
    slots.sort_unstable();
    slots
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tells_the_classes_apart() {
        let mut graph = Graph::new();
        let (x, y, d) = (graph.input(0), graph.input(5), graph.data(0));
        let scaled = graph.multiply(d, x);
        let affine = graph.subtract(scaled, y);
        let product = graph.multiply(affine, x);
        let square = graph.power(affine, 2.0);
        let quotient = graph.divide(product, d);
        let cube = graph.multiply(product, y);
        let log = graph.unary(Unary::Log, d);
        let degrees = Degrees::new(&graph);
        assert_eq!(
            [log, affine, product, square, quotient, cube].map(|node| degrees.of(node)),
            [Degree::Constant, Degree::Affine, Degree::Quadratic, Degree::Quadratic, Degree::Quadratic, Degree::Nonlinear]
        );
        assert_eq!(inputs_of(&graph, cube), [0, 5]);
    }
}
