//! Hash-consed expression graphs: equal subexpressions are one node, constants fold, neutral elements vanish.

use std::collections::{HashMap, HashSet};

use super::operators::{Binary, Unary};

/// A node of a [`Graph`].
pub type NodeId = u32;

/// One operation.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Node {
    /// A number.
    Constant(f64),
    /// The value of an input: a variable of the problem, or a local slot of a template.
    Input(u32),
    /// A number that differs from element to element of a template (data, lengths, limits): a local slot.
    Data(u32),
    /// A function of one node.
    Unary(Unary, NodeId),
    /// An operator on two nodes.
    Binary(Binary, NodeId, NodeId),
}

impl Node {
    /// The nodes it works on: none, one or two.
    pub fn operands(self) -> impl Iterator<Item = NodeId> {
        let (left, right) = match self {
            Node::Constant(_) | Node::Input(_) | Node::Data(_) => (None, None),
            Node::Unary(_, operand) => (Some(operand), None),
            Node::Binary(_, left, right) => (Some(left), Some(right)),
        };
        left.into_iter().chain(right)
    }
}

#[derive(PartialEq, Eq, Hash)]
enum Key {
    Constant(u64),
    Input(u32),
    Data(u32),
    Unary(Unary, NodeId),
    Binary(Binary, NodeId, NodeId),
}

/// Nodes in an order in which every operand stands before its use.
#[derive(Default)]
pub struct Graph {
    nodes: Vec<Node>,
    known: HashMap<Key, NodeId>,
}

impl Graph {
    /// An empty graph.
    pub fn new() -> Self {
        Self::default()
    }

    /// The operation behind a node.
    pub fn node(&self, id: NodeId) -> Node {
        self.nodes[id as usize]
    }

    /// Number of nodes.
    pub fn len(&self) -> usize {
        self.nodes.len()
    }

    /// True where nothing was built yet.
    pub fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// A node and all it is made of, operands before uses. Costs what it returns, not the size of the graph.
    pub fn below(&self, root: NodeId) -> Vec<NodeId> {
        let mut found = HashSet::from([root]);
        let mut stack = vec![root];
        while let Some(node) = stack.pop() {
            stack.extend(self.node(node).operands().filter(|&operand| found.insert(operand)));
        }
        let mut nodes: Vec<NodeId> = found.into_iter().collect();
        nodes.sort_unstable(); // operands have smaller numbers
        nodes
    }

    /// The node's number, if it is a constant.
    pub fn as_constant(&self, id: NodeId) -> Option<f64> {
        match self.node(id) {
            Node::Constant(value) => Some(value),
            _ => None,
        }
    }

    /// A number.
    pub fn constant(&mut self, value: f64) -> NodeId {
        self.intern(Key::Constant(value.to_bits()), Node::Constant(value))
    }

    /// An input slot.
    pub fn input(&mut self, slot: u32) -> NodeId {
        self.intern(Key::Input(slot), Node::Input(slot))
    }

    /// A data slot.
    pub fn data(&mut self, slot: u32) -> NodeId {
        self.intern(Key::Data(slot), Node::Data(slot))
    }

    /// `left + right`
    pub fn add(&mut self, left: NodeId, right: NodeId) -> NodeId {
        self.binary(Binary::Add, left, right)
    }

    /// `left − right`
    pub fn subtract(&mut self, left: NodeId, right: NodeId) -> NodeId {
        self.binary(Binary::Subtract, left, right)
    }

    /// `left · right`
    pub fn multiply(&mut self, left: NodeId, right: NodeId) -> NodeId {
        self.binary(Binary::Multiply, left, right)
    }

    /// `left / right`
    pub fn divide(&mut self, left: NodeId, right: NodeId) -> NodeId {
        self.binary(Binary::Divide, left, right)
    }

    /// `factor · node`
    pub fn scale(&mut self, factor: f64, node: NodeId) -> NodeId {
        let factor = self.constant(factor);
        self.multiply(factor, node)
    }

    /// `node ^ exponent`
    pub fn power(&mut self, node: NodeId, exponent: f64) -> NodeId {
        let exponent = self.constant(exponent);
        self.binary(Binary::Power, node, exponent)
    }

    /// The sum of many nodes, balanced so that depth and rounding grow with the logarithm.
    pub fn sum(&mut self, terms: &[NodeId]) -> NodeId {
        match terms {
            [] => self.constant(0.0),
            [one] => *one,
            _ => {
                let (left, right) = terms.split_at(terms.len() / 2);
                let (left, right) = (self.sum(left), self.sum(right));
                self.add(left, right)
            }
        }
    }

    /// A function of one node.
    pub fn unary(&mut self, op: Unary, node: NodeId) -> NodeId {
        if let Some(value) = self.as_constant(node) {
            return self.constant(op.evaluate(value));
        }
        if let (Unary::Negate, Node::Unary(Unary::Negate, inner)) = (op, self.node(node)) {
            return inner;
        }
        self.intern(Key::Unary(op, node), Node::Unary(op, node))
    }

    /// An operator on two nodes. Only simplifications that keep every value (bar the sign of zero) are made:
    /// `0·x` stays, for x may be no number.
    pub fn binary(&mut self, op: Binary, left: NodeId, right: NodeId) -> NodeId {
        let (l, r) = (self.as_constant(left), self.as_constant(right));
        match (op, l, r) {
            (_, Some(l), Some(r)) => return self.constant(op.evaluate(l, r)),
            (Binary::Add, Some(0.0), _) => return right,
            (Binary::Add | Binary::Subtract, _, Some(0.0)) => return left,
            (Binary::Subtract, Some(0.0), _) => return self.unary(Unary::Negate, right),
            (Binary::Multiply, Some(1.0), _) => return right,
            (Binary::Multiply | Binary::Divide | Binary::Power, _, Some(1.0)) => return left,
            _ => {}
        }
        // One order for commutative operators, so that equal terms meet.
        let (left, right) = match op {
            Binary::Add | Binary::Multiply | Binary::Min | Binary::Max if left > right => (right, left),
            _ => (left, right),
        };
        self.intern(Key::Binary(op, left, right), Node::Binary(op, left, right))
    }

    /// The value of a node for these inputs and data.
    pub fn evaluate(&self, root: NodeId, inputs: &[f64], data: &[f64]) -> f64 {
        self.values_up_to(root as usize + 1, inputs, data)[root as usize]
    }

    /// The values of all nodes, in their order.
    pub fn values(&self, inputs: &[f64], data: &[f64]) -> Vec<f64> {
        self.values_up_to(self.nodes.len(), inputs, data)
    }

    fn values_up_to(&self, count: usize, inputs: &[f64], data: &[f64]) -> Vec<f64> {
        let mut values: Vec<f64> = Vec::with_capacity(count);
        for node in &self.nodes[..count] {
            values.push(match *node {
                Node::Constant(value) => value,
                Node::Input(slot) => inputs.get(slot as usize).copied().unwrap_or(f64::NAN),
                Node::Data(slot) => data.get(slot as usize).copied().unwrap_or(f64::NAN),
                Node::Unary(op, inner) => op.evaluate(values[inner as usize]),
                Node::Binary(op, left, right) => op.evaluate(values[left as usize], values[right as usize]),
            });
        }
        values
    }

    fn intern(&mut self, key: Key, node: Node) -> NodeId {
        let nodes = &mut self.nodes;
        *self.known.entry(key).or_insert_with(|| {
            nodes.push(node);
            (nodes.len() - 1) as NodeId
        })
    }
}
