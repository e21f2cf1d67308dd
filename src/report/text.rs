//! Plain text tables with aligned columns.

use std::borrow::Cow;
use std::fmt;

pub use crate::problem::words::count;

/// A table for people: a header, rows, columns as wide as they need.
#[derive(Debug, Clone, Default)]
pub struct TextTable {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    left: usize,
}

impl TextTable {
    /// A table whose first `left` columns are aligned to the left (names), the others to the right (numbers).
    pub fn new(left: usize, header: &[&str]) -> TextTable {
        TextTable { header: header.iter().map(|&title| shown(title)).collect(), rows: Vec::new(), left }
    }

    /// Adds a row; names in it are shown as a line can take them.
    pub fn add(&mut self, row: Vec<String>) {
        self.rows.push(row.iter().map(|cell| shown(cell)).collect());
    }

    /// True without rows.
    pub fn is_empty(&self) -> bool {
        self.rows.is_empty()
    }

    fn widths(&self) -> Vec<usize> {
        let mut widths = vec![0; self.header.len()];
        for row in std::iter::once(&self.header).chain(&self.rows) {
            for (width, cell) in widths.iter_mut().zip(row) {
                *width = (*width).max(cell.chars().count());
            }
        }
        widths
    }
}

impl fmt::Display for TextTable {
    fn fmt(&self, formatter: &mut fmt::Formatter<'_>) -> fmt::Result {
        let widths = self.widths();
        for row in std::iter::once(&self.header).chain(&self.rows) {
            let mut line = String::new();
            for (column, (cell, &width)) in row.iter().zip(&widths).enumerate() {
                let padded = if column < self.left { format!("  {cell:<width$}") } else { format!("  {cell:>width$}") };
                line.push_str(&padded);
            }
            writeln!(formatter, "{}", line.trim_end())?;
        }
        Ok(())
    }
}

/// Characters of a name or a text shown in a line of a table.
const LONGEST: usize = 60;

/// A text of the user's as it may stand in a line: no control characters, no marks that turn the direction of writing, and not
/// longer than a line can take.
///
/// ```
/// use ribopt::report::text::shown;
/// assert_eq!(shown("\u{1b}[31mred\nline"), "\u{fffd}[31mred\u{fffd}line");
/// assert_eq!(shown(&"y".repeat(70_000)).chars().count(), 60);
/// ```
pub fn shown(text: &str) -> String {
    let long = text.chars().nth(LONGEST).is_some();
    let kept = if long { LONGEST - 1 } else { LONGEST };
    let mut shown: String = plain(text).chars().take(kept).collect();
    if long {
        shown.push('…');
    }
    shown
}

/// A text whose characters all show, none acts on a terminal; line breaks too become signs.
pub fn plain(text: &str) -> Cow<'_, str> {
    if text.chars().any(acts) { text.chars().map(|c| if acts(c) { '\u{fffd}' } else { c }).collect() } else { text.into() }
}

/// Control characters, and those that change the direction of what follows.
fn acts(c: char) -> bool {
    c.is_control() || matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}')
}

/// A name as a cell of a table that a spreadsheet may open: what would begin a formula there is quoted by an apostrophe.
///
/// ```
/// use ribopt::report::text::cell;
/// assert_eq!(cell("=cmd|'/c calc'!A1"), "'=cmd|'/c calc'!A1");
/// assert_eq!(cell("support.b"), "support.b");
/// ```
pub fn cell(name: &str) -> Cow<'_, str> {
    if name.starts_with(['=', '+', '-', '@', '\t', '\r']) { format!("'{name}").into() } else { name.into() }
}

/// The first few names, and how many more there are.
pub fn listing(names: impl ExactSizeIterator<Item = String>, most: usize) -> String {
    let all = names.len();
    let first: Vec<String> = names.take(most).map(|name| shown(&name)).collect();
    let more = if all > first.len() { format!(", … ({} more)", all - first.len()) } else { String::new() };
    format!("{}{more}", first.join(", "))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_stand_left_and_numbers_right() {
        let mut table = TextTable::new(1, &["name", "value"]);
        table.add(vec!["Iₓ".into(), "12".into()]);
        table.add(vec!["depth".into(), "-3.25".into()]);
        assert_eq!(table.to_string(), "  name   value\n  Iₓ        12\n  depth  -3.25\n");
    }

    #[test]
    fn long_lists_are_cut() {
        let names = || ["a", "b", "c"].map(String::from).into_iter();
        assert_eq!(listing(names(), 3), "a, b, c");
        assert_eq!(listing(names(), 2), "a, b, … (1 more)");
        assert_eq!((count(1, "row"), count(2, "row")), ("1 row".into(), "2 rows".into()));
    }
}
