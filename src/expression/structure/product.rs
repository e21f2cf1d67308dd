//! Products of powers, quotients and perspectives.

use std::collections::BTreeMap;

use super::curvature::{Curvature, power_shape};
use super::line::Line;
use super::logarithm::logarithm;
use super::{Interval, Slope, Structure, curvature};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};

use Curvature::{Affine, Concave, Constant, Convex, Unknown};

/// Operations looked at to find the factors of one product.
const MOST_STEPS: usize = 256;

/// Nodes of a graph up to which perspectives are looked for, and of the function whose perspective it may be.
const MOST_NODES: usize = 2000;
const MOST_INNER_NODES: usize = 200;

/// Exponents are the nearest numbers to the fractions they stand for: sums of them are compared with 1 up to this.
const ROUNDING: f64 = 16.0 * f64::EPSILON;

/// coefficient·Π base^exponent
struct Product {
    coefficient: Interval,
    factors: Vec<(NodeId, f64)>,
}

/// The curvature of a product, quotient, power or root; `Unknown` where no rule applies.
pub(super) fn product_curvature(graph: &Graph, root: NodeId, node: Node, known: &[Structure]) -> Curvature {
    let is_product =
        matches!(node, Node::Binary(Binary::Multiply | Binary::Divide | Binary::Power, ..) | Node::Unary(Unary::Sqrt, _));
    if !is_product {
        return Unknown;
    }
    let Some(product) = factors(graph, root, node, known) else { return Unknown };
    let found = monomial(&product, known)
        .or_else(|| of_one_input(&product, known))
        .or_else(|| affine_quotient(graph, &product, known))
        .or_else(|| perspective(graph, node, &product, known));
    found.scaled(product.coefficient)
}

/// A product as powers of its factors; `None` where there are too many.
fn factors(graph: &Graph, root: NodeId, node: Node, known: &[Structure]) -> Option<Product> {
    let of = |id: NodeId| known[id as usize];
    let mut coefficient = Interval::point(1.0);
    let mut factors: BTreeMap<NodeId, f64> = BTreeMap::new();
    let mut open = vec![(root, node, 1.0_f64)];
    for _ in 0..MOST_STEPS {
        let Some((id, node, exponent)) = open.pop() else {
            return Some(Product { coefficient, factors: factors.into_iter().collect() });
        };
        let whole = exponent.fract() == 0.0;
        let splits = |id: NodeId| whole || of(id).interval.is_non_negative();
        let mut push = |id: NodeId, exponent: f64| open.push((id, graph.node(id), exponent));
        match node {
            _ if id != root && of(id).curvature == Constant && splits(id) => {
                coefficient = coefficient.multiply(of(id).interval.power(exponent));
            }
            Node::Unary(Unary::Negate, a) if whole => {
                if exponent % 2.0 != 0.0 {
                    coefficient = coefficient.negate();
                }
                push(a, exponent);
            }
            Node::Unary(Unary::Sqrt, a) if of(a).interval.is_non_negative() => push(a, 0.5 * exponent),
            Node::Binary(op @ (Binary::Multiply | Binary::Divide), a, b) if splits(a) && splits(b) => {
                push(a, exponent);
                push(b, if op == Binary::Multiply { exponent } else { -exponent });
            }
            Node::Binary(Binary::Power, a, p) => match of(p).interval.as_point() {
                Some(p) if of(a).interval.is_non_negative() || (whole && p.fract() == 0.0) => push(a, p * exponent),
                _ if id == root => return None,
                _ => *factors.entry(id).or_insert(0.0) += exponent,
            },
            _ if id == root => return None,
            _ => *factors.entry(id).or_insert(0.0) += exponent,
        }
    }
    None
}

/// Π u_i^{p_i} of non-negative u_i is concave where all p_i > 0 and Σp_i ≤ 1; it is convex where all p_i < 0, and where exactly one
/// is positive and Σp_i ≥ 1 (C. Maranas, C. Floudas, 1995); and it rises or falls in each u_i as the sign of p_i says.
fn monomial(product: &Product, known: &[Structure]) -> Curvature {
    let of = |id: NodeId| known[id as usize];
    if let [(base, exponent)] = product.factors[..] {
        return power_shape(exponent, of(base).interval).compose(of(base).curvature);
    }
    let sum: f64 = product.factors.iter().map(|(_, p)| p).sum();
    let positive: Vec<(NodeId, f64)> = product.factors.iter().copied().filter(|(_, p)| *p > 0.0).collect();
    let concave = |&(base, _): &(NodeId, f64)| of(base).interval.is_non_negative() && of(base).curvature.is_concave();
    let log_concave = |&(base, _): &(NodeId, f64)| of(base).interval.is_non_negative() && of(base).logarithm.is_concave();
    if product.factors.iter().any(|(_, p)| *p == 0.0) {
        return Unknown;
    }
    let others = || product.factors.iter().filter(|(_, p)| *p < 0.0);
    match positive[..] {
        [] if product.factors.iter().all(log_concave) => Convex,
        [(base, p)] if sum >= 1.0 - ROUNDING && others().all(concave) && power_of_convex(of(base), p) => Convex,
        _ if positive.len() == product.factors.len() && sum <= 1.0 + ROUNDING && positive.iter().all(concave) => Concave,
        _ => Unknown,
    }
}

/// Whether |u|^p is a power of a convex function that is never negative.
pub(super) fn power_of_convex(base: Structure, p: f64) -> bool {
    let even = p % 2.0 == 0.0;
    match base.curvature {
        _ if base.interval.is_non_negative() => base.curvature.is_convex(),
        Constant | Affine => even,
        Concave => even && base.interval.is_non_positive(),
        _ => false,
    }
}

/// (fg)″ = f″g + 2f′g′ + fg″ for two functions of the same single input.
fn of_one_input(product: &Product, known: &[Structure]) -> Curvature {
    let [(a, p), (b, q)] = product.factors[..] else { return Unknown };
    let raised = |id: NodeId, p: f64| {
        let base = known[id as usize];
        let Line::One(input, slope) = base.line else { return None };
        let outer = Slope::of_power(base.interval, p);
        let slope = match outer {
            Slope::Rising => slope,
            Slope::Falling => slope.turned(),
            Slope::Mixed => return None,
        };
        let bend = power_shape(p, base.interval).compose(base.curvature);
        (slope != Slope::Mixed && base.interval.is_non_negative()).then_some((input, slope, bend))
    };
    let (Some((first, s, f)), Some((second, t, g))) = (raised(a, p), raised(b, q)) else { return Unknown };
    match (first == second, s == t) {
        (true, true) if f.is_convex() && g.is_convex() => Convex,
        (true, false) if f.is_concave() && g.is_concave() => Concave,
        _ => Unknown,
    }
}

/// Constant and coefficients of an affine node.
fn affine(graph: &Graph, root: NodeId, known: &[Structure]) -> Option<(Interval, BTreeMap<u32, Interval>)> {
    let (mut constant, mut slopes) = (Interval::point(0.0), BTreeMap::new());
    let mut open = vec![(root, Interval::point(1.0))];
    let of = |id: NodeId| known[id as usize];
    for _ in 0..MOST_STEPS {
        let Some((id, factor)) = open.pop() else { return Some((constant, slopes)) };
        let is_constant = |id: NodeId| of(id).curvature == Constant;
        match graph.node(id) {
            _ if is_constant(id) => constant = constant.add(factor.multiply(of(id).interval)),
            Node::Input(slot) => {
                let sum = slopes.get(&slot).map_or(factor, |known: &Interval| known.add(factor));
                slopes.insert(slot, sum);
            }
            Node::Unary(Unary::Negate, a) => open.push((a, factor.negate())),
            Node::Binary(op @ (Binary::Add | Binary::Subtract), a, b) => {
                open.push((a, factor));
                open.push((b, if op == Binary::Add { factor } else { factor.negate() }));
            }
            Node::Binary(Binary::Multiply, a, b) if is_constant(a) => open.push((b, factor.multiply(of(a).interval))),
            Node::Binary(Binary::Multiply, a, b) if is_constant(b) => open.push((a, factor.multiply(of(b).interval))),
            Node::Binary(Binary::Divide, a, b) if is_constant(b) => open.push((a, factor.divide(of(b).interval))),
            _ => return None,
        }
    }
    None
}

/// p/q of affine p and q of one sign, p = αq + β: α + β/q. In several inputs α must be the same in all of them.
fn affine_quotient(graph: &Graph, product: &Product, known: &[Structure]) -> Curvature {
    let (p, q) = match product.factors[..] {
        [(p, 1.0), (q, -1.0)] | [(q, -1.0), (p, 1.0)] => (p, q),
        _ => return Unknown,
    };
    let bottom = known[q as usize];
    if !(known[p as usize].curvature.is_affine() && bottom.curvature.is_affine()) {
        return Unknown;
    }
    let (Some((p0, above)), Some((q0, below))) = (affine(graph, p, known), affine(graph, q, known)) else { return Unknown };
    let Some((slot, &first)) = below.first_key_value() else { return Unknown };
    let Some(&top) = above.get(slot) else { return Unknown };
    let same = |(slot, slope): (&u32, &Interval)| {
        let other = above.get(slot)?;
        let (left, right) = (other.multiply(first).as_point()?, slope.multiply(top).as_point()?);
        (left == right).then_some(())
    };
    let proportional = above.len() == below.len() && (below.len() == 1 || below.iter().all(|entry| same(entry).is_some()));
    if !proportional || first.lower <= 0.0 && first.upper >= 0.0 {
        return Unknown;
    }
    let rest = p0.subtract(top.multiply(q0).divide(first));
    power_shape(-1.0, bottom.interval).compose(bottom.curvature).scaled(rest)
}

/// w·g(u/w, v/w, …) of a convex g and affine u, v, w with w ≥ 0 is convex: the perspective of g. Entropies are among these:
/// w·ln w is w·g(1/w) with g(r) = −ln r.
fn perspective(graph: &Graph, node: Node, product: &Product, known: &[Structure]) -> Curvature {
    let (a, b) = match (&product.factors[..], node) {
        (&[(a, 1.0), (b, 1.0)], _) => (a, b),
        // A root was taken for a power; its coefficient is taken out of it, and none is left here.
        (_, Node::Binary(Binary::Multiply, a, b)) if product.coefficient == Interval::point(1.0) => (a, b),
        _ => return Unknown,
    };
    if graph.len() > MOST_NODES {
        return Unknown;
    }
    let fits = |w: NodeId| known[w as usize].curvature.is_affine() && known[w as usize].interval.is_non_negative();
    let tried = [(a, b), (b, a)].into_iter().filter(|&(w, _)| fits(w)).map(|(w, g)| of_ratios(graph, w, g, known));
    tried.into_iter().find(|found| *found != Unknown).unwrap_or(Unknown)
}

/// The curvature of g as a function of the ratios of affine functions to w, which must be all it depends on.
fn of_ratios(graph: &Graph, w: NodeId, g: NodeId, known: &[Structure]) -> Curvature {
    let below = graph.below(g);
    if below.len() > MOST_INNER_NODES {
        return Unknown;
    }
    let mut ratios = known.to_vec();
    let is_multiple = |id: NodeId| is_multiple(graph, id, w, known);
    for id in below {
        let own = known[id as usize];
        if own.curvature == Constant {
            continue;
        }
        ratios[id as usize] = match graph.node(id) {
            // w = 1/(1/w)
            _ if id == w => Structure { curvature: Convex, logarithm: Convex, line: Line::Many, ..own },
            Node::Binary(Binary::Divide, u, v) if is_multiple(v) && known[u as usize].curvature.is_affine() => {
                let logarithm = if own.interval.is_non_negative() { Concave } else { Unknown };
                Structure { curvature: Affine, logarithm, line: Line::Many, ..own }
            }
            Node::Binary(Binary::Divide, u, v)
                if is_multiple(u) && known[v as usize].curvature.is_affine() && known[v as usize].interval.is_non_negative() =>
            {
                Structure { curvature: Convex, logarithm: Convex, line: Line::Many, ..own }
            }
            Node::Input(_) => Structure { curvature: Unknown, logarithm: Unknown, line: Line::Many, ..own },
            node => {
                let curvature = curvature::by_rules(graph, node, own.interval, &ratios);
                let logarithm = logarithm(node, own.interval, curvature, &ratios);
                let curvature = if curvature == Unknown && logarithm.is_convex() { Convex } else { curvature };
                Structure { curvature, logarithm, line: Line::Many, ..own }
            }
        };
    }
    ratios[g as usize].curvature
}

/// Whether a node is w times a positive constant.
fn is_multiple(graph: &Graph, id: NodeId, w: NodeId, known: &[Structure]) -> bool {
    let is_positive = |id: NodeId| known[id as usize].curvature == Constant && known[id as usize].interval.lower > 0.0;
    id == w
        || match graph.node(id) {
            Node::Binary(Binary::Multiply, a, b) => (b == w && is_positive(a)) || (a == w && is_positive(b)),
            Node::Binary(Binary::Divide, a, b) => a == w && is_positive(b),
            _ => false,
        }
}
