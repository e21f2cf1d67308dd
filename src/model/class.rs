//! What a problem is known to be, from the structure of its expressions.

use std::fmt;

/// The first that holds, in this order.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Default)]
pub enum Class {
    /// Objective and rows are affine.
    Linear,
    /// Posynomial objective, posynomial ≤ monomial rows: convex in the logarithms of the variables.
    GeometricProgram,
    /// Convex objective and feasible set.
    Convex,
    /// None of these: minima are local.
    #[default]
    Nonlinear,
}

impl Class {
    /// Whether every stationary point that passes the certificate is a global minimum.
    pub fn is_global(self) -> bool {
        self != Class::Nonlinear
    }
}

impl fmt::Display for Class {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        formatter.write_str(match self {
            Class::Linear => "linear",
            Class::GeometricProgram => "geometric program",
            Class::Convex => "convex",
            Class::Nonlinear => "nonlinear",
        })
    }
}
