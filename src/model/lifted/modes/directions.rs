//! The directions in which a mode moves, and what they make of the ends of members' pieces.

use super::super::Numbering;
use super::super::maps::{Linear, settlements};
use crate::model::views::mapped::Maps;
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use crate::structure::algebra::Numbers;
use crate::structure::deformation::{along, turning};

/// Where the directions of a mode stand in w.
pub(super) struct Directions<'a> {
    numbering: &'a Numbering,
    /// The first of each member's inner nodes.
    inner: Vec<usize>,
    pub(super) count: usize,
}

impl Directions<'_> {
    pub(super) fn of_node(&self, node: u32, direction: usize) -> Option<usize> {
        self.numbering.of.get(&(node, direction as u8)).map(|&at| at as usize)
    }
}

pub(super) fn mode_directions<'a>(structure: &Structure, statics: &Statics, numbering: &'a Numbering) -> Directions<'a> {
    let mut count = numbering.of.len();
    let mut inner = Vec::with_capacity(structure.members.len());
    for member in &statics.members {
        inner.push(count);
        let of_each = member.inner_directions().into_iter().filter(|&has| has).count();
        count += member.pieces.saturating_sub(1) as usize * of_each;
    }
    Directions { numbering, inner, count }
}

/// Design variables as they are, what members deform by in the cases asked for, and the ends of every piece in a mode.
pub(super) fn map_inputs(
    structure: &Structure,
    statics: &Statics,
    numbering: &Numbering,
    sets: &[u32],
    directions: &Directions,
    before: usize,
    maps: &mut Maps,
) {
    for j in 0..numbering.states.first_variable as u32 {
        maps.inputs.push([(j, 1.0)]);
        maps.constants.push(0.0);
    }
    let linear = Linear { structure, statics, numbering, settled: settlements(structure) };
    for set in 0..structure.load_sets() as u32 {
        let factors = if sets.contains(&set) { structure.factors(set) } else { Vec::new() };
        for at in 0..statics.inputs {
            let (entries, constant) = linear.of(&factors, statics.input(at));
            maps.inputs.push(entries);
            maps.constants.push(constant);
        }
    }
    for member in 0..structure.members.len() {
        for piece in 0..statics.members[member].pieces {
            for at in 0..12 {
                let entries = piece_end(structure, statics, directions, member, piece, at);
                maps.inputs.push(entries.into_iter().map(|(state, factor)| ((before + state) as u32, factor)));
                maps.constants.push(0.0);
            }
        }
    }
}

/// What a displacement of a piece's end is in those of a mode: 0 to 5 at its start, then at its end.
fn piece_end(
    structure: &Structure,
    statics: &Statics,
    directions: &Directions,
    member: usize,
    piece: u32,
    at: usize,
) -> Vec<(usize, f64)> {
    let (declared, prepared) = (&structure.members[member], &statics.members[member]);
    let (end, direction) = (at / 6, at % 6);
    let number = piece + end as u32;
    if number > 0 && number < prepared.pieces {
        let has = prepared.inner_directions();
        let each = has.into_iter().filter(|&has| has).count();
        let place = has[..direction].iter().filter(|&&has| has).count();
        return if has[direction] {
            vec![(directions.inner[member] + (number as usize - 1) * each + place, 1.0)]
        } else {
            Vec::new()
        };
    }
    let node = if end == 0 { declared.start } else { declared.end };
    if !prepared.fixed {
        return directions.of_node(node, direction).map(|state| (state, 1.0)).into_iter().collect();
    }
    let axis = prepared.frame.axes[direction % 3];
    let row = match direction < 3 {
        true => along(&mut Numbers, end, axis, declared.offset[end]),
        false => turning(&mut Numbers, end, axis),
    };
    let global = row[6 * end..6 * end + 6].iter().enumerate().filter(|(_, factor)| **factor != 0.0);
    global.filter_map(|(direction, &factor)| Some((directions.of_node(node, direction)?, factor))).collect()
}
