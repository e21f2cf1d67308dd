//! The model of a problem, with or without the analysis of its structure.

use std::sync::Arc;

use super::{AssemblyError, Lifted, Model, Reduced, RibModel, Substitution, assemble};
use crate::problem::Problem;

/// A model over the design variables.
#[derive(Clone)]
pub enum Assembled {
    /// Objective and rows are formulas of the design alone.
    Ribs(Arc<RibModel>),
    /// Some ask what the structure does.
    Structure(Arc<Reduced<Lifted>>),
}

impl Assembled {
    /// The model.
    pub fn model(&self) -> &dyn Model {
        match self {
            Assembled::Ribs(model) => model.as_ref(),
            Assembled::Structure(model) => model.as_ref(),
        }
    }

    /// The declaration.
    pub fn problem(&self) -> &Arc<Problem> {
        match self {
            Assembled::Ribs(model) => model.problem(),
            Assembled::Structure(model) => model.lifted().problem(),
        }
    }
}

/// Assembles a problem: reduced to its design variables where it asks for responses of a structure.
///
/// # Errors
/// As [`assemble`].
pub fn assemble_any(problem: &Arc<Problem>) -> Result<Assembled, AssemblyError> {
    if !problem.analyses() {
        return Ok(Assembled::Ribs(Arc::new(assemble(problem)?)));
    }
    let lifted = Lifted::of(problem)?;
    // A problem that analyses has states, if only none that are free.
    match Reduced::of(lifted) {
        Some(reduced) => Ok(Assembled::Structure(Arc::new(reduced))),
        None => Ok(Assembled::Ribs(Arc::new(assemble(problem)?))),
    }
}

/// The lifted model as other variables of the reduced one: the analysed displacements beside the design.
pub struct WithDisplacements(Arc<Reduced<Lifted>>);

impl WithDisplacements {
    /// The lifted form of a reduced model.
    pub fn of(reduced: Arc<Reduced<Lifted>>) -> Self {
        WithDisplacements(reduced)
    }
}

impl Substitution for WithDisplacements {
    fn model(&self) -> &dyn Model {
        self.0.lifted()
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        self.0.solved(x).unwrap_or_else(|_| {
            let mut z = x.to_vec();
            z.resize(self.0.lifted().meta().variables(), 0.0);
            z
        })
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        z[..self.0.meta().variables().min(z.len())].to_vec()
    }

    fn outward_multipliers(&self, y: &[f64]) -> Option<Vec<f64>> {
        Some(y.get(..self.0.meta().rows())?.to_vec())
    }
}
