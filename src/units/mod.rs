//! Units of physical quantities and the algebra of their dimensions.
//!
//! A quantity such as `12 kN/m` is converted once, where a file is read, into the file's own base units ([`System`]); what is solved afterwards
//! knows numbers only. [`inference`] finds the dimensions of numbers that are written without a unit from the formulas they stand in.

mod dimension;
pub mod inference;
mod ratio;
mod shown;
mod system;
mod unit;

pub use dimension::Dimension;
pub use ratio::{Ratio, meant_by};
pub use shown::{KINDS as SHOWN_KINDS, Label, Shown};
pub use system::System;
pub use unit::{Unit, UnitError, scan};
