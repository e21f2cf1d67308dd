//! `ribopt check`

use super::arguments::Check;
use super::failure::Failure;

/// Reads, validates, compares derivatives.
pub fn run(arguments: &Check) -> Result<u8, Failure> {
    let _ = arguments;
    Err(Failure::Request("not yet".into()))
}
