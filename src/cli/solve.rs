//! `ribopt solve`

use std::time::Instant;

use super::arguments::Solve;
use super::failure::Failure;
use super::{interrupt, live_table, output, reading};
use ribopt::files::Inputs;
use ribopt::report::answer::EarlierAnswer;
use ribopt::report::number::short;
use ribopt::report::text::count;
use ribopt::report::{result, summary};
use ribopt::run::network::{self, Network};
use ribopt::run::report::{NETWORK, report};
use ribopt::run::saf::saf;
use ribopt::run::schedule::schedule;
use ribopt::run::solve::{Request, Solved, solve};
use ribopt::run::{RunError, Subject, Watcher, choice};

/// Solves, shows what was found and returns the exit code.
pub fn run(arguments: &Solve) -> Result<u8, Failure> {
    let begun = Instant::now();
    let mut subject = reading::read(&arguments.file, &arguments.changes.set, arguments.quiet)?;
    arguments.limits.apply(&mut subject.settings);
    // The limit is on the whole command, reading included.
    let settings = &mut subject.settings;
    settings.max_seconds = (settings.max_seconds - begun.elapsed().as_secs_f64()).max(0.0);
    output::tell(&subject.warnings);
    let start = arguments.start.as_deref().map(EarlierAnswer::read).transpose().map_err(RunError::from)?;
    let inputs = inputs(arguments, &subject)?;
    let network = network(arguments, &subject)?;
    let request = Request {
        choices: choice::choose(&arguments.backends, arguments.algorithm.as_deref(), &subject.settings)?,
        out: arguments.out.as_deref(),
        start: start.as_ref(),
        inputs: &inputs,
        starts: arguments.starts.map_or_else(|| subject.usual_starts(), |starts| starts as usize),
        plot: arguments.plot || arguments.report,
        interrupt: Some(interrupt::flag()),
    };
    let mut table = live_table::on_terminal(arguments.quiet);
    let watcher: &mut dyn Watcher = match &mut table {
        Some(table) => table,
        None => &mut (),
    };
    let solved = solve(&subject, &request, watcher)?;
    interrupt::release();
    let new_warnings = solved.about.warnings.get(subject.about.warnings.len()..).unwrap_or_default();
    output::warn(new_warnings);
    show(arguments, &subject, &solved)?;
    // The answer was shown: only now what went wrong besides.
    if let Some(error) = solved.unwritten {
        return Err(error.into());
    }
    if let Some(network) = network {
        draw(arguments, &subject, &solved, &network)?;
    }
    if arguments.report {
        let written = report(&[solved.folder().to_path_buf()], None)?;
        if !(arguments.json || arguments.quiet) {
            output::print(|out| writeln!(out, "report: {}", written.display()))?;
        }
    }
    workbooks(arguments, &subject, &solved)?;
    Ok(solved.outcome.exit_code())
}

/// Everything that is read, none of which an output may take the place of.
fn inputs(arguments: &Solve, subject: &Subject) -> Result<Inputs, RunError> {
    let mut inputs = subject.inputs.clone();
    arguments.start.iter().for_each(|start| inputs.add(start));
    inputs.add(&arguments.file.with_file_name(network::GEOMETRY));
    if arguments.schedule.is_some() && subject.problem().ribs.names.is_empty() {
        return Err(RunError::Choice("a schedule lists ribs, and there are none: leave --schedule out".into()));
    }
    if arguments.saf.is_some() && subject.problem().structure.is_none() {
        let message = "no SAF file: there is no structure; ribs with `start` and `end` make one, or leave --saf out";
        return Err(RunError::Choice(message.into()));
    }
    for out in arguments.schedule.iter().chain(&arguments.saf) {
        if out.extension().is_none_or(|ending| !ending.eq_ignore_ascii_case("xlsx")) {
            return Err(RunError::Choice(format!("{}: this is to be a workbook, which ends in .xlsx", out.display())));
        }
        inputs.spare([out.clone()])?;
    }
    for out in &arguments.solids {
        inputs.spare([out.clone(), out.with_extension("csv"), out.with_extension("json")])?;
    }
    Ok(inputs)
}

/// The schedule of ribs, and the structure for other programs.
fn workbooks(arguments: &Solve, subject: &Subject, solved: &Solved) -> Result<(), Failure> {
    let mut lines = Vec::new();
    if let Some(out) = &arguments.schedule {
        schedule(subject, solved, out)?;
        lines.push(format!("schedule: {}", out.display()));
    }
    if let Some(out) = &arguments.saf {
        saf(subject, solved, out)?;
        lines.push(format!("structure: {}", out.display()));
    }
    match arguments.json || arguments.quiet {
        true => Ok(()),
        false => output::print(|to| lines.iter().try_for_each(|line| writeln!(to, "{line}"))),
    }
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
        match &solved.unwritten {
            None => writeln!(out, "logs and results: {}", solved.folder().display()),
            Some(_) => Ok(()),
        }
    })
}

/// Where the ribs lie, if solids are wanted, or pictures and there is a table; told before anything is solved if that is not
/// known.
fn network(arguments: &Solve, subject: &Subject) -> Result<Option<Network>, RunError> {
    arguments.solids.iter().try_for_each(|out| network::check_ending(out))?;
    let wanted = !arguments.solids.is_empty()
        || (arguments.plot || arguments.report) && Network::is_known(&arguments.file, subject.problem());
    Ok(wanted.then(|| Network::beside(&arguments.file, subject.problem())).transpose()?)
}

/// Solids and pictures of the reported point, whatever its status: the summary has told that.
fn draw(arguments: &Solve, subject: &Subject, solved: &Solved, network: &Network) -> Result<(), Failure> {
    let sized = network.sized(subject, &solved.outcome.x).map_err(RunError::from)?;
    let mut lines = Vec::new();
    for out in &arguments.solids {
        let report = sized.write_solids(out).map_err(RunError::from)?;
        lines.push(format!(
            "solids: {}: {}, volume {} (the model's prismatoids: {}); {} overlap, about {} counted more than once",
            out.display(),
            count(report.solids, "rib"),
            short(report.volume),
            report.model_volume.map_or("unknown".into(), short),
            count(report.overlapping_joints, "joint"),
            short(report.overlap_volume)
        ));
    }
    if arguments.plot || arguments.report {
        let out = solved.folder().join("network.svg");
        sized.write_picture(&subject.about, &out).map_err(RunError::from)?;
        lines.push(format!("picture: {}", out.display()));
    }
    if arguments.report && !sized.write_view(&solved.folder().join(NETWORK)).map_err(RunError::from)? {
        lines.push("the report shows no view in space: there are too many ribs for a page".into());
    }
    match arguments.json || arguments.quiet {
        true => Ok(()),
        false => output::print(|out| lines.iter().try_for_each(|line| writeln!(out, "{line}"))),
    }
}
