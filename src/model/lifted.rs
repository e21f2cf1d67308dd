//! The lifted model of a structure.
use crate::problem::structure::{Action, Structure};

/// The load that acts on a node itself in one direction, in a case or combination.
pub fn nodal_load(structure: &Structure, set: u32, node: u32, direction: usize) -> f64 {
    let mut sum = 0.0;
    for (case, factor) in structure.factors(set) {
        for load in structure.loads.iter().filter(|load| load.case == case) {
            if let Action::Nodal { node: at, force, moment } = &load.action
                && *at == node
            {
                sum += factor * if direction < 3 { force[direction] } else { moment[direction - 3] };
            }
        }
    }
    sum
}
