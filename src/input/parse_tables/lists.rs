//! `step`, `values`, `integer`: sizes from lists; `[catalogues]`.

use crate::problem::mistake_code::MistakeCode;
use toml::de::DeValue;

use super::name;
use crate::input::declaration::{CatalogueEntry, ListEntry, Listing};
use crate::input::fields::{Field, Fields, Reader};

/// The list of a variable or dimension, where it has one.
pub(super) fn list(fields: &mut Fields, reader: &mut Reader) -> Option<ListEntry> {
    let (step, values, integer) = (fields.take("step"), fields.take("values"), fields.take("integer"));
    let given: Vec<&Field> = [&step, &values, &integer].into_iter().flatten().collect();
    if let [_, second, ..] = given[..] {
        reader.findings.mistake(
            MistakeCode::BothGiven,
            second.key_place,
            "two lists of one size",
            "keep one of `step`, `values` and `integer`",
        );
        return None;
    }
    let place = given.first()?.place;
    let values = match (step, values, integer) {
        (Some(step), _, _) => Listing::Step(step.scalar(reader)?),
        (_, Some(field), _) => {
            let Some(items) = field.items().filter(|items| !items.is_empty()) else {
                return field.expected("a list of one number or more, such as [0.2, 0.25, 0.3]", reader);
            };
            let count = items.len();
            let values: Vec<_> = items.iter().filter_map(|item| item.scalar(reader)).collect();
            Listing::Values(Some(values).filter(|values| values.len() == count)?)
        }
        (_, _, Some(field)) => field.flag(reader)?.then_some(Listing::Integer)?,
        (None, None, None) => return None,
    };
    Some(ListEntry { place, values })
}

/// An entry of `[catalogues]`: a CSV file, or `{ file = …, kind = … }`.
pub(super) fn catalogue(field: &Field, reader: &mut Reader) -> Option<CatalogueEntry> {
    if let DeValue::String(_) = field.value {
        return Some(CatalogueEntry { name: name(field), file: field.text(reader)?, kind: None, properties: Vec::new() });
    }
    let mut fields = field.table(reader)?;
    let file = fields.require("file", &format!("catalogue `{}`", field.key), reader).and_then(|file| file.text(reader));
    let kind = fields.take("kind").and_then(|kind| kind.text(reader));
    let properties = fields.take("properties").map(|field| field.texts(reader)).unwrap_or_default();
    fields.finish(reader);
    Some(CatalogueEntry { name: name(field), file: file?, kind, properties })
}
