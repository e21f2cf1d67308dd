//! Convexity of sums with quadratic forms, proved by a factorisation in interval arithmetic.

use std::collections::BTreeMap;

use super::{Curvature, Interval, Structure};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// Forms in more inputs are not tried.
const INPUT_LIMIT: usize = 200;

/// Symmetric coefficients of products of inputs: (larger slot, smaller slot) → coefficient of the second derivative.
type QuadraticForm = BTreeMap<(u32, u32), Interval>;

/// The curvature of a sum: of its quadratic form and, beside it, of what is no product of affine functions. `Unknown` where no
/// proof is found.
pub(super) fn curvature(graph: &Graph, root: NodeId, known: &[Structure]) -> Curvature {
    let Some((form, rest)) = form(graph, root, known) else { return Curvature::Unknown };
    let matrix = |sign: f64| dense(&form, sign);
    if rest.is_convex() && matrix(1.0).is_some_and(is_positive_semidefinite) {
        Curvature::Convex
    } else if rest.is_concave() && matrix(-1.0).is_some_and(is_positive_semidefinite) {
        Curvature::Concave
    } else {
        Curvature::Unknown
    }
}

/// The second derivatives of a sum's quadratic terms, and how all its other terms bend together.
fn form(graph: &Graph, root: NodeId, known: &[Structure]) -> Option<(QuadraticForm, Curvature)> {
    let (mut form, mut rest) = (QuadraticForm::new(), Curvature::Constant);
    for (node, factor) in linear_parts(graph, root, known) {
        let (left, right) = match graph.node(node) {
            Node::Input(_) => continue,
            Node::Binary(Binary::Power, base, exponent) if graph.as_constant(exponent) == Some(2.0) => (base, base),
            Node::Binary(Binary::Multiply, left, right) => (left, right),
            _ => {
                rest = rest.plus(known[node as usize].curvature.scaled(factor));
                continue;
            }
        };
        match (gradient(graph, left, known), gradient(graph, right, known)) {
            (Some(left), Some(right)) => add_product(&mut form, factor, &left, &right),
            _ => rest = rest.plus(known[node as usize].curvature.scaled(factor)),
        }
        if rest == Curvature::Unknown {
            return None;
        }
        if form.len() > INPUT_LIMIT * (INPUT_LIMIT + 1) / 2 {
            return None;
        }
    }
    Some((form, rest))
}

/// The inputs of an affine node and their coefficients.
fn gradient(graph: &Graph, root: NodeId, known: &[Structure]) -> Option<Vec<(u32, Interval)>> {
    let parts = linear_parts(graph, root, known).into_iter().map(|(node, factor)| match graph.node(node) {
        Node::Input(slot) => Some((slot, factor)),
        _ => None,
    });
    parts.collect::<Option<Vec<_>>>().filter(|parts| parts.len() <= INPUT_LIMIT)
}

/// A node as Σ factor·part, what is free of inputs left out; parts are no sums any more.
fn linear_parts(graph: &Graph, root: NodeId, known: &[Structure]) -> Vec<(NodeId, Interval)> {
    let free = |id: NodeId| known[id as usize].curvature == Curvature::Constant;
    let value = |id: NodeId| known[id as usize].interval;
    let mut open = BTreeMap::from([(root, Interval::point(1.0))]);
    let mut parts = Vec::new();
    while let Some((node, factor)) = open.pop_last() {
        let mut pass = |id: NodeId, factor: Interval| {
            let sum = open.get(&id).map_or(factor, |other| other.add(factor));
            open.insert(id, sum);
        };
        match graph.node(node) {
            _ if free(node) => {}
            Node::Unary(Unary::Negate, operand) => pass(operand, factor.negate()),
            Node::Binary(op @ (Binary::Add | Binary::Subtract), left, right) => {
                pass(left, factor);
                pass(right, if op == Binary::Add { factor } else { factor.negate() });
            }
            Node::Binary(Binary::Multiply, left, right) if free(left) => pass(right, factor.multiply(value(left))),
            Node::Binary(Binary::Multiply, left, right) if free(right) => pass(left, factor.multiply(value(right))),
            Node::Binary(Binary::Divide, left, right) if free(right) => pass(left, factor.divide(value(right))),
            _ => parts.push((node, factor)),
        }
    }
    parts
}

/// Adds the second derivatives of factor·(a·x)(b·x).
fn add_product(form: &mut QuadraticForm, factor: Interval, a: &[(u32, Interval)], b: &[(u32, Interval)]) {
    for &(i, ai) in a {
        for &(j, bj) in b {
            let product = factor.multiply(ai).multiply(bj);
            let entry = form.entry((i.max(j), i.min(j))).or_insert(Interval::point(0.0));
            *entry = entry.add(product);
            if i == j {
                *entry = entry.add(product);
            }
        }
    }
}

/// The lower triangle, row by row; `None` for too many inputs.
fn dense(form: &QuadraticForm, sign: f64) -> Option<Vec<Vec<Interval>>> {
    let mut slots: Vec<u32> = form.keys().flat_map(|&(i, j)| [i, j]).collect();
    slots.sort_unstable();
    slots.dedup();
    if slots.len() > INPUT_LIMIT {
        return None;
    }
    let at = |slot: &u32| slots.partition_point(|other| other < slot);
    let mut rows: Vec<Vec<Interval>> = (0..slots.len()).map(|i| vec![Interval::point(0.0); i + 1]).collect();
    for ((i, j), &value) in form {
        rows[at(i)][at(j)] = if sign < 0.0 { value.negate() } else { value };
    }
    Some(rows)
}

/// Whether LDLᵀ finds pivots that are surely positive, or exactly zero with nothing else in their column.
fn is_positive_semidefinite(mut a: Vec<Vec<Interval>>) -> bool {
    let zero = Interval::point(0.0);
    for k in 0..a.len() {
        let pivot = a[k][k];
        if pivot == zero && (k + 1..a.len()).all(|i| a[i][k] == zero) {
            continue;
        }
        if pivot.lower <= 0.0 {
            return false;
        }
        for i in k + 1..a.len() {
            let factor = a[i][k].divide(pivot);
            for j in k + 1..=i {
                let change = if i == j { a[i][k].power(2.0).divide(pivot) } else { factor.multiply(a[j][k]) };
                a[i][j] = a[i][j].subtract(change);
            }
        }
    }
    true
}
