//! `[structure]`.

use super::super::Assembly;
use crate::input::declaration::structure::{Stations, StructureEntries};
use crate::input::fields::Scalar;
use crate::input::source::{Place, Written};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::structure::Plane;
use crate::problem::words::brief;

/// Stations of a rib where nothing is said.
const STATIONS: u32 = 9;

/// Pieces of a compressed member for buckling where nothing is said.
const BUCKLING_PIECES: u32 = 4;

/// Beyond these numbers a file means something else.
const MOST_STATIONS: f64 = 1001.0;
const MOST_PIECES: f64 = 64.0;

impl Assembly<'_> {
    pub(super) fn structure_settings(&mut self, entries: &StructureEntries) {
        if let Some(written) = &entries.plane {
            self.building.structure.plane = match written.text.as_str() {
                "xz" => Plane::Xz,
                "xy" => Plane::Xy,
                _ => {
                    self.building.plane_unknown = true;
                    self.unknown_word(written, "plane", &["xz", "xy"]).unwrap_or_default()
                }
            };
        }
        self.building.pinned = entries.joints.as_ref().and_then(|written| self.joints(written)).unwrap_or(false);
        if let Some(gravity) = &entries.gravity {
            self.building.structure.gravity = self.along(gravity, "gravity").unwrap_or_default();
        }
        self.building.structure.buckling_pieces = match &entries.buckling_pieces {
            Some(scalar) => self.whole(scalar, "buckling_pieces", 1.0, MOST_PIECES).unwrap_or(BUCKLING_PIECES),
            None => BUCKLING_PIECES,
        };
        self.building.structure.stations = match &entries.stations {
            Some(Stations::Count(scalar)) => even(self.whole(scalar, "stations", 2.0, MOST_STATIONS).unwrap_or(STATIONS)),
            Some(Stations::At(list)) => self.listed_stations(&list.parts, list.place),
            None => even(STATIONS),
        };
    }

    /// Whether `joints` says that ribs are bars.
    pub(super) fn joints(&mut self, written: &Written) -> Option<bool> {
        match written.text.as_str() {
            "rigid" => Some(false),
            "pinned" => Some(true),
            _ => self.unknown_word(written, "kind of joint", &["rigid", "pinned"]),
        }
    }

    fn listed_stations(&mut self, parts: &[Scalar], place: Place) -> Vec<f64> {
        let Some(list) = parts.iter().map(|part| self.constant(part)).collect::<Option<Vec<f64>>>() else {
            return even(STATIONS);
        };
        let inside = list.iter().all(|at| (0.0..=1.0).contains(at));
        if list.is_empty() || !inside || list.windows(2).any(|pair| pair[0] >= pair[1]) {
            let help = "fractions of the rib's length from 0 to 1, rising, such as [0, 0.5, 1]; or how many, such as 9";
            self.findings.mistake(MistakeCode::OutOfRange, place, "these are no stations", help);
            return even(STATIONS);
        }
        list
    }

    /// A whole number within limits.
    fn whole(&mut self, scalar: &Scalar, key: &str, least: f64, most: f64) -> Option<u32> {
        let value = self.constant(scalar)?;
        if value.fract() == 0.0 && (least..=most).contains(&value) {
            return Some(value as u32);
        }
        let message = format!("`{key}` cannot be {}", brief(value));
        self.findings.mistake(
            MistakeCode::OutOfRange,
            scalar.place(),
            message,
            format!("expected a whole number from {least} to {most}"),
        );
        None
    }

    /// The mistake of a word that is none of the known ones.
    pub(super) fn unknown_word<T>(&mut self, written: &Written, what: &str, known: &[&'static str]) -> Option<T> {
        let near = did_you_mean(&written.text, known.iter().copied());
        let help = near.unwrap_or_else(|| format!("known: {}", known.join(", ")));
        self.findings.mistake(MistakeCode::UnknownChoice, written.place, format!("unknown {what} `{}`", written.text), help);
        None
    }
}

/// 0, 1/(n−1), …, 1.
fn even(count: u32) -> Vec<f64> {
    (0..count).map(|at| f64::from(at) / f64::from(count - 1)).collect()
}
