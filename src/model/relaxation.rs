//! Convex problems whose minima lie below that of a structure: rigorous bounds for what is itself not convex.

use std::sync::Arc;

use super::assemble::convex_constraints;
use super::{AssemblyError, Formulation, formulate};
use crate::problem::Problem;

/// The problem with the forces of a truss free but for equilibrium, and of its rows those that are convex then; `None` for other structures, and where the
/// objective is not convex.
///
/// Every design that meets the limits, with the forces it has, is a point of the relaxed problem; so none is below the minimum of that.
///
/// # Errors
/// As [`formulate`].
pub fn relaxation(problem: &Problem) -> Result<Option<Formulation>, AssemblyError> {
    let Some(mut relaxed) = problem.with_free_forces() else { return Ok(None) };
    let Some(convex) = convex_constraints(&Arc::new(relaxed.clone()))? else { return Ok(None) };
    let mut kept = convex.into_iter();
    relaxed.constraints.retain(|_| kept.next().unwrap_or(false));
    let formulation = formulate(relaxed)?;
    Ok(formulation.class.is_global().then_some(formulation))
}
