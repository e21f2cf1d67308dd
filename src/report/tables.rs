//! `variables.csv` and `constraints.csv`. Open bounds and unknown numbers are empty cells.

use std::io::{self, Write};
use std::ops::Range;

use super::number::{push_exact, push_exact_or_open};
use super::{Findings, Held, blocks};

/// Writes `name,lower,start,upper,<backend>…,active,multiplier,sensitivity,value`, one row per variable; `value` is the
/// reported point, so that the table is an answer to start from.
///
/// # Errors
/// Whatever the writer says.
pub fn variables(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let answers = &findings.outcome.answers;
    let backends = answers.iter().map(|answer| answer.backend);
    let columns =
        ["name", "lower", "start", "upper"].into_iter().chain(backends).chain(["active", "multiplier", "sensitivity", "value"]);
    header(out, columns)?;
    let meta = findings.model.meta();
    let row = |j: usize, rows: &mut Rows| {
        rows.text(&findings.model.variable_name(j))?;
        for value in [meta.lower[j], meta.start[j], meta.upper[j]] {
            rows.number_or_open(value)?;
        }
        for answer in answers {
            rows.number(answer.solution.x.get(j).copied().unwrap_or(f64::NAN))?;
        }
        rows.held(findings.bound(j))?;
        rows.number(findings.outcome.x.get(j).copied().unwrap_or(f64::NAN))?;
        rows.end()
    };
    blocks::write(out, meta.variables(), |range| Rows::of(range, row))
}

/// Writes `name,value,lower,upper,active,multiplier,sensitivity`, one row per constraint row.
///
/// # Errors
/// Whatever the writer says.
pub fn constraints(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    header(out, ["name", "value", "lower", "upper", "active", "multiplier", "sensitivity"].into_iter())?;
    let meta = findings.model.meta();
    let row = |i: usize, rows: &mut Rows| {
        rows.text(&findings.model.row_name(i))?;
        rows.number(findings.row_value(i))?;
        rows.number_or_open(meta.row_lower[i])?;
        rows.number_or_open(meta.row_upper[i])?;
        rows.held(findings.row(i))?;
        rows.end()
    };
    blocks::write(out, meta.rows(), |range| Rows::of(range, row))
}

fn header<'a>(out: &mut dyn Write, columns: impl Iterator<Item = &'a str>) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(columns)?;
    table.flush()
}

/// Some rows as text.
struct Rows {
    table: csv::Writer<Vec<u8>>,
    cell: String,
}

impl Rows {
    fn of(range: Range<usize>, row: impl Fn(usize, &mut Rows) -> csv::Result<()>) -> io::Result<Vec<u8>> {
        let mut rows = Rows { table: csv::Writer::from_writer(Vec::new()), cell: String::new() };
        for at in range {
            row(at, &mut rows)?;
        }
        rows.table.into_inner().map_err(|error| io::Error::other(error.to_string()))
    }

    fn text(&mut self, text: &str) -> csv::Result<()> {
        self.table.write_field(&*super::text::cell(text))
    }

    fn number(&mut self, value: f64) -> csv::Result<()> {
        self.cell.clear();
        push_exact(&mut self.cell, value);
        self.table.write_field(&self.cell)
    }

    fn number_or_open(&mut self, value: f64) -> csv::Result<()> {
        self.cell.clear();
        push_exact_or_open(&mut self.cell, value);
        self.table.write_field(&self.cell)
    }

    fn held(&mut self, held: Held) -> csv::Result<()> {
        self.text(held.side.as_str())?;
        self.number(held.multiplier)?;
        self.number(held.sensitivity)
    }

    fn end(&mut self) -> csv::Result<()> {
        self.table.write_record(None::<&[u8]>)
    }
}
