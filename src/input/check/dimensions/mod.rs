//! What the file's numbers measure: dimensions of names inferred from the formulas they stand in, and mistakes where two do not agree.
//!
//! Known are the dimensions of sections, their areas and moments, lengths, forces, responses and every number with a unit; unknown those of
//! bare numbers, parameters, variables and data. Sums, comparisons and places that ask for a length or a force relate them
//! ([`crate::units::inference`]).

mod names;
mod places;
mod said;
mod walk;

use super::Assembly;
use crate::expression::ast::Collection;
use crate::input::declaration::Declaration;
use crate::input::source::Place;
use crate::input::table::Table;
use crate::problem::mistake_code::MistakeCode;
use crate::units::{Dimension, Shown, System};
use walk::Walk;

/// What the numbers of a problem file measure.
#[derive(Debug, Clone, Default)]
pub struct Dimensions {
    /// Whether the file has numbers with units: then, and only then, its dimensions have to agree.
    pub quantities: bool,
    /// Parameters, variables, definitions and data, in the file's order.
    pub measured: Vec<Measured>,
    /// What does not agree, in sentences, in a file without quantities.
    pub doubts: Vec<String>,
    /// What the numbers are in.
    pub units: System,
    /// What reports tell numbers in.
    pub shown: Shown,
}

/// A name and what it measures.
#[derive(Debug, Clone)]
pub struct Measured {
    /// The name.
    pub name: String,
    /// Its dimension, where it follows.
    pub dimension: Option<Dimension>,
    /// Its value, where it has one.
    pub value: Option<f64>,
}

/// A column of a table whose header has a unit.
pub(super) struct MeasuredColumn {
    holder: Collection,
    name: String,
    dimension: Dimension,
    place: Place,
}

impl Assembly<'_> {
    /// Keeps what the headers of a table say of its units.
    pub(super) fn columns_of(&mut self, table: &Table, holder: Option<Collection>) {
        for (at, unit) in table.units.iter().enumerate() {
            let Some((unit, _)) = unit else { continue };
            self.quantities = true;
            let Some(holder) = holder else { continue };
            let name = table.headers[at].split(['.', '[']).next().unwrap_or_default().to_owned();
            let place = table.place(1, at as u16);
            self.columns.push(MeasuredColumn { holder, name, dimension: unit.dimension(), place });
        }
    }

    /// Infers the dimensions of everything declared; where quantities occur, disagreement is a mistake.
    pub(super) fn dimensions(&mut self, declared: &Declaration) -> Dimensions {
        let mut walk = Walk::new(self);
        walk.places(declared);
        let measured = walk.measured(declared);
        let shown = walk.shown(declared);
        let (found, odd) = walk.finish();
        let mut doubts = Vec::new();
        if self.quantities {
            self.say_mass(declared);
            for one in found {
                self.findings.mistake(MistakeCode::Units, one.place, one.message, one.help);
            }
            for one in odd {
                self.findings.warning(MistakeCode::OddFactor, one.place, one.message, one.help);
            }
        } else {
            let sentence = |one: walk::Disagreement| format!("{}: {}", self.spoken(one.place), one.message);
            doubts = found.into_iter().chain(odd).map(sentence).collect();
        }
        // Of numbers that do not agree nothing is told.
        let shown = if doubts.is_empty() { shown } else { Shown::default() };
        Dimensions { quantities: self.quantities, measured, doubts, units: self.units.clone(), shown }
    }

    /// The mistake of a unit of mass that does not follow from the others.
    fn say_mass(&mut self, declared: &Declaration) {
        let Some((given, follows)) = self.units.mass_differs() else { return };
        let place = declared.units.iter().find(|(key, _)| key == "mass").map_or(Place::Whole, |(_, label)| label.place);
        let message = format!("with these units of length, force and time a mass is in {follows}, not in {given}");
        self.findings.mistake(MistakeCode::Units, place, message, "leave `mass` out, or choose another unit of force");
    }
}
