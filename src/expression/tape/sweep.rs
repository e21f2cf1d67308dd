//! Evaluation: up for values, down for derivatives.

use super::partials::{self, At};
use super::program::Operation;
use super::schedule::{NONE, Step};
use super::{Tape, Workspace};
use crate::expression::operators::Binary;

/// Fills the values of all slots; returns the root's.
pub(super) fn forward(tape: &Tape, x: &[f64], d: &[f64], values: &mut [f64]) -> f64 {
    let program = &tape.program;
    let (inputs, leaves) = (program.inputs(), program.inputs() + program.data());
    values[..inputs].copy_from_slice(x);
    values[inputs..leaves].copy_from_slice(d);
    for (slot, constant) in values[leaves..].iter_mut().zip(program.constants()) {
        *slot = constant;
    }
    for (slot, code) in (program.first()..).zip(&program.instructions) {
        values[slot] = code.operation.evaluate(values[code.left as usize], values[code.right as usize]);
    }
    values[program.root as usize]
}

/// Fills the adjoints of all slots. `CAREFUL`: only along what [`mark_live`] found, so that an infinite derivative of
/// a part that has no influence (the branch not taken, a factor zero) does not turn zero into NaN.
pub(super) fn gradient<const CAREFUL: bool>(tape: &Tape, workspace: &mut Workspace) {
    let Workspace { values, adjoints, live, .. } = workspace;
    reset(tape, adjoints);
    for step in &tape.schedule.steps {
        if CAREFUL && !live[step.slot as usize] {
            continue;
        }
        add_adjoints(step, slopes(step, values), alive::<CAREFUL>(step, values), adjoints);
    }
}

/// Fills adjoints and weights; see [`gradient`].
pub(super) fn hessian<const CAREFUL: bool>(tape: &Tape, workspace: &mut Workspace) {
    let Workspace { values, adjoints, weights, live } = workspace;
    reset(tape, adjoints);
    weights[..tape.schedule.weights()].fill(0.0);
    for step in &tape.schedule.steps {
        if CAREFUL && !live[step.slot as usize] {
            continue;
        }
        let (slopes, alive) = (slopes(step, values), alive::<CAREFUL>(step, values));
        let (l, r) = slopes;
        let factors = [l, r, 2.0 * l, 2.0 * r, l * l, l * r, r * r];
        for push in &tape.schedule.pushes[step.pushes.clone()] {
            if !CAREFUL || push.factor.wanted(alive) {
                weights[push.target as usize] += weights[push.source as usize] * factors[push.factor as usize];
            }
        }
        add_own(step, values, adjoints[step.slot as usize], weights);
        add_adjoints(step, slopes, alive, adjoints);
    }
}

/// Marks the slots that influence the root at this point.
pub(super) fn mark_live(tape: &Tape, workspace: &mut Workspace) {
    let Workspace { values, live, .. } = workspace;
    live[..tape.program.slots()].fill(false);
    live[tape.program.root as usize] = true;
    for step in &tape.schedule.steps {
        if live[step.slot as usize] {
            let (left, right) = alive::<true>(step, values);
            live[step.instruction.left as usize] |= left;
            live[step.instruction.right as usize] |= right;
        }
    }
}

fn reset(tape: &Tape, adjoints: &mut [f64]) {
    adjoints[..tape.program.slots()].fill(0.0);
    adjoints[tape.program.root as usize] = 1.0;
}

/// An instruction's operands and value.
pub(super) fn at(step: &Step, values: &[f64]) -> At {
    At {
        left: values[step.instruction.left as usize],
        right: values[step.instruction.right as usize],
        value: values[step.slot as usize],
        right_active: step.right_active || step.same,
    }
}

/// The first derivatives in the left and the right operand; all in the left where they are one slot.
#[inline]
fn slopes(step: &Step, values: &[f64]) -> (f64, f64) {
    let (left, right) = partials::first(step.instruction.operation, at(step, values));
    if step.same { (left + right, 0.0) } else { (left, right) }
}

/// Which operands depend on the inputs and, where `CAREFUL`, have an influence.
#[inline]
fn alive<const CAREFUL: bool>(step: &Step, values: &[f64]) -> (bool, bool) {
    let (left_dead, right_dead) = if CAREFUL { dead(step, values) } else { (false, false) };
    (step.left_active && !left_dead, step.right_active && !right_dead)
}

#[inline]
fn add_adjoints(step: &Step, slopes: (f64, f64), alive: (bool, bool), adjoints: &mut [f64]) {
    let adjoint = adjoints[step.slot as usize];
    if alive.0 {
        adjoints[step.instruction.left as usize] += adjoint * slopes.0;
    }
    if alive.1 {
        adjoints[step.instruction.right as usize] += adjoint * slopes.1;
    }
}

#[inline]
fn add_own(step: &Step, values: &[f64], adjoint: f64, weights: &mut [f64]) {
    if step.own == [NONE; 3] {
        return;
    }
    let (ll, lr, rr) = partials::second(step.instruction.operation, at(step, values));
    let second = if step.same { [ll + 2.0 * lr + rr, 0.0, 0.0] } else { [ll, lr, rr] };
    for (&own, second) in step.own.iter().zip(second) {
        if own != NONE {
            weights[own as usize] += adjoint * second;
        }
    }
}

/// Which operands have no influence near this point: the branch not taken, and what a fixed zero is multiplied with.
fn dead(step: &Step, values: &[f64]) -> (bool, bool) {
    let At { left, right, .. } = at(step, values);
    match step.instruction.operation {
        _ if step.same => (false, false),
        Operation::Power(0) => (true, false),
        Operation::Binary(Binary::Multiply) => (!step.right_active && right == 0.0, !step.left_active && left == 0.0),
        Operation::Binary(Binary::Divide) => (false, !step.left_active && left == 0.0),
        Operation::Binary(Binary::Power) => (!step.right_active && right == 0.0, false),
        Operation::Binary(Binary::Min) => (right < left, left <= right),
        Operation::Binary(Binary::Max) => (left < right, right <= left),
        _ => (false, false),
    }
}
