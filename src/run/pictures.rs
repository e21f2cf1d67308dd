//! `solve --plot`: the pictures in the output folder.

use super::folder::FolderError;
use super::solve::Solved;
use super::{RunError, Subject};
use crate::report::pictures::{Trace, convergence, cross_sections, elevation, profiles};
use crate::report::whole_file;

/// `convergence.svg`; `sections.svg`, `ribs.svg` and `profiles.svg` where there are such.
///
/// # Errors
/// Where a file cannot be written.
pub(super) fn leave(traces: &[Trace], start: &[f64], subject: &Subject, solved: &Solved) -> Result<(), RunError> {
    let (problem, answer) = (subject.problem(), solved.outcome.x.as_slice());
    let objective = solved.findings(subject).objective();
    let sections = (!problem.sections.names.is_empty()).then(|| cross_sections(problem, start, answer));
    let pictures = [
        ("convergence.svg", Some(convergence(traces, objective))),
        ("sections.svg", sections),
        ("ribs.svg", elevation(problem, start, answer)),
        ("profiles.svg", profiles(problem, start, answer)),
    ];
    for (name, picture) in pictures {
        let Some(picture) = picture else { continue };
        let path = solved.folder().join(name);
        let written = whole_file::write(&path, |out| out.write_all(picture.as_bytes()));
        written.map_err(|cause| FolderError::Unwritable { path, cause })?;
    }
    Ok(())
}
