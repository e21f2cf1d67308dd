//! How far the reading of large tables has come, on a terminal only.

use std::cell::RefCell;
use std::io::{self, IsTerminal};
use std::path::Path;

use super::progress::{Line, bar};
use ribopt::input::Progress;
use ribopt::run::{RunError, Subject};

/// Reads a problem with a bar on standard error that goes away in the end.
///
/// # Errors
/// See [`Subject::read`].
pub fn read(file: &Path, changes: &[String], quiet: bool) -> Result<Subject, RunError> {
    if quiet || !io::stderr().is_terminal() {
        return Subject::read(file, changes);
    }
    let shown = RefCell::new(Line::new(io::stderr()));
    let subject = Subject::read_watched(file, changes, &|progress| shown.borrow_mut().show(|| line(&progress)));
    shown.into_inner().clear();
    subject
}

fn line(progress: &Progress<'_>) -> String {
    let name = progress.table.file_name().unwrap_or_default().to_string_lossy();
    bar(&format!("reading {name}"), progress.read, progress.size)
}
