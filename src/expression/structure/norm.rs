//! Norms: the q-th root of a sum of q-th powers of convex functions that are never negative (Minkowski's inequality).

use super::curvature::Curvature::{self, Constant, Convex, Unknown};
use super::product::power_of_convex;
use super::{Interval, Structure};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// Terms of a sum under a root.
const MOST_STEPS: usize = 4096;

/// The curvature of a root of a sum; `Unknown` where no rule applies.
pub(super) fn root_curvature(graph: &Graph, node: Node, known: &[Structure]) -> Curvature {
    let (sum, degree) = match node {
        Node::Unary(Unary::Sqrt, sum) => (sum, 2.0),
        Node::Binary(Binary::Power, sum, p) => match known[p as usize].interval.as_point() {
            Some(p) if p > 0.0 && p < 1.0 => (sum, 1.0 / p),
            _ => return Unknown,
        },
        _ => return Unknown,
    };
    if is_sum_of_powers(graph, sum, degree, known) { Convex } else { Unknown }
}

/// Whether a node is a sum of terms whose roots of this degree are convex and never negative.
fn is_sum_of_powers(graph: &Graph, root: NodeId, degree: f64, known: &[Structure]) -> bool {
    let of = |id: NodeId| known[id as usize];
    let (mut open, mut constant) = (vec![(root, Interval::point(1.0))], Interval::point(0.0));
    for _ in 0..MOST_STEPS {
        let Some((id, factor)) = open.pop() else { return constant.is_non_negative() };
        let is_constant = |id: NodeId| of(id).curvature == Constant;
        match graph.node(id) {
            _ if is_constant(id) => constant = constant.add(factor.multiply(of(id).interval)),
            Node::Unary(Unary::Negate, a) => open.push((a, factor.negate())),
            Node::Binary(op @ (Binary::Add | Binary::Subtract), a, b) => {
                open.push((a, factor));
                open.push((b, if op == Binary::Add { factor } else { factor.negate() }));
            }
            Node::Binary(Binary::Multiply, a, b) if a != b && is_constant(a) => open.push((b, factor.multiply(of(a).interval))),
            Node::Binary(Binary::Multiply, a, b) if a != b && is_constant(b) => open.push((a, factor.multiply(of(b).interval))),
            Node::Binary(Binary::Divide, a, b) if is_constant(b) => open.push((a, factor.divide(of(b).interval))),
            node if factor.is_non_negative() && root_is_convex(node, of(id), degree, known) => {}
            _ => return false,
        }
    }
    false
}

/// Whether the root of one term is convex.
fn root_is_convex(node: Node, own: Structure, degree: f64, known: &[Structure]) -> bool {
    let of = |id: NodeId| known[id as usize];
    // Rounding of 1/p: a cube's third root is the term itself.
    let reaches = |p: f64| p >= degree * (1.0 - 4.0 * f64::EPSILON);
    match node {
        _ if own.interval.is_non_negative() && own.logarithm.is_convex() => true,
        Node::Binary(Binary::Multiply, a, b) => a == b && reaches(2.0) && power_of_convex(of(a), 2.0),
        Node::Binary(Binary::Power, a, p) => match of(p).interval.as_point() {
            Some(p) => reaches(p) && power_of_convex(of(a), p),
            None => false,
        },
        _ => false,
    }
}
