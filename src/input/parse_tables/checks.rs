//! `[[checks]]`.

use crate::problem::mistake_code::MistakeCode;
use toml::de::DeValue;

use crate::input::declaration::Name;
use crate::input::declaration::checks::{AxisEntry, BucklingEntry, CheckEntry, CmEntry, LengthEntry, LtbData, LtbEntry};
use crate::input::fields::{Field, Fields, Reader};

/// One check.
pub(super) fn check(mut fields: Fields, reader: &mut Reader) -> CheckEntry {
    let place = fields.place;
    let mut text = |key| fields.take(key).and_then(|field: Field| field.text(reader));
    let name = text("name").map(|written| Name { text: written.text, place: written.place });
    let (code, web, made) = (text("code"), text("web"), text("made"));
    let mut texts = |key| fields.take(key).map(|field| field.texts(reader)).unwrap_or_default();
    let (ribs, cases) = (texts("ribs"), texts("cases"));
    let mut scalar = |key| fields.take(key).and_then(|field| field.scalar(reader));
    let (fy, gamma, stress_unit) = (scalar("fy"), scalar("gamma_M1"), scalar("stress_unit"));
    let (class, safety, phi) = (scalar("class"), scalar("safety"), scalar("phi"));
    let buckling = fields.take("buckling").and_then(|field| buckling(&field, reader));
    let ltb = fields.take("ltb").map(|field| ltb(&field, reader));
    let cm = fields.take("Cm").and_then(|field| cm(&field, reader));
    fields.finish(reader);
    CheckEntry { name, place, code, ribs, cases, fy, gamma, stress_unit, class, web, safety, phi, made, buckling, ltb, cm }
}

fn buckling(field: &Field, reader: &mut Reader) -> Option<BucklingEntry> {
    let mut fields = field.table(reader)?;
    let mut one = |key| fields.take(key).map(|field| axis(&field, reader));
    let (y, z) = (one("y"), one("z"));
    fields.finish(reader);
    Some(BucklingEntry { place: field.key_place, y, z })
}

fn axis(field: &Field, reader: &mut Reader) -> AxisEntry {
    if held(field, reader) {
        return AxisEntry::Held;
    }
    let DeValue::Table(_) = field.value else { return AxisEntry::Wrong };
    let Some(mut fields) = field.table(reader) else { return AxisEntry::Wrong };
    let length = fields.take("length").and_then(|field| length(&field, reader));
    let curve = fields.take("curve").and_then(|field| field.text(reader));
    fields.finish(reader);
    AxisEntry::Given { place: field.key_place, length, curve }
}

fn length(field: &Field, reader: &mut Reader) -> Option<LengthEntry> {
    match field.value {
        DeValue::String(text) if text == "system" => Some(LengthEntry::System(field.place)),
        _ => field.scalar(reader).map(LengthEntry::Length),
    }
}

/// Whether a value says `"held"`; any other that is no table is a mistake.
fn held(field: &Field, reader: &mut Reader) -> bool {
    match field.value {
        DeValue::Table(_) => false,
        DeValue::String(text) if text == "held" => true,
        _ => {
            let message = format!("`{}` is no table", field.key);
            let help = "write a table { length = …, … }, or \"held\" where the rib is held against it throughout";
            reader.findings.mistake(MistakeCode::WrongType, field.place, message, help);
            false
        }
    }
}

fn ltb(field: &Field, reader: &mut Reader) -> LtbEntry {
    if held(field, reader) {
        return LtbEntry::Held(field.place);
    }
    let DeValue::Table(_) = field.value else { return LtbEntry::Wrong };
    let Some(mut fields) = field.table(reader) else { return LtbEntry::Wrong };
    let mut scalar = |key| fields.take(key).and_then(|field| field.scalar(reader));
    let (length, c1, lambda0, beta) = (scalar("length"), scalar("C1"), scalar("lambda_LT0"), scalar("beta"));
    let mut text = |key| fields.take(key).and_then(|field| field.text(reader));
    let (curve, clause) = (text("curve"), text("clause"));
    fields.finish(reader);
    LtbEntry::Given(Box::new(LtbData { place: field.key_place, length, c1, curve, clause, lambda0, beta }))
}

fn cm(field: &Field, reader: &mut Reader) -> Option<CmEntry> {
    let mut fields = field.table(reader)?;
    let mut scalar = |key| fields.take(key).and_then(|field| field.scalar(reader));
    let (y, z, lt) = (scalar("y"), scalar("z"), scalar("LT"));
    fields.finish(reader);
    Some(CmEntry { place: field.key_place, y, z, lt })
}
