//! `solve --schedule`: the sized ribs as a workbook.

use std::path::Path;

use super::sizes::{all_sizes, lines, rib_volumes};
use super::solve::Solved;
use super::{RunError, Subject};
use crate::files::whole;
use crate::report::schedule::{MOST_ROWS, Schedule};
use crate::report::sheets;

/// Writes the schedule of ribs.
///
/// # Errors
/// More ribs than a sheet has rows; a volume without a value; a file that cannot be written.
pub fn schedule(subject: &Subject, solved: &Solved, out: &Path) -> Result<(), RunError> {
    let (problem, x) = (solved.judged(subject).problem(), solved.outcome.x.as_slice());
    if problem.ribs.names.len().max(problem.sections.names.len()) > MOST_ROWS {
        return Err(RunError::Choice(format!("a sheet has {MOST_ROWS} rows at most: use volumes.csv and sizes.csv")));
    }
    let volumes = rib_volumes(problem, x, None).map_err(|error| RunError::Choice(error.to_string()))?;
    let schedule = Schedule {
        about: &solved.about,
        status: solved.outcome.status.as_str(),
        ribs: lines(problem, &volumes).collect(),
        sizes: all_sizes(problem, x).collect(),
        used: solved.utilisation.as_ref(),
    };
    let unwritable = |cause| RunError::Choice(format!("cannot write {}: {cause}", out.display()));
    whole::write(out, |file| sheets::write(&solved.about.title, &schedule.sheets(), file)).map_err(unwritable)
}
