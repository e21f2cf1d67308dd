//! The iteration log: one CSV row per iteration, on disk as soon as it is known.

use std::fmt::Write as _;
use std::fs::File;
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use crate::backends::Iteration;
use crate::problem::words::cell;

/// Up to this many variables, each has a column of its own.
pub const MOST_VARIABLE_COLUMNS: usize = 50;

const COLUMNS: [&str; 8] =
    ["iteration", "evaluations", "objective", "feasibility", "optimality", "step_norm", "seconds", "attempt"];

/// One of a backend's runs.
#[derive(Debug)]
struct Attempt {
    /// Which call of [`IterationLog::begin`] it is of.
    of: usize,
    iteration: Option<u64>,
    last: Vec<f64>,
}

/// `log-<backend>.csv` while the run goes on.
///
/// Every row reaches the file in one piece; a row that does not fit on the disk is taken back, so that a reader only
/// ever meets whole rows. The first error ends the log, not the run.
#[derive(Debug)]
pub struct IterationLog {
    path: PathBuf,
    /// None where attempts are numbered and nothing is written.
    file: Option<File>,
    with_variables: bool,
    begun: Option<Instant>,
    attempts: Vec<Attempt>,
    /// How often [`IterationLog::begin`] was called.
    begun_times: usize,
    failure: Option<io::Error>,
}

impl IterationLog {
    /// Opens the log and writes its header.
    ///
    /// # Errors
    /// Where the file cannot be made or written to.
    pub fn create(path: &Path, variables: usize, name: impl Fn(usize) -> String) -> io::Result<IterationLog> {
        let with_variables = variables <= MOST_VARIABLE_COLUMNS;
        let mut header: Vec<String> = COLUMNS.map(String::from).to_vec();
        if with_variables {
            header.extend((0..variables).map(|j| cell(&name(j)).into_owned()));
        }
        let mut file = File::create(path)?;
        write_row(&mut file, &header)?;
        Ok(IterationLog { path: path.into(), file: Some(file), with_variables, ..IterationLog::unwritten() })
    }

    /// A log that numbers attempts as any other and writes nothing.
    pub fn unwritten() -> IterationLog {
        IterationLog {
            path: PathBuf::new(),
            file: None,
            with_variables: false,
            begun: None,
            attempts: Vec::new(),
            begun_times: 0,
            failure: None,
        }
    }

    /// The backend begins anew: further rows are of the next attempt. Seconds count from the first.
    pub fn begin(&mut self) {
        self.begun.get_or_insert_with(Instant::now);
        self.begun_times += 1;
        self.attempts.push(Attempt { of: self.begun_times, iteration: None, last: Vec::new() });
    }

    /// Adds a row; brings back its attempt. A backend that counts its iterations anew has begun another attempt by itself.
    pub fn add(&mut self, iteration: &Iteration<'_>) -> usize {
        let again = |attempt: &Attempt| attempt.iteration.is_some_and(|before| iteration.iteration <= before);
        if self.attempts.last().is_none_or(again) {
            self.attempts.push(Attempt { of: self.begun_times, iteration: None, last: Vec::new() });
        }
        if let Some(attempt) = self.attempts.last_mut() {
            attempt.iteration = Some(iteration.iteration);
            attempt.last.clear();
            attempt.last.extend_from_slice(iteration.x);
        }
        self.row(self.attempts.len(), iteration);
        self.attempts.len()
    }

    /// The attempt, counted as its rows are, that brought back the point x after call number `begun` of
    /// [`IterationLog::begin`]: the one whose last row is nearest. 0 where none has rows.
    pub fn attempt(&self, begun: usize, x: &[f64]) -> usize {
        let distance = |attempt: &Attempt| {
            let apart = |(a, b): (&f64, &f64)| (a - b).abs() / a.abs().max(b.abs()).max(f64::MIN_POSITIVE);
            x.iter().zip(&attempt.last).map(apart).fold(0.0, f64::max)
        };
        let of = self.attempts.iter().enumerate().filter(|(_, attempt)| attempt.of == begun && !attempt.last.is_empty());
        of.map(|(at, attempt)| (distance(attempt), at + 1)).min_by(|a, b| a.0.total_cmp(&b.0)).map_or(0, |(_, number)| number)
    }

    /// Adds the point an attempt brought back, unless its last row is that already; brings back whether it did.
    pub fn close(&mut self, attempt: usize, answer: &Iteration<'_>) -> bool {
        let known = attempt.checked_sub(1).and_then(|at| self.attempts.get(at)).is_some_and(|one| one.last == answer.x);
        if !known {
            self.row(attempt, answer);
        }
        !known
    }

    fn row(&mut self, attempt: usize, iteration: &Iteration<'_>) {
        let Some(file) = self.file.as_mut().filter(|_| self.failure.is_none()) else { return };
        let mut row = vec![iteration.iteration.to_string(), iteration.evaluations.to_string()];
        let seconds = self.begun.map_or(0.0, |begun| begun.elapsed().as_secs_f64());
        let numbers = [iteration.objective, iteration.feasibility, iteration.optimality, iteration.step_norm, seconds];
        row.extend(numbers.map(exact));
        row.push(attempt.to_string());
        if self.with_variables {
            row.extend(iteration.x.iter().copied().map(exact));
        }
        self.failure = write_row(file, &row).err();
    }

    /// Why the log ends early, if it does.
    pub fn failure(&self) -> Option<String> {
        let cause = self.failure.as_ref()?;
        Some(format!("{} ends early: {cause}; the answer is not affected", self.path.display()))
    }
}

/// The shortest text that reads back as the same `f64`, bit for bit; empty for NaN, `inf` and `-inf` for infinities.
///
/// ```
/// assert_eq!(ribopt::log::exact(0.1), "0.1");
/// assert_eq!(ribopt::log::exact(1e300), "1e300");
/// ```
pub fn exact(value: f64) -> String {
    let mut text = String::new();
    push_exact(&mut text, value);
    text
}

/// Appends what [`exact`] says.
pub fn push_exact(text: &mut String, value: f64) {
    if (1e-4..1e15).contains(&value.abs()) {
        // The same digits, sooner.
        text.push_str(zmij::Buffer::new().format_finite(value));
    } else if !value.is_nan() {
        // Writing to a string cannot fail.
        let _ = write!(text, "{value:?}");
    }
}

fn write_row(file: &mut File, cells: &[String]) -> io::Result<()> {
    let mut row = csv::WriterBuilder::new().from_writer(Vec::new());
    row.write_record(cells)?;
    let bytes = row.into_inner().map_err(|error| io::Error::other(error.to_string()))?;
    let end = file.stream_position()?;
    file.write_all(&bytes).inspect_err(|_| {
        // Part of a row may be there; if even this fails, nothing more can be done.
        let _ = file.set_len(end);
    })
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn logged(x: &[f64], objective: f64) -> (Vec<String>, Vec<csv::StringRecord>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("log-argmin.csv");
        let mut log = IterationLog::create(&path, x.len(), |j| format!("x[{}], in m", j + 1)).unwrap();
        log.begin();
        let row =
            Iteration { iteration: 3, evaluations: 7, objective, feasibility: 0.1, optimality: f64::NAN, step_norm: 0.2, x };
        log.add(&row);
        assert!(log.failure().is_none());
        let mut reader = csv::Reader::from_path(&path).unwrap();
        let header = reader.headers().unwrap().iter().map(String::from).collect();
        (header, reader.records().map(Result::unwrap).collect())
    }

    proptest! {
        #[test]
        fn rows_read_back_bit_for_bit(x in prop::collection::vec(proptest::num::f64::NORMAL, 1..5), f in proptest::num::f64::NORMAL) {
            let (header, rows) = logged(&x, f);
            prop_assert_eq!(header.len(), COLUMNS.len() + x.len());
            prop_assert_eq!(rows[0][2].parse::<f64>().unwrap().to_bits(), f.to_bits());
            for (j, value) in x.iter().enumerate() {
                prop_assert_eq!(rows[0][COLUMNS.len() + j].parse::<f64>().unwrap().to_bits(), value.to_bits());
            }
        }
    }

    proptest! {
        #[test]
        fn exact_text_is_the_shortest(value in proptest::num::f64::ANY, size in -20..20_i32) {
            for value in [value, (value % 1.0) * 10f64.powi(size)].into_iter().filter(|value| !value.is_nan()) {
                let text = exact(value);
                prop_assert_eq!(text.parse::<f64>().unwrap().to_bits(), value.to_bits());
                // Of two shortest texts either will do.
                prop_assert_eq!(text.len(), format!("{value:?}").len());
            }
        }
    }

    #[test]
    fn attempts_are_numbered_and_end_with_their_answers() {
        let file = tempfile::NamedTempFile::new().unwrap();
        let mut log = IterationLog::create(file.path(), 1, |_| "x".into()).unwrap();
        let row = |x: &'static [f64]| Iteration {
            iteration: 1,
            evaluations: 1,
            objective: 0.0,
            feasibility: 0.0,
            optimality: 0.0,
            step_norm: 0.0,
            x,
        };
        for attempt in 0..2 {
            log.begin();
            assert_eq!(log.add(&row(if attempt == 0 { &[1.0] } else { &[2.0] })), attempt + 1);
        }
        assert_eq!(log.add(&row(&[3.0])), 3, "iterations are counted anew");
        assert_eq!(
            [log.attempt(1, &[1.1]), log.attempt(2, &[2.1]), log.attempt(2, &[2.9]), log.attempt(3, &[0.0])],
            [1, 2, 3, 0]
        );
        assert!(!log.close(2, &row(&[2.0])) && log.close(1, &row(&[1.5])));
        let mut reader = csv::Reader::from_path(file.path()).unwrap();
        let rows: Vec<_> = reader.records().map(Result::unwrap).collect();
        let shown: Vec<_> = rows.iter().map(|row| (row[7].to_string(), row[8].to_string())).collect();
        assert_eq!(shown, [("1", "1.0"), ("2", "2.0"), ("3", "3.0"), ("1", "1.5")].map(|(a, b)| (a.to_string(), b.to_string())));
    }

    #[test]
    fn beyond_fifty_variables_there_are_no_variable_columns() {
        let (header, rows) = logged(&[1.0; 51], 1.0);
        assert_eq!(header, COLUMNS);
        assert_eq!(rows[0].len(), COLUMNS.len());
        assert_eq!(&rows[0][4], "", "an unknown number is an empty cell");
    }
}
