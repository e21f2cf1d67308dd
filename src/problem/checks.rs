//! What checks by design codes state, for reports.

use std::collections::BTreeSet;

/// A check by a code.
#[derive(Debug, Clone, Default)]
pub struct Check {
    /// Its name.
    pub name: String,
    /// The code with its edition and the clauses checked.
    pub code: String,
    /// Everything that was assumed, as the file gives it.
    pub assumptions: Vec<String>,
    /// Its rows by what they state.
    pub rows: Vec<CheckRow>,
}

/// Rows that state the same of several ribs, cases and stations.
#[derive(Debug, Clone, PartialEq)]
pub struct CheckRow {
    /// The clause: `6.3.1 y`.
    pub clause: String,
    /// The requirement, in short names.
    pub short: String,
    /// What the short names stand for, at the first of them.
    pub names: Vec<String>,
    /// Names of ribs or sections.
    pub items: BTreeSet<String>,
    /// How many rows there are.
    pub count: usize,
}

/// Said wherever a check is reported.
pub const DISCLAIMER: &str = "design aid, not certification";

impl Check {
    /// `ec3: EN 1993-1-1:2005, 6.3.1 …: design aid, not certification`
    pub fn title(&self) -> String {
        format!("{}: {}: {DISCLAIMER}", self.name, self.code)
    }

    /// Takes note of rows of some items.
    pub fn note(&mut self, row: CheckRow) {
        let same = |known: &&mut CheckRow| known.clause == row.clause && known.short == row.short;
        match self.rows.iter_mut().find(same) {
            Some(known) => {
                known.count += row.count;
                known.items.extend(row.items);
            }
            None => self.rows.push(row),
        }
    }
}
