//! A table of points: a CSV file whose columns are the varied names.

use std::path::Path;

use crate::files;

/// The table as it stands.
pub(super) struct List {
    pub names: Vec<String>,
    pub cells: Vec<Vec<Cell>>,
    /// Expressions that have to be computed.
    pub texts: Vec<String>,
}

/// A cell of the table.
pub(super) enum Cell {
    /// The file's own number.
    Empty,
    Number(f64),
    /// One of the texts.
    Text(usize),
}

impl Cell {
    /// Its number, those of the texts given.
    pub fn number(&self, computed: &[f64]) -> Option<f64> {
        match self {
            Cell::Empty => None,
            Cell::Number(value) => Some(*value),
            Cell::Text(at) => computed.get(*at).copied(),
        }
    }
}

/// Reads the table. Cells are numbers or constant expressions; an empty one leaves the problem's own number.
pub(super) fn read(path: &Path) -> Result<List, String> {
    let file = files::open(path).map_err(|error| format!("cannot read {}: {error}", path.display()))?;
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).comment(Some(b'#')).from_reader(file);
    let wrong = |error: csv::Error| format!("{}: {error}", path.display());
    let names: Vec<String> =
        reader.headers().map_err(wrong)?.iter().map(|name| name.trim_start_matches('\u{feff}').to_owned()).collect();
    if names.iter().any(String::is_empty) {
        return Err(format!("{}: a column has no name; the first line names what is varied", path.display()));
    }
    if let Some(twice) = names.iter().enumerate().find(|(at, name)| names[..*at].contains(name)) {
        return Err(format!("{}: there are two columns `{}`", path.display(), twice.1));
    }
    let (mut cells, mut texts) = (Vec::new(), Vec::new());
    for record in reader.records() {
        let record = record.map_err(wrong)?;
        if cells.len() >= super::MOST_POINTS as usize {
            return Err(format!("{}: a study has at most {} points", path.display(), super::MOST_POINTS));
        }
        cells.push(record.iter().map(|text| cell(text, &mut texts)).collect());
    }
    if cells.is_empty() {
        return Err(format!("{}: there are no points below the first line", path.display()));
    }
    Ok(List { names, cells, texts })
}

fn cell(text: &str, texts: &mut Vec<String>) -> Cell {
    if text.is_empty() {
        return Cell::Empty;
    }
    match text.parse::<f64>() {
        Ok(value) if value.is_finite() => Cell::Number(value),
        _ => {
            texts.push(text.to_owned());
            Cell::Text(texts.len() - 1)
        }
    }
}
