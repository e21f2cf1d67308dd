//! `[sections.NAME]` and `[[ribs]]`.

use super::{name, range};
use crate::input::declaration::{Datum, DimensionEntry, Name, PointsEntry, RibEntry, SectionEntry};
use crate::input::fields::{Field, Fields, Reader, Scalar};
use crate::input::source::Written;
use crate::problem::VolumeLaw;
use crate::problem::mistake_code::MistakeCode;
use crate::sections::is_dimension;
use toml::de::DeValue;

/// One section: `kind`, `data`, and every other key a dimension.
pub(super) fn section(field: &Field, reader: &mut Reader) -> Option<SectionEntry> {
    let mut fields = field.table(reader)?;
    let what = format!("section `{}`", field.key);
    let kind = fields.require("kind", &what, reader).and_then(|field| field.text(reader));
    let data = data(&mut fields, reader);
    let points = outline(&mut fields, reader);
    let from = fields.take("from").and_then(|field| field.text(reader));
    let dimensions = fields.rest().iter().flat_map(|field| dimensions(field, reader)).collect();
    Some(SectionEntry { name: name(field), kind, from, points, dimensions, data })
}

/// `points` and `holes`.
fn outline(fields: &mut Fields, reader: &mut Reader) -> Option<PointsEntry> {
    let (outer, holes) = (fields.take("points"), fields.take("holes"));
    let place = outer.as_ref().or(holes.as_ref())?.place;
    let Some(outer) = outer else {
        reader.findings.mistake(
            MistakeCode::Outline,
            place,
            "`holes` without `points`",
            "give the outer ring as points = [[x, y], [x, y], …]",
        );
        return Some(PointsEntry { rings: None, place });
    };
    let (outer, holes) = (points(&outer, reader), holes.map_or(Some(Vec::new()), |field| rings(&field, reader)));
    let rings = outer.zip(holes).map(|(outer, holes)| std::iter::once(outer).chain(holes).collect());
    Some(PointsEntry { rings, place })
}

/// `[[[x, y], …], …]`; `None` after a mistake.
fn rings(field: &Field, reader: &mut Reader) -> Option<Vec<Vec<[Scalar; 2]>>> {
    let items = field.items().filter(|items| items.iter().all(is_ring));
    let Some(items) = items else { return field.expected("a list of rings: [[[1, 1], [2, 1], [2, 2]]]", reader) };
    let read: Vec<Option<_>> = items.iter().map(|item| points(item, reader)).collect();
    read.into_iter().collect()
}

/// A list of lists, or what only a look at its points can refuse.
fn is_ring(field: &Field) -> bool {
    field.items().is_some_and(|points| points.iter().all(|point| point.items().is_some()))
}

/// `[[x, y], …]`; `None` after a mistake.
fn points(field: &Field, reader: &mut Reader) -> Option<Vec<[Scalar; 2]>> {
    const SHAPE: &str = "pairs of numbers: [[0, 0], [0.4, 0], [0.4, 0.3]]";
    let Some(items) = field.items() else { return field.expected(SHAPE, reader) };
    let count = items.len();
    let list: Vec<[Scalar; 2]> = items
        .iter()
        .filter_map(|item| {
            let Some(pair) = item.items() else { return item.expected(SHAPE, reader) };
            let found = pair.len();
            let both: Option<Vec<Scalar>> = pair.iter().map(|one| one.scalar(reader)).collect();
            let both = both?;
            if both.len() != 2 {
                let message = format!("a point of {found} numbers");
                reader.findings.mistake(MistakeCode::Outline, item.place, message, format!("expected {SHAPE}"));
            }
            both.try_into().ok()
        })
        .collect();
    // Further mistakes of points that are only partly known would be none of the user's.
    (list.len() == count).then_some(list)
}

/// One dimension, or one per item of an array: `thickness = [0.01, 0.02]` gives `thickness[1]` and `thickness[2]`.
fn dimensions(field: &Field, reader: &mut Reader) -> Vec<(Name, DimensionEntry)> {
    match field.items() {
        Some(items) if is_dimension(&format!("{}[1]", field.key)) => {
            let numbered = |(at, item): (usize, &Field)| {
                let name = Name { text: format!("{}[{}]", field.key, at + 1), place: item.place };
                (name, dimension(item, reader))
            };
            items.iter().enumerate().map(numbered).collect()
        }
        _ => vec![(name(field), dimension(field, reader))],
    }
}

fn dimension(field: &Field, reader: &mut Reader) -> DimensionEntry {
    if let DeValue::Table(_) = field.value
        && let Some(mut fields) = field.table(reader)
    {
        let own = range(&mut fields, |field, reader| field.scalar(reader), reader);
        let list = super::lists::list(&mut fields, reader);
        fields.finish(reader);
        return DimensionEntry::Own(own, list);
    }
    match field.value {
        DeValue::Integer(_) | DeValue::Float(_) | DeValue::String(_) => {}
        _ => {
            let what = "a number, an expression in quotes, or { lower = …, upper = …, start = … }";
            return field.expected(what, reader).unwrap_or(DimensionEntry::Own(Default::default(), None));
        }
    }
    field.scalar(reader).map_or_else(|| DimensionEntry::Own(Default::default(), None), DimensionEntry::Given)
}

/// `data = { … }`
pub(super) fn data(fields: &mut Fields, reader: &mut Reader) -> Vec<(Name, Datum)> {
    let Some(mut table) = fields.take("data").and_then(|field| field.table(reader)) else { return Vec::new() };
    table.rest().iter().filter_map(|field| datum(field, reader).map(|datum| (name(field), datum))).collect()
}

fn datum(field: &Field, reader: &mut Reader) -> Option<Datum> {
    match field.value {
        DeValue::String(text) => Some(field.quantity(reader).map_or_else(|| Datum::Text(text.to_string()), Datum::Number)),
        DeValue::Integer(_) | DeValue::Float(_) => field.number(reader).map(Datum::Number),
        DeValue::Array(_) => {
            let items = field.items().unwrap_or_default();
            let number = |item: &Field, reader: &mut Reader| item.quantity(reader).or_else(|| item.number(reader));
            let numbers: Vec<f64> = items.iter().filter_map(|item| number(item, reader)).collect();
            if items.is_empty() {
                return field.expected("an array of one number or more", reader);
            }
            (numbers.len() == items.len()).then_some(Datum::Numbers(numbers))
        }
        _ => field.expected("a number, text, or an array of numbers", reader),
    }
}

/// One rib.
pub(super) fn rib(mut fields: Fields, reader: &mut Reader) -> Option<RibEntry> {
    let place = fields.place;
    let given = fields.require("name", "a rib", reader).and_then(|field| field.text(reader));
    let what = given.as_ref().map_or("a rib".to_owned(), |name| format!("rib `{}`", name.text));
    let (from, to) = ends(&mut fields, &what, reader);
    let member = super::member::member(&mut fields, reader);
    let length = match member.given() {
        true => fields.take("length"),
        false => fields.require("length", &what, reader),
    };
    let length = length.and_then(|field| field.scalar(reader));
    let law = fields.take("volume").and_then(|field| field.text(reader)).and_then(|written| law(&written, reader));
    let data = data(&mut fields, reader);
    fields.finish(reader);
    let name = given.map_or(Name { text: String::new(), place }, |written| Name { text: written.text, place: written.place });
    Some(RibEntry { name, from, to, length, law: law.unwrap_or_default(), data, member })
}

/// `from` and `to`, or `section` for both.
fn ends(fields: &mut Fields, what: &str, reader: &mut Reader) -> (Option<Written>, Option<Written>) {
    let mut text = |key| fields.take(key).and_then(|field| Some((field.key_place, field.text(reader)?)));
    let (section, from, to) = (text("section"), text("from"), text("to"));
    let place = fields.place;
    match (section, from, to) {
        (Some((_, section)), None, None) => (Some(section.clone()), Some(section)),
        (None, Some((_, from)), Some((_, to))) => (Some(from), Some(to)),
        (Some((place, _)), _, _) => {
            reader.findings.mistake(
                MistakeCode::RibEnds,
                place,
                format!("{what} has `section` and `from`/`to`"),
                "keep one of the two",
            );
            (None, None)
        }
        (None, from, to) => {
            let lacking = if from.is_some() {
                "`to`"
            } else if to.is_some() {
                "`from`"
            } else {
                "its sections"
            };
            let help = "give `from` and `to`, or `section` for the same one at both ends";
            reader.findings.mistake(MistakeCode::RibEnds, place, format!("{what} lacks {lacking}"), help);
            (None, None)
        }
    }
}

/// A volume law by name.
fn law(written: &Written, reader: &mut Reader) -> Option<VolumeLaw> {
    let law = VolumeLaw::named(&written.text);
    if law.is_none() {
        let message = format!("unknown volume law `{}`", written.text);
        reader.findings.mistake(MistakeCode::UnknownChoice, written.place, message, "known: frustum, prismatoid");
    }
    law
}
