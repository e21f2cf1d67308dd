//! `ribopt new` and `ribopt schema`: what a problem file looks like; `ribopt explain`: what a
//! mistake means; `ribopt report`: what a run came to.

use std::path::{Path, PathBuf};

use super::failure::Failure;
use super::output;
use ribopt::input;
use ribopt::report::result::write_value;
use ribopt::run::report::report;

/// Prints a commented example.
pub fn example(kind: Option<&str>) -> Result<u8, Failure> {
    let text = input::example(kind).map_err(Failure::Request)?;
    output::print(|out| out.write_all(text.as_bytes()))?;
    Ok(0)
}

/// Prints what a kind of mistake means, or all kinds.
pub fn explanation(code: Option<&str>) -> Result<u8, Failure> {
    let text = input::explain(code).map_err(Failure::Request)?;
    output::print(|out| out.write_all(text.as_bytes()))?;
    Ok(0)
}

/// Prints the JSON Schema of problem files.
pub fn schema() -> Result<u8, Failure> {
    output::print(|out| write_value(&input::schema(), out))?;
    Ok(0)
}

/// Writes the page about some runs and says where it is.
pub fn page(results: &[PathBuf], out: Option<&Path>) -> Result<u8, Failure> {
    let written = report(results, out)?;
    output::print(|out| writeln!(out, "report: {}", written.display()))?;
    Ok(0)
}
