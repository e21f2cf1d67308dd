//! `[[loads]]`.

use toml::de::DeValue;

use super::name;
use super::vector;
use crate::input::declaration::structure::{LoadEntry, Targets, Vector};
use crate::input::fields::{Field, Fields, Reader, Scalar};

/// Keys that say what acts.
const KINDS: &[&str] = &["force", "moment", "self_weight", "temperature", "gradient", "pretension", "displacement"];

/// One load.
pub(super) fn load(mut fields: Fields, reader: &mut Reader) -> LoadEntry {
    let place = fields.place;
    let acts = KINDS.iter().any(|key| fields.has(key));
    let case = fields.require("case", "a load", reader).and_then(|field| field.text(reader));
    let (nodes, ribs) = (targets(&mut fields, "nodes", reader), targets(&mut fields, "ribs", reader));
    let axes = fields.take("axes").and_then(|field| field.text(reader));
    let mut along = |key| fields.take(key).and_then(|field| vector(&field, reader));
    let (force, force_end) = (along("force"), along("force_end"));
    let moment = fields.take("moment").and_then(|field| moment(&field, reader));
    let mut number = |key| fields.take(key).and_then(|field| field.scalar(reader));
    let (from, to, at) = (number("from"), number("to"), number("at"));
    let (temperature, gradient, pretension) = (number("temperature"), number("gradient"), number("pretension"));
    let self_weight = fields.take("self_weight").and_then(|field| field.flag(reader)?.then_some(field.key_place));
    let displacement = fields.take("displacement").and_then(|field| displacement(&field, reader));
    fields.finish(reader);
    LoadEntry {
        place,
        case,
        acts,
        nodes,
        ribs,
        axes,
        force,
        force_end,
        moment,
        from,
        to,
        at,
        self_weight,
        temperature,
        gradient,
        pretension,
        displacement,
    }
}

fn targets(fields: &mut Fields, key: &'static str, reader: &mut Reader) -> Option<Targets> {
    let field = fields.take(key)?;
    Some(Targets { names: field.texts(reader), place: field.place })
}

/// One number in a plane, three in space.
fn moment(field: &Field, reader: &mut Reader) -> Option<Vector> {
    match field.value {
        DeValue::Array(_) => vector(field, reader),
        _ => field.scalar(reader).map(|one| Vector { place: one.place(), parts: vec![one] }),
    }
}

fn displacement(field: &Field, reader: &mut Reader) -> Option<Vec<(crate::input::declaration::Name, Scalar)>> {
    let mut fields = field.table(reader)?;
    Some(fields.rest().iter().filter_map(|field| field.scalar(reader).map(|value| (name(field), value))).collect())
}
