//! `[nodes]` and the table of nodes.

use super::super::Assembly;
use crate::input::declaration::structure::Vector;
use crate::input::declaration::{Declaration, Name};
use crate::input::source::{Place, Written};
use crate::input::table::Tables;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::DIRECTIONS;
use crate::problem::{Cells, Column, Dimension};

/// Stands for coordinates after a mistake in them.
pub(super) const UNKNOWN: [Dimension; 3] = [Dimension::Constant(f64::NAN); 3];

impl Assembly<'_> {
    pub(super) fn nodes(&mut self, declared: &Declaration, tables: &mut Tables<'_>) {
        for entry in &declared.structure.nodes {
            let position = entry.at.as_ref().and_then(|at| self.position(at, &entry.name.text));
            let Some(node) = self.node(&entry.name, position.unwrap_or(UNKNOWN)) else { continue };
            for (name, datum) in &entry.data {
                self.building.node_data.put(&name.text, node as usize, datum);
            }
        }
        if let Some(written) = &declared.structure.node_table {
            self.node_table(written, tables);
        }
    }

    fn position(&mut self, at: &Vector, name: &str) -> Option<[Dimension; 3]> {
        let axes = self.building.structure.plane.axes();
        self.fits(at, axes.len(), &format!("node `{name}`"))?;
        let mut position = [Dimension::Constant(0.0); 3];
        let parts: Vec<Option<Dimension>> = at.parts.iter().map(|part| self.quantity(part)).collect();
        for (&axis, part) in axes.iter().zip(parts) {
            position[axis] = part?;
        }
        Some(position)
    }

    /// Adds a node.
    pub(in crate::input::check) fn node(&mut self, name: &Name, position: [Dimension; 3]) -> Option<u32> {
        if name.text.trim().is_empty() {
            self.findings.mistake(MistakeCode::ReservedName, name.place, "a node without a name", "give it a name");
            return None;
        }
        let nodes = &mut self.building.structure.nodes;
        if let Some(first) = self.names.nodes.find(&nodes.names, &name.text) {
            let first = self.spoken(self.building.node_places[first as usize]);
            let message = format!("the node `{}` is given twice", name.text);
            self.findings.mistake(
                MistakeCode::DuplicateName,
                name.place,
                message,
                format!("the first is declared at {first}; rename one of them"),
            );
            return None;
        }
        let number = nodes.names.len() as u32;
        nodes.names.push(&name.text);
        nodes.position.push(position);
        let _ = self.names.nodes.enter(&nodes.names, number); // known to be free
        self.building.node_places.push(name.place);
        Some(number)
    }

    /// Coordinates as data of the nodes, to choose and to reckon by; empty cells where they depend on variables.
    pub(super) fn coordinate_columns(&mut self) {
        let structure = &mut self.building.structure;
        for &axis in structure.plane.axes() {
            let number = |position: &[Dimension; 3]| match position[axis] {
                Dimension::Constant(value) => value,
                _ => f64::NAN,
            };
            if structure.nodes.data.iter().all(|column| column.name != DIRECTIONS[axis]) {
                let cells = Cells::Numbers(structure.nodes.position.iter().map(number).collect());
                structure.nodes.data.push(Column { name: DIRECTIONS[axis].to_owned(), cells });
            }
        }
    }

    /// Where nodes are declared.
    pub(in crate::input::check) fn node_places(&self) -> &[Place] {
        &self.building.node_places
    }

    /// The node of this name, or a mistake.
    pub(super) fn node_named(&mut self, written: &Written) -> Option<u32> {
        let found = self.names.nodes.find(&self.building.structure.nodes.names, &written.text);
        if found.is_none() {
            self.unknown_node(&written.text, written.place);
        }
        found
    }

    pub(super) fn unknown_node(&mut self, name: &str, place: Place) {
        if self.building.incomplete {
            return; // perhaps it stands in what could not be read
        }
        let near = did_you_mean(name, self.building.structure.nodes.names.iter().take(10_000));
        let help = near.unwrap_or_else(|| "declare it under [nodes] or in the table of nodes".into());
        self.findings.mistake(MistakeCode::UnknownItem, place, format!("there is no node `{name}`"), help);
    }
}
