//! What of a structure stands where bars have vanished.

use std::sync::Arc;

use super::{AssemblyError, EvaluationError, Lifted};
use crate::problem::structure::{Action, Structure};
use crate::problem::{Formula, Problem};

/// Directions that move by this share of the one that moves most belong to a mechanism.
const MOVES: f64 = 0.3;

/// A structure without the bars that have vanished.
pub struct Remainder {
    /// It, with all names and rows.
    pub problem: Problem,
    /// The ribs that are gone.
    pub gone: Vec<u32>,
    /// Ribs whose areas have all but vanished and that are needed: without them something would move without resistance.
    pub needed: Vec<u32>,
}

/// The structure without the bars that have vanished at x, as many as it can stand without; `None` where none has.
///
/// Bars at a node that would move, or at one that carries a load and would have nothing left to carry it, are put back until the rest
/// stands: every round puts back at least one, so there are no more rounds than bars.
///
/// # Errors
/// The rest cannot be assembled, or has no value at x.
pub fn remainder(problem: &Problem, x: &[f64]) -> Result<Option<Remainder>, RemainderError> {
    let mut gone = problem.vanished_members(x);
    let all = gone.clone();
    while !gone.is_empty() {
        let rest = problem.without_members(&gone);
        let Some(structure) = rest.structure.as_deref() else { return Ok(None) };
        let mut open = abandoned(problem, &rest, structure);
        if open.is_empty() {
            open = moving(&rest, x)?;
        }
        if open.is_empty() {
            let rib = |&member: &u32| structure.members[member as usize].rib;
            let needed = all.iter().filter(|member| !gone.contains(member)).map(rib).collect();
            return Ok(Some(Remainder { gone: gone.iter().map(rib).collect(), needed, problem: rest }));
        }
        let before = gone.len();
        gone.retain(|&member| {
            let member = &structure.members[member as usize];
            !open.contains(&member.start) && !open.contains(&member.end)
        });
        if gone.len() == before {
            return Ok(None);
        }
    }
    Ok(None)
}

/// Nodes that have lost all hold in some direction, but for those that nothing loads and that no member is left at: these go with their bars.
fn abandoned(problem: &Problem, rest: &Problem, structure: &Structure) -> Vec<u32> {
    let (Some(before), Some(after)) = (problem.statics.as_deref(), rest.statics.as_deref()) else { return Vec::new() };
    let mut is_loaded = vec![false; structure.nodes.names.len()];
    for load in &structure.loads {
        if let Action::Nodal { node, force, moment } = &load.action {
            is_loaded[*node as usize] |= force.iter().chain(moment).any(|&value| value != 0.0);
        }
    }
    let stays = |node: u32| is_loaded[node as usize] || !after.members_at[node as usize].is_empty();
    let is_lost = |node: u32| (0..6).any(|at| before.is_free(node, at) && !after.exists[node as usize][at]);
    (0..structure.nodes.names.len() as u32).filter(|&node| stays(node) && is_lost(node)).collect()
}

/// Nodes of a mechanism.
fn moving(rest: &Problem, x: &[f64]) -> Result<Vec<u32>, RemainderError> {
    let bare = Problem { constraints: Vec::new(), objective: Formula::default(), auxiliaries: Vec::new(), ..rest.clone() };
    let lifted = Lifted::of(&Arc::new(bare))?;
    let Some(mechanism) = lifted.mechanism(x)? else { return Ok(Vec::new()) };
    let motion = mechanism.motion.iter().enumerate().filter(|(_, motion)| motion.abs() > MOVES);
    Ok(motion.map(|(state, _)| lifted.direction(state).0).collect())
}

/// Why the rest could not be looked at.
#[derive(Debug, thiserror::Error)]
pub enum RemainderError {
    /// It cannot be assembled.
    #[error(transparent)]
    Assembly(#[from] AssemblyError),
    /// It has no value.
    #[error(transparent)]
    Value(#[from] EvaluationError),
}
