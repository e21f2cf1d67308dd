//! Log-log curvature by the rules of disciplined geometric programming (A. Agrawal, S. Diamond, S. Boyd, 2019).

use super::curvature::Curvature::{self, Affine, Concave, Constant, Convex, Unknown};
use super::{Interval, Structure};
use crate::expression::graph::{Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// The log-log curvature of a node whose operands are known. Zero counts as a positive constant here (a term that is not there).
pub(super) fn log_curvature(node: Node, interval: Interval, free: bool, known: &[Structure]) -> Curvature {
    let of = |id: NodeId| known[id as usize];
    if !interval.is_non_negative() {
        return Unknown;
    }
    match node {
        _ if free => Constant,
        Node::Constant(_) | Node::Data(_) => Constant,
        Node::Input(_) => Affine,
        Node::Unary(op, a) => unary(op, of(a)),
        Node::Binary(op, a, b) => binary(op, of(a), of(b)),
    }
}

fn unary(op: Unary, argument: Structure) -> Curvature {
    let log_log = argument.log_curvature;
    match op {
        Unary::Sqrt | Unary::Abs => log_log,
        // Power series with positive coefficients.
        Unary::Exp | Unary::Sinh | Unary::Cosh | Unary::Asin if log_log.is_convex() => Convex,
        Unary::Tan if log_log.is_convex() && argument.interval.upper <= std::f64::consts::FRAC_PI_2 => Convex,
        Unary::Log | Unary::Log10 if log_log.is_concave() && argument.interval.lower >= 1.0 => Concave,
        _ => Unknown,
    }
}

fn binary(op: Binary, left: Structure, right: Structure) -> Curvature {
    let (l, r) = (left.log_curvature, right.log_curvature);
    match op {
        Binary::Add | Binary::Max if l.is_convex() && r.is_convex() => Convex,
        Binary::Min if l.is_concave() && r.is_concave() => Concave,
        // log(eᵃ − eᵇ) is concave, rising in a, falling in b.
        Binary::Subtract if l.is_concave() && r.is_convex() => Concave,
        Binary::Multiply => l.plus(r),
        Binary::Divide => l.plus(r.negated()),
        Binary::Power => match right.interval.as_point() {
            Some(0.0) => Constant,
            Some(exponent) if exponent > 0.0 => l,
            Some(_) => l.negated(),
            None => Unknown,
        },
        _ => Unknown,
    }
}
