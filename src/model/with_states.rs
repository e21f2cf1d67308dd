//! What models with states offer besides those without.

use super::stiffness::Factors;
use super::{EvaluationError, Model};
use crate::problem::kinks::Auxiliary;

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
