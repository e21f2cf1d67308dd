//! All rows of a study, in the order of its points.

use std::io::{self, Write};

use super::layout::Layout;
use super::store::Store;
use super::{Row, Study};
use crate::report::number::push_exact;

/// Columns every table has, before and after those of the study.
pub(super) const COLUMNS: [&str; 15] = [
    "point",
    "status",
    "scope",
    "exit",
    "objective",
    "lower_bound",
    "volume",
    "governs",
    "start",
    "iterations",
    "seconds",
    "message",
    "limit",
    "first",
    "second",
];

/// What governs, in one cell.
const SEPARATOR: &str = "; ";

/// A study's rows.
#[derive(Debug, Clone, Default)]
pub struct Table {
    /// By their points.
    pub rows: Vec<Row>,
    /// Points of chains that are not finished.
    pub missing: usize,
}

impl Table {
    /// What the folder holds by now.
    pub fn of(study: &Study, store: &Store) -> Table {
        let mut table = Table::default();
        loop {
            let chains = study.next(&table.rows);
            let (before, mut missing) = (table.rows.len(), 0);
            for (number, points) in &chains {
                match store.rows_of(*number, points) {
                    Some(rows) => table.rows.extend(rows),
                    None => missing += points.len(),
                }
            }
            table.rows.sort_by_key(|row| row.point);
            table.missing = missing;
            let is_front = matches!(study.layout, Layout::Front(_));
            if missing > 0 || !is_front || table.rows.len() == before {
                return table;
            }
        }
    }

    /// Rows by their status, in the order of their first point.
    pub fn counts(&self) -> Vec<(&str, usize)> {
        let mut counts: Vec<(&str, usize)> = Vec::new();
        for row in &self.rows {
            match counts.iter_mut().find(|(status, _)| *status == row.status) {
                Some((_, count)) => *count += 1,
                None => counts.push((&row.status, 1)),
            }
        }
        counts
    }

    /// Writes `point`, the varied names, `status,scope,exit,objective,lower_bound,volume`, the quantities and the first variables, `governs`,
    /// `sensitivity:NAME` of every varied name, `start,iterations,seconds,message`.
    ///
    /// # Errors
    /// Whatever the writer says.
    pub fn write(&self, study: &Study, out: &mut dyn Write) -> io::Result<()> {
        let names = study.names();
        // A variable that is varied is fixed there: it has its column already.
        let shown: Vec<usize> = (0..study.variables.len()).filter(|&j| !names.contains(&study.variables[j].as_str())).collect();
        let mut writer = csv::Writer::from_writer(out);
        let mut header: Vec<String> = vec!["point".into()];
        header.extend(names.iter().map(|name| (*name).to_owned()));
        header.extend(["status", "scope", "exit", "objective", "lower_bound", "volume"].map(String::from));
        header.extend(study.quantities.iter().map(|quantity| quantity.column.clone()));
        header.extend(shown.iter().map(|&j| study.variables[j].clone()));
        header.push("governs".into());
        header.extend(names.iter().map(|name| format!("sensitivity:{name}")));
        header.extend(["start", "iterations", "seconds", "message"].map(String::from));
        writer.write_record(&header)?;
        for row in &self.rows {
            writer.write_record(record(row, names.len(), study.quantities.len(), &shown))?;
        }
        writer.flush()
    }
}

fn record(row: &Row, names: usize, quantities: usize, shown: &[usize]) -> Vec<String> {
    let mut cells = vec![row.point.to_string()];
    let list = |values: &[Option<f64>], count: usize| -> Vec<String> {
        (0..count).map(|at| number(values.get(at).copied().flatten())).collect()
    };
    cells.extend(list(&row.varied, names));
    cells.extend([
        row.status.clone(),
        row.scope.clone().unwrap_or_default(),
        row.exit.map_or(String::new(), |code| code.to_string()),
    ]);
    cells.extend([row.objective, row.lower_bound, row.volume].map(number));
    cells.extend(list(&row.quantities, quantities));
    cells.extend(shown.iter().map(|&j| number(row.variables.get(j).copied().flatten())));
    cells.push(row.governs.join(SEPARATOR));
    cells.extend(list(&row.sensitivities, names));
    cells.extend([row.start.clone(), row.iterations.map_or(String::new(), |count| count.to_string())]);
    cells.extend([format!("{:.3}", row.seconds), row.message.clone()]);
    cells
}

/// The shortest text that reads back as this number; empty where there is none.
fn number(value: Option<f64>) -> String {
    let mut text = String::new();
    if let Some(value) = value {
        push_exact(&mut text, value);
    }
    text
}
