//! The linear maps between design, states and the elements: deformations, equilibrium, what is known at the supports.

use super::super::Meta;
use super::super::views::composed::Links;
use super::super::views::mapped::Maps;
use super::{Numbering, States};
use crate::problem::statics::{Input, Statics};
use crate::problem::structure::{Action, Structure};
use std::collections::HashMap;

/// What an input is made of where it is linear in the displacements: entries and constant.
pub(super) struct Linear<'a> {
    pub(super) structure: &'a Structure,
    pub(super) statics: &'a Statics,
    pub(super) numbering: &'a Numbering,
    pub(super) settled: HashMap<(u32, u32, u8), f64>,
}

impl Linear<'_> {
    pub(super) fn of(&self, factors: &[(u32, f64)], input: Input) -> (Vec<(u32, f64)>, f64) {
        let (mut entries, mut constant): (Vec<(u32, f64)>, f64) = (Vec::new(), 0.0);
        let mut add = |node: u32, direction: usize, coefficient: f64| {
            for &(case, factor) in factors {
                match self.numbering.variable(case, node, direction) {
                    Some(variable) => entries.push((variable, factor * coefficient)),
                    None => {
                        let held = self.settled.get(&(case, node, direction as u8)).copied().unwrap_or(0.0);
                        constant += factor * coefficient * held;
                    }
                }
            }
        };
        match input {
            Input::Displacement(node, direction) => add(node, direction, 1.0),
            Input::Deformation(member, component) => {
                let declared = &self.structure.members[member as usize];
                let row = &self.statics.members[member as usize].rows[component];
                for (at, &coefficient) in row.iter().enumerate().filter(|(_, coefficient)| **coefficient != 0.0) {
                    add(if at < 6 { declared.start } else { declared.end }, at % 6, coefficient);
                }
            }
        }
        (entries, constant)
    }
}

/// B and b of the forces: design variables as they are, then what members deform by in every case.
pub(super) fn deformations(structure: &Structure, statics: &Statics, numbering: &Numbering, maps: &mut Maps) {
    for j in 0..numbering.states.first_variable as u32 {
        maps.inputs.push([(j, 1.0)]);
        maps.constants.push(0.0);
    }
    let linear = Linear { structure, statics, numbering, settled: settlements(structure) };
    for case in 0..structure.cases.len() as u32 {
        for at in 0..statics.inputs {
            let (entries, constant) = linear.of(&[(case, 1.0)], statics.input(at));
            maps.inputs.push(entries);
            maps.constants.push(constant);
        }
    }
}

/// The first row of the forces that is a state equation is their number; before it stand the basic forces of members known by them.
pub(super) type Known = HashMap<(u32, u32, u8), u32>;

/// What the user's rows look at, in every case and combination: basic forces, deformations of bars, displacements.
pub(super) fn links(structure: &Structure, statics: &Statics, numbering: &Numbering, known: &Known) -> Links {
    let mut links = Links::default();
    for j in 0..numbering.states.first_variable as u32 {
        links.variables.push([(j, 1.0)]);
        links.rows.push([]);
        links.constants.push(0.0);
    }
    let linear = Linear { structure, statics, numbering, settled: settlements(structure) };
    for set in 0..structure.load_sets() as u32 {
        let factors = structure.factors(set);
        for at in 0..statics.inputs {
            let input = statics.input(at);
            let force = |&(case, factor): &(u32, f64)| match input {
                Input::Deformation(member, component) => Some((*known.get(&(case, member, component as u8))?, factor)),
                Input::Displacement(..) => None,
            };
            let forces: Vec<(u32, f64)> = factors.iter().filter_map(force).collect();
            let by_forces = matches!(input, Input::Deformation(member, _) if statics.members[member as usize].by_forces);
            let (entries, constant) = if by_forces { (Vec::new(), 0.0) } else { linear.of(&factors, input) };
            links.variables.push(entries);
            links.rows.push(forces);
            links.constants.push(constant);
        }
    }
    links
}

/// Prescribed displacements by case, node and direction.
pub(super) fn settlements(structure: &Structure) -> HashMap<(u32, u32, u8), f64> {
    let mut settled = HashMap::new();
    for load in &structure.loads {
        if let Action::Displacement { node, direction, value } = load.action {
            *settled.entry((load.case, node, direction)).or_insert(0.0) += value;
        }
    }
    settled
}

/// Bounds and starts of the design, open ones of the states; limits of the rows, the loads for the state equations.
pub(super) fn outer_meta(inner: &Meta, states: States, loads: &[f64]) -> Meta {
    let (n, m) = (states.first_variable, states.first_row);
    let number = states.block * states.blocks;
    let with = |own: &[f64], value: f64| own[..n].iter().copied().chain(std::iter::repeat_n(value, number)).collect();
    let followed = |own: &[f64]| own[..m].iter().copied().chain(loads.iter().copied()).collect();
    Meta {
        lower: with(&inner.lower, f64::NEG_INFINITY),
        upper: with(&inner.upper, f64::INFINITY),
        start: with(&inner.start, 0.0),
        typical: with(&inner.typical, 0.0),
        row_lower: followed(&inner.row_lower),
        row_upper: followed(&inner.row_upper),
        row_is_linear: inner.row_is_linear[..m].iter().copied().chain(std::iter::repeat_n(false, number)).collect(),
        objective_is_linear: inner.objective_is_linear,
        states: Some(states),
        ..Meta::default()
    }
}
