//! A line on a terminal that says how far something is, and goes away in the end.

use std::io::Write;
use std::time::{Duration, Instant};

/// What takes less is not worth a line.
const PATIENCE: Duration = Duration::from_millis(300);
const EVERY: Duration = Duration::from_millis(100);
/// Characters of a bar.
const WIDTH: u64 = 30;

/// The line.
pub(super) struct Line<W: Write> {
    out: W,
    due: Instant,
    shown: usize,
}

impl<W: Write> Line<W> {
    pub fn new(out: W) -> Self {
        Line { out, due: Instant::now() + PATIENCE, shown: 0 }
    }

    /// Shows a text, but not too often. A terminal that has gone away is no reason to stop.
    pub fn show(&mut self, text: impl FnOnce() -> String) {
        let now = Instant::now();
        if now < self.due {
            return;
        }
        self.due = now + EVERY;
        let text = text();
        let gap = self.shown.saturating_sub(text.chars().count());
        self.shown = text.chars().count();
        let _ = write!(self.out, "\r{text}{:gap$}", "");
        let _ = self.out.flush();
    }

    pub fn clear(&mut self) {
        if self.shown > 0 {
            let _ = write!(self.out, "\r{:width$}\r", "", width = self.shown);
            let _ = self.out.flush();
        }
    }
}

/// A bar and per cent.
pub(super) fn bar(what: &str, done: u64, of: u64) -> String {
    let part = |whole: u64| (done.min(of) * whole).checked_div(of).unwrap_or(whole);
    let bar: String = (0..WIDTH).map(|at| if at < part(WIDTH) { '#' } else { '.' }).collect();
    format!("{what} [{bar}] {:>3} %", part(100))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_bar_says_what_and_how_far() {
        assert_eq!(bar("reading ribs.csv", 50, 200), "reading ribs.csv [#######.......................]  25 %");
    }

    #[test]
    fn nothing_is_left_on_the_line_and_what_is_short_shows_nothing() {
        let mut line = Line::new(Vec::new());
        line.show(|| bar("reading", 1, 2));
        line.clear();
        assert!(line.out.is_empty());
        line.due = Instant::now();
        line.show(|| bar("reading", 1, 2));
        line.clear();
        let text = String::from_utf8(line.out).unwrap();
        assert!(text.starts_with("\rreading") && text.ends_with(" \r"), "{text:?}");
    }
}
