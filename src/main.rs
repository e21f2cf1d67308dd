//! The command line.

use std::process::ExitCode;

fn main() -> ExitCode {
    ExitCode::from(ribopt::cli::run(std::env::args_os()))
}
