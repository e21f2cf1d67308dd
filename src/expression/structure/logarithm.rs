//! How the logarithm of a node bends in the inputs themselves: log-convex and log-concave functions
//! (S. Boyd, L. Vandenberghe, Convex Optimization, 2004, §3.5).

use super::curvature::Curvature::{self, Concave, Constant, Convex, Unknown};
use super::{Interval, Structure};
use crate::expression::graph::{Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// Of a node that is never negative and bends as `curvature`. Where it is zero its logarithm is −∞.
pub(super) fn logarithm(node: Node, interval: Interval, curvature: Curvature, known: &[Structure]) -> Curvature {
    if !interval.is_non_negative() {
        return Unknown;
    }
    if curvature == Constant {
        return Constant;
    }
    let of = |id: NodeId| known[id as usize];
    let by_rule = match node {
        Node::Unary(op, a) => unary(op, of(a)),
        Node::Binary(op, a, b) => binary(op, of(a), of(b)),
        _ => Unknown,
    };
    match by_rule {
        // A concave function that is never negative is log-concave.
        Unknown if curvature.is_concave() => Concave,
        known => known,
    }
}

fn unary(op: Unary, argument: Structure) -> Curvature {
    match op {
        Unary::Exp => argument.curvature,
        Unary::Sqrt | Unary::Abs => argument.logarithm,
        Unary::Cosh if argument.curvature.is_affine() => Convex,
        _ => Unknown,
    }
}

fn binary(op: Binary, left: Structure, right: Structure) -> Curvature {
    let (l, r) = (left.logarithm, right.logarithm);
    match op {
        // The logarithm of a sum of exponentials of convex functions is convex.
        Binary::Add | Binary::Max if l.is_convex() && r.is_convex() => Convex,
        Binary::Min if l.is_concave() && r.is_concave() => Concave,
        Binary::Multiply => l.plus(r),
        Binary::Divide => l.plus(r.negated()),
        Binary::Power => match (right.interval.as_point(), left.curvature) {
            (Some(0.0), _) => Constant,
            (Some(exponent), _) if exponent > 0.0 => l,
            (Some(_), _) => l.negated(),
            (None, Constant) if left.interval.lower >= 1.0 => right.curvature,
            (None, Constant) if left.interval.lower > 0.0 && left.interval.upper <= 1.0 => right.curvature.negated(),
            _ => Unknown,
        },
        _ => Unknown,
    }
}
