//! What can be proved about a graph's nodes over given bounds: range, curvature, log-log curvature.
//!
//! A proof, not a guess: `Unknown` where no rule applies. Log-log statements hold for positive inputs.

mod blame;
mod curvature;
mod interval;
mod log_curvature;
mod quadratic;
mod slope;
#[cfg(test)]
mod tests;

use super::degree::{Degree, Degrees};
use super::graph::{Graph, Node, NodeId};
pub use blame::{Wanted, blame};
pub use curvature::Curvature;
pub use interval::Interval;
pub use slope::Slope;

/// What is known of one node.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Structure {
    /// The values it takes.
    pub interval: Interval,
    /// How it bends in the inputs.
    pub curvature: Curvature,
    /// How its logarithm bends in the logarithms of the inputs (for positive inputs): monomials are `Affine`, posynomials
    /// `Convex`. `Unknown` where it may be negative.
    pub log_curvature: Curvature,
}

/// The structure of every node, given the ranges of inputs and data by slot (missing ones: nothing known).
///
/// ```
/// use ribopt::expression::{graph::Graph, structure::{analyse, Curvature, Interval}};
/// let mut graph = Graph::new();
/// let (b, h) = (graph.input(0), graph.input(1));
/// let area = graph.multiply(b, h);
/// let positive = Interval::new(0.1, 2.0);
/// let structure = analyse(&graph, &[positive, positive], &[])[area as usize];
/// assert_eq!((structure.curvature, structure.log_curvature), (Curvature::Unknown, Curvature::Affine));
/// ```
pub fn analyse(graph: &Graph, inputs: &[Interval], data: &[Interval]) -> Vec<Structure> {
    let degrees = Degrees::new(graph);
    let inner = inner_quadratics(graph, &degrees);
    let mut known: Vec<Structure> = Vec::with_capacity(graph.len());
    for id in 0..graph.len() {
        let node = graph.node(id as NodeId);
        let interval = range(node, inputs, data, &known);
        let log_curvature = log_curvature::log_curvature(node, interval, degrees.of(id as NodeId) == Degree::Constant, &known);
        let curvature = curvature::curvature(graph, node, interval, &known);
        known.push(Structure { interval, curvature, log_curvature });
        if curvature == Curvature::Unknown && degrees.of(id as NodeId) == Degree::Quadratic && !inner[id] {
            known[id].curvature = quadratic::curvature(graph, id as NodeId, &known);
        }
    }
    known
}

fn range(node: Node, inputs: &[Interval], data: &[Interval], known: &[Structure]) -> Interval {
    let of = |id: NodeId| known[id as usize].interval;
    let given = |list: &[Interval], slot: u32| list.get(slot as usize).copied().unwrap_or(Interval::WHOLE);
    match node {
        Node::Constant(value) => Interval::point(value),
        Node::Input(slot) => given(inputs, slot),
        Node::Data(slot) => given(data, slot),
        Node::Unary(op, a) => of(a).unary(op),
        Node::Binary(op, a, b) if a == b && op == super::operators::Binary::Multiply => of(a).power(2.0),
        Node::Binary(op, a, b) => of(a).binary(op, of(b)),
    }
}

/// Nodes that are part of a larger quadratic form: only the largest is factorised.
fn inner_quadratics(graph: &Graph, degrees: &Degrees) -> Vec<bool> {
    let mut inner = vec![false; graph.len()];
    for id in (0..graph.len() as NodeId).filter(|&id| degrees.of(id) == Degree::Quadratic) {
        for operand in graph.node(id).operands() {
            inner[operand as usize] = true;
        }
    }
    inner
}
