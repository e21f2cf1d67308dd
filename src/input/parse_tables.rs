//! Walks the file's tables into a [`Declaration`].

mod checks;
mod constraints;
mod lists;
mod loads;
mod member;
mod profiles;
mod sequences;
mod settings;
mod shapes;
mod show;
mod structure;

use toml::de::DeTable;

pub(super) use profiles::{DEFAULT_DEGREE, KINDS as PROFILE_KINDS};

use super::declaration::structure::Vector;
use super::declaration::{Declaration, Name, Numbers, Range, VariableEntry};
use super::fields::{Field, Fields, Reader, Scalar};
use super::source::Place;
use crate::problem::Sense;
use crate::problem::mistake_code::MistakeCode;
use crate::units::System;

/// The whole file.
pub(super) fn parse_tables(document: &DeTable, reader: &mut Reader) -> Declaration {
    let mut top = Fields::of(document, Place::Whole);
    let title = top.take("title").and_then(|field| field.text(reader)).map(|title| title.text);
    let mut declared = Declaration { title, ..Declaration::default() };
    objective(&mut top, &mut declared, reader);
    for field in named(&mut top, "units", reader) {
        declared.units.extend(field.text(reader).map(|label| (field.key.to_owned(), label)));
    }
    let labels: Vec<_> = declared.units.iter().map(|(key, label)| (key.clone(), label.text.clone())).collect();
    reader.units = System::of(&labels);
    if let Some(fields) = top.take("show").and_then(|field| field.table(reader)) {
        declared.show = show::show(fields, reader);
    }
    for field in named(&mut top, "parameters", reader) {
        // A name whose value is wrong is known all the same: its uses are no mistakes.
        let value = numbers(&field, reader).unwrap_or(Numbers::One(Scalar::Number(f64::NAN, field.place)));
        declared.parameters.push((name(&field), value));
    }
    for field in named(&mut top, "variables", reader) {
        declared.variables.extend(variable(&field, reader));
    }
    for field in named(&mut top, "profiles", reader) {
        let (profile, controls) = profiles::profile(&field, declared.variables.len(), reader);
        declared.profiles.extend(profile);
        declared.variables.push(controls);
    }
    for field in named(&mut top, "definitions", reader) {
        declared.definitions.extend(sequences::definition(&field, reader).map(|entry| (name(&field), entry)));
    }
    for field in named(&mut top, "catalogues", reader) {
        declared.catalogues.extend(lists::catalogue(&field, reader));
    }
    for field in named(&mut top, "sections", reader) {
        declared.sections.extend(shapes::section(&field, reader));
    }
    structure::structure(&mut top, &mut declared.structure, reader);
    for fields in top.take("ribs").map(|field| field.tables(reader)).unwrap_or_default() {
        declared.ribs.extend(shapes::rib(fields, reader));
    }
    for fields in top.take("constraints").map(|field| field.tables(reader)).unwrap_or_default() {
        declared.constraints.push(constraints::constraint(fields, reader));
    }
    for fields in top.take("checks").map(|field| field.tables(reader)).unwrap_or_default() {
        declared.checks.push(checks::check(fields, reader));
    }
    if let Some(fields) = top.take("solver").and_then(|field| field.table(reader)) {
        settings::settings(fields, &mut declared.settings, reader);
    }
    if let Some(mut fields) = top.take("tables").and_then(|field| field.table(reader)) {
        let mut table = |key| fields.take(key).and_then(|field| field.text(reader));
        (declared.section_table, declared.rib_table) = (table("sections"), table("ribs"));
        let structure = &mut declared.structure;
        (structure.node_table, structure.support_table, structure.load_table) =
            (table("nodes"), table("supports"), table("loads"));
        fields.finish(reader);
    }
    top.finish(reader);
    declared.measured = std::mem::take(&mut reader.measured);
    declared
}

/// The name a field declares.
fn name(field: &Field) -> Name {
    Name { text: field.key.to_owned(), place: field.key_place }
}

/// The fields of a table whose keys are names.
fn named<'a>(top: &mut Fields<'a>, key: &'static str, reader: &mut Reader) -> Vec<Field<'a>> {
    top.take(key).and_then(|field| field.table(reader)).map(|mut fields| fields.rest()).unwrap_or_default()
}

fn objective(top: &mut Fields, declared: &mut Declaration, reader: &mut Reader) {
    let (minimize, maximize) = (top.take("minimize"), top.take("maximize"));
    if let (Some(_), Some(second)) = (&minimize, &maximize) {
        let help = "keep one of `minimize` and `maximize`";
        reader.findings.mistake(MistakeCode::Objective, second.key_place, "two objectives", help);
    }
    let sense = if minimize.is_some() { Sense::Minimize } else { Sense::Maximize };
    declared.objective = minimize.or(maximize).map(|field| (sense, field.text(reader)));
}

fn numbers(field: &Field, reader: &mut Reader) -> Option<Numbers> {
    match field.items() {
        Some(items) => {
            let items = rows(items, field, reader)?;
            let count = items.len();
            let values: Vec<Scalar> = items.iter().filter_map(|item| item.scalar(reader)).collect();
            (values.len() == count).then_some(Numbers::Many(values, field.place))
        }
        None => field.scalar(reader).map(Numbers::One),
    }
}

/// The numbers of a matrix, row by row; other arrays as they are.
fn rows<'a>(items: Vec<Field<'a>>, field: &Field, reader: &mut Reader) -> Option<Vec<Field<'a>>> {
    let Some(rows) = items.iter().map(Field::items).collect::<Option<Vec<_>>>() else { return Some(items) };
    if let [first, rest @ ..] = &rows[..]
        && let Some(other) = rest.iter().find(|row| row.len() != first.len())
    {
        let message = format!("rows of {} and of {} numbers", first.len(), other.len());
        reader.findings.mistake(MistakeCode::ArraySize, field.place, message, "the rows of a matrix are of one length");
        return None;
    }
    Some(rows.into_iter().flatten().collect())
}

fn variable(field: &Field, reader: &mut Reader) -> Option<VariableEntry> {
    let Some(mut fields) = field.table(reader) else { return Some(open_variable(field)) };
    let size = fields.take("size").and_then(|field| field.scalar(reader));
    let range = range(&mut fields, numbers, reader);
    let list = lists::list(&mut fields, reader);
    let positive = fields.take("positive").and_then(|field| field.flag(reader)).unwrap_or(false);
    fields.finish(reader);
    Some(VariableEntry { name: name(field), size, range, list, positive })
}

/// Stands in for a variable whose declaration is wrong, so that its uses are not mistakes as well.
fn open_variable(field: &Field) -> VariableEntry {
    VariableEntry { name: name(field), size: None, range: Range::default(), list: None, positive: false }
}

/// `lower`, `upper` and `start` of a table.
fn range<T>(fields: &mut Fields, value: impl Fn(&Field, &mut Reader) -> Option<T>, reader: &mut Reader) -> Range<T> {
    let mut one = |key| {
        reader.bounds = key != "start";
        let read = fields.take(key).and_then(|field| value(&field, reader));
        reader.bounds = false;
        read
    };
    Range { lower: one("lower"), upper: one("upper"), start: one("start") }
}

/// A list of numbers or expressions; `None` after a mistake.
fn vector(field: &Field, reader: &mut Reader) -> Option<Vector> {
    let Some(items) = field.items() else { return field.expected("a list of numbers, such as [0, 0, -1]", reader) };
    let parts: Vec<Scalar> = items.iter().filter_map(|item| item.scalar(reader)).collect();
    (parts.len() == items.len()).then_some(Vector { parts, place: field.place })
}
