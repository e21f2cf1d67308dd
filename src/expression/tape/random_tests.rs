//! Random formulas against hyper-dual numbers and central differences.

use num_dual::{DualNum, HyperDual64};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

use super::tests::derivatives;
use super::*;
use crate::expression::graph::Node;
use crate::expression::operators::{Binary, Unary};
use crate::math::special;

/// The same formula in hyper-dual numbers, and next to each value the sum of the magnitudes it was made of.
fn hyper_dual(graph: &Graph, root: NodeId, x: &[HyperDual64]) -> (HyperDual64, f64) {
    let mut values: Vec<HyperDual64> = Vec::new();
    let mut size: f64 = 1.0;
    for id in 0..=root {
        let of = |operand: NodeId| values[operand as usize];
        if at_kink(graph.node(id), &values) {
            size = f64::INFINITY;
        }
        let value = match graph.node(id) {
            Node::Constant(number) => HyperDual64::from(number),
            Node::Input(slot) => x[slot as usize],
            Node::Data(_) => unreachable!(),
            Node::Unary(op, a) => hyper_unary(op, of(a)),
            Node::Binary(op, a, b) => hyper_binary(op, of(a), of(b)),
        };
        let parts = [value.re, value.eps1, value.eps2, value.eps1eps2];
        size = parts.iter().fold(size, |size, part| if part.is_finite() { size.max(part.abs()) } else { f64::INFINITY });
        values.push(value);
    }
    (values[root as usize], size)
}

fn at_kink(node: Node, values: &[HyperDual64]) -> bool {
    match node {
        Node::Unary(Unary::Abs, a) => values[a as usize].re.abs() < 1e-3,
        Node::Binary(Binary::Min | Binary::Max, a, b) => (values[a as usize].re - values[b as usize].re).abs() < 1e-3,
        _ => false,
    }
}

fn hyper_unary(op: Unary, a: HyperDual64) -> HyperDual64 {
    match op {
        Unary::Negate => -a,
        Unary::Sqrt => a.sqrt(),
        Unary::Exp => a.exp(),
        Unary::Log => a.ln(),
        Unary::Log10 => a.log10(),
        Unary::Sin => a.sin(),
        Unary::Cos => a.cos(),
        Unary::Tan => a.tan(),
        Unary::Asin => a.asin(),
        Unary::Acos => a.acos(),
        Unary::Atan => a.atan(),
        Unary::Sinh => a.sinh(),
        Unary::Cosh => a.cosh(),
        Unary::Tanh => a.tanh(),
        Unary::Erf => {
            let (slope, bend) = (special::erf_slope(a.re), -2.0 * a.re * special::erf_slope(a.re));
            let mixed = slope * a.eps1eps2 + bend * a.eps1 * a.eps2;
            HyperDual64::new(special::erf(a.re), slope * a.eps1, slope * a.eps2, mixed)
        }
        Unary::LnGamma => unreachable!("drawn from the named functions"),
        Unary::Abs => {
            if a.re < 0.0 {
                -a
            } else {
                a
            }
        }
    }
}

fn hyper_binary(op: Binary, a: HyperDual64, b: HyperDual64) -> HyperDual64 {
    match op {
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Multiply => a * b,
        Binary::Divide => a / b,
        Binary::Power => (a.ln() * b).exp(),
        Binary::Atan2 => a.atan2(b),
        Binary::Min => {
            if a.re <= b.re {
                a
            } else {
                b
            }
        }
        Binary::Max => {
            if a.re >= b.re {
                a
            } else {
                b
            }
        }
    }
}

const UNARY: [Unary; 13] = [
    Unary::Negate,
    Unary::Sqrt,
    Unary::Exp,
    Unary::Log,
    Unary::Log10,
    Unary::Sin,
    Unary::Cos,
    Unary::Asin,
    Unary::Atan,
    Unary::Sinh,
    Unary::Tanh,
    Unary::Abs,
    Unary::Erf,
];
const BINARY: [Binary; 8] =
    [Binary::Add, Binary::Subtract, Binary::Multiply, Binary::Divide, Binary::Power, Binary::Atan2, Binary::Min, Binary::Max];

/// A formula in three inputs: each step takes two earlier nodes and an operation.
fn random_formula(steps: &[(u8, u8, u8)], constant: f64) -> (Graph, NodeId) {
    let mut graph = Graph::new();
    let mut nodes: Vec<NodeId> = (0..3).map(|slot| graph.input(slot)).collect();
    nodes.push(graph.constant(constant));
    for &(which, a, b) in steps {
        let pick = |index: u8| nodes[nodes.len() - 1 - usize::from(index) % nodes.len()];
        let (a, b) = (pick(a), pick(b));
        nodes.push(match usize::from(which) % (UNARY.len() + BINARY.len()) {
            unary if unary < UNARY.len() => graph.unary(UNARY[unary], a),
            binary => graph.binary(BINARY[binary - UNARY.len()], a, b),
        });
    }
    let root = nodes[nodes.len() - 1];
    (graph, root)
}

/// Checks against hyper-dual numbers; `None` where the formula has no tame value there.
fn agrees(graph: &Graph, root: NodeId, x: &[f64]) -> Option<()> {
    let (tape, binding) = Tape::compile(graph, root).unwrap();
    let local: Vec<f64> = binding.inputs.iter().map(|&slot| x[slot as usize]).collect();
    let all = derivatives(&tape, &local, &[]);
    let pairs = (0..tape.inputs() as u32).flat_map(|i| (0..=i).map(move |j| (i, j)));
    for (i, j) in pairs {
        let (gi, gj) = (binding.inputs[i as usize] as usize, binding.inputs[j as usize] as usize);
        let seed = |k: usize| HyperDual64::new(x[k], f64::from(k == gi), f64::from(k == gj), 0.0);
        let (expected, size) = hyper_dual(graph, root, &[seed(0), seed(1), seed(2)]);
        if !(size < 100.0 && expected.eps1eps2.is_finite()) {
            return None;
        }
        let second = all.hessian.iter().find(|entry| entry.0 == (i, j)).map_or(0.0, |entry| entry.1);
        let tolerance = 1e-12 * size * size;
        assert!((all.value - expected.re).abs() <= tolerance, "value {} {}", all.value, expected.re);
        assert!(
            (all.gradient[i as usize] - expected.eps1).abs() <= tolerance,
            "slope {i}: {} {}",
            all.gradient[i as usize],
            expected.eps1
        );
        assert!((second - expected.eps1eps2).abs() <= tolerance, "second ({i}, {j}): {second} {}", expected.eps1eps2);
    }
    Some(())
}

/// Central differences of value and gradient.
fn agrees_with_differences(graph: &Graph, root: NodeId, x: &[f64]) {
    let (tape, binding) = Tape::compile(graph, root).unwrap();
    let local: Vec<f64> = binding.inputs.iter().map(|&slot| x[slot as usize]).collect();
    let all = derivatives(&tape, &local, &[]);
    for j in 0..local.len() {
        let moved = |step: f64| {
            let mut point = local.clone();
            point[j] += step;
            derivatives(&tape, &point, &[])
        };
        let (ahead, behind) = (moved(1e-5), moved(-1e-5));
        let slope = (ahead.value - behind.value) / 2e-5;
        assert!((slope - all.gradient[j]).abs() <= 1e-6 * 100.0, "slope {j}: {slope} {}", all.gradient[j]);
        for i in 0..local.len() {
            let pair = (i.max(j) as u32, i.min(j) as u32);
            let second = all.hessian.iter().find(|entry| entry.0 == pair).map_or(0.0, |entry| entry.1);
            let change = (ahead.gradient[i] - behind.gradient[i]) / 2e-5;
            assert!((change - second).abs() <= 1e-6 * 100.0, "second {pair:?}: {change} {second}");
        }
    }
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 500, max_global_rejects: 50_000, rng_seed: RngSeed::Fixed(7), ..ProptestConfig::default() })]

    #[test]
    fn derivatives_agree_with_hyper_dual_numbers(
        steps in prop::collection::vec(any::<(u8, u8, u8)>(), 1..14),
        x in prop::array::uniform3(0.2_f64..3.0),
        constant in prop::sample::select(vec![2.0, 3.0, -1.0, 0.5, 1.7]),
    ) {
        let (graph, root) = random_formula(&steps, constant);
        prop_assume!(agrees(&graph, root, &x).is_some());
        agrees_with_differences(&graph, root, &x);
    }
}
