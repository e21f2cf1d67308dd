//! `ribopt completions` and `ribopt man`: what shells and manuals know of the command line.

use std::path::Path;

use clap::CommandFactory;
use clap_complete::Shell;

use super::arguments::Arguments;
use super::failure::Failure;
use super::output;
use ribopt::run::RunError;

/// Prints the completions of a shell.
pub fn completions(shell: Shell) -> Result<u8, Failure> {
    let mut text = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "ribopt", &mut text);
    output::print(|out| out.write_all(&text))?;
    Ok(0)
}

/// Writes a manual page per command.
pub fn pages(folder: &Path) -> Result<u8, Failure> {
    let written = std::fs::create_dir_all(folder).and_then(|()| clap_mangen::generate_to(Arguments::command(), folder));
    written.map_err(|cause| RunError::Choice(format!("cannot write manual pages into {}: {cause}", folder.display())))?;
    output::print(|out| writeln!(out, "manual pages: {}", folder.display()))?;
    Ok(0)
}
