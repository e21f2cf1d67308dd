//! The table of nodes: name, coordinates, data.

use super::super::super::Assembly;
use super::super::super::data::put;
use super::super::nodes::UNKNOWN;
use super::{filled, require, scalar};
use crate::expression::ast::Collection;
use crate::input::declaration::Name;
use crate::input::source::Written;
use crate::input::table::{Row, Table, Tables};
use crate::problem::Dimension;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::structure::DIRECTIONS;

/// Columns of the table.
struct Columns {
    name: usize,
    coordinates: [Option<usize>; 3],
    /// Field and data column.
    data: Vec<(usize, usize)>,
}

impl Assembly<'_> {
    pub(in crate::input::check::structure) fn node_table(&mut self, written: &Written, tables: &mut Tables<'_>) {
        // Until the columns are known.
        let before = std::mem::replace(&mut self.without.table, true);
        self.building.incomplete = true;
        let Some(mut table) = tables.open(written, &mut self.findings) else { return };
        self.columns_of(&table, Some(Collection::Nodes));
        let Some(columns) = self.node_columns(&table) else { return };
        while let Some(row) = table.next(&mut self.findings) {
            self.node_row(&row, &columns);
        }
        table.say_how(&mut self.findings);
        self.building.incomplete = table.ragged;
        self.without.table = before || (table.ragged && self.building.structure.nodes.names.is_empty());
    }

    fn node_columns(&mut self, table: &Table) -> Option<Columns> {
        let name = require(table, "name", &mut self.findings);
        let mut coordinates = [0, 1, 2].map(|axis| super::find(table, DIRECTIONS[axis]));
        let mut whole = true;
        for &axis in self.building.structure.plane.axes() {
            coordinates[axis] = require(table, DIRECTIONS[axis], &mut self.findings);
            whole &= coordinates[axis].is_some();
        }
        let mut columns = Columns { name: name?, coordinates, data: Vec::new() };
        for (at, header) in table.headers.iter().enumerate() {
            if at == columns.name || columns.coordinates.contains(&Some(at)) || header.is_empty() {
                continue;
            }
            if header.contains('.') {
                let help = "nodes have no dimensions; choose another name for the datum";
                self.findings.mistake(MistakeCode::Table, table.place(1, at as u16), format!("unknown column `{header}`"), help);
            } else {
                columns.data.push((at, self.building.node_data.column(header)));
            }
        }
        whole.then_some(columns)
    }

    fn node_row(&mut self, row: &Row, columns: &Columns) {
        let name = Name { text: row.field(columns.name).to_owned(), place: row.place(columns.name) };
        let position = self.node_position(row, columns, &name);
        let Some(node) = self.node(&name, position.unwrap_or(UNKNOWN)) else { return };
        for &(at, column) in &columns.data {
            put(&mut self.building.node_data, &mut self.findings, row, at, column, node as usize);
        }
    }

    fn node_position(&mut self, row: &Row, columns: &Columns, name: &Name) -> Option<[Dimension; 3]> {
        let axes = self.building.structure.plane.axes();
        self.nothing_along_others(row, columns.coordinates, axes, "a node");
        let mut position = [Dimension::Constant(0.0); 3];
        for &axis in axes {
            let at = columns.coordinates[axis]?;
            if filled(row, Some(at)).is_none() {
                let message = format!("node `{}` has no {}", name.text, DIRECTIONS[axis]);
                self.findings.mistake(MistakeCode::EmptyCell, row.place(at), message, "fill the cell");
                return None;
            }
            position[axis] = self.quantity(&scalar(row, at)?)?;
        }
        Some(position)
    }
}
