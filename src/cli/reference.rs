//! `ribopt new` and `ribopt schema`: what a problem file looks like.

use super::failure::Failure;
use super::output;

/// Prints a commented example.
pub fn example(kind: Option<&str>) -> Result<u8, Failure> {
    let _ = kind;
    Err(Failure::Request("not yet".into()))
}

/// Prints the JSON Schema of problem files.
pub fn schema() -> Result<u8, Failure> {
    output::print(|_| Ok(()))?;
    Ok(0)
}
