//! Models some of whose variables follow from the others through equations of their own.

use super::stiffness::Factors;
use super::{EvaluationError, Model};
use crate::problem::kinks::Auxiliary;

/// Which variables are states, and which rows their equations: one block of both per load case, all after the design's own.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct States {
    /// The first of them; design variables stand before.
    pub first_variable: usize,
    /// The first of their equations.
    pub first_row: usize,
    /// States and equations per block.
    pub block: usize,
    /// Number of blocks. All have the same matrix ∂R/∂u.
    pub blocks: usize,
}

/// A model with states.
pub trait WithStates: Model {
    /// A design with its states, and the factors they were found with; those of an `earlier` design keep their analysis of the pattern.
    ///
    /// # Errors
    /// Where the state equations have no value, or leave a state open.
    fn solve_states(&self, x: &[f64], earlier: Option<Factors>) -> Result<(Vec<f64>, Factors), EvaluationError>;

    /// Design variables in the place of kinks, the last ones of the design, and the first of the rows that bound them.
    fn auxiliaries(&self) -> Option<(&[Auxiliary], usize)> {
        None
    }
}
