//! `variables.csv` and `constraints.csv`. Open bounds and unknown numbers are empty cells.

use std::io::{self, Write};

use super::number::{exact, exact_or_open};
use super::{Findings, Held};

/// Writes `name,lower,start,upper,<backend>…,active,multiplier,sensitivity`, one row per variable.
///
/// # Errors
/// Whatever the writer says.
pub fn variables(findings: &Findings<'_>, out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let answers = &findings.outcome.answers;
    let backends = answers.iter().map(|answer| answer.backend);
    let columns = ["name", "lower", "start", "upper"].into_iter().chain(backends).chain(["active", "multiplier", "sensitivity"]);
    table.write_record(columns)?;
    let meta = findings.model.meta();
    for j in 0..meta.variables() {
        table.write_field(findings.model.variable_name(j))?;
        for value in [meta.lower[j], meta.start[j], meta.upper[j]] {
            table.write_field(exact_or_open(value))?;
        }
        for answer in answers {
            table.write_field(exact(answer.solution.x.get(j).copied().unwrap_or(f64::NAN)))?;
        }
        write_held(&mut table, findings.bound(j))?;
    }
    table.flush()
}

/// Writes `name,value,lower,upper,active,multiplier,sensitivity`, one row per constraint row.
///
/// # Errors
/// Whatever the writer says.
pub fn constraints(findings: &Findings<'_>, out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    table.write_record(["name", "value", "lower", "upper", "active", "multiplier", "sensitivity"])?;
    let meta = findings.model.meta();
    for i in 0..meta.rows() {
        table.write_field(findings.model.row_name(i))?;
        table.write_field(exact(findings.row_value(i)))?;
        table.write_field(exact_or_open(meta.row_lower[i]))?;
        table.write_field(exact_or_open(meta.row_upper[i]))?;
        write_held(&mut table, findings.row(i))?;
    }
    table.flush()
}

fn write_held(table: &mut csv::Writer<impl Write>, held: Held) -> io::Result<()> {
    Ok(table.write_record([held.side.as_str(), &exact(held.multiplier), &exact(held.sensitivity)])?)
}
