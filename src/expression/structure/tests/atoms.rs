//! Atoms of convex programming: what is built of squares, norms, logarithms and quotients is known for what it is.

use super::super::*;
use super::Case;
use crate::expression::operators::Unary;
use Curvature::{Concave, Convex, Unknown};

#[test]
fn atoms_are_known() {
    let convex: [fn(&mut Case) -> NodeId; 17] = [
        |case| case.over(3.0),
        |case| case.norm(0.0),
        |case| case.norm(1.0),
        |case| case.log_sum_exp(),
        |case| case.entropy(),
        |case| case.relative_entropy(),
        |case| case.entropy_in_other_units(),
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

    /// 2a·ln(2a/(2a + b))
    fn entropy_in_other_units(&mut self) -> NodeId {
        let scaled = self.graph.scale(2.0, self.a);
        let sum = self.graph.add(scaled, self.b);
        let ratio = self.graph.divide(scaled, sum);
        let log = self.graph.unary(Unary::Log, ratio);
        self.graph.multiply(scaled, log)
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
