//! From the file's units to those of the format.

use super::super::RunError;
use crate::units::{System, Unit};

/// A number of the file's in a unit of the format's; `Err` names what the file does not say.
pub(super) struct Converter<'a>(pub &'a System);

impl Converter<'_> {
    /// # Errors
    /// A base unit that is not given.
    pub fn to(&self, value: f64, symbol: &str) -> Result<f64, RunError> {
        let told = Unit::parse(symbol).map_err(|error| error.message).and_then(|unit| {
            self.0.shown(value, unit).map_err(|key| {
                let (message, help) = self.0.missing(key);
                format!("{message}; {help}")
            })
        });
        told.map_err(|cause| RunError::Choice(format!("no SAF file: {cause}")))
    }
}
