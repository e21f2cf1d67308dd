//! Checks by design codes: what they state, of what, under which assumptions.

use std::io::{self, Write};

use serde::ser::{Serialize, SerializeSeq, Serializer};

use super::text::{count, listing};
use crate::problem::checks::{Check, DISCLAIMER};

/// Ribs or sections of a row that are named.
const MOST_ITEMS: usize = 10;

/// One line per check.
///
/// # Errors
/// Whatever the writer says.
pub fn write_titles(checks: &[Check], out: &mut dyn Write) -> io::Result<()> {
    checks.iter().try_for_each(|check| writeln!(out, "check {}", check.title()))
}

/// Every check with its assumptions and the text of its rows.
///
/// # Errors
/// Whatever the writer says.
pub fn write_rows(checks: &[Check], out: &mut dyn Write) -> io::Result<()> {
    for check in checks {
        writeln!(out, "\ncheck {}", check.title())?;
        for assumption in &check.assumptions {
            writeln!(out, "  {assumption}")?;
        }
        for row in &check.rows {
            let of = listing(row.items.iter().cloned(), MOST_ITEMS);
            writeln!(out, "  {} ({}; {of}): {}", row.clause, count(row.count, "row"), row.short)?;
            for name in &row.names {
                writeln!(out, "      {name}")?;
            }
        }
    }
    Ok(())
}

/// Checks in `result.json`.
pub struct Said<'a>(pub &'a [Check]);

impl Serialize for Said<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut list = serializer.serialize_seq(Some(self.0.len()))?;
        for check in self.0 {
            list.serialize_element(&serde_json::json!({
                "name": check.name,
                "code": check.code,
                "note": DISCLAIMER,
                "assumptions": check.assumptions,
            }))?;
        }
        list.end()
    }
}
