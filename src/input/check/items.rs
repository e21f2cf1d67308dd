//! Sections and ribs, one by one, whether they come from the problem file or from a table.

mod ribs;

use super::Assembly;
use super::links::Link;
use super::listing::Listing;
use super::outlines::Points;
use crate::input::declaration::{Declaration, DimensionEntry, Name, Range, SectionEntry};
use crate::input::source::{Place, Written};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::{Dimension, Origin};
use crate::sections::{self, Form, Kind};
use ribs::nearest;

/// Sets of dimensions that help lists whole; of a kind with more, only this many.
const MOST_SETS: usize = 8;
const SETS_SHOWN: usize = 3;

/// One given dimension of a section.
pub(super) struct Given<'n> {
    pub name: &'n str,
    pub place: Place,
    pub value: GivenValue,
}

/// What is given for it.
pub(super) enum GivenValue {
    Fixed(f64),
    Own(Range<f64>, Option<Listing>),
    Expression(Written),
}

impl Assembly<'_> {
    /// The sections and ribs of the problem file itself.
    pub(super) fn items(&mut self, declared: &Declaration) {
        self.problem.sections.first_dimension.push(0);
        for section in &declared.sections {
            self.section_entry(section);
        }
        for rib in &declared.ribs {
            self.early_rib(rib);
        }
    }

    fn section_entry(&mut self, entry: &SectionEntry) {
        if entry.kind.as_ref().is_some_and(|kind| kind.text == "catalogue") {
            if let Some(s) = self.catalogue_section(entry) {
                entry.data.iter().for_each(|(name, datum)| self.section_data.put(&name.text, s as usize, datum));
            }
            return;
        }
        if let Some(from) = &entry.from {
            self.findings.mistake(
                MistakeCode::UnknownKey,
                from.place,
                "`from` belongs to sections of kind \"catalogue\"",
                "leave it out",
            );
        }
        let given: Vec<Given> = entry.dimensions.iter().map(|(name, value)| self.given(name, value)).collect();
        let kind = entry.kind.as_ref().and_then(|written| self.kind(&written.text, written.place));
        let points = entry.points.as_ref().map(|points| self.points(points));
        let Some(s) = self.section(&entry.name, kind, given, points) else { return };
        for (name, datum) in &entry.data {
            if kind.is_some_and(|kind| kind.properties().contains(&name.text.as_str())) {
                let message = format!("`{}` is a property of this kind of section already", name.text);
                self.findings.mistake(MistakeCode::ReservedName, name.place, message, "choose another name for the datum");
                continue;
            }
            self.section_data.put(&name.text, s as usize, datum);
        }
    }

    fn given<'n>(&mut self, name: &'n Name, entry: &DimensionEntry) -> Given<'n> {
        let value = match entry {
            DimensionEntry::Given(crate::input::fields::Scalar::Number(value, _)) => GivenValue::Fixed(*value),
            DimensionEntry::Given(crate::input::fields::Scalar::Expression(written)) => GivenValue::Expression(written.clone()),
            DimensionEntry::Own(range, list) => {
                let mut part = |scalar: &Option<_>| scalar.as_ref().and_then(|scalar| self.constant(scalar));
                let own = Range { lower: part(&range.lower), upper: part(&range.upper), start: part(&range.start) };
                GivenValue::Own(own, list.as_ref().and_then(|list| self.listing(list)))
            }
        };
        Given { name: &name.text, place: name.place, value }
    }

    /// The kind of this name, or a mistake.
    pub(super) fn kind(&mut self, name: &str, place: Place) -> Option<&'static dyn Kind> {
        let found = sections::kind(name);
        if found.is_none() {
            let names = || sections::KINDS.iter().map(|kind| kind.name());
            let help = did_you_mean(name, names());
            let help = help.unwrap_or_else(|| format!("known: {}", names().collect::<Vec<_>>().join(", ")));
            self.findings.mistake(MistakeCode::UnknownChoice, place, format!("unknown kind of section `{name}`"), help);
        }
        found
    }

    /// Adds a section, with what can be told of it even after a mistake (its uses are no further mistakes).
    pub(super) fn section(
        &mut self,
        name: &Name,
        kind: Option<&'static dyn Kind>,
        given: Vec<Given>,
        points: Option<Points>,
    ) -> Option<u32> {
        let first = self.names.find(&self.problem, &name.text);
        if !self.usable(name, "section") || !self.is_new(name, "section", first) {
            return None;
        }
        let s = self.problem.sections.names.len() as u32;
        let is_left_out = |one: &Given| {
            matches!(one.value, GivenValue::Fixed(value) if value == 0.0) && kind.is_some_and(|kind| kind.absent(one.name))
        };
        let given: Vec<Given> = given.into_iter().filter(|one| !is_left_out(one)).collect();
        let form = kind.and_then(|kind| self.form(name, kind, &given));
        let known_form = form;
        let fallback = || kind.unwrap_or(sections::KINDS[0]).forms().first();
        let form = form.or_else(fallback)?;
        self.problem.sections.form.push(sections::form_number(form)?);
        self.problem.sections.names.push(&name.text);
        self.section_places.push(name.place);
        let _ = self.names.sections.enter(&self.problem.sections.names, s); // known to be free
        if let Some(kind) = kind {
            self.outline(s, name, kind.name(), known_form, points);
        }
        let mut slots = vec![None; form.dimensions.len()];
        for one in given {
            if let Some(position) = form.dimensions.iter().position(|dimension| *dimension == one.name) {
                slots[position] = Some(self.dimension(s, position as u8, one));
            }
        }
        let dimensions = slots.into_iter().map(|slot| slot.unwrap_or(Dimension::Constant(1.0)));
        self.problem.sections.dimensions.extend(dimensions);
        self.problem.sections.first_dimension.push(self.problem.sections.dimensions.len() as u32);
        Some(s)
    }

    fn dimension(&mut self, section: u32, position: u8, given: Given) -> Dimension {
        if let Place::File { .. } = given.place {
            self.dimension_places.insert((section, position), given.place);
        }
        match given.value {
            GivenValue::Fixed(value) => {
                self.positive(given.name, value, given.place);
                Dimension::Constant(value)
            }
            GivenValue::Own(range, list) => {
                if let Some(upper) = range.upper.filter(|upper| *upper <= 0.0) {
                    self.positive(given.name, upper, given.place);
                }
                let variable = self.push_variable(Origin::Dimension(section, position), range);
                self.listings.extend(list.map(|list| (variable, list)));
                Dimension::Variable(variable)
            }
            GivenValue::Expression(written) => {
                let (place, inside) = (written.place, written.inside);
                let text = self.text_number(written);
                self.links.push(Link { section, position, text, place, inside });
                Dimension::Formula(u32::MAX)
            }
        }
    }

    /// A dimension is positive and finite.
    pub(super) fn positive(&mut self, name: &str, value: f64, place: Place) {
        if value <= 0.0 || value == f64::INFINITY {
            let message = format!("dimension `{name}` cannot be {value}");
            self.findings.mistake(MistakeCode::OutOfRange, place, message, "expected a positive number");
        }
    }

    fn text_number(&mut self, written: Written) -> u32 {
        if let Some(&number) = self.text_numbers.get(&written.text) {
            return number;
        }
        let number = self.texts.len() as u32;
        self.text_numbers.insert(written.text.clone(), number);
        self.texts.push(written);
        number
    }

    /// The form that asks for exactly the given dimensions; a mistake where there is none.
    fn form(&mut self, name: &Name, kind: &'static dyn Kind, given: &[Given]) -> Option<&'static Form> {
        let has = |dimension: &str| given.iter().any(|one| one.name == dimension);
        let fits = |form: &&Form| form.dimensions.len() == given.len() && form.dimensions.iter().all(|d| has(d));
        if let Some(form) = kind.forms().iter().find(fits) {
            return Some(form);
        }
        let mut known: Vec<&str> = kind.forms().iter().flat_map(|form| form.dimensions.iter().copied()).collect();
        known.extend(kind.has_outline().then_some("points"));
        known.extend(kind.takes_holes().then_some("holes"));
        known.sort_unstable();
        known.dedup();
        let unknown: Vec<&Given> = given.iter().filter(|one| !known.contains(&one.name)).collect();
        for one in &unknown {
            let help = did_you_mean(one.name, known.iter().copied().chain(["data", "kind"]));
            let help = help.unwrap_or_else(|| format!("{} knows: {}", kind.name(), shown(&known)));
            self.findings.mistake(MistakeCode::UnknownKey, one.place, format!("unknown dimension `{}`", one.name), help);
        }
        if unknown.is_empty() {
            self.misfit(name, kind, given);
        }
        // The nearest form stands in.
        nearest(kind, given)
    }

    /// The mistake of dimensions that are too few, too many, or of different sets.
    fn misfit(&mut self, name: &Name, kind: &'static dyn Kind, given: &[Given]) {
        let has = |dimension: &&str| given.iter().any(|one| one.name == *dimension);
        let takes = |form: &Form| given.iter().all(|one| form.dimensions.contains(&one.name));
        let numbered = |form: &&Form| form.dimensions.iter().any(|name| name.ends_with(']'));
        let mut forms: Vec<&Form> = kind.forms().iter().filter(|form| !numbered(form)).collect();
        if forms.len() > MOST_SETS {
            // Of many sets those that take what is given, or else those that come nearest.
            let foreign = |form: &Form| given.iter().filter(|one| !form.dimensions.contains(&one.name)).count();
            forms.sort_by_key(|form| (foreign(form), form.dimensions.len()));
            forms.truncate(SETS_SHOWN);
        }
        let sets: Vec<String> = forms.iter().map(|form| form.dimensions.join(", ")).collect();
        let list = kind.forms().iter().find(numbered).and_then(|form| form.dimensions.first()?.split('[').next());
        let list = list.map(|name| format!("; or {name} = [ … ], one per segment")).unwrap_or_default();
        let help = format!("give {}{list}", sets.join("; or "));
        let (place, message) = match kind.forms().iter().find(|form| takes(form)) {
            Some(form) => {
                let lacking: Vec<String> = form.dimensions.iter().filter(|d| !has(d)).map(|d| format!("`{d}`")).collect();
                (name.place, format!("section `{}` lacks {}", name.text, lacking.join(" and ")))
            }
            None => {
                let nearest = nearest(kind, given);
                let surplus = given.iter().rev().find(|one| nearest.is_some_and(|form| !form.dimensions.contains(&one.name)));
                let what = surplus.map_or("a dimension".into(), |one| format!("`{}`", one.name));
                let message = format!("section `{}`: {what} does not go with the other dimensions given", name.text);
                (surplus.map_or(name.place, |one| one.place), message)
            }
        };
        self.findings.mistake(MistakeCode::Dimensions, place, message, help);
    }

    /// Closes the data columns.
    pub(super) fn finish_items(&mut self) {
        let (sections, ribs) = (self.problem.sections.names.len(), self.problem.ribs.names.len());
        self.problem.sections.data = std::mem::take(&mut self.section_data).finish(sections);
        self.problem.ribs.data = std::mem::take(&mut self.rib_data).finish(ribs);
    }

    /// Where a dimension is given.
    pub(super) fn dimension_place(&self, section: u32, position: u8) -> Place {
        let own = self.dimension_places.get(&(section, position));
        own.or_else(|| self.section_places.get(section as usize)).copied().unwrap_or(Place::Whole)
    }
}

/// Names for help; of a numbered list its first.
fn shown(names: &[&str]) -> String {
    let told = names.iter().filter(|name| !name.ends_with(']') || name.ends_with("[1]"));
    told.copied().collect::<Vec<_>>().join(", ")
}
