use super::*;
use crate::expression::operators::{Binary, Unary};

/// Value, gradient and Hessian (all positions of the pattern) at a point.
pub(super) struct Derivatives {
    pub(super) value: f64,
    pub(super) gradient: Vec<f64>,
    pub(super) hessian: Vec<((u32, u32), f64)>,
}

pub(super) fn derivatives(tape: &Tape, x: &[f64], d: &[f64]) -> Derivatives {
    let mut workspace = Workspace::default();
    let mut gradient = vec![0.0; tape.inputs()];
    let value = tape.gradient(x, d, &mut workspace, &mut gradient);
    let mut h = vec![0.0; tape.hessian_pattern().len()];
    let again = tape.hessian(x, d, &mut workspace, &mut h);
    assert_eq!(value.to_bits(), again.to_bits());
    Derivatives { value, gradient, hessian: tape.hessian_pattern().iter().copied().zip(h).collect() }
}

/// Of a formula in one input.
fn at(build: impl Fn(&mut Graph, NodeId) -> NodeId, x: f64) -> (f64, f64, f64) {
    let mut graph = Graph::new();
    let input = graph.input(0);
    let root = build(&mut graph, input);
    let (tape, _) = Tape::compile(&graph, root).unwrap();
    let all = derivatives(&tape, &[x], &[]);
    (all.value, all.gradient[0], all.hessian.first().map_or(0.0, |entry| entry.1))
}

#[test]
fn powers_at_zero() {
    assert_eq!(at(|g, x| g.power(x, 2.0), 0.0), (0.0, 0.0, 2.0));
    assert_eq!(at(|g, x| g.power(x, 3.0), 0.0), (0.0, 0.0, 0.0));
    assert_eq!(at(|g, x| g.power(x, 0.0), 0.0), (1.0, 0.0, 0.0));
    assert_eq!(at(|g, x| g.power(x, 1.5), 0.0), (0.0, 0.0, f64::INFINITY));
    assert_eq!(at(|g, x| g.power(x, 2.5), 0.0), (0.0, 0.0, 0.0));
    assert_eq!(at(|g, x| g.multiply(x, x), -3.0), (9.0, -6.0, 2.0));
    let (value, slope, curvature) = at(|g, x| g.binary(Binary::Power, x, x), 2.0);
    let log = 2.0_f64.ln() + 1.0;
    assert!(value == 4.0 && (slope - 4.0 * log).abs() < 1e-14 && (curvature - 4.0 * (log * log + 0.5)).abs() < 1e-13);
}

#[test]
fn a_variable_exponent_over_a_base_of_zero() {
    let mut graph = Graph::new();
    let (x, y) = (graph.input(0), graph.input(1));
    let root = graph.binary(Binary::Power, x, y);
    let (tape, _) = Tape::compile(&graph, root).unwrap();
    let all = derivatives(&tape, &[0.0, 3.0], &[]);
    assert_eq!((all.value, all.gradient), (0.0, vec![0.0, 0.0]));
    assert_eq!(all.hessian, [((0, 0), 0.0), ((1, 0), 0.0), ((1, 1), 0.0)]);
}

#[test]
fn infinite_derivatives_come_out() {
    assert_eq!(at(|g, x| g.unary(Unary::Sqrt, x), 0.0), (0.0, f64::INFINITY, f64::NEG_INFINITY));
    let squared_root = at(
        |g, x| {
            let root = g.unary(Unary::Sqrt, x);
            g.power(root, 2.0)
        },
        0.0,
    );
    assert!(squared_root.1.is_nan(), "one by the limit, but no finite sum says so");
}

#[test]
fn what_has_no_influence_makes_no_nan() {
    let zero_times = |g: &mut Graph, x| {
        let root = g.unary(Unary::Sqrt, x);
        g.scale(0.0, root)
    };
    assert_eq!(at(zero_times, 0.0), (0.0, 0.0, 0.0));
    let larger = |g: &mut Graph, x| {
        let (root, one) = (g.unary(Unary::Sqrt, x), g.constant(1.0));
        let larger = g.binary(Binary::Max, root, one);
        let square = g.power(x, 2.0);
        g.add(larger, square)
    };
    assert_eq!(at(larger, 0.0), (1.0, 0.0, 2.0));
}

#[test]
fn kinks_take_one_side() {
    assert_eq!(at(|g, x| g.unary(Unary::Abs, x), 0.0), (0.0, 1.0, 0.0));
    let smaller = |g: &mut Graph, x| {
        let twice = g.scale(2.0, x);
        g.binary(Binary::Min, x, twice)
    };
    assert!([1.0, 2.0].contains(&at(smaller, 0.0).1));
}

#[test]
fn the_pattern_has_only_what_interacts() {
    let mut graph = Graph::new();
    let [x, y, z] = [0, 1, 2].map(|slot| graph.input(slot));
    let (product, cube) = (graph.multiply(x, y), graph.power(z, 3.0));
    let root = graph.add(product, cube);
    let (tape, binding) = Tape::compile(&graph, root).unwrap();
    let mut global: Vec<(u32, u32)> = tape
        .hessian_pattern()
        .iter()
        .map(|&(i, j)| (binding.inputs[i as usize], binding.inputs[j as usize]))
        .map(|(i, j)| (i.max(j), i.min(j)))
        .collect();
    global.sort_unstable();
    assert_eq!(global, [(1, 0), (2, 2)]);
}

#[test]
fn one_shape_makes_one_program() {
    let mut graph = Graph::new();
    let (late, early) = (graph.input(7), graph.input(1));
    let programs: Vec<_> = [(early, 0.5), (late, 0.9)]
        .iter()
        .map(|&(input, factor)| {
            let cube = graph.power(input, 3.0);
            let term = graph.scale(factor, cube);
            let length = graph.data(4);
            let term = graph.multiply(length, term);
            Program::extract(&graph, term, Literals::AsData)
        })
        .collect();
    assert_eq!(programs[0].0, programs[1].0);
    assert_eq!((&programs[0].1.inputs, &programs[1].1.inputs), (&vec![1], &vec![7]));
    assert!(programs[1].1.data.contains(&Source::Literal(0.9)) && programs[1].1.data.contains(&Source::Data(4)));
    let tape = Tape::new(programs[0].0.clone()).unwrap();
    let d = programs[0].1.data.iter().map(|source| if *source == Source::Data(4) { 10.0 } else { 0.5 }).collect::<Vec<_>>();
    assert_eq!(tape.value(&[2.0], &d, &mut Workspace::default()), 40.0);
}

#[test]
fn the_first_failure_is_named() {
    let cause = |build: &dyn Fn(&mut Graph, NodeId) -> NodeId, x: f64| {
        let mut graph = Graph::new();
        let input = graph.input(0);
        let inner = build(&mut graph, input);
        let root = graph.add(inner, input);
        Tape::compile(&graph, root).unwrap().0.explain(&[x], &[]).map(|invalid| invalid.cause)
    };
    let one_over = |g: &mut Graph, x| {
        let one = g.constant(1.0);
        g.divide(one, x)
    };
    assert_eq!(cause(&|g, x| g.unary(Unary::Sqrt, x), -0.25).unwrap(), "square root of -0.25");
    assert_eq!(cause(&|g, x| g.unary(Unary::Log, x), 0.0).unwrap(), "logarithm of 0");
    assert_eq!(cause(&one_over, 0.0).unwrap(), "division by zero");
    assert_eq!(cause(&|g, x| g.unary(Unary::Exp, x), 1e3).unwrap(), "the value overflows");
    assert_eq!(cause(&|g, x| g.power(x, 0.5), -1.0).unwrap(), "-1 to the power 0.5");
    assert_eq!(cause(&|g, x| g.power(x, 0.5), f64::NAN).unwrap(), "a number that goes in is NaN");
    assert_eq!(cause(&|g, x| g.unary(Unary::Sqrt, x), 0.0).unwrap(), "the square root has no finite derivative at 0");
    assert_eq!(cause(&|g, x| g.power(x, 1.5), 0.0).unwrap(), "the power has no finite second derivative at (0, 1.5)");
    assert_eq!(cause(&one_over, 2.0), None);
}

#[test]
fn deep_and_wide_programs() {
    let mut graph = Graph::new();
    let mut deep = graph.input(0);
    for _ in 0..200_000 {
        deep = graph.unary(Unary::Atan, deep);
    }
    let (tape, _) = Tape::compile(&graph, deep).unwrap();
    assert!(derivatives(&tape, &[1.0], &[]).value > 0.0);
    let inputs: Vec<NodeId> = (0..100_000).map(|slot| graph.input(slot)).collect();
    let squares: Vec<NodeId> = inputs.iter().map(|&input| graph.power(input, 2.0)).collect();
    let sum = graph.sum(&squares);
    let (tape, _) = Tape::compile(&graph, sum).unwrap();
    assert_eq!(tape.hessian_pattern().len(), 100_000);
    let some = graph.sum(&squares[..1000]);
    let norm = graph.unary(Unary::Sqrt, some);
    assert_eq!(Tape::compile(&graph, norm).unwrap().0.hessian_pattern().len(), 1000 * 1001 / 2);
    let norm = graph.unary(Unary::Sqrt, sum);
    assert_eq!(Tape::compile(&graph, norm).unwrap_err(), TapeError::TooDense { inputs: 100_000 });
}
