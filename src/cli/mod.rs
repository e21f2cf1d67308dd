//! Arguments, subcommands, the live table, Ctrl-C. Everything here ends in an exit code; nothing is decided here.

mod analyse;
mod arguments;
mod bounds;
mod check;
mod compare;
mod failure;
mod interrupt;
mod live_table;
mod manual;
mod mesh;
mod output;
mod progress;
mod reading;
mod reference;
mod section;
mod solve;
mod sweep;
mod units;
mod verify;

use std::ffi::OsString;

use clap::Parser;

use arguments::{Arguments, Command, Limits};
use failure::Failure;
use ribopt::problem::Settings;

/// Runs the command line and returns the exit code.
pub fn run(arguments: impl IntoIterator<Item = OsString>) -> u8 {
    interrupt::install();
    let arguments: Vec<OsString> = arguments.into_iter().collect();
    // Known before the arguments are, for even a mistake in them is told as JSON.
    let json = arguments.iter().any(|argument| argument == "--json");
    let result = match Arguments::try_parse_from(arguments) {
        Ok(arguments) => dispatch(arguments.command),
        Err(error) if !error.use_stderr() => output::print(|out| write!(out, "{}", error.render())).map(|()| 0),
        Err(error) => Err(Failure::Arguments(error)),
    };
    result.unwrap_or_else(|failure| failure.tell(json))
}

fn dispatch(command: Command) -> Result<u8, Failure> {
    match command {
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Compare(arguments) => compare::run(&arguments),
        Command::Bounds(arguments) => bounds::run(&arguments),
        Command::Check(arguments) => check::run(&arguments),
        Command::Analyse(arguments) => analyse::run(&arguments),
        Command::Verify(arguments) => verify::run(&arguments),
        Command::Sweep(arguments) => sweep::run(&arguments),
        Command::Report { results, output } => reference::page(&results, output.as_deref()),
        Command::Section(arguments) => section::run(&arguments),
        Command::New { kind } => reference::example(kind.as_deref()),
        Command::Mesh { stage } => mesh::run(&stage),
        Command::Explain { code } => reference::explanation(code.as_deref()),
        Command::Schema => reference::schema(),
        Command::Completions { shell } => manual::completions(shell),
        Command::Man { folder } => manual::pages(&folder),
    }
}

impl Limits {
    /// Puts what was given in the place of what the file says.
    fn apply(&self, settings: &mut Settings) {
        fn set<T: Copy>(value: Option<T>, target: &mut T) {
            if let Some(value) = value {
                *target = value;
            }
        }
        set(self.optimality_tolerance, &mut settings.optimality_tolerance);
        set(self.step_tolerance, &mut settings.step_tolerance);
        set(self.constraint_tolerance, &mut settings.constraint_tolerance);
        set(self.max_iterations, &mut settings.max_iterations);
        set(self.max_evaluations, &mut settings.max_evaluations);
        set(self.max_seconds, &mut settings.max_seconds);
    }
}
