//! What can be proved about a graph's nodes over given bounds: range, curvature, log-log curvature.
//!
//! A proof, not a guess: `Unknown` where no rule applies. Log-log statements hold for positive inputs.

mod blame;
mod curvature;
mod interval;
mod line;
mod log_curvature;
mod logarithm;
mod norm;
mod product;
mod quadratic;
mod slope;
#[cfg(test)]
mod tests;

use super::degree::{Degree, Degrees};
use super::graph::{Graph, Node, NodeId};
use super::operators::{Binary, Unary};
pub use blame::{Wanted, blame};
pub use curvature::Curvature;
pub use interval::Interval;
pub use line::Line;
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
    /// How its logarithm bends in the inputs themselves: exponentials of affine functions are `Affine`. `Unknown` where it may be
    /// negative.
    pub logarithm: Curvature,
    /// Whether it depends on one input alone, and whether it rises or falls in it.
    pub line: Line,
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
    let inner = inner_sums(graph);
    let mut known: Vec<Structure> = Vec::with_capacity(graph.len());
    for id in 0..graph.len() {
        let node = graph.node(id as NodeId);
        let interval = range(node, inputs, data, &known);
        let log_curvature = log_curvature::log_curvature(node, interval, degrees.of(id as NodeId) == Degree::Constant, &known);
        let mut curvature = curvature::curvature(graph, id as NodeId, node, interval, &known);
        let logarithm = logarithm::logarithm(node, interval, curvature, &known);
        if curvature == Curvature::Unknown && logarithm.is_convex() {
            curvature = Curvature::Convex;
        }
        let line = line::line(node, interval, &known);
        known.push(Structure { interval, curvature, log_curvature, logarithm, line });
        if curvature == Curvature::Unknown && is_sum(node) && !inner[id] {
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
        Node::Binary(op, a, b) if a == b && op == Binary::Multiply => of(a).power(2.0),
        Node::Binary(op, a, b) => of(a).binary(op, of(b)),
    }
}

/// Sums, and products with what is constant: what [`quadratic`] sees through, and a product of affine functions itself.
fn is_sum(node: Node) -> bool {
    match node {
        Node::Unary(op, _) => op == Unary::Negate,
        Node::Binary(op, ..) => matches!(op, Binary::Add | Binary::Subtract | Binary::Multiply | Binary::Divide | Binary::Power),
        _ => false,
    }
}

/// Nodes that are part of a larger sum: only the largest is looked at as a whole, and its products with it.
fn inner_sums(graph: &Graph) -> Vec<bool> {
    let mut inner = vec![false; graph.len()];
    let mut outer = vec![false; graph.len()];
    for id in 0..graph.len() as NodeId {
        let node = graph.node(id);
        let adds = matches!(node, Node::Unary(Unary::Negate, _) | Node::Binary(Binary::Add | Binary::Subtract, ..));
        let target = if adds { &mut inner } else { &mut outer };
        node.operands().for_each(|operand| target[operand as usize] = true);
    }
    // What stands in another place too is looked at by itself.
    inner.iter().zip(outer).map(|(&inner, outer)| inner && !outer).collect()
}
