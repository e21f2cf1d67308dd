//! `solve --plot`: the pictures in the output folder.

use std::io;

use super::Subject;
use super::results::Writer;
use crate::report::Findings;
use crate::report::pictures::{Trace, convergence, cross_sections, elevation, profiles};

/// `convergence.svg`; `sections.svg`, `ribs.svg` and `profiles.svg` where there are such.
///
/// # Errors
/// Where a file cannot be written.
pub(super) fn leave(
    traces: &[Trace],
    start: &[f64],
    subject: &Subject,
    findings: &Findings<'_>,
    files: &mut Writer,
) -> io::Result<()> {
    let (problem, about, answer) = (subject.problem(), findings.about, findings.outcome.x.as_slice());
    let sections = (!problem.sections.names.is_empty()).then(|| cross_sections(problem, about, start, answer));
    let pictures = [
        ("convergence.svg", Some(convergence(traces, about, findings.objective()))),
        ("sections.svg", sections),
        ("ribs.svg", elevation(problem, about, start, answer)),
        ("profiles.svg", profiles(problem, about, start, answer)),
    ];
    for (name, picture) in pictures {
        if let Some(picture) = picture {
            files.file(name, |out| out.write_all(picture.as_bytes()))?;
        }
    }
    Ok(())
}
