//! The two volume laws, for areas given as expressions.

use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Unary;

/// Which law.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Law {
    /// (S1 + S2 + √(S1·S2))/3 per unit length, note (2.3.1).
    Frustum,
    /// (S1 + 4·Sm + S2)/6 per unit length, Sm the area at the mean dimensions.
    Prismatoid,
}

/// Frustum volume per unit length. √S1·√S2 rather than √(S1·S2): two negative areas must not pass for a volume.
pub fn frustum(graph: &mut Graph, left: NodeId, right: NodeId) -> NodeId {
    let (left_root, right_root) = (graph.unary(Unary::Sqrt, left), graph.unary(Unary::Sqrt, right));
    let mean = graph.multiply(left_root, right_root);
    let sum = graph.sum(&[left, mean, right]);
    graph.scale(1.0 / 3.0, sum)
}

/// Prismatoid volume per unit length.
pub fn prismatoid(graph: &mut Graph, left: NodeId, middle: NodeId, right: NodeId) -> NodeId {
    let middle = graph.scale(4.0, middle);
    let sum = graph.sum(&[left, middle, right]);
    graph.scale(1.0 / 6.0, sum)
}
