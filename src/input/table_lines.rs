//! Finds single lines of a CSV table again, for messages (rows are not kept while reading).

use std::collections::HashMap;
use std::fs::File;
use std::io::{BufRead, BufReader};
use std::ops::Range;
use std::path::Path;

/// Lines by number.
pub(super) type Lines = HashMap<usize, String>;

/// The wanted lines of a file, in one pass; what cannot be read is left out.
pub(super) fn read(path: &Path, wanted: &[usize]) -> Lines {
    let mut lines = Lines::new();
    let Some(&last) = wanted.iter().max() else { return lines };
    let Ok(file) = File::open(path) else { return lines };
    let mut reader = BufReader::new(file);
    let mut raw = Vec::new();
    for number in 1..=last {
        raw.clear();
        match reader.read_until(b'\n', &mut raw) {
            Ok(read) if read > 0 => {}
            _ => break,
        }
        if wanted.contains(&number) {
            let text = String::from_utf8_lossy(&raw);
            lines.insert(number, text.trim_start_matches('\u{feff}').trim_end_matches(['\r', '\n']).to_owned());
        }
    }
    lines
}

/// The characters of field `number` in a line of a table, or the whole line.
pub(super) fn field(line: &str, separator: char, number: u16) -> Range<usize> {
    let (mut current, mut start, mut quoted) = (0, 0, false);
    for (at, c) in line.chars().enumerate() {
        match c {
            '"' => quoted = !quoted,
            c if c == separator && !quoted && current == number => return start..at,
            c if c == separator && !quoted => (current, start) = (current + 1, at + 1),
            _ => {}
        }
    }
    let length = line.chars().count();
    if current == number { start..length } else { 0..length }
}
