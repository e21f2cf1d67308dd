//! Lines and words of text formats, with their line numbers.

use std::io::BufRead;

use super::FormatError;

/// Hands out the lines of a text file one by one into one buffer; `#` starts a comment.
pub(super) struct Lines<R> {
    source: R,
    buffer: Vec<u8>,
    text: String,
    /// The number of the line handed out last, from 1.
    pub number: usize,
    /// Join a line ending in `\` with the next (OBJ).
    pub continued: bool,
}

impl<R: BufRead> Lines<R> {
    pub fn new(source: R) -> Self {
        Lines { source, buffer: Vec::new(), text: String::new(), number: 0, continued: false }
    }

    /// The next line without its comment; `None` at the end. Bytes that are no UTF-8 become replacement characters.
    pub fn next(&mut self) -> Result<Option<&str>, FormatError> {
        self.text.clear();
        loop {
            self.buffer.clear();
            let read = self.source.read_until(b'\n', &mut self.buffer);
            if read.map_err(|cause| FormatError::line(self.number + 1, cause.to_string()))? == 0 {
                return Ok(if self.text.is_empty() { None } else { Some(&self.text) });
            }
            self.number += 1;
            let line = self.buffer.split(|&byte| byte == b'#').next().unwrap_or_default();
            let line = String::from_utf8_lossy(line);
            let line = line.trim_end();
            match line.strip_suffix('\\').filter(|_| self.continued) {
                Some(part) => {
                    self.text.push_str(part);
                    self.text.push(' ');
                }
                None => {
                    self.text.push_str(line);
                    return Ok(Some(&self.text));
                }
            }
        }
    }
}

/// The next word as a number.
pub(super) fn number<'a, T: std::str::FromStr>(words: &mut impl Iterator<Item = &'a str>, what: &str) -> Result<T, String> {
    let word = words.next().ok_or_else(|| format!("{what} is missing"))?;
    word.parse().map_err(|_| format!("expected {what}, found '{word}'"))
}
