//! `[structure]`, `[materials]`, `[nodes]`, `[supports]`, `[masses]`, `[combinations]`.

use toml::de::DeValue;

use super::shapes::data;
use super::{loads, name, named, vector};
use crate::input::declaration::Name;
use crate::input::declaration::structure::{
    CombinationEntry, Fix, MaterialEntry, NodeEntry, Stations, StructureEntries, SupportEntry,
};
use crate::input::fields::{Field, Fields, Reader, Scalar};

/// Everything of the structure but the ribs and the tables.
pub(super) fn structure(top: &mut Fields, entries: &mut StructureEntries, reader: &mut Reader) {
    if let Some(field) = top.take("structure") {
        entries.place = Some(field.key_place);
        if let Some(fields) = field.table(reader) {
            settings(fields, entries, reader);
        }
    }
    for field in named(top, "materials", reader) {
        entries.materials.push(material(&field, reader));
    }
    for field in named(top, "nodes", reader) {
        entries.nodes.push(node(&field, reader));
    }
    for field in named(top, "supports", reader) {
        entries.supports.push(support(&field, reader));
    }
    for field in named(top, "masses", reader) {
        entries.masses.extend(field.scalar(reader).map(|mass| (name(&field), mass)));
    }
    for fields in top.take("loads").map(|field| field.tables(reader)).unwrap_or_default() {
        entries.loads.push(loads::load(fields, reader));
    }
    for field in named(top, "combinations", reader) {
        let factors = field.table(reader).map(|fields| numbers(fields, reader)).unwrap_or_default();
        entries.combinations.push(CombinationEntry { name: name(&field), factors });
    }
}

fn settings(mut fields: Fields, entries: &mut StructureEntries, reader: &mut Reader) {
    let mut text = |key| fields.take(key).and_then(|field| field.text(reader));
    (entries.plane, entries.joints) = (text("plane"), text("joints"));
    entries.gravity = fields.take("gravity").and_then(|field| vector(&field, reader));
    entries.stations = fields.take("stations").and_then(|field| match field.value {
        DeValue::Array(_) => vector(&field, reader).map(Stations::At),
        _ => field.scalar(reader).map(Stations::Count),
    });
    entries.buckling_pieces = fields.take("buckling_pieces").and_then(|field| field.scalar(reader));
    fields.finish(reader);
}

/// Every key of a table with its number.
fn numbers(mut fields: Fields, reader: &mut Reader) -> Vec<(Name, Scalar)> {
    fields.rest().iter().filter_map(|field| field.scalar(reader).map(|value| (name(field), value))).collect()
}

fn material(field: &Field, reader: &mut Reader) -> MaterialEntry {
    let numbers = field.table(reader).map(|fields| numbers(fields, reader)).unwrap_or_default();
    MaterialEntry { name: name(field), numbers }
}

/// `[x, y, z]`, or `{ at = [x, y, z], data = { … } }`.
fn node(field: &Field, reader: &mut Reader) -> NodeEntry {
    let DeValue::Table(_) = field.value else {
        return NodeEntry { name: name(field), at: vector(field, reader), data: Vec::new() };
    };
    let Some(mut fields) = field.table(reader) else { return NodeEntry { name: name(field), at: None, data: Vec::new() } };
    let at = fields.require("at", &format!("node `{}`", field.key), reader).and_then(|at| vector(&at, reader));
    let data = data(&mut fields, reader);
    fields.finish(reader);
    NodeEntry { name: name(field), at, data }
}

fn support(field: &Field, reader: &mut Reader) -> SupportEntry {
    let node = name(field);
    let DeValue::Table(_) = field.value else {
        return SupportEntry { node, fix: fix(field, reader), springs: Vec::new() };
    };
    let Some(mut fields) = field.table(reader) else { return SupportEntry { node, fix: None, springs: Vec::new() } };
    let held = fields.take("fix").and_then(|field| fix(&field, reader));
    let springs = fields.take("springs").and_then(|field| field.table(reader));
    let springs = springs.map(|fields| numbers(fields, reader)).unwrap_or_default();
    fields.finish(reader);
    SupportEntry { node, fix: held, springs }
}

fn fix(field: &Field, reader: &mut Reader) -> Option<Fix> {
    match field.value {
        DeValue::String(_) => field.text(reader).map(Fix::Word),
        DeValue::Array(_) => Some(Fix::Directions(field.texts(reader))),
        _ => field.expected("\"fixed\", \"pinned\", or a list of directions such as [\"x\", \"z\"]", reader),
    }
}
