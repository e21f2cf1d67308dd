//! Ribs: their ends, lengths and laws.

use super::super::Assembly;
use super::Given;
use crate::input::declaration::{Name, RibEntry};
use crate::input::source::Place;
use crate::problem::VolumeLaw;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::names::Entity;
use crate::problem::nearest::did_you_mean;
use crate::sections::{self, Form, Kind};

impl Assembly<'_> {
    /// A rib of the problem file. Its sections may stand in a table, which is read later: see [`Assembly::late_ends`].
    pub(super) fn early_rib(&mut self, entry: &RibEntry) {
        let length = entry.length.as_ref().map(|scalar| (self.constant(scalar), scalar.place()));
        let length = match length {
            Some((Some(value), place)) => self.length(value, place),
            _ => 1.0,
        };
        let Some(r) = self.rib(&entry.name, length, entry.law) else { return };
        for (name, datum) in &entry.data {
            if self.rib_word(&name.text, name.place) {
                continue;
            }
            self.rib_data.put(&name.text, r as usize, datum);
        }
    }

    /// True, and a mistake, where a datum has a name a rib has already.
    pub(super) fn rib_word(&mut self, name: &str, place: Place) -> bool {
        let taken = ["length", "volume", "from", "to", "section", "name"].contains(&name);
        if taken {
            self.findings.mistake(
                MistakeCode::ReservedName,
                place,
                format!("a rib has a `{name}` already"),
                "choose another name for the datum",
            );
        }
        taken
    }

    /// The length, or 1 after a mistake.
    pub(in super::super) fn length(&mut self, value: f64, place: Place) -> f64 {
        if value > 0.0 && value < f64::INFINITY {
            return value;
        }
        self.findings.mistake(
            MistakeCode::OutOfRange,
            place,
            format!("a rib cannot be {value} long"),
            "expected a positive number",
        );
        1.0
    }

    /// Adds a rib; its ends are entered later.
    pub(in super::super) fn rib(&mut self, name: &Name, length: f64, law: VolumeLaw) -> Option<u32> {
        let first = self.names.find(&self.problem, &name.text);
        if !self.usable(name, "rib") || !self.is_new(name, "rib", first) {
            return None;
        }
        let r = self.problem.ribs.names.len() as u32;
        self.problem.ribs.names.push(&name.text);
        self.rib_places.push(name.place);
        let _ = self.names.ribs.enter(&self.problem.ribs.names, r); // known to be free
        self.problem.ribs.length.push(length);
        self.problem.ribs.law.push(law);
        self.problem.ribs.from.push(0);
        self.problem.ribs.to.push(0);
        Some(r)
    }

    /// Enters the ends of the problem file's ribs, once the tables' sections are known too.
    pub(in super::super) fn late_ends(&mut self, entries: &[RibEntry]) {
        for entry in entries {
            let Some(Entity::Rib(r)) = self.names.find(&self.problem, &entry.name.text) else { continue };
            if self.rib_places[r as usize] != entry.name.place {
                continue; // the second of two of this name
            }
            if let (Some(from), Some(to)) = (&entry.from, &entry.to) {
                let prismatic = from.place == to.place;
                let from = self.end(&from.text, from.place);
                let to = if prismatic { from } else { self.end(&to.text, to.place) };
                self.connect(r, from, to, entry.name.place);
            }
        }
    }

    /// The section of this name.
    pub(in super::super) fn end(&mut self, name: &str, place: Place) -> Option<u32> {
        let found = self.names.sections.find(&self.problem.sections.names, name);
        if found.is_none() && self.without.sections {
            // Perhaps it stands in what could not be read.
            return None;
        }
        if found.is_none() {
            let near = self.problem.sections.names.iter().take(10_000);
            let help = did_you_mean(name, near).unwrap_or_else(|| "declare it under [sections] or in the table".into());
            let message = match self.names.find(&self.problem, name) {
                Some(entity) => format!("`{name}` is a {}, not a section", entity.word()),
                None => format!("there is no section `{name}`"),
            };
            self.findings.mistake(MistakeCode::UnknownItem, place, message, help);
        }
        found
    }

    /// Joins a rib to its sections, which must be of one kind.
    pub(in super::super) fn connect(&mut self, r: u32, from: Option<u32>, to: Option<u32>, place: Place) {
        let (Some(from), Some(to)) = (from, to) else { return };
        let kind = |s: u32| sections::kind_of(self.problem.sections.form[s as usize]).name();
        if kind(from) != kind(to) {
            let name = &self.problem.ribs.names[r as usize];
            let message = format!("rib `{name}` joins sections of two kinds: {} and {}", kind(from), kind(to));
            self.findings.mistake(MistakeCode::RibEnds, place, message, "a rib runs between two sections of one kind");
        } else if self.problem.outline(from) != self.problem.outline(to) {
            // Neither a solid between them nor its prismatoid volume would be defined.
            let message = format!("rib `{}` joins sections drawn by different points", &self.problem.ribs.names[r as usize]);
            let help = "draw both by the same points; their dimensions (scale, thickness) may differ";
            self.findings.mistake(MistakeCode::RibEnds, place, message, help);
        }
        self.problem.ribs.from[r as usize] = from;
        self.problem.ribs.to[r as usize] = to;
    }
}

/// The form with the most of the given dimensions.
pub(super) fn nearest(kind: &'static dyn Kind, given: &[Given]) -> Option<&'static Form> {
    let common = |form: &Form| given.iter().filter(|one| form.dimensions.contains(&one.name)).count();
    kind.forms().iter().rev().max_by_key(|form| common(form))
}
