//! Why there is no feasible point, and what would make one.

use std::io::{self, Write};

use super::{MOST_LINES, share_text};
use crate::crosscheck::Conflict;
use crate::report::Findings;
use crate::report::number::{short, significant};
use crate::report::text::{TextTable, listing};

/// What is violated, what conflicts, and each move that is enough.
///
/// # Errors
/// Whatever the writer says.
pub(super) fn write(findings: &Findings<'_>, out: &mut dyn Write) -> io::Result<()> {
    let Some(Conflict { violated_rows, rows, bounds, alternatives, minimal }) = &findings.outcome.conflict else {
        return Ok(());
    };
    let model = findings.model;
    let amounts = |list: &[(usize, f64)]| {
        let list: Vec<String> = list.iter().map(|&(i, by)| format!("{} by {}", model.row_name(i), short(by))).collect();
        listing(list.into_iter(), MOST_LINES)
    };
    if !violated_rows.is_empty() {
        writeln!(out, "\nViolated at the point of least violation: {}", amounts(violated_rows))?;
    }
    if !rows.is_empty() {
        let set = if *minimal { "These conflict, and no part of them does" } else { "These conflict" };
        let place = |i: usize| model.row_place(i).map_or(String::new(), |place| format!(" ({place})"));
        let row_names = rows.iter().map(|&i| model.row_name(i) + &place(i));
        let ends = bounds.iter().map(|&(j, upper)| {
            let side = if upper { "upper" } else { "lower" };
            format!("{side} bound of {}", model.variable_name(j))
        });
        let names: Vec<String> = row_names.chain(ends).collect();
        writeln!(out, "{set}: {}", listing(names.into_iter(), MOST_LINES))?;
    }
    if !alternatives.is_empty() {
        writeln!(out, "\nAny one of these moves makes it feasible")?;
        let mut table = TextTable::new(1, &["limit", "from", "to", "relative", ""]);
        for found in alternatives.iter().take(MOST_LINES) {
            let least = if found.least { "the least" } else { "enough" };
            let (from, to) = (significant(found.from, 6), significant(found.to, 6));
            table.add(vec![found.limit.label(model), from, to, share_text(found.relative()), least.into()]);
        }
        write!(out, "{table}")?;
    }
    Ok(())
}
