//! Files, for every room: inputs are read within limits, outputs come whole, and no output takes the place of an input.

mod guard;
pub mod memory;
mod open;
pub mod whole;

pub use guard::{Inputs, Overwrites};
pub use open::{Limited, STANDARD_INPUT, open};
