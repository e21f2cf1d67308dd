//! Plain text tables with aligned columns.

use std::fmt;

pub use crate::problem::words::{cell, count, plain, shortened, shown};

/// A table for people: a header, rows, columns as wide as they need.
#[derive(Debug, Clone, Default)]
pub struct TextTable {
    header: Vec<String>,
    rows: Vec<Vec<String>>,
    left: usize,
    /// Whether the last column is of words.
    noted: bool,
}

impl TextTable {
    /// A table whose first `left` columns are aligned to the left (names), the others to the right (numbers).
    pub fn new(left: usize, header: &[&str]) -> TextTable {
        TextTable { header: header.iter().map(|&title| shown(title)).collect(), rows: Vec::new(), left, noted: false }
    }

    /// Adds a row; names in it are shown as a line can take them.
    pub fn add(&mut self, row: Vec<String>) {
        self.rows.push(row.iter().map(|cell| shown(cell)).collect());
    }

    /// Adds a last column of words, one per row, unless all are empty.
    pub fn note(&mut self, title: &str, words: Vec<String>) {
        if words.iter().all(String::is_empty) {
            return;
        }
        self.noted = true;
        self.header.push(shown(title));
        self.rows.iter_mut().zip(words).for_each(|(row, word)| row.push(shown(&word)));
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
                let is_word = column < self.left || self.noted && column + 1 == self.header.len();
                let padded = if is_word { format!("  {cell:<width$}") } else { format!("  {cell:>width$}") };
                line.push_str(&padded);
            }
            writeln!(formatter, "{}", line.trim_end())?;
        }
        Ok(())
    }
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
