//! Lengths of members: distances of their nodes where the variables start.

use super::super::Assembly;
use crate::input::source::Place;
use crate::problem::Dimension;
use crate::problem::evaluate::Evaluation;
use crate::problem::mistake_code::MistakeCode;

/// Largest relative difference of a length given beside the distance of the nodes.
const SAME: f64 = 1e-9;

impl Assembly<'_> {
    /// Enters the lengths of all members.
    pub(super) fn lengths(&mut self) {
        let positions = self.start_positions();
        self.without_place(&positions);
        for at in 0..self.building.structure.members.len() {
            let (rib, ends) = {
                let member = &self.building.structure.members[at];
                (member.rib as usize, [member.start, member.end])
            };
            let [start, end] = ends.map(|node| positions[node as usize]);
            let length = distance(start, end);
            self.problem.ribs.length[rib] = length;
            if !length.is_finite() {
                // A node whose coordinates have a mistake, or no value: told at the node.
                self.problem.ribs.length[rib] = 1.0;
            } else if length <= 0.0 {
                self.problem.ribs.length[rib] = 1.0;
                self.no_length(rib, ends);
            } else if let Some((given, place)) = self.building.said.get(&(at as u32)).and_then(|said| said.length) {
                self.same_length(rib, given, length, place);
            }
        }
    }

    /// The mistakes of coordinates that have no value where the variables start.
    fn without_place(&mut self, positions: &[[f64; 3]]) {
        for (node, position) in positions.iter().enumerate() {
            let known = |dimension: &Dimension| !matches!(dimension, Dimension::Constant(value) if value.is_nan());
            let declared = self.building.structure.nodes.position[node];
            if declared.iter().all(known) && position.iter().any(|value| !value.is_finite()) {
                let message = format!("node `{}` has no place at the start", &self.building.structure.nodes.names[node]);
                let help = "its coordinates leave their domain there: give other starts";
                self.findings.mistake(MistakeCode::NoValue, self.building.node_places[node], message, help);
            }
        }
    }

    /// Coordinates of all nodes where the variables start; NaN where an expression has no value.
    pub(super) fn start_positions(&self) -> Vec<[f64; 3]> {
        let evaluation = Evaluation::at_start(&self.problem);
        let value = |dimension: Dimension| match dimension {
            Dimension::Constant(value) => value,
            // No item's own names hold in a coordinate.
            other => evaluation.dimension(u32::MAX, other).unwrap_or(f64::NAN),
        };
        self.building.structure.nodes.position.iter().map(|position| position.map(value)).collect()
    }

    fn no_length(&mut self, rib: usize, ends: [u32; 2]) {
        let nodes = &self.building.structure.nodes.names;
        let (name, [start, end]) = (&self.problem.ribs.names[rib], ends.map(|node| &nodes[node as usize]));
        let message = format!("rib `{name}` has no length: nodes `{start}` and `{end}` are at one place");
        self.findings.mistake(MistakeCode::RibEnds, self.rib_places[rib], message, "move one of them, or leave the rib out");
    }

    fn same_length(&mut self, rib: usize, given: f64, length: f64, place: Place) {
        if (given - length).abs() > SAME * length {
            let name = &self.problem.ribs.names[rib];
            let message = format!("rib `{name}` is {given} long here, but its nodes are {length} apart");
            self.findings.mistake(MistakeCode::RibEnds, place, message, "leave `length` out: it follows from the nodes");
        }
    }
}

fn distance(start: [f64; 3], end: [f64; 3]) -> f64 {
    let [x, y, z] = [0, 1, 2].map(|axis| end[axis] - start[axis]);
    x.hypot(y).hypot(z)
}
