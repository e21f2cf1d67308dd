//! The text of a file, and where in it something stands.

use std::ops::Range;
use std::sync::OnceLock;

use super::mistake::Mistake;
use crate::problem::mistake_code::MistakeCode;

/// Where something was written. Small, for a million ribs keep theirs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Place {
    /// Bytes of the problem file.
    File { start: u32, end: u32 },
    /// A row of a CSV table: the table's number, the line, and which field ([`Place::WHOLE_ROW`] for the whole row).
    Row { table: u8, line: u32, field: u16 },
    /// Bytes of a `--set` argument.
    Argument { number: u16, start: u32, end: u32 },
    /// The problem file as a whole.
    Whole,
}

impl Place {
    /// The field of a row's mistake that concerns no single field.
    pub const WHOLE_ROW: u16 = u16::MAX;

    /// A range of bytes in the problem file.
    pub fn file(range: Range<usize>) -> Place {
        Place::File { start: range.start as u32, end: range.end as u32 }
    }
}

/// A text that is no part of the file, and what mistakes call it.
pub(super) struct Argument<'a> {
    pub origin: &'static str,
    pub text: &'a str,
}

/// A text with its name.
pub(super) struct Source {
    pub name: String,
    pub text: String,
    /// Where its lines end, once asked for.
    ends: OnceLock<Vec<usize>>,
}

impl Source {
    /// A text under a name.
    pub fn new(name: impl Into<String>, text: String) -> Source {
        Source { name: name.into(), text, ends: OnceLock::new() }
    }

    /// A mistake at a range of bytes; the range is cut at the end of its first line.
    pub fn mistake(&self, code: Option<MistakeCode>, range: Range<usize>, message: String, help: Option<String>) -> Mistake {
        let start = self.boundary(range.start);
        let line_start = self.text[..start].rfind('\n').map_or(0, |at| at + 1);
        let line_end = self.text[start..].find('\n').map_or(self.text.len(), |at| start + at);
        let text = self.text[line_start..line_end].trim_end_matches('\r');
        let end = self.boundary(range.end).clamp(start, line_start + text.len().max(start - line_start));
        let column = self.text[line_start..start].chars().count();
        let width = self.text[start..end].chars().count();
        Mistake {
            code,
            file: self.name.clone(),
            line: self.line(start),
            column: column + 1,
            text: text.to_owned(),
            caret: column..column + width,
            message,
            help,
        }
    }

    /// The line a byte stands on, counted from 1.
    pub fn line(&self, byte: usize) -> usize {
        let ends =
            self.ends.get_or_init(|| self.text.bytes().enumerate().filter(|(_, b)| *b == b'\n').map(|(at, _)| at).collect());
        ends.partition_point(|&end| end < byte) + 1
    }

    /// The nearest character boundary at or before a byte.
    fn boundary(&self, byte: usize) -> usize {
        let mut at = byte.min(self.text.len());
        while !self.text.is_char_boundary(at) {
            at -= 1;
        }
        at
    }
}

/// A text value as the file has it: what it says and where.
#[derive(Debug, Clone)]
pub(super) struct Written {
    pub text: String,
    pub place: Place,
    /// Where the text's first byte stands in the file; `None` where escapes keep the two from running in step.
    pub inside: Option<u32>,
}

impl Written {
    /// A TOML string at `range` of the file.
    pub fn of(source: &str, range: Range<usize>, text: &str) -> Written {
        let raw = source.get(range.clone()).unwrap_or("");
        let skipped = ["\"\"\"\r\n", "\"\"\"\n", "'''\r\n", "'''\n", "\"\"\"", "'''", "\"", "'"]
            .into_iter()
            .find(|opening| raw.starts_with(opening))
            .map_or(0, str::len);
        let inside = raw[skipped..].starts_with(text).then_some((range.start + skipped) as u32);
        Written { text: text.to_owned(), place: Place::file(range), inside }
    }

    /// Where a part of the text stands.
    pub fn part(&self, start: usize, end: usize) -> Place {
        match self.inside {
            Some(base) => Place::File { start: base + start as u32, end: base + end.max(start + 1) as u32 },
            None => self.place,
        }
    }
}
