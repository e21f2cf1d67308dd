use super::*;
use crate::expression::display::display;
use crate::expression::operators::{Binary, Unary};
use crate::expression::tape::{Tape, Workspace};

/// Two inputs a and b, one datum c; all of them between 0.1 and 2.
struct Case {
    graph: Graph,
    a: NodeId,
    b: NodeId,
    c: NodeId,
}

impl Case {
    fn new() -> Self {
        let mut graph = Graph::new();
        let (a, b, c) = (graph.input(0), graph.input(1), graph.data(0));
        Case { graph, a, b, c }
    }

    fn analyse(&self) -> Vec<Structure> {
        let range = Interval::new(0.1, 2.0);
        analyse(&self.graph, &[range, range], &[range])
    }

    fn of(&self, node: NodeId) -> (Curvature, Curvature) {
        let structure = self.analyse()[node as usize];
        (structure.curvature, structure.log_curvature)
    }

    fn blamed(&self, node: NodeId, wanted: Wanted) -> Option<String> {
        let culprit = blame(&self.graph, &self.analyse(), node, wanted)?;
        Some(display(&self.graph, culprit, &|slot| ["a", "b"][slot as usize].into(), &|_| "c".into()))
    }
}

use Curvature::{Affine, Concave, Constant, Convex, Unknown};

#[test]
fn sums_of_squares_are_convex() {
    let mut case = Case::new();
    let two = case.graph.constant(2.0);
    let shifted = case.graph.subtract(case.a, two);
    let (first, second) = (case.graph.power(shifted, 2.0), case.graph.power(case.b, 2.0));
    let sum = case.graph.add(first, second);
    assert_eq!(case.of(sum).0, Convex);
}

#[test]
fn an_input_fixed_by_its_bounds_is_a_constant() {
    let mut case = Case::new();
    let square = case.graph.power(case.b, 2.0);
    let product = case.graph.multiply(case.a, square);
    let ranges = |a| analyse(&case.graph, &[a, Interval::new(-1.0, 1.0)], &[])[product as usize].curvature;
    assert_eq!(ranges(Interval::point(3.0)), Convex);
    assert_eq!(ranges(Interval::point(-3.0)), Concave);
    assert_eq!(ranges(Interval::new(2.0, 3.0)), Unknown);
}

#[test]
fn quadratic_forms_are_factorised() {
    for (middle, expected) in [(1.0, Convex), (-2.0, Convex), (2.0, Convex), (2.0 + 1e-15, Unknown), (3.0, Unknown)] {
        let mut case = Case::new();
        let (first, second) = (case.graph.power(case.a, 2.0), case.graph.power(case.b, 2.0));
        let product = case.graph.multiply(case.a, case.b);
        let product = case.graph.scale(middle, product);
        let sum = case.graph.add(first, product);
        let sum = case.graph.add(sum, second);
        assert_eq!(case.of(sum).0, expected, "{middle}");
        let mut turned = case;
        let minus = turned.graph.unary(Unary::Negate, sum);
        assert_eq!(turned.of(minus).0, expected.negated(), "−, {middle}");
    }
}

#[test]
fn rectangles_are_monomials_and_their_frusta_posynomials() {
    let mut case = Case::new();
    let area = case.graph.multiply(case.a, case.b);
    let cube = case.graph.power(case.b, 3.0);
    let inertia = case.graph.multiply(case.a, cube);
    let squared = case.graph.power(case.a, 2.0);
    let both = case.graph.multiply(area, squared);
    let root = case.graph.unary(Unary::Sqrt, both);
    let sum = case.graph.add(area, squared);
    let volume = case.graph.add(sum, root);
    let volume = case.graph.multiply(case.c, volume);
    assert_eq!(case.of(inertia), (Unknown, Affine));
    assert_eq!(case.of(volume).1, Convex);
    let inverse = case.graph.divide(case.c, volume);
    assert_eq!(case.of(inverse).1, Concave);
    assert_eq!(case.of(case.c), (Constant, Constant));
}

#[test]
fn differences_of_cubes_are_no_posynomials_and_are_blamed() {
    let mut case = Case::new();
    let (a3, b3) = (case.graph.power(case.a, 3.0), case.graph.power(case.b, 3.0));
    let difference = case.graph.subtract(a3, b3);
    let root = case.graph.add(difference, case.a);
    assert_eq!(case.of(root), (Unknown, Unknown));
    assert_eq!(case.blamed(root, Wanted::LogConvex).unwrap(), "a^3 - b^3");
    assert_eq!(case.blamed(root, Wanted::Convex).unwrap(), "b^3");
    assert_eq!(case.blamed(case.a, Wanted::Convex), None);
}

#[test]
fn compositions_follow_slope_and_range() {
    let mut case = Case::new();
    let square = case.graph.power(case.a, 2.0);
    let exponential = case.graph.unary(Unary::Exp, square);
    let log = case.graph.unary(Unary::Log, case.a);
    let inverse = case.graph.power(case.a, -1.0);
    let quotient = case.graph.divide(square, case.b);
    let root = case.graph.unary(Unary::Sqrt, square);
    let absolute = case.graph.unary(Unary::Abs, log);
    let larger = case.graph.binary(Binary::Max, square, inverse);
    let smaller = case.graph.binary(Binary::Min, case.a, log);
    let two = case.graph.constant(2.0);
    let exponent = case.graph.binary(Binary::Power, two, square);
    let nodes = [exponential, log, inverse, quotient, root, absolute, larger, smaller, exponent];
    let expected = [Convex, Concave, Convex, Convex, Convex, Unknown, Convex, Concave, Convex];
    assert_eq!(nodes.map(|node| case.of(node).0), expected);
}

/// Midpoint convexity at random points, for every claim made about random formulas over several ranges.
#[test]
fn claims_hold_at_random_points() {
    let mut random = Random(1);
    let mut claims = 0;
    for round in 0..15_000 {
        let (graph, root) = random.formula(5 + round % 5);
        let (lower, upper) =
            [(0.3, 1.4), (-1.2, 0.9), (-1.6, -0.2), (0.0, 3.0), (0.01, 40.0), (1.0, 1.1), (-3.0, 0.0)][round % 7];
        let range = Interval::new(lower, upper);
        let structure = analyse(&graph, &[range, range], &[])[root as usize];
        let (tape, _) = Tape::compile(&graph, root).unwrap();
        if tape.inputs() == 0 {
            continue;
        }
        for _ in 0..10 {
            let mut point = || (0..tape.inputs()).map(|_| lower + (upper - lower) * random.uniform()).collect::<Vec<f64>>();
            let (p, q) = (point(), point());
            let text = || display(&graph, root, &|slot| format!("x{slot}"), &|_| String::new());
            claims += check_claims(&tape, structure, &p, &q).unwrap_or_else(|wrong| panic!("{wrong}: {}", text()));
            check_hessian(&tape, structure.curvature, &p).unwrap_or_else(|wrong| panic!("{wrong}: {}", text()));
        }
    }
    assert!(claims > 40_000, "{claims}");
}

/// What disciplined convex programming has as atoms, with its right answer between 0.1 and 2.
#[test]
fn atoms_are_known() {
    let convex: [fn(&mut Case) -> NodeId; 16] = [
        |case| case.over(3.0),
        |case| case.norm(0.0),
        |case| case.norm(1.0),
        |case| case.log_sum_exp(),
        |case| case.entropy(),
        |case| case.relative_entropy(),
        |case| case.square_over(2.0, -1.0),
        |case| case.square_over(4.0, -3.0),
        |case| case.square_over(-0.5, -0.7),
        |case| case.negative_mean(0.3, 0.7),
        |case| case.negative_mean(0.25, 0.5),
        |case| case.perspective(Unary::Exp),
        |case| case.shifted_inverse(),
        |case| case.rising_product(),
        |case| case.form_beside_exponential(),
        |case| case.power_of_sum(1.7),
    ];
    for (number, build) in convex.into_iter().enumerate() {
        let mut case = Case::new();
        let node = build(&mut case);
        assert_eq!(case.of(node).0, Convex, "atom {number}");
        let minus = case.graph.unary(Unary::Negate, node);
        assert_eq!(case.of(minus).0, Concave, "minus atom {number}");
    }
    let neither: [fn(&mut Case) -> NodeId; 5] = [
        |case| case.square_over(2.0, -1.5),
        |case| case.negative_mean(0.6, 0.7),
        |case| case.square_over(1.0, -1.0),
        |case| case.square_over(1.0, 1.0),
        |case| case.perspective(Unary::Sin),
    ];
    for (number, build) in neither.into_iter().enumerate() {
        let mut case = Case::new();
        let node = build(&mut case);
        assert_eq!(case.of(node).0, Unknown, "no atom {number}");
    }
}

impl Case {
    fn over(&mut self, exponent: f64) -> NodeId {
        let power = self.graph.power(self.a, exponent);
        self.graph.divide(self.c, power)
    }

    fn norm(&mut self, constant: f64) -> NodeId {
        let difference = self.graph.subtract(self.a, self.b);
        let (first, second) = (self.graph.power(difference, 2.0), self.graph.multiply(self.b, self.b));
        let constant = self.graph.constant(constant);
        let sum = self.graph.add(first, second);
        let sum = self.graph.add(sum, constant);
        self.graph.unary(Unary::Sqrt, sum)
    }

    fn log_sum_exp(&mut self) -> NodeId {
        let difference = self.graph.subtract(self.a, self.b);
        let (first, second) = (self.graph.unary(Unary::Exp, difference), self.graph.unary(Unary::Exp, self.b));
        let sum = self.graph.add(first, second);
        let sum = self.graph.add(sum, self.c);
        self.graph.unary(Unary::Log, sum)
    }

    fn entropy(&mut self) -> NodeId {
        let (scaled, log) = (self.graph.multiply(self.c, self.a), self.graph.unary(Unary::Log, self.a));
        self.graph.multiply(scaled, log)
    }

    fn relative_entropy(&mut self) -> NodeId {
        let ratio = self.graph.divide(self.a, self.b);
        let log = self.graph.unary(Unary::Log, ratio);
        self.graph.multiply(self.a, log)
    }

    fn square_over(&mut self, p: f64, q: f64) -> NodeId {
        let (first, second) = (self.graph.power(self.a, p), self.graph.power(self.b, q));
        self.graph.multiply(first, second)
    }

    fn negative_mean(&mut self, p: f64, q: f64) -> NodeId {
        let mean = self.square_over(p, q);
        self.graph.unary(Unary::Negate, mean)
    }

    fn perspective(&mut self, op: Unary) -> NodeId {
        let ratio = self.graph.divide(self.a, self.b);
        let outer = self.graph.unary(op, ratio);
        self.graph.multiply(self.b, outer)
    }

    /// (1 + a)/a
    fn shifted_inverse(&mut self) -> NodeId {
        let one = self.graph.constant(1.0);
        let sum = self.graph.add(one, self.a);
        self.graph.divide(sum, self.a)
    }

    fn rising_product(&mut self) -> NodeId {
        let exponential = self.graph.unary(Unary::Exp, self.a);
        self.graph.multiply(self.a, exponential)
    }

    fn form_beside_exponential(&mut self) -> NodeId {
        let (square, exponential) = (self.graph.power(self.a, 2.0), self.graph.unary(Unary::Exp, self.a));
        let (product, other) = (self.graph.multiply(self.a, self.b), self.graph.power(self.b, 2.0));
        let sum = self.graph.add(square, exponential);
        let sum = self.graph.add(sum, product);
        self.graph.add(sum, other)
    }

    fn power_of_sum(&mut self, exponent: f64) -> NodeId {
        let sum = self.graph.add(self.a, self.b);
        self.graph.power(sum, exponent)
    }
}

/// The Hessian at a point of what is called convex, or concave, has no eigenvalue of the wrong sign beyond rounding.
fn check_hessian(tape: &Tape, curvature: Curvature, p: &[f64]) -> Result<(), String> {
    let pattern = tape.hessian_pattern();
    let mut entries = vec![0.0; pattern.len()];
    let value = tape.hessian(p, &[], &mut Workspace::default(), &mut entries);
    // Derivatives may be finite where there is no value.
    if !value.is_finite() || !entries.iter().all(|entry| entry.is_finite()) {
        return Ok(());
    }
    let entry =
        |i: u32, j: u32| pattern.iter().zip(&entries).filter(|((r, c), _)| (*r, *c) == (i, j)).map(|(_, e)| e).sum::<f64>();
    let (a, b, c) = (entry(0, 0), entry(1, 0), entry(1, 1));
    let (middle, reach) = (0.5 * (a + c), (0.5 * a - 0.5 * c).hypot(b));
    let slack = 1e-7 * (a.abs() + b.abs() + c.abs() + 1.0);
    if curvature.is_convex() && middle - reach < -slack || curvature.is_concave() && middle + reach > slack {
        return Err(format!("the Hessian {a} {b} {c} at {p:?} is not that of a {curvature:?} function"));
    }
    Ok(())
}

/// The number of claims that were put to the test between two points, or the wrong one.
fn check_claims(tape: &Tape, structure: Structure, p: &[f64], q: &[f64]) -> Result<usize, String> {
    let value = |x: &[f64]| tape.value(x, &[], &mut Workspace::default());
    let between = |mean: fn(f64, f64) -> f64| value(&p.iter().zip(q).map(|(&p, &q)| mean(p, q)).collect::<Vec<_>>());
    let (at_p, at_q) = (value(p), value(q));
    if !at_p.is_finite() || !at_q.is_finite() {
        return Ok(0);
    }
    if !(structure.interval.lower <= at_p && at_p <= structure.interval.upper) {
        return Err(format!("{at_p} is outside {:?}", structure.interval));
    }
    let gap = 0.5 * (at_p + at_q) - between(|p, q| 0.5 * (p + q));
    let log_gap = 0.5 * (at_p.ln() + at_q.ln()) - between(|p, q| (p * q).sqrt()).ln();
    let slack = 1e-9 * (at_p.abs() + at_q.abs() + 1.0);
    // Log-log statements hold for positive inputs.
    let positive = at_p > 0.0 && at_q > 0.0 && p.iter().chain(q).all(|x| *x > 0.0);
    let mut claims = 0;
    for (tested, curvature, gap, slack) in
        [(true, structure.curvature, gap, slack), (positive, structure.log_curvature, log_gap, 1e-9)]
    {
        claims += usize::from(tested && curvature != Unknown);
        // Not finite: the domain is not convex.
        if tested && curvature.is_convex() && (gap.is_nan() || gap < -slack) {
            return Err(format!("not convex by {gap}"));
        }
        if tested && curvature.is_concave() && (gap.is_nan() || gap > slack) {
            return Err(format!("not concave by {gap}"));
        }
    }
    Ok(claims)
}

struct Random(u64);

impl Random {
    fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    fn below(&mut self, count: usize) -> usize {
        (self.uniform() * count as f64) as usize
    }

    fn formula(&mut self, operations: usize) -> (Graph, NodeId) {
        const BINARY: [Binary; 7] =
            [Binary::Add, Binary::Subtract, Binary::Multiply, Binary::Divide, Binary::Power, Binary::Min, Binary::Max];
        let mut graph = Graph::new();
        let mut nodes = vec![graph.input(0), graph.input(1)];
        nodes.extend([0.5, -1.5, 2.0, 1.5, 3.0, 1.0 / 3.0].map(|number| graph.constant(number)));
        for _ in 0..operations {
            let (a, b) = (nodes[self.below(nodes.len())], nodes[self.below(nodes.len())]);
            nodes.push(match self.below(28) {
                unary @ 0..14 => graph.unary(Unary::NAMED[unary].1, a),
                binary => graph.binary(BINARY[binary % 7], a, b),
            });
        }
        (graph, nodes[nodes.len() - 1])
    }
}
