//! State equations: Σ abᵀq + (ΘO)ᵀg + k·u = P in every free direction and load case.

use std::sync::Arc;

use super::{Numbering, identity, with_inputs};
use crate::model::assemble::support_rows;
use crate::model::views::mapped::Maps;
use crate::model::{Model, RibModel};
use crate::problem::formula::{Response, Subject, What};
use crate::problem::statics::Statics;
use crate::problem::structure::{Action, Structure};
use crate::problem::{Constraint, Formula, Limit, Problem, Scope};
use crate::structure::algebra::Numbers;
use crate::structure::deformation::BASIC;

/// The problem over design variables and inputs, with rows for every force that the state equations are made of.
pub(super) fn inner_problem(problem: &Problem, structure: &Structure, statics: &Statics) -> Problem {
    let mut inner = problem.clone();
    with_inputs(&mut inner, structure.load_sets() * statics.inputs as usize);
    for set in 0..structure.cases.len() as u32 {
        for (what, ribs) in forces(structure, statics, set) {
            let left = Formula::Response(Arc::new(Response { set, subject: Subject::Own, what }));
            let right = Limit::AtMost(Formula::Constant(f64::INFINITY));
            let (name, place, text) = ("force".into(), String::new(), String::new());
            inner.constraints.push(Constraint {
                name,
                detail: Box::default(),
                place,
                text,
                scope: Scope::Ribs(ribs),
                left,
                right,
            });
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

/// C and D: the user's rows as they are, then every state equation. Returns the loads on the nodes, the equations' right sides.
pub(super) fn outputs(
    inner: &RibModel,
    structure: &Structure,
    statics: &Statics,
    numbering: &Numbering,
    maps: &mut Maps,
) -> Vec<f64> {
    let states = numbering.states;
    for row in 0..states.first_row as u32 {
        identity(&mut maps.outputs, row);
        maps.linear.push([]);
    }
    let number = states.block * states.blocks;
    let (mut sums, mut springs) = (vec![Vec::new(); number], vec![Vec::new(); number]);
    for row in states.first_row..inner.meta().rows() {
        for (equation, factor) in shares(inner, row, structure, statics, numbering) {
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
    loads(structure, numbering)
}

/// The state equations that the force of an inner row goes into, and its factor there.
fn shares(inner: &RibModel, row: usize, structure: &Structure, statics: &Statics, numbering: &Numbering) -> Vec<(usize, f64)> {
    let origin = inner.row_origin(row);
    let constraint = &inner.problem().constraints[origin.constraint as usize];
    let (Formula::Response(response), Scope::Ribs(ribs)) = (&constraint.left, &constraint.scope) else { return Vec::new() };
    let Some(member) = structure.member(ribs[origin.item as usize]) else { return Vec::new() };
    let (declared, prepared) = (&structure.members[member as usize], &statics.members[member as usize]);
    let factors = match response.what {
        What::Basic(component) => prepared.rows[usize::from(component)],
        What::Support(component) => support_rows(&mut Numbers, &prepared.frame, declared.offset)[usize::from(component)],
        What::End(direction) => std::array::from_fn(|at| f64::from(u8::from(at == usize::from(direction)))),
        _ => return Vec::new(),
    };
    let share = |(at, factor): (usize, f64)| {
        let node = if at < 6 { declared.start } else { declared.end };
        (factor != 0.0).then(|| Some((numbering.row(response.set, node, at % 6)?, factor))).flatten()
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

/// The load that acts on a node itself in one direction, in a case or combination.
pub fn nodal_load(structure: &Structure, statics: &Statics, set: u32, node: u32, direction: usize) -> f64 {
    let factors = structure.factors(set);
    let value = |&load: &u32| {
        let load = &structure.loads[load as usize];
        let factor = factors.iter().find(|(case, _)| *case == load.case).map_or(0.0, |(_, factor)| *factor);
        match &load.action {
            Action::Nodal { force, moment, .. } if direction < 3 => factor * force[direction],
            Action::Nodal { moment, .. } => factor * moment[direction - 3],
            _ => 0.0,
        }
    };
    statics.loads_at[node as usize].iter().map(value).sum()
}
