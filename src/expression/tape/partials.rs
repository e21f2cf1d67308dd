//! First and second derivatives of each operation.

use super::program::Operation;
use crate::expression::operators::{Binary, Unary};
use crate::math::special;

/// An operation at a point: operands and value, and whether the right operand depends on the inputs.
#[derive(Clone, Copy)]
pub(super) struct At {
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) value: f64,
    pub(super) right_active: bool,
}

/// (∂/∂left, ∂/∂right)
#[inline]
pub(super) fn first(operation: Operation, at: At) -> (f64, f64) {
    let At { left: a, right: b, value: v, right_active } = at;
    match operation {
        Operation::Unary(op) => (unary_first(op, a, v), 0.0),
        Operation::Power(k) => (whole_power(a, k, 1), 0.0),
        Operation::Binary(op) => match op {
            Binary::Add => (1.0, 1.0),
            Binary::Subtract => (1.0, -1.0),
            Binary::Multiply => (b, a),
            Binary::Divide => (1.0 / b, -v / b),
            Binary::Power => (power_first(a, b), if right_active { v_times_log(v, a, b) } else { 0.0 }),
            Binary::Atan2 => {
                let r = a.hypot(b);
                (b / r / r, -a / r / r)
            }
            Binary::Min => branch(a <= b),
            Binary::Max => branch(a >= b),
        },
    }
}

/// (∂²/∂left², ∂²/∂left∂right, ∂²/∂right²)
#[inline]
pub(super) fn second(operation: Operation, at: At) -> (f64, f64, f64) {
    let At { left: a, right: b, value: v, right_active } = at;
    match operation {
        Operation::Unary(op) => (unary_second(op, a, v), 0.0, 0.0),
        Operation::Power(k) => (whole_power(a, k, 2), 0.0, 0.0),
        Operation::Binary(op) => match op {
            Binary::Add | Binary::Subtract | Binary::Min | Binary::Max => (0.0, 0.0, 0.0),
            Binary::Multiply => (0.0, 1.0, 0.0),
            Binary::Divide => (0.0, -1.0 / b / b, 2.0 * v / b / b),
            Binary::Power if right_active => (power_second(a, b), power_mixed(a, b), v_times_log(v_times_log(v, a, b), a, b)),
            Binary::Power => (power_second(a, b), 0.0, 0.0),
            Binary::Atan2 => {
                let r = a.hypot(b);
                let (s, c) = (a / r, b / r);
                (-2.0 * s * c / r / r, (s - c) * (s + c) / r / r, 2.0 * s * c / r / r)
            }
        },
    }
}

/// Of the branch taken.
fn branch(left: bool) -> (f64, f64) {
    if left { (1.0, 0.0) } else { (0.0, 1.0) }
}

fn unary_first(op: Unary, a: f64, v: f64) -> f64 {
    match op {
        Unary::Negate => -1.0,
        Unary::Sqrt => 0.5 / v,
        Unary::Exp => v,
        Unary::Log => 1.0 / a,
        Unary::Log10 => std::f64::consts::LOG10_E / a,
        Unary::Sin => a.cos(),
        Unary::Cos => -a.sin(),
        Unary::Tan => 1.0 + v * v,
        Unary::Asin => 1.0 / ((1.0 - a) * (1.0 + a)).sqrt(),
        Unary::Acos => -1.0 / ((1.0 - a) * (1.0 + a)).sqrt(),
        Unary::Atan => 1.0 / (1.0 + a * a),
        Unary::Sinh => a.cosh(),
        Unary::Cosh => a.sinh(),
        Unary::Tanh => a.cosh().powi(-2),
        Unary::Abs if a < 0.0 => -1.0,
        Unary::Abs => 1.0,
        Unary::Erf => special::erf_slope(a),
        Unary::LnGamma => special::digamma(a),
    }
}

fn unary_second(op: Unary, a: f64, v: f64) -> f64 {
    match op {
        Unary::Negate | Unary::Abs => 0.0,
        Unary::Sqrt => -0.25 / a / v,
        Unary::Exp | Unary::Sinh | Unary::Cosh => v,
        Unary::Log => -1.0 / a / a,
        Unary::Log10 => -std::f64::consts::LOG10_E / a / a,
        Unary::Sin | Unary::Cos => -v,
        Unary::Tan => 2.0 * v * (1.0 + v * v),
        Unary::Asin => a * ((1.0 - a) * (1.0 + a)).powf(-1.5),
        Unary::Acos => -a * ((1.0 - a) * (1.0 + a)).powf(-1.5),
        Unary::Atan => {
            let slope = 1.0 / (1.0 + a * a);
            -2.0 * a * slope * slope
        }
        Unary::Tanh => -2.0 * v * a.cosh().powi(-2),
        Unary::Erf => -2.0 * a * special::erf_slope(a),
        Unary::LnGamma => special::polygamma(1, a),
    }
}

/// The derivative of `order` of a^k. A factor of zero means the function has no such power left, whatever a is.
fn whole_power(a: f64, k: i32, order: i32) -> f64 {
    let factor = (0..order).map(|i| f64::from(k - i)).product::<f64>();
    if factor == 0.0 { 0.0 } else { factor * a.powi(k - order) }
}

/// b·a^(b−1)
fn power_first(a: f64, b: f64) -> f64 {
    if b == 0.0 { 0.0 } else { b * Binary::Power.evaluate(a, b - 1.0) }
}

/// b·(b−1)·a^(b−2)
fn power_second(a: f64, b: f64) -> f64 {
    let factor = b * (b - 1.0);
    if factor == 0.0 { 0.0 } else { factor * Binary::Power.evaluate(a, b - 2.0) }
}

/// ∂²(a^b)/∂a∂b = a^(b−1)·(1 + b·ln a); for a → 0 and b > 1 it vanishes.
fn power_mixed(a: f64, b: f64) -> f64 {
    if a == 0.0 && b > 1.0 { 0.0 } else { Binary::Power.evaluate(a, b - 1.0) * (1.0 + b * a.ln()) }
}

/// v·ln a; for a → 0 and b > 0, where v = a^b (times powers of ln a) vanishes, zero.
fn v_times_log(v: f64, a: f64, b: f64) -> f64 {
    if a == 0.0 && b > 0.0 { 0.0 } else { v * a.ln() }
}
