//! A text file beside the problem file, with mistakes that point into it.

use std::ops::Range;
use std::path::Path;

use super::load;
use super::mistake::{Mistake, Mistakes};
use super::source::Source;

/// A file that was read whole.
pub struct Document(Source);

impl Document {
    /// Reads a file; a byte order mark is taken off.
    ///
    /// # Errors
    /// Where it is missing, no text, empty or far too large.
    pub fn read(path: &Path) -> Result<Document, Mistakes> {
        load::load(path).map(|(source, _)| Document(source))
    }

    /// What it says.
    pub fn text(&self) -> &str {
        &self.0.text
    }

    /// A mistake at a range of bytes.
    pub fn mistake(&self, range: Range<usize>, message: impl Into<String>, help: Option<&str>) -> Mistake {
        self.0.mistake(None, range, message.into(), help.map(str::to_owned))
    }
}
