//! `ribopt check`

use std::io::{self, Write};

use serde::Serialize;

use super::arguments::Check;
use super::failure::Failure;
use super::{output, reading, units};
use ribopt::model::EvaluationError;
use ribopt::model::derivative_check::DerivativeCheck;
use ribopt::report::checks;
use ribopt::report::number::short;
use ribopt::report::result::write_value;
use ribopt::report::text::{count, listing};
use ribopt::run::{Subject, check::check};

/// Reads, validates, compares derivatives; exit code 1 where one disagrees or there is no value.
pub fn run(arguments: &Check) -> Result<u8, Failure> {
    let subject = reading::read(&arguments.file, &arguments.changes.set, false)?;
    output::tell(&subject.warnings);
    if arguments.units {
        output::print(|out| units::write(&subject.dimensions, out))?;
        return Ok(u8::from(!subject.dimensions.doubts.is_empty()));
    }
    let result = check(&subject);
    if arguments.json {
        output::print(|out| write_value(&Found::of(&subject, result.as_ref().ok()), out))?;
        return Ok(exit_code(&result));
    }
    output::print(|out| {
        sizes(&subject, out)?;
        match arguments.rows {
            true => checks::write_rows(&subject.about.checks, out)?,
            false => checks::write_titles(&subject.about.checks, out)?,
        }
        match &result {
            Ok(check) => derivatives(check, &subject, out),
            Err(error) => writeln!(out, "derivatives: no value at the start: {error}"),
        }
    })?;
    Ok(exit_code(&result))
}

fn exit_code(result: &Result<DerivativeCheck, EvaluationError>) -> u8 {
    u8::from(!result.as_ref().is_ok_and(|check| check.disagreements == 0))
}

/// The classes a nonlinear problem misses, with the term that breaks each.
fn misses(subject: &Subject) -> impl Iterator<Item = (&'static str, &str)> {
    let (not_geometric, not_convex) = subject.obstacles();
    let reasons = [("a geometric program", not_geometric), ("convex", not_convex)];
    let nonlinear = !subject.class().is_global();
    reasons.into_iter().filter_map(move |(name, reason)| Some((name, reason.filter(|_| nonlinear)?)))
}

/// What `--json` prints.
#[derive(Serialize)]
struct Found<'a> {
    file: &'a str,
    title: &'a str,
    class: String,
    not_geometric: Option<&'a str>,
    not_convex: Option<&'a str>,
    variables: usize,
    constraints: usize,
    checks: Vec<String>,
    derivatives: Option<Derivatives>,
}

#[derive(Serialize)]
struct Derivatives {
    compared: usize,
    disagreements: usize,
}

impl<'a> Found<'a> {
    fn of(subject: &'a Subject, check: Option<&DerivativeCheck>) -> Self {
        let (about, meta) = (&subject.about, subject.shown().meta());
        Found {
            file: &about.file,
            title: &about.title,
            class: subject.class().to_string(),
            not_geometric: subject.obstacles().0,
            not_convex: subject.obstacles().1,
            variables: meta.variables(),
            constraints: meta.rows(),
            checks: about.checks.iter().map(|check| check.title()).collect(),
            derivatives: check.map(|check| Derivatives { compared: check.compared, disagreements: check.disagreements }),
        }
    }
}

fn sizes(subject: &Subject, out: &mut dyn Write) -> io::Result<()> {
    let (about, meta) = (&subject.about, subject.shown().meta());
    let equalities = (0..meta.rows()).filter(|&i| meta.row_lower[i] == meta.row_upper[i]).count();
    let linear = meta.row_is_linear.iter().filter(|&&linear| linear).count();
    let fixed = (0..meta.variables()).filter(|&j| meta.lower[j] == meta.upper[j]).count();
    let (sections, ribs) = (subject.problem().sections.names.len(), subject.problem().ribs.names.len());
    writeln!(out, "{} ({}): no mistakes", about.title, about.file)?;
    writeln!(out, "class: {}", subject.class())?;
    for (name, reason) in misses(subject) {
        writeln!(out, "  not shown to be {name}: {reason}")?;
    }
    writeln!(out, "{}, {}", count(sections, "section"), count(ribs, "rib"))?;
    writeln!(out, "{}, {fixed} of them fixed", count(meta.variables(), "variable"))?;
    writeln!(out, "{}: {equalities} equalities, {linear} linear", count(meta.rows(), "constraint row"))?;
    let (jacobian, hessian) = (meta.jacobian.len(), meta.hessian.len());
    writeln!(out, "entries: {jacobian} in the Jacobian, {hessian} in the Hessian's lower triangle")
}

fn derivatives(check: &DerivativeCheck, subject: &Subject, out: &mut dyn Write) -> io::Result<()> {
    let (looked_at, all) = check.variables;
    writeln!(
        out,
        "derivatives: {} compared (variables: {looked_at} of {all}), {} disagree",
        check.compared, check.disagreements
    )?;
    let Some(worst) = &check.worst else { return Ok(()) };
    let (exact, numeric, error) = (short(worst.exact), short(worst.numeric), short(worst.error));
    writeln!(out, "worst: {}: exact {exact}, by differences {numeric}, relative error {error}", worst.name)?;
    let kinks = subject.problem().kinks();
    if check.disagreements > 0 && !kinks.is_empty() {
        writeln!(
            out,
            "there are kinks left in {}: where the arguments of a max or min meet, or the one of an abs is 0, there is no derivative,\n\
             and differences across such a place do not agree with the exact ones on either side. This is no mistake of the file;\n\
             a bound (a new variable t with t >= every argument) in place of the max makes it smooth.",
            listing(kinks.into_iter(), 5)
        )?;
    }
    Ok(())
}
