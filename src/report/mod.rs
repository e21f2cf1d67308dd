//! What a run leaves and shows: CSV tables, the JSON result, the summary, performance profiles.
//!
//! Reports judge nothing. They turn what the certificate and the cross-check found into the user's sense and words.

pub mod answer;
mod blocks;
pub mod bounds;
pub mod checks;
pub mod comparison;
pub mod cross_section;
pub mod earlier;
pub mod governing;
pub mod measured_by;
mod named_numbers;
pub mod number;
pub mod page;
pub mod performance_profile;
pub mod pictures;
pub mod result;
pub mod schedule;
pub mod sheets;
pub mod sizes;
pub mod space;
pub mod structure;
pub mod summary;
pub mod tables;
pub mod text;
pub mod utilisation;

use crate::certificate::Side;
use crate::crosscheck::Outcome;
use crate::model::{Class, Model};
use crate::problem::Sense;
use crate::problem::checks::Check;
use crate::units::Shown;

/// Where the problem came from and how it wants to be called.
#[derive(Debug, Clone, Default)]
pub struct About {
    /// The title.
    pub title: String,
    /// The file as given on the command line.
    pub file: String,
    /// SHA-256 of the file and its tables, hexadecimal.
    pub sha256: String,
    /// Minimise or maximise.
    pub sense: Sense,
    /// The objective as written.
    pub objective: String,
    /// Unit labels.
    pub units: Vec<(String, String)>,
    /// What numbers are told in.
    pub shown: Shown,
    /// True where sections offer an Ix, whose convention reports must state.
    pub has_sections: bool,
    /// True where ribs make up a structure, whose axes reports must state.
    pub has_structure: bool,
    /// Checks by design codes.
    pub checks: Vec<Check>,
    /// What the reader wants said.
    pub warnings: Vec<String>,
    /// Sections and the rows of catalogues that were chosen for them.
    pub chosen: Vec<(String, String)>,
    /// Changes to the file's numbers for this run, as given by `--set`.
    pub changes: Vec<String>,
}

impl About {
    /// The label of a unit, where the file gives one.
    pub fn unit(&self, name: &str) -> Option<&str> {
        self.units.iter().find(|(known, _)| known == name).map(|(_, label)| label.as_str())
    }
}

/// Totals over all ribs, by the laws the note and the solid give.
#[derive(Debug, Clone, Copy, PartialEq, serde::Serialize)]
pub struct Volumes {
    /// Each rib by its own law.
    pub total: f64,
    /// All by the frustum law (2.3.1), (2.4.1).
    pub frustum: f64,
    /// All by the prismatoid law: the solid whose dimensions vary linearly.
    pub prismatoid: f64,
}

impl Volumes {
    /// By how much the laws differ, relative to the prismatoid.
    pub fn difference(&self) -> f64 {
        if self.frustum == self.prismatoid { 0.0 } else { ((self.frustum - self.prismatoid) / self.prismatoid).abs() }
    }
}

/// Everything reports speak of.
pub struct Findings<'a> {
    /// The problem's origin and words.
    pub about: &'a About,
    /// The problem in the user's variables, minimised.
    pub model: &'a dyn Model,
    /// What is proved about it.
    pub class: Class,
    /// What the run found.
    pub outcome: &'a Outcome,
    /// Volumes at the reported point, where there are ribs.
    pub volumes: Option<Volumes>,
    /// Mass of all ribs there, where each has a density.
    pub mass: Option<f64>,
    /// How far the limits are used there.
    pub utilisation: Option<&'a utilisation::Table>,
}

/// One row, or the bounds of one variable, at the reported point and in the user's sense.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Held {
    /// The side it rests on.
    pub side: Side,
    /// Its multiplier; NaN where nothing is known.
    pub multiplier: f64,
    /// d(reported objective)/d(limit) = −multiplier.
    pub sensitivity: f64,
}

impl Held {
    const UNKNOWN: Held = Held { side: Side::None, multiplier: f64::NAN, sensitivity: f64::NAN };

    fn new(side: Side, multiplier: f64) -> Held {
        // 0.0 − m, so that no multiplier of zero becomes −0.
        Held { side, multiplier: multiplier + 0.0, sensitivity: 0.0 - multiplier }
    }
}

impl Findings<'_> {
    /// −1 where the user maximises: turns objective and multipliers of the minimised form into the user's sense.
    pub fn sign(&self) -> f64 {
        sign(self.about.sense)
    }

    /// The objective as users know it.
    pub fn objective(&self) -> Option<f64> {
        self.outcome.objective.map(|value| self.in_users_sense(value))
    }

    /// The bound no feasible point passes, in the user's sense.
    pub fn lower_bound(&self) -> Option<f64> {
        self.outcome.lower_bound.map(|value| self.in_users_sense(value))
    }

    /// A value of the minimised objective in the user's sense.
    pub fn in_users_sense(&self, value: f64) -> f64 {
        self.sign() * value + 0.0
    }

    /// Row i.
    pub fn row(&self, i: usize) -> Held {
        let held = self.outcome.certificate.as_ref().and_then(|certificate| {
            Some(Held::new(*certificate.row_sides.get(i)?, self.sign() * certificate.row_multipliers.get(i)?))
        });
        held.unwrap_or(Held::UNKNOWN)
    }

    /// c_i(x), NaN where it has no value.
    pub fn row_value(&self, i: usize) -> f64 {
        let values = self.outcome.certificate.as_ref().map(|certificate| certificate.row_values.as_slice());
        values.and_then(|values| values.get(i)).copied().unwrap_or(f64::NAN)
    }

    /// The bounds of variable j.
    pub fn bound(&self, j: usize) -> Held {
        let held = self.outcome.certificate.as_ref().and_then(|certificate| {
            Some(Held::new(*certificate.bound_sides.get(j)?, self.sign() * certificate.bound_multipliers.get(j)?))
        });
        held.unwrap_or(Held::UNKNOWN)
    }
}

/// −1 where the user maximises.
pub fn sign(sense: Sense) -> f64 {
    match sense {
        Sense::Minimize => 1.0,
        Sense::Maximize => -1.0,
    }
}

#[cfg(test)]
mod tests;
