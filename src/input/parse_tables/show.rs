//! `show = { stress = "MPa" }`: units that reports tell numbers in.

use crate::input::fields::{Fields, Reader};
use crate::problem::mistake_code::MistakeCode;
use crate::units::{SHOWN_KINDS, Unit};

pub(super) fn show(mut fields: Fields, reader: &mut Reader) -> Vec<(Unit, String)> {
    let mut wanted = Vec::new();
    for (kind, dimension) in SHOWN_KINDS {
        let Some(written) = fields.take(kind).and_then(|field| field.text(reader)) else { continue };
        let unit = Unit::parse(&written.text).map_err(|error| (error.message, error.help)).and_then(|unit| {
            if unit.dimension() != dimension {
                return Err((format!("`{}` is no unit of {kind}", written.text), format!("expected a unit of {dimension}")));
            }
            reader.units.unit(dimension).map(|_| unit).map_err(|key| reader.units.missing(key))
        });
        match unit {
            Ok(unit) => wanted.push((unit, written.text)),
            Err((message, help)) => reader.findings.mistake(MistakeCode::Units, written.place, message, help),
        }
    }
    fields.finish(reader);
    wanted
}
