//! Curvature by the rules of disciplined convex programming (M. Grant, S. Boyd, Y. Ye, 2006).

use std::f64::consts::{FRAC_PI_2, PI};

use super::product::product_curvature;
use super::{Interval, Structure, norm};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// How a function bends. Of log-log curvature: how log f bends in the logarithms of the inputs, so that `Affine` is a monomial,
/// and posynomials are `Convex`.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Curvature {
    Constant,
    Affine,
    Convex,
    Concave,
    Unknown,
}

use Curvature::{Affine, Concave, Constant, Convex, Unknown};

impl Curvature {
    /// Convex, affine or constant.
    pub fn is_convex(self) -> bool {
        matches!(self, Constant | Affine | Convex)
    }

    /// Concave, affine or constant.
    pub fn is_concave(self) -> bool {
        self.negated().is_convex()
    }

    /// Affine or constant.
    pub fn is_affine(self) -> bool {
        matches!(self, Constant | Affine)
    }

    /// Of −f.
    pub fn negated(self) -> Self {
        match self {
            Convex => Concave,
            Concave => Convex,
            other => other,
        }
    }

    /// Of the sum of two.
    pub fn plus(self, other: Self) -> Self {
        match (self, other) {
            (Constant, same) | (same, Constant) => same,
            (Affine, same) | (same, Affine) => same,
            (left, right) if left == right => left,
            _ => Unknown,
        }
    }

    /// This, or what another rule finds where this one found nothing.
    pub(super) fn or_else(self, other: impl FnOnce() -> Self) -> Self {
        if self == Unknown { other() } else { self }
    }

    /// Of c·f for a factor of this sign.
    pub(super) fn scaled(self, factor: Interval) -> Self {
        match self {
            Constant | Affine => self,
            _ if factor.is_non_negative() => self,
            _ if factor.is_non_positive() => self.negated(),
            _ => Unknown,
        }
    }
}

/// How a function of one argument bends over the argument's range, and whether it rises or falls.
#[derive(Clone, Copy)]
pub(super) struct Shape {
    bend: Curvature,
    slope: Slope,
}

#[derive(Clone, Copy, PartialEq)]
enum Slope {
    Rising,
    Falling,
    Mixed,
}

const NO_SHAPE: Shape = Shape { bend: Unknown, slope: Slope::Mixed };

impl Shape {
    fn of(bend: Curvature, slope: Slope) -> Self {
        Shape { bend, slope }
    }

    /// One shape left of zero, one right of it, none across.
    fn by_sign(range: Interval, negative: Shape, positive: Shape) -> Self {
        match (range.is_non_negative(), range.is_non_positive()) {
            (true, _) => positive,
            (_, true) => negative,
            _ => NO_SHAPE,
        }
    }

    /// Falls, then rises, bending upwards throughout.
    fn bowl(range: Interval) -> Self {
        let mixed = Shape::of(Convex, Slope::Mixed);
        match Shape::by_sign(range, Shape::of(Convex, Slope::Falling), Shape::of(Convex, Slope::Rising)) {
            Shape { bend: Unknown, .. } => mixed,
            known => known,
        }
    }

    /// Of the function applied to an argument of this curvature.
    pub(super) fn compose(self, argument: Curvature) -> Curvature {
        let slope_fits = |wanted_convex: bool| match self.slope {
            Slope::Rising => (argument.is_convex() && wanted_convex) || (argument.is_concave() && !wanted_convex),
            Slope::Falling => (argument.is_concave() && wanted_convex) || (argument.is_convex() && !wanted_convex),
            Slope::Mixed => argument.is_affine(),
        };
        match self.bend {
            _ if argument == Constant => Constant,
            Affine if self.slope == Slope::Falling => argument.negated(),
            Affine => argument,
            Convex if slope_fits(true) => Convex,
            Concave if slope_fits(false) => Concave,
            _ => Unknown,
        }
    }
}

/// The curvature of a node whose operands are known: by the operation and, where that does not tell, by what its operands are made of.
pub(super) fn curvature(graph: &Graph, id: NodeId, node: Node, interval: Interval, known: &[Structure]) -> Curvature {
    by_rules(graph, node, interval, known).or_else(|| product_curvature(graph, id, node, known))
}

/// The curvature by rules that look at one operation and at what is known of its operands.
pub(super) fn by_rules(graph: &Graph, node: Node, interval: Interval, known: &[Structure]) -> Curvature {
    by_operation(graph, node, interval, known).or_else(|| norm::root_curvature(graph, node, known))
}

fn by_operation(graph: &Graph, node: Node, interval: Interval, known: &[Structure]) -> Curvature {
    let of = |id: NodeId| known[id as usize];
    match node {
        Node::Constant(_) | Node::Data(_) => Constant,
        Node::Input(_) if interval.as_point().is_some() => Constant, // fixed by its bounds
        Node::Input(_) => Affine,
        Node::Unary(op, a) => match unary_shape(op, of(a).interval).compose(of(a).curvature) {
            Unknown if matches!(op, Unary::Log | Unary::Log10) => of(a).logarithm,
            known => known,
        },
        Node::Binary(op, a, b) => binary(graph, op, (a, of(a)), (b, of(b)), known),
    }
}

fn binary(
    graph: &Graph,
    op: Binary,
    (a, left): (NodeId, Structure),
    (b, right): (NodeId, Structure),
    known: &[Structure],
) -> Curvature {
    match (op, left.curvature, right.curvature) {
        (_, Constant, Constant) => Constant,
        (Binary::Add, l, r) => l.plus(r),
        (Binary::Subtract, l, r) => l.plus(r.negated()),
        (Binary::Multiply, l, _) if a == b => power_shape(2.0, left.interval).compose(l),
        (Binary::Multiply, Constant, r) => r.scaled(left.interval),
        (Binary::Multiply, l, Constant) => l.scaled(right.interval),
        (Binary::Divide, l, Constant) => l.scaled(right.interval),
        (Binary::Divide, Constant, r) => match power_shape(-1.0, right.interval).compose(r) {
            Unknown if right.logarithm.is_concave() => Convex.scaled(left.interval),
            known => known.scaled(left.interval),
        },
        (Binary::Divide, _, r) => square_over(graph, a, r, right.interval, known),
        (Binary::Power, l, Constant) => right.interval.as_point().map_or(Unknown, |p| power_shape(p, left.interval).compose(l)),
        (Binary::Power, Constant, r) => exponential_shape(left.interval).compose(r),
        (Binary::Min, l, r) if l.is_concave() && r.is_concave() => Concave,
        (Binary::Max, l, r) if l.is_convex() && r.is_convex() => Convex,
        _ => Unknown,
    }
}

/// u²/v with u affine and v positive and concave is convex.
fn square_over(graph: &Graph, numerator: NodeId, denominator: Curvature, range: Interval, known: &[Structure]) -> Curvature {
    let base = match graph.node(numerator) {
        Node::Binary(Binary::Power, base, exponent) if graph.as_constant(exponent) == Some(2.0) => base,
        Node::Binary(Binary::Multiply, base, other) if base == other => base,
        _ => return Unknown,
    };
    let fits = known[base as usize].curvature.is_affine() && denominator.is_concave() && range.is_non_negative();
    if fits { Convex } else { Unknown }
}

fn unary_shape(op: Unary, range: Interval) -> Shape {
    let rising = |bend| Shape::of(bend, Slope::Rising);
    let falling = |bend| Shape::of(bend, Slope::Falling);
    match op {
        Unary::Negate => falling(Affine),
        Unary::Sqrt | Unary::Log | Unary::Log10 => rising(Concave),
        Unary::Exp => rising(Convex),
        Unary::Abs => match Shape::by_sign(range, falling(Affine), rising(Affine)) {
            Shape { bend: Unknown, .. } => Shape::of(Convex, Slope::Mixed),
            known => known,
        },
        Unary::Cosh => Shape::bowl(range),
        Unary::Sinh | Unary::Asin => Shape::by_sign(range, rising(Concave), rising(Convex)),
        Unary::Tanh | Unary::Atan | Unary::Erf => Shape::by_sign(range, rising(Convex), rising(Concave)),
        Unary::Acos => Shape::by_sign(range, falling(Convex), falling(Concave)),
        Unary::Tan if range.lower > -FRAC_PI_2 && range.upper < FRAC_PI_2 => {
            Shape::by_sign(range, rising(Concave), rising(Convex))
        }
        Unary::Sin if range.lower >= 0.0 && range.upper <= PI => Shape::of(Concave, Slope::Mixed),
        Unary::Cos if range.lower >= -FRAC_PI_2 && range.upper <= FRAC_PI_2 => Shape::of(Concave, Slope::Mixed),
        // It falls as far as 1.4616… and rises from there.
        Unary::LnGamma if range.lower >= 1.47 => rising(Convex),
        Unary::LnGamma => Shape::of(Convex, Slope::Mixed),
        Unary::Sin | Unary::Cos | Unary::Tan => NO_SHAPE,
    }
}

/// Of u ↦ u^p over the range of u; for p not whole the domain is u ≥ 0.
pub(super) fn power_shape(p: f64, range: Interval) -> Shape {
    let (whole, even) = (p.fract() == 0.0, p % 2.0 == 0.0);
    let rising = |bend| Shape::of(bend, Slope::Rising);
    let falling = |bend| Shape::of(bend, Slope::Falling);
    match p {
        0.0 => Shape::of(Affine, Slope::Mixed),
        1.0 => rising(Affine),
        // Where u is convex and may be negative, the domain u ≥ 0 need not be convex.
        _ if !whole && p > 1.0 && !range.is_non_negative() => Shape::of(Convex, Slope::Mixed),
        _ if !whole && p > 1.0 => rising(Convex),
        _ if !whole && p > 0.0 => rising(Concave),
        _ if !whole => falling(Convex),
        _ if even && p > 0.0 => Shape::bowl(range),
        _ if even => Shape::by_sign(range, rising(Convex), falling(Convex)),
        _ if p > 0.0 => Shape::by_sign(range, rising(Concave), rising(Convex)),
        _ => Shape::by_sign(range, falling(Concave), falling(Convex)),
    }
}

/// Of u ↦ a^u for a positive a.
fn exponential_shape(base: Interval) -> Shape {
    match base {
        _ if base.lower >= 1.0 => Shape::of(Convex, Slope::Rising),
        _ if base.lower > 0.0 && base.upper <= 1.0 => Shape::of(Convex, Slope::Falling),
        _ if base.lower > 0.0 => Shape::of(Convex, Slope::Mixed),
        _ => NO_SHAPE,
    }
}
