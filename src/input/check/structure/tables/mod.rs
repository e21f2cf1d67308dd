//! The tables of nodes, supports and loads, and the ribs' columns that make members of them.

mod loads;
mod members;
mod nodes;
mod supports;

pub(in crate::input::check) use members::MemberColumns;

use super::super::Assembly;
use crate::input::declaration::structure::Vector;
use crate::input::fields::Scalar;
use crate::input::findings::Findings;
use crate::input::source::Place;
use crate::input::table::{Row, Table};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::words::brief;

/// The cell as a number or an expression; `None` where it is empty.
fn scalar(row: &Row, at: usize) -> Option<Scalar> {
    match (row.field(at), row.number(at)) {
        ("", _) => None,
        (_, Some(value)) => Some(Scalar::Number(value, row.place(at))),
        (_, None) => Some(Scalar::Expression(row.written(at))),
    }
}

/// The filled cell among the columns.
fn filled(row: &Row, at: Option<usize>) -> Option<usize> {
    at.filter(|&at| !row.field(at).is_empty())
}

/// The column of this name.
fn find(table: &Table, name: &str) -> Option<usize> {
    table.headers.iter().position(|header| header == name)
}

/// The column of this name, or a mistake.
fn require(table: &Table, name: &str, findings: &mut Findings) -> Option<usize> {
    let found = find(table, name);
    if found.is_none() {
        let near = table.headers.iter().find(|header| did_you_mean(header, [name].into_iter()).is_some());
        let help = match near {
            Some(header) => format!("rename `{header}`?"),
            None => "add it to the header".to_owned(),
        };
        findings.mistake(
            MistakeCode::Table,
            table.place(1, Place::WHOLE_ROW),
            format!("the table lacks the column `{name}`"),
            help,
        );
    }
    found
}

/// The mistakes of headers that are none of the known ones.
fn refuse_others(table: &Table, known: &[&str], findings: &mut Findings) {
    for (at, header) in table.headers.iter().enumerate() {
        if !header.is_empty() && !known.contains(&header.as_str()) {
            let near = did_you_mean(header, known.iter().copied());
            let help = near.unwrap_or_else(|| format!("known: {}", known.join(", ")));
            findings.mistake(MistakeCode::Table, table.place(1, at as u16), format!("unknown column `{header}`"), help);
        }
    }
}

impl Assembly<'_> {
    /// Numbers of up to three cells, along the axes of the plane; `None` where all are empty or after a mistake.
    fn along_cells(&mut self, row: &Row, columns: [Option<usize>; 3], what: &str) -> Option<Vector> {
        if columns.iter().all(|&at| filled(row, at).is_none()) {
            return None;
        }
        let axes = self.building.structure.plane.axes();
        self.nothing_along_others(row, columns, axes, what);
        let place = row.place(columns.into_iter().flatten().next()?);
        let zero = Scalar::Number(0.0, place);
        let parts = axes.iter().map(|&axis| columns[axis].and_then(|at| scalar(row, at)).unwrap_or(zero.clone())).collect();
        Some(Vector { parts, place })
    }

    /// Cells along axes there are not are empty or 0.
    fn nothing_along_others(&mut self, row: &Row, columns: [Option<usize>; 3], axes: &[usize], what: &str) {
        for at in (0..3).filter(|axis| !axes.contains(axis)).filter_map(|axis| filled(row, columns[axis])) {
            if row.number(at) != Some(0.0) {
                let value = row.number(at).map_or_else(|| row.field(at).to_owned(), brief);
                let space = self.building.structure.plane.name().map_or("space".into(), |name| format!("the plane \"{name}\""));
                let message = format!("{what}: {value} along an axis that is not in {space}");
                self.findings.mistake(MistakeCode::Coordinates, row.place(at), message, "leave the cell empty");
            }
        }
    }
}
