//! Headers with units, such as `h.upper [mm]`, and the numbers below them.

use super::Table;
use crate::input::findings::Findings;
use crate::problem::mistake_code::MistakeCode;
use crate::units::{System, Unit};

impl Table<'_> {
    /// Takes the units off headers such as `h.upper [mm]`.
    pub(super) fn read_units(&mut self, system: &System, findings: &mut Findings) {
        self.units = vec![None; self.headers.len()];
        for at in 0..self.headers.len() {
            let place = self.place(1, at as u16);
            let Some((name, rest)) = self.headers[at].split_once(" [") else { continue };
            let Some(text) = rest.strip_suffix(']') else { continue };
            let unit = Unit::parse(text).map_err(|error| (error.message, error.help));
            let own = unit.and_then(|unit| system.own(1.0, unit).map(|one| (unit, one)).map_err(|key| system.missing(key)));
            match own {
                Ok(own) => self.units[at] = Some(own),
                Err((message, help)) => findings.mistake(MistakeCode::Units, place, message, help),
            }
            self.headers[at] = name.trim_end().to_owned();
        }
    }

    /// A cell that is no number where the header has a unit.
    pub(super) fn beside_unit(&self) -> Option<u16> {
        let wrong = |at: &usize| {
            let text = self.record.get(*at).unwrap_or("").trim();
            let is_number = |text: &str| decimal(text, self.separator != b',').is_some();
            let number = match self.headers[*at].ends_with(".values") {
                true => text.split_whitespace().all(is_number),
                false => text.is_empty() || is_number(text),
            };
            self.units[*at].is_some() && !number
        };
        (0..self.units.len()).find(wrong).map(|at| at as u16)
    }
}

/// A number; with a decimal comma where one may stand.
pub(super) fn decimal(text: &str, commas: bool) -> Option<f64> {
    if let Ok(number) = text.parse::<f64>() {
        return Some(number).filter(|number| !number.is_nan());
    }
    let is_decimal = text.bytes().all(|b| b.is_ascii_digit() || b"+-,eE".contains(&b));
    let (before, after) = text.split_once(',').filter(|_| is_decimal && commas)?;
    format!("{before}.{after}").parse::<f64>().ok().filter(|number| !number.is_nan())
}
