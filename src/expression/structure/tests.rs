mod atoms;
mod random;

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

/// What disciplined convex programming has as atoms, with its right answer between 0.1 and 2.
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
