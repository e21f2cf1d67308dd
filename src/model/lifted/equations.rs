//! State equations: Σ abᵀq + (ΘO)ᵀg + k·u = P in every free direction and load case.

use std::sync::Arc;

use super::{Known, Numbering, with_inputs};
use crate::model::views::mapped::Maps;
use crate::model::{Model, RibModel};
use crate::problem::formula::{Response, Subject, What};
use crate::problem::modes::Eigenvalue;
use crate::problem::statics::Statics;
use crate::problem::structure::{Action, Structure};
use crate::problem::{Constraint, Formula, Problem, Scope};
use crate::structure::algebra::Numbers;
use crate::structure::deformation::{BASIC, support_rows};

/// The user's problem over design variables and inputs: basic forces of members known by them, in every case and combination.
pub(super) fn rows_problem(problem: &Problem, structure: &Structure, statics: &Statics, eigenvalues: Vec<Eigenvalue>) -> Problem {
    let mut inner = problem.clone();
    with_inputs(&mut inner, structure.load_sets() * statics.inputs as usize + eigenvalues.len());
    inner.inputs_are_forces = true;
    inner.eigenvalues = eigenvalues;
    inner
}

/// Every force that the state equations are made of, as rows over design variables and deformations.
pub(super) fn forces_problem(problem: &Problem, structure: &Structure, statics: &Statics) -> Problem {
    let mut inner =
        Problem { constraints: Vec::new(), objective: Formula::default(), auxiliaries: Vec::new(), ..problem.clone() };
    with_inputs(&mut inner, structure.cases.len() * statics.inputs as usize);
    for set in 0..structure.cases.len() as u32 {
        for (what, ribs) in forces(structure, statics, set) {
            let left = Formula::Response(Arc::new(Response { set, subject: Subject::Own, what }));
            inner.constraints.push(Constraint::unlimited("force", Scope::Ribs(ribs), left));
        }
    }
    inner
}

/// Which forces of which ribs make up the state equations of a case.
fn forces(structure: &Structure, statics: &Statics, case: u32) -> Vec<(What, Vec<u32>)> {
    let members = || structure.members.iter().zip(&statics.members);
    let mut list = Vec::new();
    for component in 0..BASIC {
        let carries = members().filter(|(_, prepared)| prepared.fixed && prepared.components[component]);
        list.push((What::Basic(component as u8), carries.map(|(member, _)| member.rib).collect::<Vec<u32>>()));
    }
    let loaded = |prepared: &crate::problem::statics::Prepared| {
        prepared.loads.iter().any(|&load| {
            let load = &structure.loads[load as usize];
            load.case == case
                && matches!(load.action, Action::Distributed { .. } | Action::Point { .. } | Action::SelfWeight { .. })
        })
    };
    for component in 0..6 {
        let carried = members().filter(|(_, prepared)| prepared.fixed && loaded(prepared));
        list.push((What::Support(component), carried.map(|(member, _)| member.rib).collect()));
    }
    for direction in 0..12u8 {
        let moving = members().filter(|(member, prepared)| {
            let node = if direction < 6 { member.start } else { member.end };
            !prepared.fixed && statics.is_free(node, usize::from(direction) % 6)
        });
        list.push((What::End(direction), moving.map(|(member, _)| member.rib).collect()));
    }
    list.retain(|(_, ribs)| !ribs.is_empty());
    list
}

/// C and D: the basic forces that others look at as they are, then every state equation. Returns where these forces stand, and the loads on
/// the nodes: the equations' right sides.
pub(super) fn outputs(
    forces: &RibModel,
    structure: &Structure,
    statics: &Statics,
    numbering: &Numbering,
    maps: &mut Maps,
) -> (Known, Vec<f64>) {
    let (states, mut known) = (numbering.states, Known::new());
    let number = states.block * states.blocks;
    let (mut sums, mut springs) = (vec![Vec::new(); number], vec![Vec::new(); number]);
    for row in 0..forces.meta().rows() {
        let Some((case, member, what)) = force(forces, row, structure) else { continue };
        let prepared = &statics.members[member as usize];
        if let What::Basic(component) = what
            && prepared.by_forces
        {
            known.insert((case, member, component), known.len() as u32);
            maps.outputs.push([(row as u32, 1.0)]);
            maps.linear.push([]);
        }
        for (equation, factor) in shares(&what, case, member, structure, statics, numbering) {
            sums[equation - states.first_row].push((row as u32, factor));
        }
    }
    for support in &structure.supports {
        for direction in (0..6).filter(|&direction| support.springs[direction] != 0.0) {
            for case in 0..states.blocks as u32 {
                let equation = numbering.row(case, support.node, direction);
                if let (Some(equation), Some(variable)) = (equation, numbering.variable(case, support.node, direction)) {
                    springs[equation - states.first_row].push((variable, support.springs[direction]));
                }
            }
        }
    }
    sums.into_iter().for_each(|sum| maps.outputs.push(sum));
    springs.into_iter().for_each(|spring| maps.linear.push(spring));
    (known, loads(structure, numbering))
}

/// Case, member and kind of the force that a row is.
fn force(forces: &RibModel, row: usize, structure: &Structure) -> Option<(u32, u32, What)> {
    let origin = forces.row_origin(row);
    let constraint = &forces.problem().constraints[origin.constraint as usize];
    let (Formula::Response(response), Scope::Ribs(ribs)) = (&constraint.left, &constraint.scope) else { return None };
    Some((response.set, structure.member(ribs[origin.item as usize])?, response.what.clone()))
}

/// The state equations that a force goes into, and its factor there.
fn shares(
    what: &What,
    case: u32,
    member: u32,
    structure: &Structure,
    statics: &Statics,
    numbering: &Numbering,
) -> Vec<(usize, f64)> {
    let (declared, prepared) = (&structure.members[member as usize], &statics.members[member as usize]);
    let factors = match *what {
        What::Basic(component) => prepared.rows[usize::from(component)],
        What::Support(component) => support_rows(&mut Numbers, &prepared.frame, declared.offset)[usize::from(component)],
        What::End(direction) => std::array::from_fn(|at| f64::from(u8::from(at == usize::from(direction)))),
        _ => return Vec::new(),
    };
    let share = |(at, factor): (usize, f64)| {
        let node = if at < 6 { declared.start } else { declared.end };
        (factor != 0.0).then(|| Some((numbering.row(case, node, at % 6)?, factor))).flatten()
    };
    factors.into_iter().enumerate().filter_map(share).collect()
}

/// The loads on nodes by state equation.
fn loads(structure: &Structure, numbering: &Numbering) -> Vec<f64> {
    let states = numbering.states;
    let mut loads = vec![0.0; states.block * states.blocks];
    for load in &structure.loads {
        if let Action::Nodal { node, force, moment } = &load.action {
            for (direction, value) in force.iter().chain(moment).enumerate() {
                if let Some(row) = numbering.row(load.case, *node, direction) {
                    loads[row - states.first_row] += value;
                }
            }
        }
    }
    loads
}
