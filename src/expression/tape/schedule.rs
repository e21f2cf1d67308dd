//! Which inputs each instruction depends on, and the steps of edge pushing, worked out once per program.

use std::collections::HashMap;

use super::TapeError;
use super::program::{Instruction, Operation, Program};
use crate::expression::operators::{Binary, Unary};

/// Multiply-adds a Hessian may take: enough for the square root of a thousand squares.
const PUSH_LIMIT: usize = 4_000_000;

/// No such edge.
pub(super) const NONE: u32 = u32::MAX;

/// `weights[target] += weights[source] · factors[factor]`
#[derive(Debug, Clone, Copy)]
pub(super) struct Push {
    pub(super) source: u32,
    pub(super) target: u32,
    pub(super) factor: Factor,
}

/// What a weight is multiplied by on its way down: a product of an instruction's first derivatives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[repr(u8)]
pub(super) enum Factor {
    Left,
    Right,
    TwiceLeft,
    TwiceRight,
    LeftLeft,
    LeftRight,
    RightRight,
}

impl Factor {
    /// Whether the operands it is made of are alive (left, right).
    pub(super) fn wanted(self, (left, right): (bool, bool)) -> bool {
        match self {
            Factor::Left | Factor::TwiceLeft | Factor::LeftLeft => left,
            Factor::Right | Factor::TwiceRight | Factor::RightRight => right,
            Factor::LeftRight => left && right,
        }
    }
}

/// An instruction that depends on the inputs, and what it does to the weights of the Hessian.
#[derive(Debug, Clone)]
pub(super) struct Step {
    /// Its slot.
    pub(super) slot: u32,
    pub(super) instruction: Instruction,
    pub(super) left_active: bool,
    pub(super) right_active: bool,
    /// Both operands are one slot: derivatives are taken along both.
    pub(super) same: bool,
    /// Weights that take up its own second derivatives (left², left·right, right²), or [`NONE`].
    pub(super) own: [u32; 3],
    /// Its part of the pushes.
    pub(super) pushes: std::ops::Range<usize>,
}

#[derive(Debug, Clone)]
pub(super) struct Schedule {
    /// From the root down.
    pub(super) steps: Vec<Step>,
    pub(super) pushes: Vec<Push>,
    pattern: Vec<(u32, u32)>,
    weights: usize,
}

impl Schedule {
    pub(super) fn new(program: &Program) -> Result<Schedule, TapeError> {
        let mut edges = Edges::default();
        let mut pushes = Vec::new();
        let mut steps = steps(program);
        for step in &mut steps {
            let start = pushes.len();
            for (other, source) in edges.take(step.slot) {
                edges.push_down(step, other, source, &mut pushes);
            }
            if pushes.len() > PUSH_LIMIT {
                return Err(TapeError::TooDense { inputs: program.inputs() });
            }
            step.pushes = start..pushes.len();
            edges.add_own(step);
        }
        let weights = edges.slots.len();
        let (pattern, place) = edges.inputs_first(program.inputs() as u32);
        for push in &mut pushes {
            push.source = place[push.source as usize];
            push.target = place[push.target as usize];
        }
        for own in steps.iter_mut().flat_map(|step| &mut step.own).filter(|own| **own != NONE) {
            *own = place[*own as usize];
        }
        Ok(Schedule { steps, pushes, pattern, weights })
    }

    pub(super) fn pattern(&self) -> &[(u32, u32)] {
        &self.pattern
    }

    /// Number of weights; those of the pattern come first.
    pub(super) fn weights(&self) -> usize {
        self.weights
    }
}

/// The instructions that depend on inputs and that the root depends on, from the root down.
fn steps(program: &Program) -> Vec<Step> {
    let first = program.first();
    let mut active = vec![false; program.slots()];
    active[..program.inputs()].fill(true);
    let mut steps = Vec::new();
    for (index, &instruction) in program.instructions.iter().enumerate() {
        let (left, right) = (instruction.left as usize, instruction.right as usize);
        let (left_active, slot) = (active[left], first + index);
        let two = matches!(instruction.operation, Operation::Binary(_));
        let right_active = two && left != right && active[right];
        active[slot] = left_active || right_active;
        if active[slot] {
            let same = two && left == right;
            steps.push(Step { slot: slot as u32, instruction, left_active, right_active, same, own: [NONE; 3], pushes: 0..0 });
        }
    }
    steps.reverse();
    steps
}

/// Pairs of slots with a weight, kept with the later slot of the pair.
#[derive(Default)]
struct Edges {
    slots: HashMap<(u32, u32), u32>,
    pairs: Vec<(u32, u32)>,
    of: HashMap<u32, Vec<(u32, u32)>>,
}

impl Edges {
    /// The weight of a pair, made if new.
    fn weight(&mut self, a: u32, b: u32) -> u32 {
        let pair = (a.max(b), a.min(b));
        *self.slots.entry(pair).or_insert_with(|| {
            let weight = self.pairs.len() as u32;
            self.pairs.push(pair);
            self.of.entry(pair.0).or_default().push((pair.1, weight));
            weight
        })
    }

    /// All pairs whose later slot this is: (other slot, weight).
    fn take(&mut self, slot: u32) -> Vec<(u32, u32)> {
        self.of.remove(&slot).unwrap_or_default()
    }

    /// Hands the weight of (step, other) to the step's operands.
    fn push_down(&mut self, step: &Step, other: u32, source: u32, pushes: &mut Vec<Push>) {
        let (left, right) = (step.instruction.left, step.instruction.right);
        let mut push = |edges: &mut Self, a, b, factor| {
            let target = edges.weight(a, b);
            pushes.push(Push { source, target, factor });
        };
        if other == step.slot {
            if step.left_active {
                push(self, left, left, Factor::LeftLeft);
            }
            if step.left_active && step.right_active {
                push(self, left, right, Factor::LeftRight);
            }
            if step.right_active {
                push(self, right, right, Factor::RightRight);
            }
            return;
        }
        if step.left_active {
            push(self, left, other, if left == other { Factor::TwiceLeft } else { Factor::Left });
        }
        if step.right_active {
            push(self, right, other, if right == other { Factor::TwiceRight } else { Factor::Right });
        }
    }

    /// The weights for a step's own second derivatives.
    fn add_own(&mut self, step: &mut Step) {
        let (left, right) = (step.instruction.left, step.instruction.right);
        let [in_left, mixed, in_right] = curved(step);
        let pairs = [
            (in_left && step.left_active, left, left),
            (mixed && step.left_active && step.right_active, left, right),
            (in_right && step.right_active, right, right),
        ];
        for (own, (wanted, a, b)) in step.own.iter_mut().zip(pairs) {
            if wanted {
                *own = self.weight(a, b);
            }
        }
    }

    /// The pairs of inputs in order, and where each weight goes so that they come first.
    fn inputs_first(&self, inputs: u32) -> (Vec<(u32, u32)>, Vec<u32>) {
        let mut order: Vec<usize> = (0..self.pairs.len()).collect();
        order.sort_by_key(|&weight| self.pairs[weight]); // an input has a smaller slot than any result
        let mut place = vec![0; order.len()];
        for (position, &weight) in order.iter().enumerate() {
            place[weight] = position as u32;
        }
        let pairs = order.iter().map(|&weight| self.pairs[weight]);
        (pairs.take_while(|&(later, _)| later < inputs).collect(), place)
    }
}

/// Which second derivatives (left², left·right, right²) of an operation are not zero everywhere.
fn curved(step: &Step) -> [bool; 3] {
    match step.instruction.operation {
        Operation::Unary(Unary::Negate | Unary::Abs) | Operation::Power(0 | 1) => [false; 3],
        Operation::Unary(_) | Operation::Power(_) => [true, false, false],
        Operation::Binary(Binary::Add | Binary::Subtract | Binary::Min | Binary::Max) => [false; 3],
        Operation::Binary(_) if step.same => [true, false, false],
        Operation::Binary(Binary::Multiply) => [false, true, false],
        Operation::Binary(Binary::Divide) => [false, true, true],
        Operation::Binary(Binary::Power | Binary::Atan2) => [true; 3],
    }
}
