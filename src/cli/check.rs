//! `ribopt check`

use std::io::{self, Write};

use super::arguments::Check;
use super::failure::Failure;
use super::output;
use ribopt::model::derivative_check::DerivativeCheck;
use ribopt::report::number::short;
use ribopt::report::text::count;
use ribopt::run::{Subject, check::check};

/// Reads, validates, compares derivatives; exit code 1 where one disagrees or there is no value.
pub fn run(arguments: &Check) -> Result<u8, Failure> {
    let subject = Subject::read(&arguments.file, &arguments.changes.set)?;
    output::tell(&subject.warnings);
    let result = check(&subject);
    output::print(|out| {
        sizes(&subject, out)?;
        match &result {
            Ok(check) => derivatives(check, out),
            Err(error) => writeln!(out, "derivatives: no value at the start: {error}"),
        }
    })?;
    Ok(u8::from(!result.is_ok_and(|check| check.disagreements == 0)))
}

fn sizes(subject: &Subject, out: &mut dyn Write) -> io::Result<()> {
    let (about, meta) = (&subject.about, subject.model().meta());
    let equalities = (0..meta.rows()).filter(|&i| meta.row_lower[i] == meta.row_upper[i]).count();
    let linear = meta.row_is_linear.iter().filter(|&&linear| linear).count();
    let fixed = (0..meta.variables()).filter(|&j| meta.lower[j] == meta.upper[j]).count();
    let (sections, ribs) = (subject.problem().sections.names.len(), subject.problem().ribs.names.len());
    writeln!(out, "{} ({}): no mistakes", about.title, about.file)?;
    writeln!(out, "class: {}", subject.class)?;
    let misses = [("a geometric program", &subject.not_geometric), ("convex", &subject.not_convex)];
    for (class, reason) in misses {
        if let Some(reason) = reason.as_ref().filter(|_| !subject.class.is_global()) {
            writeln!(out, "  not shown to be {class}: {reason}")?;
        }
    }
    writeln!(out, "{}, {}", count(sections, "section"), count(ribs, "rib"))?;
    writeln!(out, "{}, {fixed} of them fixed", count(meta.variables(), "variable"))?;
    writeln!(out, "{}: {equalities} equalities, {linear} linear", count(meta.rows(), "constraint row"))?;
    let (jacobian, hessian) = (meta.jacobian.len(), meta.hessian.len());
    writeln!(out, "entries: {jacobian} in the Jacobian, {hessian} in the Hessian's lower triangle")
}

fn derivatives(check: &DerivativeCheck, out: &mut dyn Write) -> io::Result<()> {
    let (looked_at, all) = check.variables;
    writeln!(
        out,
        "derivatives: {} compared (variables: {looked_at} of {all}), {} disagree",
        check.compared, check.disagreements
    )?;
    let Some(worst) = &check.worst else { return Ok(()) };
    let (exact, numeric, error) = (short(worst.exact), short(worst.numeric), short(worst.error));
    writeln!(out, "worst: {}: exact {exact}, by differences {numeric}, relative error {error}", worst.name)
}
