//! Catalogues, whose rows are sections: known by their dimensions, or by properties of theirs.

use std::sync::Arc;

use super::Assembly;
use super::items::{Given, GivenValue};
use crate::expression::ast::Collection;
use crate::input::declaration::{CatalogueEntry, Range, SectionEntry};
use crate::input::source::{Place, Written};
use crate::input::table::Tables;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::{Dimension, Listed};
use crate::sections::{self, Form, Kind};

/// A catalogue that was read.
pub(super) struct Catalogue {
    kind: &'static dyn Kind,
    /// Names of the dimensions.
    columns: Vec<String>,
    names: Vec<String>,
    rows: Vec<Vec<f64>>,
}

impl Catalogue {
    /// The form its columns are the dimensions of, and where each of these stands in a row.
    fn form(&self) -> Option<(&'static Form, Vec<usize>)> {
        let fits = |form: &&Form| {
            form.dimensions.len() == self.columns.len()
                && form.dimensions.iter().all(|name| self.columns.iter().any(|column| column == name))
        };
        let form = self.kind.forms().iter().find(fits)?;
        let place = |name: &&str| self.columns.iter().position(|column| column == name);
        Some((form, form.dimensions.iter().filter_map(place).collect()))
    }
}

impl Assembly<'_> {
    /// Reads the CSV files of `[catalogues]`.
    pub(super) fn read_catalogues(&mut self, entries: &[CatalogueEntry], tables: &mut Tables<'_>) {
        for entry in entries {
            let catalogue = self.read_catalogue(entry, tables).map(Arc::new);
            // Of its sections nothing would be known.
            self.without.table |= catalogue.is_none();
            self.without.sections |= catalogue.is_none();
            self.catalogues.insert(entry.name.text.clone(), catalogue);
        }
    }

    fn read_catalogue(&mut self, entry: &CatalogueEntry, tables: &mut Tables<'_>) -> Option<Catalogue> {
        let kind = match &entry.kind {
            Some(kind) => self.kind(&kind.text, kind.place)?,
            None => sections::kind("general")?,
        };
        let mut table = tables.open(&entry.file, &mut self.findings)?;
        self.columns_of(&table, Some(Collection::Sections));
        let name = table.headers.iter().position(|header| header == "name");
        let known = |header: &str| kind.forms().iter().any(|form| form.dimensions.contains(&header));
        let columns: Vec<usize> = (0..table.headers.len()).filter(|&at| known(&table.headers[at])).collect();
        for (at, header) in table.headers.iter().enumerate() {
            if Some(at) != name && !known(header) && !header.is_empty() {
                let message = format!("`{header}` is no dimension of kind `{}`", kind.name());
                self.findings.mistake(
                    MistakeCode::Catalogue,
                    table.place(1, at as u16),
                    message,
                    "leave the column out, or choose the catalogue's `kind`",
                );
            }
        }
        let Some(name) = name else {
            let message = "the catalogue lacks the column `name`";
            self.findings.mistake(MistakeCode::Catalogue, table.place(1, Place::WHOLE_ROW), message, "add it to the header");
            return None;
        };
        let (mut names, mut rows, mut places) = (Vec::new(), Vec::new(), Vec::new());
        let headers: Vec<String> = columns.iter().map(|&at| table.headers[at].clone()).collect();
        while let Some(row) = table.next(&mut self.findings) {
            let numbers: Vec<Option<f64>> = columns.iter().map(|&at| row.number(at)).collect();
            for (&at, number) in columns.iter().zip(&numbers) {
                if !number.is_some_and(|value| value > 0.0 && value.is_finite()) {
                    self.findings.mistake(
                        MistakeCode::OutOfRange,
                        row.place(at),
                        "a size of a catalogue is a positive number",
                        None,
                    );
                }
            }
            places.push(row.place(name));
            names.push(row.field(name).to_owned());
            rows.push(numbers.into_iter().map(Option::unwrap_or_default).collect());
        }
        table.say_how(&mut self.findings);
        if rows.is_empty() {
            self.findings.mistake(MistakeCode::Catalogue, entry.file.place, "the catalogue has no rows", "add a row per section");
            return None;
        }
        let catalogue = Catalogue { kind, columns: headers, names, rows };
        self.possible_rows(&catalogue, &places);
        if entry.properties.is_empty() { Some(catalogue) } else { self.by_properties(catalogue, entry) }
    }

    /// Says which rows are no sections: flanges thicker than the whole is high.
    fn possible_rows(&mut self, catalogue: &Catalogue, places: &[Place]) {
        let Some((form, order)) = catalogue.form() else { return };
        for ((row, name), &place) in catalogue.rows.iter().zip(&catalogue.names).zip(places) {
            let given: Vec<f64> = order.iter().map(|&at| row[at]).collect();
            let positive = given.iter().all(|value| *value > 0.0);
            if let Some(defect) = catalogue.kind.defect(form, &given, &[]).filter(|_| positive) {
                let message = format!("`{name}` is no section: {defect}");
                self.findings.mistake(MistakeCode::Catalogue, place, message, "correct the row, or take it out");
            }
        }
    }

    /// The same sections known by properties of theirs: numbers of kind `general`.
    fn by_properties(&mut self, catalogue: Catalogue, entry: &CatalogueEntry) -> Option<Catalogue> {
        let general = sections::kind("general")?;
        let mut sound = true;
        for written in &entry.properties {
            let name = written.text.as_str();
            let both =
                catalogue.kind.properties().contains(&name) && general.forms().iter().any(|form| form.dimensions.contains(&name));
            if !both {
                let message =
                    format!("`{name}` is no property that sections of kind `{}` can be known by", catalogue.kind.name());
                self.findings.mistake(
                    MistakeCode::Catalogue,
                    written.place,
                    message,
                    "known: A, Ix, Iy, J, Wx, Wy, Asx, Asy, as far as the kind has them",
                );
            }
            sound &= both;
        }
        let Some((form, order)) = catalogue.form() else {
            let message = format!("these columns do not give a section of kind `{}`", catalogue.kind.name());
            self.findings.mistake(
                MistakeCode::Catalogue,
                entry.file.place,
                message,
                "give the dimensions of one of the kind's forms",
            );
            return None;
        };
        let of = |row: &Vec<f64>| -> Option<Vec<f64>> {
            let given: Vec<f64> = order.iter().map(|&at| row[at]).collect();
            let value = |written: &Written| sections::evaluate(catalogue.kind, form, &given, &[], &written.text);
            entry.properties.iter().map(value).collect()
        };
        let rows = catalogue.rows.iter().map(of).collect::<Option<Vec<_>>>().filter(|_| sound)?;
        let columns = entry.properties.iter().map(|written| written.text.clone()).collect();
        Some(Catalogue { kind: general, columns, rows, names: catalogue.names })
    }

    /// The catalogue a section is of.
    fn catalogue_of(&mut self, entry: &SectionEntry) -> Option<Arc<Catalogue>> {
        let what = &entry.name;
        let Some(from) = &entry.from else {
            let message = format!("section `{}` is of no catalogue", what.text);
            self.findings.mistake(MistakeCode::Catalogue, what.place, message, "add from = \"…\", a name of [catalogues]");
            return None;
        };
        let Some(found) = self.catalogues.get(&from.text).cloned() else {
            let near = did_you_mean(&from.text, self.catalogues.keys().map(String::as_str));
            let help = near.unwrap_or_else(|| "declare it under [catalogues]".into());
            self.findings.mistake(MistakeCode::UnknownItem, from.place, format!("there is no catalogue `{}`", from.text), help);
            return None;
        };
        for (name, _) in &entry.dimensions {
            let message = format!("`{}`: the dimensions of this section are those of a row of `{}`", name.text, from.text);
            self.findings.mistake(MistakeCode::UnknownKey, name.place, message, "leave it out");
        }
        found
    }

    /// Enters a section of a catalogue: each dimension is a variable from its least number to its largest.
    pub(super) fn catalogue_section(&mut self, entry: &SectionEntry) -> Option<u32> {
        let catalogue = self.catalogue_of(entry)?;
        let columns = catalogue.columns.clone();
        let column = |k: usize| catalogue.rows.iter().map(move |row| row[k]);
        let middle = catalogue.rows.len() / 2;
        let given = columns.iter().enumerate().map(|(k, name)| {
            let lower = Some(column(k).fold(f64::INFINITY, f64::min));
            let upper = Some(column(k).fold(0.0, f64::max));
            let start = Some(catalogue.rows[middle][k]);
            Given { name: name.as_str(), place: entry.name.place, value: GivenValue::Own(Range { lower, upper, start }, None) }
        });
        let s = self.section(&entry.name, Some(catalogue.kind), given.collect(), None)?;
        self.from_catalogues.push((s, catalogue));
        Some(s)
    }

    pub(super) fn list_of_section(&mut self, section: u32, catalogue: &Catalogue) {
        let s = section as usize;
        let form = sections::form(self.problem.sections.form[s]);
        let at = |name: &String| {
            let position = form.dimensions.iter().position(|dimension| dimension == name)?;
            match self.problem.dimensions(s).get(position) {
                Some(Dimension::Variable(j)) => Some(*j),
                _ => None,
            }
        };
        let Some(variables) = catalogue.columns.iter().map(at).collect::<Option<Vec<u32>>>() else { return };
        let name = self.problem.sections.names[s].to_string();
        let bounds = &self.problem.variables;
        let inside = |row: &[f64]| {
            let mut numbers = row.iter().zip(&variables);
            numbers.all(|(value, &j)| (bounds.lower[j as usize]..=bounds.upper[j as usize]).contains(value))
        };
        let left = catalogue.rows.iter().zip(&catalogue.names).filter(|(row, _)| inside(row));
        let (rows, names): (Vec<Vec<f64>>, Vec<String>) = left.map(|(row, name)| (row.clone(), name.clone())).unzip();
        if rows.is_empty() {
            let message = format!("no row of the catalogue of `{name}` is within what was set");
            self.findings.mistake(MistakeCode::List, self.section_places[s], message, "widen what `--set` says");
            return;
        }
        self.problem.listed.push(Listed { name, variables, rows, names });
    }
}
