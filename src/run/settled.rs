//! What a run found where it was to be looked at anew.

use super::Subject;
use crate::crosscheck::Outcome;

/// A problem beside the user's, and what it came to.
pub(super) struct Settled {
    /// The problem.
    pub subject: Subject,
    /// What it is at the point found.
    pub outcome: Outcome,
}
