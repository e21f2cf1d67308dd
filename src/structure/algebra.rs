//! The same formulas on numbers and on expression graphs: what is constant is computed once, what varies keeps its derivatives.

use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::Unary;

/// Arithmetic on something.
pub trait Algebra {
    /// What is computed with.
    type Number: Copy;

    /// A constant.
    fn constant(&mut self, value: f64) -> Self::Number;
    /// left + right
    fn add(&mut self, left: Self::Number, right: Self::Number) -> Self::Number;
    /// left − right
    fn subtract(&mut self, left: Self::Number, right: Self::Number) -> Self::Number;
    /// left · right
    fn multiply(&mut self, left: Self::Number, right: Self::Number) -> Self::Number;
    /// left / right
    fn divide(&mut self, left: Self::Number, right: Self::Number) -> Self::Number;
    /// √operand
    fn sqrt(&mut self, operand: Self::Number) -> Self::Number;

    /// factor · operand
    fn scale(&mut self, factor: f64, operand: Self::Number) -> Self::Number {
        let factor = self.constant(factor);
        self.multiply(factor, operand)
    }

    /// a · b
    fn dot(&mut self, a: [Self::Number; 3], b: [Self::Number; 3]) -> Self::Number {
        let mut sum = self.multiply(a[0], b[0]);
        for axis in 1..3 {
            let product = self.multiply(a[axis], b[axis]);
            sum = self.add(sum, product);
        }
        sum
    }

    /// a × b
    fn cross(&mut self, a: [Self::Number; 3], b: [Self::Number; 3]) -> [Self::Number; 3] {
        [(1, 2), (2, 0), (0, 1)].map(|(i, j)| {
            let (forth, back) = (self.multiply(a[i], b[j]), self.multiply(a[j], b[i]));
            self.subtract(forth, back)
        })
    }

    /// a + factor · b
    fn plus_scaled(&mut self, a: [Self::Number; 3], factor: Self::Number, b: [Self::Number; 3]) -> [Self::Number; 3] {
        [0, 1, 2].map(|axis| {
            let product = self.multiply(factor, b[axis]);
            self.add(a[axis], product)
        })
    }

    /// a / |a| and |a|
    fn normalised(&mut self, a: [Self::Number; 3]) -> ([Self::Number; 3], Self::Number) {
        let square = self.dot(a, a);
        let length = self.sqrt(square);
        (a.map(|component| self.divide(component, length)), length)
    }
}

/// Plain numbers.
#[derive(Debug, Clone, Copy, Default)]
pub struct Numbers;

impl Algebra for Numbers {
    type Number = f64;

    fn constant(&mut self, value: f64) -> f64 {
        value
    }
    fn add(&mut self, left: f64, right: f64) -> f64 {
        left + right
    }
    fn subtract(&mut self, left: f64, right: f64) -> f64 {
        left - right
    }
    fn multiply(&mut self, left: f64, right: f64) -> f64 {
        left * right
    }
    fn divide(&mut self, left: f64, right: f64) -> f64 {
        left / right
    }
    fn sqrt(&mut self, operand: f64) -> f64 {
        operand.sqrt()
    }
}

/// Nodes of a graph. A product with the constant 0 is 0 here: coordinates and displacements are finite.
impl Algebra for Graph {
    type Number = NodeId;

    fn constant(&mut self, value: f64) -> NodeId {
        Graph::constant(self, value)
    }
    fn add(&mut self, left: NodeId, right: NodeId) -> NodeId {
        Graph::add(self, left, right)
    }
    fn subtract(&mut self, left: NodeId, right: NodeId) -> NodeId {
        Graph::subtract(self, left, right)
    }
    fn multiply(&mut self, left: NodeId, right: NodeId) -> NodeId {
        let zero = |graph: &Graph, node| graph.as_constant(node) == Some(0.0);
        if zero(self, left) || zero(self, right) {
            return Graph::constant(self, 0.0);
        }
        Graph::multiply(self, left, right)
    }
    fn divide(&mut self, left: NodeId, right: NodeId) -> NodeId {
        if self.as_constant(left) == Some(0.0) {
            return left;
        }
        Graph::divide(self, left, right)
    }
    fn sqrt(&mut self, operand: NodeId) -> NodeId {
        self.unary(Unary::Sqrt, operand)
    }
}
