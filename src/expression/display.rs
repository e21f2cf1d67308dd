//! A node as text a reader knows.

use super::graph::{Graph, Node, NodeId};
use super::operators::{Binary, Unary};

/// Without rows of zeros, or of digits.
pub fn plain(value: f64) -> String {
    if value == 0.0 || (1e-4..1e9).contains(&value.abs()) { value.to_string() } else { format!("{value:e}") }
}

/// What lies deeper is shown as `…`.
const DEPTH: usize = 12;

/// The text of a node, given the names of inputs and data; parts that lie deep become `…`.
pub fn display(graph: &Graph, root: NodeId, input: &dyn Fn(u32) -> String, data: &dyn Fn(u32) -> String) -> String {
    Printer { graph, input, data }.text(root, DEPTH).0
}

struct Printer<'a> {
    graph: &'a Graph,
    input: &'a dyn Fn(u32) -> String,
    data: &'a dyn Fn(u32) -> String,
}

/// How tightly the outermost operator binds.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Rank {
    Sum,
    Product,
    Power,
    Atom,
}

impl Printer<'_> {
    fn text(&self, node: NodeId, depth: usize) -> (String, Rank) {
        let Some(deeper) = depth.checked_sub(1) else { return ("…".into(), Rank::Atom) };
        let at_least = |node, rank| {
            let (text, own) = self.text(node, deeper);
            if own >= rank { text } else { format!("({text})") }
        };
        let infix = |left, sign, right, rank, right_rank| {
            (format!("{}{sign}{}", at_least(left, rank), at_least(right, right_rank)), rank)
        };
        match self.graph.node(node) {
            Node::Constant(value) => (value.to_string(), if value < 0.0 { Rank::Sum } else { Rank::Atom }),
            Node::Input(slot) => ((self.input)(slot), Rank::Atom),
            Node::Data(slot) => ((self.data)(slot), Rank::Atom),
            Node::Unary(Unary::Negate, operand) => (format!("-{}", at_least(operand, Rank::Product)), Rank::Sum),
            Node::Unary(op, operand) => (format!("{}({})", unary_name(op), self.text(operand, deeper).0), Rank::Atom),
            Node::Binary(op, left, right) => match op {
                Binary::Add => infix(left, " + ", right, Rank::Sum, Rank::Sum),
                Binary::Subtract => infix(left, " - ", right, Rank::Sum, Rank::Product),
                Binary::Multiply => infix(left, "*", right, Rank::Product, Rank::Product),
                Binary::Divide => infix(left, "/", right, Rank::Product, Rank::Power),
                Binary::Power => (format!("{}^{}", at_least(left, Rank::Atom), at_least(right, Rank::Power)), Rank::Power),
                Binary::Atan2 | Binary::Min | Binary::Max => {
                    let arguments = format!("{}, {}", self.text(left, deeper).0, self.text(right, deeper).0);
                    (format!("{}({arguments})", binary_name(op)), Rank::Atom)
                }
            },
        }
    }
}

fn unary_name(op: Unary) -> &'static str {
    let unnamed = if op == Unary::LnGamma { "lgamma" } else { "-" };
    Unary::NAMED.iter().find(|(_, known)| *known == op).map_or(unnamed, |(name, _)| name)
}

fn binary_name(op: Binary) -> &'static str {
    match op {
        Binary::Min => "min",
        Binary::Max => "max",
        _ => "atan2",
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn parentheses_where_needed() {
        let mut graph = Graph::new();
        let (x, y, c) = (graph.input(0), graph.input(1), graph.data(0));
        let sum = graph.add(x, y);
        let power = graph.power(sum, -2.0);
        let quotient = graph.divide(power, c);
        let root = graph.unary(Unary::Sqrt, quotient);
        let difference = graph.subtract(root, sum);
        let name = |slot| ["x", "y"][slot as usize].to_string();
        assert_eq!(display(&graph, difference, &name, &|_| "c".into()), "sqrt((x + y)^(-2)/c) - (x + y)");
        let mut deep = x;
        for _ in 0..100_000 {
            deep = graph.unary(Unary::Sin, deep);
        }
        assert!(display(&graph, deep, &name, &|_| "c".into()).contains("sin(…)"));
    }
}
