//! From a checked problem to what is solved: kinks restated, the model assembled, its class proved, and other variables found where the
//! problem is easier to solve in them.

use std::sync::Arc;

use super::components::{FEWEST_VARIABLES, SMALL};
use super::views::flange_substitution::FlangeSubstitution;
use super::{Assembled, AssemblyError, Class, Classification, Model, RibModel, Substitution, assemble_any, classify};
use crate::problem::Problem;

/// A problem in all the forms it is solved and shown in.
pub struct Formulation {
    /// The model that is solved: kinks restated, auxiliaries after the user's own variables.
    pub model: Assembled,
    /// The same as it was written: kinks stay, and there are no auxiliaries.
    pub shown: Assembled,
    /// What is proved about it.
    pub class: Class,
    /// Which term keeps it from being a geometric program.
    pub not_geometric: Option<String>,
    /// Which term keeps it from being convex.
    pub not_convex: Option<String>,
    /// The same in other variables, where there are any that suit it better.
    pub substitution: Option<Box<dyn Substitution + Send>>,
}

/// Formulates a problem. Statically determinate trusses are written out in the forces of equilibrium where that proves them convex or
/// geometric programs.
///
/// # Errors
/// Where one term couples so many variables that its second derivatives do not fit.
pub fn formulate(problem: Problem) -> Result<Formulation, AssemblyError> {
    if !problem.auxiliaries.is_empty() {
        return formulated(problem);
    }
    let problem = problem.with_force_limits();
    if let Some(explicit) = problem.determinate() {
        let explicit = formulated(explicit.without_kinks())?;
        if explicit.class.is_global() {
            return Ok(explicit);
        }
    }
    formulated(problem.without_kinks())
}

fn formulated(problem: Problem) -> Result<Formulation, AssemblyError> {
    let problem = Arc::new(problem);
    let model = assemble_any(&problem)?;
    let shown = match problem.auxiliaries.is_empty() {
        true => model.clone(),
        false => assemble_any(&Arc::new(problem.with_kinks()))?,
    };
    let Classification { class, logarithmic, not_geometric, not_convex } = match &model {
        Assembled::Ribs(model) => classify(model)?,
        Assembled::Structure(_) => Classification::nonlinear(),
    };
    let substitution = match (logarithmic, &model) {
        (_, Assembled::Ribs(model)) if has_small_components(model) => None,
        (Some(logarithmic), _) => Some(Box::new(logarithmic) as Box<dyn Substitution + Send>),
        (None, Assembled::Ribs(model)) => flanges(&problem, model),
        (None, Assembled::Structure(_)) => model.other_form(),
    };
    Ok(Formulation { model, shown, class, not_geometric, not_convex, substitution })
}

/// Whether the model decomposes into so many small components that it is solved one by one, each in variables that suit it.
fn has_small_components(model: &RibModel) -> bool {
    let large = model.meta().variables() >= FEWEST_VARIABLES;
    large && model.components().is_some_and(|components| components.partition().largest() <= SMALL)
}

/// H beams given by two heights are solved in the flange thickness, where the bounds let it vanish.
fn flanges(problem: &Problem, model: &Arc<RibModel>) -> Option<Box<dyn Substitution + Send>> {
    let pairs = FlangeSubstitution::pairs(problem);
    (!pairs.is_empty()).then(|| Box::new(FlangeSubstitution::new(Arc::clone(model) as _, &pairs)) as Box<dyn Substitution + Send>)
}
