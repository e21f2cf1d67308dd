//! A problem file read, checked and assembled: what every command starts from.

use std::path::Path;
use std::sync::Arc;

use super::RunError;
use crate::model::{Class, Model, Substitution};
use crate::problem::{Problem, Settings};
use crate::report::{self, About, Volumes};

/// A problem ready to be solved.
pub struct Subject {
    /// Its origin and words.
    pub about: About,
    /// What is proved about it.
    pub class: Class,
    /// Tolerances and limits: the file's, unless the command line changed them.
    pub settings: Settings,
    problem: Arc<Problem>,
    model: Box<dyn Model>,
}

impl Subject {
    /// Reads a file with the changes of `--set`.
    ///
    /// # Errors
    /// All mistakes of the file, its tables and the changes.
    pub fn read(file: &Path, changes: &[String]) -> Result<Subject, RunError> {
        let _ = (file, changes);
        Err(RunError::Input("not yet".into(), Vec::new()))
    }

    /// The problem in the user's variables, minimised.
    pub fn model(&self) -> &dyn Model {
        &*self.model
    }

    /// The declaration.
    pub fn problem(&self) -> &Problem {
        &self.problem
    }

    /// The same in variables that are easier to solve in, where there are any.
    pub fn substitution(&self) -> Option<&dyn Substitution> {
        None
    }

    /// −1 where the user maximises.
    pub fn sign(&self) -> f64 {
        report::sign(self.problem.sense)
    }

    /// Total volumes at a point, where there are ribs and they have a volume there.
    pub fn volumes(&self, x: &[f64]) -> Option<Volumes> {
        let _ = x;
        None
    }
}
