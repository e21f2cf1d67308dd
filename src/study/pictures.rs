//! Pictures of a study, by what it varies.

use super::{Study, Table};

/// Names and SVG texts.
pub fn pictures(_study: &Study, _table: &Table) -> Vec<(String, String)> {
    Vec::new()
}
