//! `ribopt bounds`

use super::arguments::Bounds;
use super::failure::Failure;

/// The bound-convergence test.
pub fn run(arguments: &Bounds) -> Result<u8, Failure> {
    let _ = arguments;
    Err(Failure::Request("not yet".into()))
}
