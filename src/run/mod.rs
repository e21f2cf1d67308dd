//! One run, start to finish: read, assemble, solve, certify, compare, leave the files.

pub mod analyse;
mod bounded;
pub mod bounds;
pub mod check;
pub mod choice;
mod coinciding;
pub mod compare;
mod courses;
pub mod folder;
mod further;
mod lists;
mod matrix_bound;
pub mod network;
mod observe;
mod open_end;
mod pictures;
mod place;
mod plausible;
mod present;
pub mod refinement;
mod remaining;
pub mod report;
mod results;
pub mod saf;
pub mod schedule;
pub mod section;
mod settled;
pub mod sizes;
mod sizing;
pub mod solve;
mod stand_in;
mod strongest;
pub mod structure_files;
pub mod subject;
pub(crate) mod unobserved;
pub mod utilisation;
mod vanished;
pub mod verify;

use thiserror::Error;

pub use choice::Choice;
pub use subject::Subject;

use crate::backends::Iteration;
use crate::input;
use crate::report::answer::AnswerError;
use crate::report::result::Mistake;
use folder::FolderError;

/// Rows, sections or ribs up to which utilisation, sizes and volumes are listed: beyond, the lists would take as long as the run.
const MOST_LISTED: usize = 300_000;

/// Sees a run as it goes on.
pub trait Watcher {
    /// A backend begins.
    fn begin(&mut self, backend: &str, algorithm: &str);

    /// An iteration; the objective is in the user's sense.
    fn iteration(&mut self, iteration: &Iteration<'_>);

    /// No more iterations will come.
    fn end(&mut self);
}

/// Watches nothing.
impl Watcher for () {
    fn begin(&mut self, _: &str, _: &str) {}
    fn iteration(&mut self, _: &Iteration<'_>) {}
    fn end(&mut self) {}
}

/// Why a run could not begin, or could not leave its files.
#[derive(Debug, Error)]
pub enum RunError {
    /// The problem file or a `--set` is wrong.
    #[error("{0}")]
    Input(String, Vec<Mistake>),
    /// The output folder.
    #[error(transparent)]
    Folder(#[from] FolderError),
    /// An output that is an input.
    #[error(transparent)]
    Overwrites(#[from] crate::files::Overwrites),
    /// The answer to start from or to verify.
    #[error(transparent)]
    Answer(#[from] AnswerError),
    /// Where ribs lie in space, or their solids and pictures.
    #[error(transparent)]
    Network(#[from] network::NetworkFailure),
    /// No such backend or algorithm, or none that takes the problem.
    #[error("{0}")]
    Choice(String),
}

impl From<input::Mistakes> for RunError {
    fn from(mistakes: input::Mistakes) -> Self {
        let list = mistakes.list.iter().map(subject::reported).collect();
        RunError::Input(mistakes.to_string(), list)
    }
}

impl RunError {
    /// What is wrong, one by one.
    pub fn mistakes(&self) -> Vec<Mistake> {
        match self {
            RunError::Input(_, mistakes) => mistakes.clone(),
            other => vec![Mistake::of_command(other.to_string())],
        }
    }
}

#[cfg(test)]
mod tests;
#[cfg(test)]
mod toy_kind;
