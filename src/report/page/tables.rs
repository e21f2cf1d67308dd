//! Tables of the page: sizes by section, ribs, variables.

use maud::{Markup, html};
use serde_json::Value;

use super::{Left, number};
use crate::report::number::significant;

/// Rows that are shown: browsers sort as many without a delay; all stand in the CSV files.
pub(super) const MOST_ROWS: usize = 2000;

/// A CSV table.
pub(super) struct Csv {
    header: Vec<String>,
    pub rows: Vec<Vec<String>>,
}

impl Csv {
    /// Reads a table that ribopt wrote.
    pub fn of(text: &str) -> Csv {
        let mut reader = csv::Reader::from_reader(text.as_bytes());
        let header = reader.headers().map(|header| header.iter().map(str::to_owned).collect()).unwrap_or_default();
        let rows = reader.records().filter_map(Result::ok).map(|row| row.iter().map(str::to_owned).collect()).collect();
        Csv { header, rows }
    }

    /// The columns' names.
    pub fn header(&self) -> Vec<&str> {
        self.header.iter().map(String::as_str).collect()
    }

    /// The place of a column.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.header.iter().position(|header| header == name)
    }

    /// Some columns of every row.
    pub fn select(&self, columns: &[&str]) -> Vec<Vec<String>> {
        self.rows.iter().map(|row| columns.iter().map(|column| self.cell(row, column).to_owned()).collect()).collect()
    }

    /// A cell of a row.
    pub fn cell<'r>(&self, row: &'r [String], name: &str) -> &'r str {
        self.column(name).and_then(|at| row.get(at)).map_or("", String::as_str)
    }
}

/// A number of a table with as many digits as one reads; any other text as it is.
pub(super) fn shown(text: &str) -> String {
    text.parse::<f64>().map_or_else(|_| text.to_owned(), |value| significant(value, 6))
}

/// A cell with what it is sorted by.
pub(super) fn cell(text: &str) -> Markup {
    match text.parse::<f64>() {
        Ok(value) => html! { td class="number" data-value=(value) { (shown(text)) } },
        Err(_) => html! { td { (text) } },
    }
}

/// A table that can be sorted, cut where it is too long for a page.
pub(super) fn table(header: &[&str], rows: &[Vec<String>], file: &str) -> Markup {
    html! {
        div class="wide" { table class="sortable" {
            thead { tr { @for title in header { th { (title) } } } }
            tbody { @for row in rows.iter().take(MOST_ROWS) { tr data-rib=[rib(header, row)] { @for text in row { (cell(text)) } } } }
        } }
        (left_out(rows.len(), file))
    }
}

/// The rib a row is about.
fn rib<'r>(header: &[&str], row: &'r [String]) -> Option<&'r str> {
    row.first().filter(|_| header.first() == Some(&"rib")).map(String::as_str)
}

/// What a page says of rows that it does not show.
pub(super) fn left_out(rows: usize, file: &str) -> Markup {
    html! { @if rows > MOST_ROWS { p { (rows - MOST_ROWS) " more rows in " code { (file) } "." } } }
}

/// A section, its kind, and its numbers by name.
type Section<'t> = (&'t str, &'t str, Vec<(&'t str, &'t str)>);

/// Dimensions and properties, a row per section; a column per section where there are fewer sections than numbers.
pub(super) fn sizes(left: &Left) -> Markup {
    let Some(sizes) = left.table("sizes.csv") else { return html! {} };
    let mut names: Vec<&str> = Vec::new();
    let mut sections: Vec<Section> = Vec::new();
    for row in &sizes.rows {
        let [section, kind, name, value] = ["section", "kind", "name", "value"].map(|column| sizes.cell(row, column));
        if !names.contains(&name) {
            names.push(name);
        }
        match sections.last_mut().filter(|last| last.0 == section) {
            Some(last) => last.2.push((name, value)),
            None => sections.push((section, kind, vec![(name, value)])),
        }
    }
    let header: Vec<&str> = ["section", "kind"].into_iter().chain(names.iter().copied()).collect();
    let rows: Vec<Vec<String>> = sections
        .iter()
        .map(|(section, kind, values)| {
            let value = |name: &&str| values.iter().find(|(known, _)| known == name).map_or("", |(_, value)| value).to_owned();
            [(*section).to_owned(), (*kind).to_owned()].into_iter().chain(names.iter().map(value)).collect()
        })
        .collect();
    if rows.len() < header.len() {
        let turned: Vec<Vec<String>> = (1..header.len())
            .map(|column| std::iter::once(header[column].to_owned()).chain(rows.iter().map(|row| row[column].clone())).collect())
            .collect();
        let header: Vec<&str> = std::iter::once("").chain(sections.iter().map(|(section, ..)| *section)).collect();
        return html! { @if !rows.is_empty() { h2 { "Sections" } (table(&header, &turned, "sizes.csv")) } };
    }
    html! { h2 { "Sections" } (table(&header, &rows, "sizes.csv")) }
}

/// The schedule of ribs.
pub(super) fn ribs(left: &Left) -> Markup {
    let Some(volumes) = left.table("volumes.csv").filter(|table| !table.rows.is_empty()) else { return html! {} };
    let columns = ["rib", "from", "to", "length", "volume", "mass"];
    html! { h2 { "Ribs" } (table(&columns, &volumes.select(&columns), "volumes.csv")) }
}

/// All variables with their bounds.
pub(super) fn variables(left: &Left) -> Markup {
    let rows: Vec<Vec<String>> = match left.table("variables.csv") {
        Some(table) => {
            let mut rows = table.select(&["name", "value", "lower", "upper", "active"]);
            in_units(left, &mut rows);
            rows
        }
        None => {
            let values = left.result.get("variables").and_then(Value::as_object);
            values.into_iter().flatten().map(|(name, value)| vec![name.clone(), number(Some(value))]).collect()
        }
    };
    html! {
        @if !rows.is_empty() {
            h2 { "Variables" }
            (table(&["variable", "value", "lower", "upper", "rests on", "unit"], &rows, "variables.csv"))
        }
    }
}

/// Values and bounds of variables in the units they are told in, which stand behind.
fn in_units(left: &Left, rows: &mut [Vec<String>]) {
    for (row, bound) in rows.iter_mut().zip(left.list("bounds")) {
        let same = bound.get("name").and_then(Value::as_str) == row.first().map(String::as_str);
        let (factor, unit) = left.told(bound.get("unit").and_then(Value::as_str).filter(|_| same));
        for cell in row.iter_mut().skip(1).take(3) {
            if let Ok(value) = cell.parse::<f64>() {
                *cell = (factor * value).to_string();
            }
        }
        row.push(unit);
    }
}
