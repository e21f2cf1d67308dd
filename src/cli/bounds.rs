//! `ribopt bounds`

use super::arguments::Bounds;
use super::failure::Failure;
use super::{interrupt, output, reading};
use ribopt::report;
use ribopt::run::bounds::bounds;
use ribopt::run::choice;

/// The bound-convergence test.
pub fn run(arguments: &Bounds) -> Result<u8, Failure> {
    let mut subject = reading::read(&arguments.file, &arguments.changes.set, false)?;
    arguments.limits.apply(&mut subject.settings);
    output::tell(&subject.warnings);
    let choices = choice::choose(&[], None, &subject.settings)?;
    let test = bounds(&subject, &choices, Some(interrupt::flag()));
    interrupt::release();
    let (about, rows) = (&subject.about, subject.shown().meta().rows());
    output::print(|out| {
        writeln!(out, "{} ({}), only bounds remain ({} left out)", about.title, about.file, report::text::count(rows, "row"))?;
        writeln!(out, "{}: {}\n", test.outcome.status.as_str(), test.outcome.message)?;
        match &test.ends {
            Ok(ends) => report::bounds::write(ends, &about.objective, out),
            Err(error) => writeln!(out, "no gradient where the variables ended: {error}"),
        }
    })?;
    Ok(interrupt::code(test.exit_code(arguments.strict)))
}
