//! What makes a rib a member of the structure: its nodes, material, orientation and joints.

use toml::de::DeValue;

use super::vector;
use crate::input::declaration::structure::MemberEntry;
use crate::input::fields::{Fields, Reader};
use crate::input::source::Place;

/// The keys of a member, taken from a rib's.
pub(super) fn member(fields: &mut Fields, reader: &mut Reader) -> MemberEntry {
    let mut key: Option<Place> = None;
    let mut text = |name| {
        let field = fields.take(name)?;
        key = key.or(Some(field.key_place));
        field.text(reader)
    };
    let (start, end) = (text("start"), text("end"));
    let (material, joints) = (text("material"), text("joints"));
    let mut entry = MemberEntry { start, end, material, joints, ..MemberEntry::default() };
    let mut take = |name| {
        let field = fields.take(name)?;
        key = key.or(Some(field.key_place));
        Some(field)
    };
    entry.up = take("up").and_then(|field| vector(&field, reader));
    entry.roll = take("roll").and_then(|field| field.scalar(reader));
    entry.shear = take("shear").and_then(|field| field.flag(reader)).unwrap_or(false);
    let (hinges, offset) = (take("hinges"), take("offset"));
    match hinges {
        Some(field) if matches!(field.value, DeValue::String(_)) => entry.hinged = field.text(reader),
        Some(field) => {
            if let Some(mut table) = field.table(reader) {
                entry.hinges = ["start", "end"].map(|end| table.take(end).map(|field| field.texts(reader)).unwrap_or_default());
                table.finish(reader);
            }
        }
        None => {}
    }
    if let Some(mut table) = offset.and_then(|field| field.table(reader)) {
        entry.offset = ["start", "end"].map(|end| table.take(end).and_then(|field| vector(&field, reader)));
        table.finish(reader);
    }
    entry.key = key;
    entry
}
