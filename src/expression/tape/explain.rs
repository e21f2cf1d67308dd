//! Why a value or a derivative is no number.

use thiserror::Error;

use super::partials::{self, At};
use super::program::Operation;
use super::{Tape, Workspace, sweep};
use crate::expression::operators::{Binary, Unary};

/// The first operation that made no finite number of finite ones.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{cause}")]
pub struct Invalid {
    /// `square root of -0.2`, `division by zero`, `the value overflows`, `the square root has no finite derivative at 0`.
    pub cause: String,
}

impl Tape {
    /// Why the value at a point, or else a first, or else a second derivative is no number; `None` where all are.
    pub fn explain(&self, x: &[f64], d: &[f64]) -> Option<Invalid> {
        let mut workspace = Workspace::default();
        workspace.fit(self);
        sweep::forward(self, x, d, &mut workspace.values);
        sweep::mark_live(self, &mut workspace);
        let cause = self.bad_value(&workspace.values).or_else(|| self.bad_derivative(&workspace))?;
        Some(Invalid { cause })
    }

    fn bad_value(&self, values: &[f64]) -> Option<String> {
        let program = &self.program;
        if let Some(leaf) = values[..program.first()].iter().find(|leaf| !leaf.is_finite()) {
            return Some(format!("a number that goes in is {leaf}"));
        }
        for (slot, code) in (program.first()..).zip(&program.instructions) {
            if !values[slot].is_finite() {
                return Some(cause(code.operation, values[code.left as usize], values[code.right as usize]));
            }
        }
        None
    }

    fn bad_derivative(&self, workspace: &Workspace) -> Option<String> {
        let live = || self.schedule.steps.iter().rev().filter(|step| workspace.live[step.slot as usize]);
        let finite = |values: &[(bool, f64)]| values.iter().all(|&(wanted, value)| !wanted || value.is_finite());
        let first = live().find(|step| {
            let (left, right) = partials::first(step.instruction.operation, sweep::at(step, &workspace.values));
            !finite(&[(step.left_active, left), (step.right_active || step.same, right)])
        });
        if let Some(step) = first {
            return Some(no_derivative(step.instruction.operation, sweep::at(step, &workspace.values), ""));
        }
        let second = live().find(|step| {
            let (ll, lr, rr) = partials::second(step.instruction.operation, sweep::at(step, &workspace.values));
            let right = step.right_active || step.same;
            !finite(&[(step.left_active, ll), (step.left_active && right, lr), (right, rr)])
        })?;
        Some(no_derivative(second.instruction.operation, sweep::at(second, &workspace.values), "second "))
    }
}

fn no_derivative(operation: Operation, at: At, order: &str) -> String {
    let operands = match operation {
        Operation::Binary(_) => format!("({}, {})", at.left, at.right),
        _ => at.left.to_string(),
    };
    format!("the {} has no finite {order}derivative at {operands}", name(operation))
}

/// What went wrong in an operation on finite operands.
fn cause(operation: Operation, left: f64, right: f64) -> String {
    match operation {
        Operation::Unary(op @ (Unary::Sqrt | Unary::Log | Unary::Log10 | Unary::Asin | Unary::Acos | Unary::LnGamma)) => {
            format!("{} of {left}", name(Operation::Unary(op)))
        }
        Operation::Binary(Binary::Divide) if right == 0.0 => "division by zero".into(),
        Operation::Power(exponent) if left == 0.0 => format!("0 to the power {exponent}"),
        Operation::Binary(Binary::Power) if left < 0.0 && right.fract() != 0.0 || left == 0.0 => {
            format!("{left} to the power {right}")
        }
        _ => "the value overflows".into(),
    }
}

fn name(operation: Operation) -> &'static str {
    match operation {
        Operation::Power(_) | Operation::Binary(Binary::Power) => "power",
        Operation::Unary(op) => match op {
            Unary::Sqrt => "square root",
            Unary::Log | Unary::Log10 => "logarithm",
            Unary::Asin => "arc sine",
            Unary::Acos => "arc cosine",
            Unary::Negate | Unary::Abs => "modulus",
            Unary::Exp => "exponential",
            Unary::Sin | Unary::Cos | Unary::Tan => "trigonometric function",
            Unary::Sinh | Unary::Cosh | Unary::Tanh => "hyperbolic function",
            Unary::Atan => "arc tangent",
            Unary::Erf => "error function",
            Unary::LnGamma => "logarithm of gamma",
        },
        Operation::Binary(Binary::Divide) => "quotient",
        Operation::Binary(Binary::Atan2) => "angle atan2",
        Operation::Binary(Binary::Add | Binary::Subtract) => "sum",
        Operation::Binary(Binary::Multiply) => "product",
        Operation::Binary(Binary::Min | Binary::Max) => "minimum or maximum",
    }
}
