//! How far the reading of large tables has come, on a terminal only.

use std::cell::RefCell;
use std::io::{self, IsTerminal, Write};
use std::path::Path;
use std::time::{Duration, Instant};

use ribopt::input::Progress;
use ribopt::run::{RunError, Subject};

/// Readings shorter than this are not worth a line.
const PATIENCE: Duration = Duration::from_millis(300);
const EVERY: Duration = Duration::from_millis(100);
/// Characters of the bar.
const WIDTH: u64 = 30;

/// Reads a problem with a bar on standard error that goes away in the end.
///
/// # Errors
/// See [`Subject::read`].
pub fn read(file: &Path, changes: &[String], quiet: bool) -> Result<Subject, RunError> {
    if quiet || !io::stderr().is_terminal() {
        return Subject::read(file, changes);
    }
    let bar = RefCell::new(Bar::new(io::stderr()));
    let subject = Subject::read_watched(file, changes, &|progress| bar.borrow_mut().show(&progress));
    bar.into_inner().clear();
    subject
}

struct Bar<W: Write> {
    out: W,
    due: Instant,
    shown: usize,
}

impl<W: Write> Bar<W> {
    fn new(out: W) -> Self {
        Bar { out, due: Instant::now() + PATIENCE, shown: 0 }
    }

    // A terminal that has gone away is no reason to stop.
    fn show(&mut self, progress: &Progress<'_>) {
        let now = Instant::now();
        if now < self.due {
            return;
        }
        self.due = now + EVERY;
        let text = line(progress);
        let gap = self.shown.saturating_sub(text.chars().count());
        self.shown = text.chars().count();
        let _ = write!(self.out, "\r{text}{:gap$}", "");
        let _ = self.out.flush();
    }

    fn clear(&mut self) {
        if self.shown > 0 {
            let _ = write!(self.out, "\r{:width$}\r", "", width = self.shown);
            let _ = self.out.flush();
        }
    }
}

fn line(progress: &Progress<'_>) -> String {
    let name = progress.table.file_name().unwrap_or_default().to_string_lossy();
    let part = |of: u64| (progress.read.min(progress.size) * of).checked_div(progress.size).unwrap_or(of);
    let bar: String = (0..WIDTH).map(|at| if at < part(WIDTH) { '#' } else { '.' }).collect();
    format!("reading {name} [{bar}] {:>3} %", part(100))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_line_says_what_is_read_and_how_far() {
        let progress = Progress { table: Path::new("net/ribs.csv"), read: 50, size: 200 };
        assert_eq!(line(&progress), "reading ribs.csv [#######.......................]  25 %");
    }

    #[test]
    fn nothing_is_left_on_the_line_and_short_readings_show_nothing() {
        let mut bar = Bar::new(Vec::new());
        let progress = Progress { table: Path::new("ribs.csv"), read: 1, size: 2 };
        bar.show(&progress);
        bar.clear();
        assert!(bar.out.is_empty());
        bar.due = Instant::now();
        bar.show(&progress);
        bar.clear();
        let text = String::from_utf8(bar.out).unwrap();
        assert!(text.starts_with("\rreading") && text.ends_with(" \r"), "{text:?}");
    }
}
