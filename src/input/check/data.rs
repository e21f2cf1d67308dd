//! Data columns while rows come in: numbers as long as all are numbers, labels from the first text on.

use std::collections::HashMap;

use crate::input::declaration::Datum;
use crate::input::findings::Findings;
use crate::input::table::Row;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::{Cells, Column};

/// No label in this cell.
const NONE: u32 = u32::MAX;

/// The columns of sections or of ribs.
#[derive(Default)]
pub(super) struct DataColumns {
    columns: Vec<Growing>,
    numbers: HashMap<String, usize>,
}

struct Growing {
    column: Column,
    known: HashMap<Box<str>, u32>,
}

impl DataColumns {
    /// The number of the column of this name, made where there is none.
    pub fn column(&mut self, name: &str) -> usize {
        if let Some(&at) = self.numbers.get(name) {
            return at;
        }
        let column = Column { name: name.to_owned(), cells: Cells::Numbers(Vec::new()) };
        self.columns.push(Growing { column, known: HashMap::new() });
        self.numbers.insert(name.to_owned(), self.columns.len() - 1);
        self.columns.len() - 1
    }

    /// A datum of `row`; an array takes as many columns, `M[1]`, `M[2]`, ….
    pub fn put(&mut self, name: &str, row: usize, datum: &Datum) {
        match datum {
            Datum::Number(value) => {
                let column = self.column(name);
                self.number(column, row, *value);
            }
            Datum::Text(text) => {
                let column = self.column(name);
                self.text(column, row, text);
            }
            Datum::Numbers(list) => {
                for (at, value) in list.iter().enumerate() {
                    let column = self.column(&format!("{name}[{}]", at + 1));
                    self.number(column, row, *value);
                }
            }
        }
    }

    /// A number in the cell of `row`. Rows come in order.
    pub fn number(&mut self, column: usize, row: usize, value: f64) {
        match &mut self.columns[column].column.cells {
            Cells::Numbers(numbers) => {
                numbers.resize(row, f64::NAN);
                numbers.push(value);
            }
            Cells::Labels { .. } => self.columns[column].label(row, &value.to_string()),
        }
    }

    /// A text in the cell of `row`; earlier numbers of the column become texts.
    pub fn text(&mut self, column: usize, row: usize, text: &str) {
        let growing = &mut self.columns[column];
        if let Cells::Numbers(numbers) = &mut growing.column.cells {
            let numbers = std::mem::take(numbers);
            growing.column.cells = Cells::Labels { labels: Vec::new(), of: Vec::new() };
            for (row, value) in numbers.into_iter().enumerate().filter(|(_, value)| !value.is_nan()) {
                growing.label(row, &value.to_string());
            }
        }
        growing.label(row, text);
    }

    /// The columns, each with one cell per row.
    pub fn finish(self, rows: usize) -> Vec<Column> {
        let fill = |mut column: Column| {
            match &mut column.cells {
                Cells::Numbers(numbers) => numbers.resize(rows, f64::NAN),
                Cells::Labels { of, .. } => of.resize(rows, NONE),
            }
            column
        };
        self.columns.into_iter().map(|growing| fill(growing.column)).collect()
    }
}

impl Growing {
    fn label(&mut self, row: usize, text: &str) {
        let Cells::Labels { labels, of } = &mut self.column.cells else { return };
        let number = *self.known.entry(text.into()).or_insert_with(|| {
            labels.push(text.into());
            (labels.len() - 1) as u32
        });
        of.resize(row, NONE);
        of.push(number);
    }
}

/// The mistake of a number that is too large for one, or infinite where no bound stands.
pub(super) fn infinite(row: &Row<'_>, at: usize, findings: &mut Findings) {
    let help = "numbers reach to about 1.8e308; only bounds may be inf, or left empty";
    findings.mistake(MistakeCode::NoNumber, row.place(at), format!("`{}` is not finite", row.field(at)), help);
}

/// Puts a cell into a data column: a number, a text, or nothing.
pub(super) fn put(data: &mut DataColumns, findings: &mut Findings, row: &Row<'_>, at: usize, column: usize, item: usize) {
    let text = row.field(at);
    match row.number(at) {
        Some(value) if value.is_infinite() => infinite(row, at, findings),
        Some(value) => data.number(column, item, value),
        None if text.parse::<f64>().is_ok() => {
            findings.mistake(MistakeCode::NoNumber, row.place(at), "this is no number", "leave the cell empty")
        }
        None if text.is_empty() => {}
        None => data.text(column, item, text),
    }
}
