//! The model of a problem, with or without the analysis of its structure.

use std::sync::Arc;

use super::{AssemblyError, EvaluationError, Lifted, Model, Reduced, RibModel, Substitution, assemble};
use crate::problem::Problem;
use crate::problem::structure::DIRECTIONS;

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

    /// The model that points are judged on: with its states beside the design where dense derivatives of the design alone would be
    /// larger than `LARGEST_DENSE`. Both say the same of a point, see [`Lifted`].
    pub fn judge(&self) -> &dyn Model {
        match self {
            Assembled::Structure(model) if is_large(model.lifted()) => model.lifted(),
            other => other.model(),
        }
    }

    /// The same in the other variables, for backends that want these.
    pub fn other_form(&self) -> Option<Box<dyn Substitution + Send>> {
        match self {
            Assembled::Ribs(_) => None,
            Assembled::Structure(model) if is_large(model.lifted()) => {
                let fits = entries(model.lifted()) <= LARGEST_REDUCED;
                fits.then(|| Box::new(DesignAlone(Arc::clone(model))) as Box<dyn Substitution + Send>)
            }
            // Beyond what is small, few design variables are dense columns beside the displacements.
            Assembled::Structure(model) if entries(model.lifted()) > LARGEST_DENSE => None,
            Assembled::Structure(model) => Some(Box::new(WithDisplacements(Arc::clone(model)))),
        }
    }

    /// The structure's analysis, where there is any.
    pub fn analysis(&self) -> Option<&Reduced<Lifted>> {
        match self {
            Assembled::Structure(model) => Some(model),
            Assembled::Ribs(_) => None,
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

/// Entries of the reduced Jacobian up to which points are judged on the reduced model: its matrices are dense, and each costs as many solves
/// as there are design variables.
const LARGEST_DENSE: usize = 5_000;

/// Entries up to which the reduced model has derivatives at all: 80 MB.
const LARGEST_REDUCED: usize = 10_000_000;

fn entries(lifted: &Lifted) -> usize {
    let states = lifted.states();
    states.first_variable.saturating_mul(states.first_row.max(states.first_variable))
}

fn is_large(lifted: &Lifted) -> bool {
    let few = lifted.states().first_variable <= FEW_VARIABLES && entries(lifted) <= LARGEST_OF_FEW;
    entries(lifted) > LARGEST_DENSE && !few
}

/// Design variables up to which the reduced model judges larger problems, too: each is in nearly every row of the lifted one by the sections it
/// shares, and so many dense columns fill its factors, while derivatives of the reduced one cost a solve each.
const FEW_VARIABLES: usize = 64;

/// Entries of the reduced Jacobian up to which it does: 8 MB.
const LARGEST_OF_FEW: usize = 1_000_000;

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
    let derivatives = entries(&lifted) <= LARGEST_REDUCED;
    match Reduced::of(lifted, derivatives) {
        Some(reduced) => Ok(Assembled::Structure(Arc::new(reduced))),
        None => Ok(Assembled::Ribs(Arc::new(assemble(problem)?))),
    }
}

/// How a structure moves without resistance at a design, in words; `None` where it does not.
///
/// # Errors
/// The state equations have no value at x.
pub fn mechanism(lifted: &Lifted, x: &[f64]) -> Result<Option<String>, EvaluationError> {
    let Some(structure) = lifted.problem().structure.as_deref() else { return Ok(None) };
    let Some(mechanism) = lifted.mechanism(x)? else { return Ok(None) };
    let moving = mechanism.motion.iter().enumerate().filter(|(_, motion)| motion.abs() > NAMED_SHARE).take(MOST_NAMED);
    let words: Vec<String> = moving
        .map(|(state, _)| {
            let (node, direction) = lifted.direction(state);
            let name = &structure.nodes.names[node as usize];
            match direction {
                0..3 => format!("node {name} can move in {}", DIRECTIONS[direction]),
                _ => format!("node {name} can rotate about {}", &DIRECTIONS[direction][1..]),
            }
        })
        .collect();
    Ok(Some(words.join("; ")))
}

/// Directions that move by this share of the one that moves most are named, but not more than so many.
const NAMED_SHARE: f64 = 0.3;
const MOST_NAMED: usize = 6;

/// The lifted model as other variables of the reduced one: the analysed displacements beside the design.
struct WithDisplacements(Arc<Reduced<Lifted>>);

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

    fn outward_multipliers(&self, _user: &dyn Model, _z: &[f64], y: &[f64]) -> Option<Vec<f64>> {
        Some(y.get(..self.0.meta().rows())?.to_vec())
    }
}

/// The reduced model as other variables of the lifted one: the design alone.
struct DesignAlone(Arc<Reduced<Lifted>>);

impl Substitution for DesignAlone {
    fn model(&self) -> &dyn Model {
        self.0.as_ref()
    }

    fn inward(&self, z: &[f64]) -> Vec<f64> {
        z[..self.0.meta().variables().min(z.len())].to_vec()
    }

    fn outward(&self, x: &[f64]) -> Vec<f64> {
        let mut z = x.to_vec();
        z.resize(self.0.lifted().meta().variables(), 0.0);
        self.0.lifted().complete(&mut z);
        z
    }
}
