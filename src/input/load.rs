//! From a path to text: files that are missing, no files, no text, empty or far too large.

use std::io::{self, Read};
use std::path::Path;

use super::mistake::{Mistake, Mistakes};
use super::source::Source;
use crate::files;
use crate::problem::mistake_code::MistakeCode;

/// The largest problem file in bytes; more belongs into tables.
const LARGEST: u64 = 64 << 20;

/// The text of a file, a byte order mark taken off, and its bytes for the checksum.
pub(super) fn load(path: &Path) -> Result<(Source, Vec<u8>), Mistakes> {
    let name = path.display().to_string();
    let whole = |message: String, help: &str| refuse(&name, message, help);
    if path.is_dir() {
        return Err(whole(format!("{name} is a directory"), "name the problem file in it, such as problem.toml"));
    }
    // A device may go on for ever whatever its length says.
    let mut bytes = Vec::new();
    let read = files::open(path).and_then(|file| file.take(LARGEST + 1).read_to_end(&mut bytes));
    read.map_err(|error| unreadable(&name, &error))?;
    if bytes.len() as u64 > LARGEST {
        let help = "many sections and ribs belong into CSV tables: [tables] sections = \"sections.csv\"";
        return Err(whole(format!("{name} is larger than {} MB", LARGEST >> 20), help));
    }
    let text = match std::str::from_utf8(&bytes) {
        Ok(text) => text.strip_prefix('\u{feff}').unwrap_or(text).to_owned(),
        Err(error) => return Err(not_text(&name, &bytes, error.valid_up_to())),
    };
    if text.trim().is_empty() {
        return Err(whole(format!("{name} is empty"), "`ribopt new` prints an example to start from"));
    }
    Ok((Source::new(name, text), bytes))
}

/// Why the system would not open a file.
pub(super) fn reason(error: &io::Error) -> (String, &'static str) {
    match error.kind() {
        io::ErrorKind::NotFound => ("there is no such file".into(), "check the path; it is taken from the current folder"),
        io::ErrorKind::PermissionDenied => ("it may not be read".into(), "check the file's permissions"),
        io::ErrorKind::IsADirectory => ("it is a directory".into(), "name a file"),
        _ => (error.to_string(), "check the file"),
    }
}

fn unreadable(name: &str, error: &io::Error) -> Mistakes {
    let (cause, help) = reason(error);
    refuse(name, format!("cannot read {name}: {cause}"), help)
}

fn refuse(name: &str, message: String, help: &str) -> Mistakes {
    let help = Some(help.to_owned());
    let mistake = Mistake {
        code: Some(MistakeCode::File),
        file: name.to_owned(),
        line: 0,
        column: 0,
        text: String::new(),
        caret: 0..0,
        message,
        help,
    };
    Mistakes { list: vec![mistake], more: 0 }
}

/// The place of the first byte that is no UTF-8.
fn not_text(name: &str, bytes: &[u8], valid: usize) -> Mistakes {
    let source = Source::new(name, String::from_utf8_lossy(bytes).into_owned());
    let message = format!("{name} is not UTF-8 text: byte {:#04x} at position {valid}", bytes.get(valid).unwrap_or(&0));
    let help = Some("save the file as UTF-8".to_owned());
    Mistakes { list: vec![source.mistake(Some(MistakeCode::File), valid..valid + 1, message, help)], more: 0 }
}
