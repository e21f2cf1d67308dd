//! `ribopt verify`

use super::arguments::Verify;
use super::failure::Failure;
use super::{output, reading};
use ribopt::certificate::Tolerances;
use ribopt::crosscheck::Status;
use ribopt::report::{measured_by, result, summary};
use ribopt::run::verify::verify;

/// Certifies a point and returns the exit code: 0 certified, 1 not.
pub fn run(arguments: &Verify) -> Result<u8, Failure> {
    let mut subject = reading::read(&arguments.file, &arguments.changes.set, false)?;
    arguments.limits.apply(&mut subject.settings);
    output::tell(&subject.warnings);
    let verified = verify(&subject, &arguments.answer)?;
    let findings = verified.findings(&subject);
    output::print(|out| if arguments.json { result::write(&findings, out) } else { summary::write(&findings, out) })?;
    if arguments.parameters {
        let (optimality, constraint) = (subject.settings.optimality_tolerance, subject.settings.constraint_tolerance);
        output::print(|out| measured_by::write(&Tolerances { optimality, constraint }, out))?;
    }
    Ok(u8::from(verified.outcome.status != Status::Certified))
}
