//! Runs that nobody watches and that leave no log.

use super::Choice;
use crate::backends::Backend;
use crate::backends::argmin::Argmin;
use crate::crosscheck::{self, Outcome, Task};

/// A run that nobody watches.
pub(crate) fn unobserved(task: &Task<'_>, choices: &[Choice]) -> Outcome {
    let backends: Vec<(&dyn Backend, &str)> = choices.iter().map(|choice| (choice.backend, choice.algorithm.as_str())).collect();
    crosscheck::run(task, &backends, &mut |_, _| Box::new(|_| {}))
}

/// What solves a convex problem beside another.
pub(crate) fn by_interior_point() -> Choice {
    Choice { backend: &Argmin, algorithm: "auto".into() }
}
