//! The problem of a study: where it is, and what its numbers are.

use std::path::{Path, PathBuf};

use crate::input::Additions;
use crate::run::{RunError, Subject};

/// A path that is taken from the folder of the study file.
pub(super) fn beside(file: &Path, path: &str) -> PathBuf {
    file.parent().unwrap_or(Path::new("")).join(path)
}

/// The numbers of constant expressions of the problem.
pub(super) fn computed(problem: &Path, constants: Vec<String>) -> Result<Vec<f64>, RunError> {
    if constants.is_empty() {
        return Ok(Vec::new());
    }
    let additions = Additions { constants, ..Additions::default() };
    Ok(Subject::read_with(problem, &additions, &|_| {})?.constants)
}
