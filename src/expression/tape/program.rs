//! Graph → straight-line program with dense local slots, in a form by which equal shapes are equal programs.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Unary};

/// Whole exponents up to this size are part of a program's shape.
const WHOLE_EXPONENT: f64 = 64.0;

/// One operation with two operands at the most.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Operation {
    Unary(Unary),
    Binary(Binary),
    /// A whole power.
    Power(i32),
}

/// An operation and the slots of its operands; with one operand both are the same.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Instruction {
    pub(super) operation: Operation,
    pub(super) left: u32,
    pub(super) right: u32,
}

/// Slots: inputs, then data, then constants, then one per instruction. Equal programs compute the same function.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub struct Program {
    inputs: u32,
    data: u32,
    constants: Vec<u64>,
    pub(super) instructions: Vec<Instruction>,
    pub(super) root: u32,
}

/// What the local slots of a program are.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Binding {
    /// Local input → slot of [`Node::Input`].
    pub inputs: Vec<u32>,
    /// Local datum → where its number comes from.
    pub data: Vec<Source>,
}

/// Where a local datum comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Source {
    /// The slot of a [`Node::Data`].
    Data(u32),
    /// A number in the formula ([`Literals::AsData`]).
    Literal(f64),
}

/// What becomes of the numbers in a formula.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Literals {
    /// They stay in the program.
    Kept,
    /// All but whole exponents become data, so that `0.5·x^3` and `0.9·y^3` give one program.
    AsData,
}

impl Program {
    /// The program of a node. Operands of commutative operators are put in an order of shape, not of age.
    pub fn extract(graph: &Graph, root: NodeId, literals: Literals) -> (Program, Binding) {
        let mut builder = Builder::new(graph, shapes(graph, root), literals);
        builder.visit(root);
        builder.finish(root)
    }

    pub(super) fn inputs(&self) -> usize {
        self.inputs as usize
    }

    pub(super) fn data(&self) -> usize {
        self.data as usize
    }

    pub(super) fn constants(&self) -> impl Iterator<Item = f64> + '_ {
        self.constants.iter().map(|&bits| f64::from_bits(bits))
    }

    /// The slot of the first instruction.
    pub(super) fn first(&self) -> usize {
        self.inputs() + self.data() + self.constants.len()
    }

    pub(super) fn slots(&self) -> usize {
        self.first() + self.instructions.len()
    }
}

impl Operation {
    pub(super) fn evaluate(self, left: f64, right: f64) -> f64 {
        match self {
            Operation::Unary(op) => op.evaluate(left),
            Operation::Binary(op) => op.evaluate(left, right),
            Operation::Power(exponent) => left.powi(exponent),
        }
    }
}

/// A slot while the number of leaves is not yet known.
#[derive(Debug, Clone, Copy)]
enum Slot {
    Input(u32),
    Data(u32),
    Constant(u32),
    Result(u32),
}

struct Builder<'a> {
    graph: &'a Graph,
    shapes: HashMap<NodeId, u64>,
    literals: Literals,
    slots: HashMap<NodeId, Slot>,
    binding: Binding,
    constants: Vec<u64>,
    code: Vec<(Operation, Slot, Slot)>,
}

impl<'a> Builder<'a> {
    fn new(graph: &'a Graph, shapes: HashMap<NodeId, u64>, literals: Literals) -> Self {
        Builder {
            graph,
            shapes,
            literals,
            slots: HashMap::new(),
            binding: Binding::default(),
            constants: Vec::new(),
            code: Vec::new(),
        }
    }

    /// Operands before uses, without recursion.
    fn visit(&mut self, root: NodeId) {
        let mut stack = vec![(root, false)];
        while let Some((node, operands_done)) = stack.pop() {
            if self.slots.contains_key(&node) {
                continue;
            }
            let Some((operation, left, right)) = self.ordered(node) else {
                self.leaf(node);
                continue;
            };
            if operands_done {
                let (left, right) = (self.leaf(left), self.leaf(right));
                self.slots.insert(node, Slot::Result(self.code.len() as u32));
                self.code.push((operation, left, right));
            } else {
                stack.extend([(node, true), (right, false), (left, false)]);
            }
        }
    }

    fn ordered(&self, node: NodeId) -> Option<(Operation, NodeId, NodeId)> {
        let (operation, left, right) = operation(self.graph, node)?;
        let rank = |operand: NodeId| (self.shapes.get(&operand).copied(), operand);
        match commutes(operation) && rank(left) > rank(right) {
            true => Some((operation, right, left)),
            false => Some((operation, left, right)),
        }
    }

    /// The slot of a node whose operands, if any, are done. Numbers as data get a slot for every use.
    fn leaf(&mut self, node: NodeId) -> Slot {
        if let Some(&slot) = self.slots.get(&node) {
            return slot;
        }
        let slot = match self.graph.node(node) {
            Node::Input(slot) => {
                self.binding.inputs.push(slot);
                Slot::Input(self.binding.inputs.len() as u32 - 1)
            }
            Node::Constant(value) if self.literals == Literals::AsData => return self.datum(Source::Literal(value)),
            Node::Constant(value) => {
                self.constants.push(value.to_bits());
                Slot::Constant(self.constants.len() as u32 - 1)
            }
            Node::Data(slot) => self.datum(Source::Data(slot)),
            Node::Unary(..) | Node::Binary(..) => unreachable!("operands are visited before their uses"),
        };
        self.slots.insert(node, slot);
        slot
    }

    fn datum(&mut self, source: Source) -> Slot {
        self.binding.data.push(source);
        Slot::Data(self.binding.data.len() as u32 - 1)
    }

    fn finish(mut self, root: NodeId) -> (Program, Binding) {
        let root = self.leaf(root);
        let (inputs, data) = (self.binding.inputs.len() as u32, self.binding.data.len() as u32);
        let first = inputs + data + self.constants.len() as u32;
        let place = |slot| match slot {
            Slot::Input(at) => at,
            Slot::Data(at) => inputs + at,
            Slot::Constant(at) => inputs + data + at,
            Slot::Result(at) => first + at,
        };
        let instruction = |&(operation, left, right): &_| Instruction { operation, left: place(left), right: place(right) };
        let instructions = self.code.iter().map(instruction).collect();
        (Program { inputs, data, constants: self.constants, instructions, root: place(root) }, self.binding)
    }
}

/// The operation of a node that is no leaf; whole powers and squares by their own name.
fn operation(graph: &Graph, node: NodeId) -> Option<(Operation, NodeId, NodeId)> {
    match graph.node(node) {
        Node::Constant(_) | Node::Input(_) | Node::Data(_) => None,
        Node::Unary(op, operand) => Some((Operation::Unary(op), operand, operand)),
        Node::Binary(Binary::Multiply, left, right) if left == right => Some((Operation::Power(2), left, left)),
        Node::Binary(Binary::Power, base, exponent) => Some(match graph.as_constant(exponent) {
            Some(whole) if whole.fract() == 0.0 && whole.abs() <= WHOLE_EXPONENT => (Operation::Power(whole as i32), base, base),
            _ => (Operation::Binary(Binary::Power), base, exponent),
        }),
        Node::Binary(op, left, right) => Some((Operation::Binary(op), left, right)),
    }
}

fn commutes(operation: Operation) -> bool {
    matches!(operation, Operation::Binary(Binary::Add | Binary::Multiply | Binary::Min | Binary::Max))
}

/// A number per node below `root` that depends on the shape alone: not on which input, datum or constant stands where.
fn shapes(graph: &Graph, root: NodeId) -> HashMap<NodeId, u64> {
    let mut shapes: HashMap<NodeId, u64> = HashMap::new();
    for node in graph.below(root) {
        let shape = match graph.node(node) {
            Node::Constant(_) => 1,
            Node::Data(_) => 2,
            Node::Input(_) => 3,
            Node::Unary(..) | Node::Binary(..) => operation(graph, node).map_or(0, |(operation, left, right)| {
                let (left, right) = (shapes[&left], shapes[&right]);
                digest(operation, if commutes(operation) && left > right { (right, left) } else { (left, right) })
            }),
        };
        shapes.insert(node, shape);
    }
    shapes
}

fn digest(operation: Operation, operands: (u64, u64)) -> u64 {
    let mut hasher = DefaultHasher::new();
    (operation, operands).hash(&mut hasher);
    hasher.finish() | 4 // apart from the leaves, which come first
}
