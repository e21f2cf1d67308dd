//! Mistakes of the study file, collected.

use std::ops::Range;

use crate::input::{self, Document};

/// The mistakes so far.
pub(super) struct Mistakes<'a> {
    document: &'a Document,
    list: Vec<input::Mistake>,
}

impl<'a> Mistakes<'a> {
    /// None yet.
    pub fn of(document: &'a Document) -> Self {
        Mistakes { document, list: Vec::new() }
    }

    /// Something wrong at a range of bytes.
    pub fn tell(&mut self, span: Range<usize>, message: impl Into<String>, help: Option<&str>) {
        self.list.push(self.document.mistake(span, message, help));
    }

    /// Fails where anything is wrong, in the order of the file.
    pub fn end(mut self) -> Result<(), input::Mistakes> {
        self.list.sort_by_key(|mistake| (mistake.line, mistake.column));
        if self.list.is_empty() { Ok(()) } else { Err(input::Mistakes { list: self.list, more: 0 }) }
    }
}
