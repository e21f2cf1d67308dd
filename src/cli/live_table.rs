//! The table that grows while a run goes on: fmincon's columns, on a terminal only.

use std::io::{self, IsTerminal, Write};
use std::time::{Duration, Instant};

use ribopt::backends::Iteration;
use ribopt::report::number::significant;
use ribopt::run::Watcher;

/// The first rows are all shown, later ones at most this often.
const EVERY: Duration = Duration::from_millis(100);
const SHOWN_AT_ONCE: usize = 40;
/// The header comes again after as many rows, as in fmincon.
const HEADER_EVERY: usize = 30;

const HEADER: &str = "\n iteration  evaluations         objective  feasibility  first-order  norm of
                                                          optimality      step\n";

/// Rows on standard error, so that standard output holds results only.
pub struct LiveTable<W: Write> {
    out: W,
    rows: usize,
    last_shown: Option<Instant>,
    /// The latest row where it was passed over.
    pending: Option<String>,
}

/// A table where somebody can watch it.
pub fn on_terminal(quiet: bool) -> Option<LiveTable<io::Stderr>> {
    (!quiet && io::stderr().is_terminal()).then(|| LiveTable::new(io::stderr()))
}

impl<W: Write> LiveTable<W> {
    /// An empty table.
    pub fn new(out: W) -> LiveTable<W> {
        LiveTable { out, rows: 0, last_shown: None, pending: None }
    }

    fn show(&mut self, row: &str) {
        // A terminal that has gone away is no reason to stop a run.
        if self.rows.is_multiple_of(HEADER_EVERY) {
            let _ = self.out.write_all(HEADER.as_bytes());
        }
        let _ = writeln!(self.out, "{row}");
        self.rows += 1;
        self.last_shown = Some(Instant::now());
        self.pending = None;
    }
}

impl<W: Write> Watcher for LiveTable<W> {
    fn begin(&mut self, backend: &str, algorithm: &str) {
        self.end();
        let _ = writeln!(self.out, "\n{backend}, algorithm {algorithm}");
        (self.rows, self.last_shown) = (0, None);
    }

    fn iteration(&mut self, iteration: &Iteration<'_>) {
        let row = row(iteration);
        let due = self.last_shown.is_none_or(|shown| shown.elapsed() >= EVERY);
        if due || self.rows < SHOWN_AT_ONCE {
            self.show(&row);
        } else {
            self.pending = Some(row);
        }
    }

    fn end(&mut self) {
        if let Some(row) = self.pending.take() {
            self.show(&row);
        }
    }
}

fn row(iteration: &Iteration<'_>) -> String {
    let Iteration { iteration: number, evaluations, objective, feasibility, optimality, step_norm, .. } = iteration;
    let [feasibility, optimality, step] = [*feasibility, *optimality, *step_norm].map(|value| significant(value, 4));
    format!("{number:>10} {evaluations:>12} {:>17} {feasibility:>12} {optimality:>12} {step:>9}", significant(*objective, 9))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn watched(rows: u64) -> String {
        let mut table = LiveTable::new(Vec::new());
        table.begin("argmin", "auto");
        for iteration in 0..rows {
            let objective = 1.0 / (iteration + 1) as f64;
            let (feasibility, optimality, step_norm) = (1e-9, f64::NAN, 0.25);
            let evaluations = iteration + 1;
            table.iteration(&Iteration { iteration, evaluations, objective, feasibility, optimality, step_norm, x: &[] });
        }
        table.end();
        String::from_utf8(table.out).unwrap()
    }

    #[test]
    fn the_table_reads_as_fmincons() {
        insta::assert_snapshot!(watched(3));
    }

    #[test]
    fn a_long_run_shows_its_last_row_and_does_not_flood() {
        let text = watched(100_000);
        assert!(text.lines().count() < 1000);
        assert!(text.trim_end().lines().last().unwrap().trim_start().starts_with("99999 "));
    }
}
