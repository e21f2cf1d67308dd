//! Claims about random formulas, held against their values.

use super::super::*;
use super::check_hessian;
use crate::expression::display::display;
use crate::expression::operators::{Binary, Unary};
use crate::expression::tape::{Tape, Workspace};
use Curvature::Unknown;

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

pub(super) struct Random(u64);

impl Random {
    pub(super) fn uniform(&mut self) -> f64 {
        self.0 = self.0.wrapping_mul(6364136223846793005).wrapping_add(1442695040888963407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.uniform() * count as f64) as usize
    }

    pub(super) fn formula(&mut self, operations: usize) -> (Graph, NodeId) {
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
