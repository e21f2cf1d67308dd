//! `[definitions]`: expressions, and sequences `{ for = "i in 1..N", first = …, value = "…" }`.

use crate::input::declaration::{DefinitionEntry, SequenceEntry};
use crate::input::fields::{Field, Reader, Scalar};

pub(super) fn definition(field: &Field, reader: &mut Reader) -> Option<DefinitionEntry> {
    if !field.is_table() {
        return field.scalar(reader).map(DefinitionEntry::One);
    }
    let mut fields = field.table(reader)?;
    let what = format!("the sequence `{}`", field.key);
    let range = fields.require("for", &what, reader).and_then(|field| field.text(reader));
    let value = fields.require("value", &what, reader).and_then(|field| field.text(reader));
    let first: Vec<Option<Scalar>> = match fields.take("first") {
        Some(field) => match field.items() {
            Some(items) => items.iter().map(|item| item.scalar(reader)).collect(),
            None => vec![field.scalar(reader)],
        },
        None => Vec::new(),
    };
    fields.finish(reader);
    let first = first.into_iter().collect::<Option<Vec<Scalar>>>()?;
    Some(DefinitionEntry::Sequence(SequenceEntry { range: range?, first, value: value? }))
}
