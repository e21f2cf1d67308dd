//! A row of the table: what came of one point.

use serde::{Deserialize, Serialize};

use super::Point;

/// What came of one point. Numbers that are none are `None`.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct Row {
    /// The point's number.
    pub point: usize,
    /// The value of every varied name; `None` where the file's stands.
    pub varied: Vec<Option<f64>>,
    /// The status of its run, `mistake` where the problem cannot be read with these values, `crashed` where it ended its worker.
    pub status: String,
    /// How far the answer is proved: `global`, `local`.
    pub scope: Option<String>,
    /// The exit code `ribopt solve` would have.
    pub exit: Option<u8>,
    /// In the user's sense.
    pub objective: Option<f64>,
    /// No feasible point is below this; of a maximum, above.
    pub lower_bound: Option<f64>,
    /// Of all ribs.
    pub volume: Option<f64>,
    /// The study's own quantities.
    pub quantities: Vec<Option<f64>>,
    /// The first variables.
    pub variables: Vec<Option<f64>>,
    /// The limits that cost most, the costliest first.
    pub governs: Vec<String>,
    /// d(objective)/d(name) of every varied name, along the optimum.
    pub sensitivities: Vec<Option<f64>>,
    /// `cold` from the file's start, `warm` from the answer before.
    pub start: String,
    /// Of the backend whose answer it is.
    pub iterations: Option<u64>,
    /// By the clock.
    pub seconds: f64,
    /// The verdict in words, or what is wrong.
    pub message: String,
}

impl Row {
    /// A point of which nothing is known but why.
    pub(super) fn without_numbers(point: &Point, status: &str, exit: Option<u8>, message: String) -> Row {
        let (status, varied) = (status.to_owned(), point.values.clone());
        Row { point: point.number, varied, status, exit, message, ..Row::default() }
    }

    /// Whether its answer is proved.
    pub fn is_certified(&self) -> bool {
        self.exit == Some(0)
    }

    /// Whether nothing was settled: neither a certified answer nor a proof that there is none.
    pub fn has_failed(&self) -> bool {
        !matches!(self.exit, Some(0 | 3 | 4))
    }
}

/// A number that is one.
pub(super) fn finite(value: Option<f64>) -> Option<f64> {
    value.filter(|value| value.is_finite())
}
