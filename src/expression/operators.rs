//! The operators and functions of the language, and how wide their calls are.

use crate::math::special;

/// A function or prefix operator of one argument.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Unary {
    Negate,
    Sqrt,
    Exp,
    Log,
    Log10,
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Sinh,
    Cosh,
    Tanh,
    Abs,
    /// The error function.
    Erf,
    /// ln Γ, for superellipses; not among the functions users write.
    LnGamma,
}

/// An operator or function of two arguments.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Binary {
    Add,
    Subtract,
    Multiply,
    Divide,
    Power,
    Atan2,
    Min,
    Max,
}

/// How a list of values becomes one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Fold {
    Sum,
    Min,
    Max,
}

/// A comparison sign.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Comparison {
    LessOrEqual,
    GreaterOrEqual,
    Equal,
    /// Only in `where`.
    NotEqual,
    /// Only in `where`.
    Less,
    /// Only in `where`.
    Greater,
}

impl Unary {
    /// The functions by the names users write.
    pub const NAMED: [(&'static str, Unary); 15] = [
        ("sqrt", Unary::Sqrt),
        ("exp", Unary::Exp),
        ("log", Unary::Log),
        ("log10", Unary::Log10),
        ("sin", Unary::Sin),
        ("cos", Unary::Cos),
        ("tan", Unary::Tan),
        ("asin", Unary::Asin),
        ("acos", Unary::Acos),
        ("atan", Unary::Atan),
        ("sinh", Unary::Sinh),
        ("cosh", Unary::Cosh),
        ("tanh", Unary::Tanh),
        ("abs", Unary::Abs),
        ("erf", Unary::Erf),
    ];

    /// The value, by IEEE rules (NaN outside the domain).
    pub fn evaluate(self, x: f64) -> f64 {
        match self {
            Unary::Negate => -x,
            Unary::Sqrt => x.sqrt(),
            Unary::Exp => x.exp(),
            Unary::Log => x.ln(),
            Unary::Log10 => x.log10(),
            Unary::Sin => x.sin(),
            Unary::Cos => x.cos(),
            Unary::Tan => x.tan(),
            Unary::Asin => x.asin(),
            Unary::Acos => x.acos(),
            Unary::Atan => x.atan(),
            Unary::Sinh => x.sinh(),
            Unary::Cosh => x.cosh(),
            Unary::Tanh => x.tanh(),
            Unary::Abs => x.abs(),
            Unary::Erf => special::erf(x),
            Unary::LnGamma => special::ln_gamma(x),
        }
    }
}

impl Binary {
    /// The value, by IEEE rules (NaN outside the domain).
    pub fn evaluate(self, x: f64, y: f64) -> f64 {
        match self {
            Binary::Add => x + y,
            Binary::Subtract => x - y,
            Binary::Multiply => x * y,
            Binary::Divide => x / y,
            Binary::Power => power(x, y),
            Binary::Atan2 => x.atan2(y),
            Binary::Min => minimum(x, y),
            Binary::Max => -minimum(-x, -y),
        }
    }
}

/// `x ^ y`, whole exponents by repeated multiplication (exact for small ones).
fn power(x: f64, y: f64) -> f64 {
    if y.fract() == 0.0 && y.abs() <= 64.0 { x.powi(y as i32) } else { x.powf(y) }
}

/// The smaller one; NaN where either is (Rust's own `min` would drop it).
fn minimum(x: f64, y: f64) -> f64 {
    if x.is_nan() || y.is_nan() { f64::NAN } else { x.min(y) }
}
