//! `[profiles.NAME]`.

use super::{name, numbers, open_variable, range};
use crate::input::declaration::{Degree, Numbers, ProfileEntry, Range, VariableEntry};
use crate::input::fields::{Field, Fields, Reader, Scalar};
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;

/// The kinds of profile, with the degree and the number of control values that go with them.
pub(in crate::input) const KINDS: &[(&str, Option<(u32, u32)>)] =
    &[("b-spline", None), ("linear", Some((1, 2))), ("constant", Some((0, 1)))];

/// The degree where none is given: smooth to the second derivative.
pub(in crate::input) const DEFAULT_DEGREE: u32 = 3;

/// One profile and its control values, which become variable number `variable` of the declaration.
pub(super) fn profile(field: &Field, variable: usize, reader: &mut Reader) -> (Option<ProfileEntry>, VariableEntry) {
    let Some(mut fields) = field.table(reader) else { return (None, open_variable(field)) };
    let what = format!("profile `{}`", field.key);
    let kind = kind(&mut fields, reader);
    let fixed = kind.flatten();
    let degree = fields.take("degree");
    let knots = fields.take("knots");
    if fixed.is_some() {
        for idle in degree.iter().chain(&knots) {
            let message = format!("`{}` does not go with the kind of {what}", idle.key);
            reader.findings.mistake(MistakeCode::BothGiven, idle.key_place, message, "leave it out, or use kind = \"b-spline\"");
        }
    }
    let degree = match (fixed, degree.and_then(|field| field.scalar(reader))) {
        (Some((degree, _)), _) => Degree::Fixed(degree),
        (None, Some(given)) => Degree::Given(given),
        (None, None) => Degree::Fixed(DEFAULT_DEGREE),
    };
    let knots = knots.and_then(|field| match field.items() {
        Some(items) => Some((items.iter().filter_map(|item| item.scalar(reader)).collect(), field.place)),
        None => field.expected("an array of knots", reader),
    });
    let controls = controls(field, &mut fields, kind.map(|fixed| fixed.map(|(_, size)| size)), &what, reader);
    fields.finish(reader);
    // After a mistake a constant stands in, which fits any number of control values.
    let known = kind.is_some() && controls.size.is_some();
    let degree = if known { degree } else { Degree::Fixed(0) };
    let knots = knots.filter(|_| known && fixed.is_none());
    (Some(ProfileEntry { name: name(field), variable, degree, knots }), controls)
}

/// Degree and size, where the kind fixes them; `None` after a mistake.
fn kind(fields: &mut Fields, reader: &mut Reader) -> Option<Option<(u32, u32)>> {
    let Some(field) = fields.take("kind") else { return Some(None) };
    let written = field.text(reader)?;
    let known = KINDS.iter().find(|(name, _)| *name == written.text);
    if known.is_none() {
        let names = || KINDS.iter().map(|(name, _)| *name);
        let help = did_you_mean(&written.text, names());
        let help = help.unwrap_or_else(|| format!("known: {}", names().collect::<Vec<_>>().join(", ")));
        reader.findings.mistake(
            MistakeCode::UnknownChoice,
            written.place,
            format!("unknown kind of profile `{}`", written.text),
            help,
        );
    }
    known.map(|(_, fixed)| *fixed)
}

/// `control = { size, lower, upper, start }`; `kind` holds the size its kind fixes. Without a size after a mistake.
fn controls(field: &Field, fields: &mut Fields, kind: Option<Option<u32>>, what: &str, reader: &mut Reader) -> VariableEntry {
    let given = fields.require("control", what, reader);
    let Some((control, mut table)) = given.and_then(|control| Some((control.clone(), control.table(reader)?))) else {
        return open_variable(field);
    };
    let size = kind.flatten();
    let given = match kind {
        Some(None) => table.require("size", &format!("{what}: control"), reader),
        _ => table.take("size"),
    };
    let given = given.and_then(|field| field.scalar(reader));
    if let (Some(size), Some(Scalar::Number(value, place))) = (size, &given)
        && *value != f64::from(size)
    {
        let message = format!("{what} has {size} control values by its kind, not {value}");
        reader.findings.mistake(MistakeCode::BothGiven, *place, message, "leave `size` out, or use kind = \"b-spline\"");
    }
    let size = size.map(|size| Scalar::Number(size.into(), control.place)).or(given);
    let range: Range<Numbers> = range(&mut table, numbers, reader);
    table.finish(reader);
    VariableEntry { name: name(field), size, range, list: None, positive: false }
}
