//! The two volume laws, for areas given as expressions.

use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Unary;

/// How a rib's volume follows from its ends.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub enum VolumeLaw {
    /// l/3·(S1 + S2 + √(S1·S2)): the frustum of a pyramid.
    #[default]
    Frustum,
    /// l/6·(S1 + 4·Sm + S2), Sm the area at the mean dimensions: exact where dimensions vary linearly.
    Prismatoid,
}

impl VolumeLaw {
    /// All of them.
    pub const ALL: [VolumeLaw; 2] = [VolumeLaw::Frustum, VolumeLaw::Prismatoid];

    /// The law's name in files.
    pub fn name(self) -> &'static str {
        match self {
            VolumeLaw::Frustum => "frustum",
            VolumeLaw::Prismatoid => "prismatoid",
        }
    }

    /// The law of this name.
    pub fn named(name: &str) -> Option<VolumeLaw> {
        VolumeLaw::ALL.into_iter().find(|law| law.name() == name)
    }
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
