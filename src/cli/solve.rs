//! `ribopt solve`

use std::time::Instant;

use super::arguments::Solve;
use super::failure::Failure;
use super::{interrupt, live_table, output};
use ribopt::report::{result, summary};
use ribopt::run::solve::{Request, Solved, solve};
use ribopt::run::{Subject, Watcher, choice};

/// Solves, shows what was found and returns the exit code.
pub fn run(arguments: &Solve) -> Result<u8, Failure> {
    let (begun, interrupt) = (Instant::now(), interrupt::flag());
    let mut subject = Subject::read(&arguments.file, &arguments.changes.set)?;
    arguments.limits.apply(&mut subject.settings);
    // The limit is on the whole command, reading included.
    let settings = &mut subject.settings;
    settings.max_seconds = (settings.max_seconds - begun.elapsed().as_secs_f64()).max(0.0);
    output::tell(&subject.warnings);
    let request = Request {
        choices: choice::choose(&arguments.backends, arguments.algorithm.as_deref(), &subject.settings)?,
        out: arguments.out.as_deref(),
        start: arguments.start.as_deref(),
        starts: arguments.starts as usize,
        plot: arguments.plot,
        interrupt: Some(interrupt),
    };
    let mut table = live_table::on_terminal(arguments.quiet);
    let watcher: &mut dyn Watcher = match &mut table {
        Some(table) => table,
        None => &mut (),
    };
    let solved = solve(&subject, &request, watcher)?;
    let new_warnings = solved.about.warnings.get(subject.about.warnings.len()..).unwrap_or_default();
    output::warn(new_warnings);
    show(arguments, &subject, &solved)?;
    Ok(solved.outcome.exit_code())
}

fn show(arguments: &Solve, subject: &Subject, solved: &Solved) -> Result<(), Failure> {
    let findings = solved.findings(subject);
    if arguments.json {
        return output::print(|out| result::write(&findings, out));
    }
    if arguments.quiet {
        return Ok(());
    }
    output::print(|out| {
        summary::write(&findings, out)?;
        writeln!(out, "logs and results: {}", solved.folder().display())
    })
}
