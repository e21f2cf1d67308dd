//! `[solver]`.

use crate::input::fields::{Field, Fields, Reader};
use crate::input::source::Written;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::settings::{AUTO, BACKENDS, BackendNames, Settings};
use crate::problem::words::brief;

/// The table's values, each checked; what is left out keeps its default.
pub(super) fn settings(mut fields: Fields, settings: &mut Settings, reader: &mut Reader) {
    if let Some(field) = fields.take("backends") {
        settings.backends = backends(&field, reader);
    }
    tolerance(&mut fields, "optimality_tolerance", &mut settings.optimality_tolerance, reader);
    tolerance(&mut fields, "step_tolerance", &mut settings.step_tolerance, reader);
    tolerance(&mut fields, "constraint_tolerance", &mut settings.constraint_tolerance, reader);
    count(&mut fields, "max_iterations", &mut settings.max_iterations, reader);
    count(&mut fields, "max_evaluations", &mut settings.max_evaluations, reader);
    if let Some(field) = fields.take("max_seconds") {
        let not_negative = |value: f64| value >= 0.0;
        settings.max_seconds =
            checked(&field, not_negative, "a number of seconds, 0 or more", reader).unwrap_or(settings.max_seconds);
    }
    for backend in BACKENDS {
        if let Some(name) = algorithm(&mut fields, backend, reader) {
            settings.algorithms.insert(backend.name.to_owned(), name);
        }
    }
    fields.finish(reader);
}

fn backends(field: &Field, reader: &mut Reader) -> Vec<String> {
    let all: Vec<&str> = BACKENDS.iter().map(|backend| backend.name).collect();
    let mut names: Vec<String> = Vec::new();
    for written in field.texts(reader) {
        if known(&written, "backend", &all, reader) && !names.contains(&written.text) {
            names.push(written.text);
        }
    }
    names
}

fn tolerance(fields: &mut Fields, key: &'static str, target: &mut f64, reader: &mut Reader) {
    if let Some(field) = fields.take(key) {
        let inside = |value: f64| value > 0.0 && value < 1.0;
        *target = checked(&field, inside, "a number between 0 and 1, neither of them, such as 1e-6", reader).unwrap_or(*target);
    }
}

fn count(fields: &mut Fields, key: &'static str, target: &mut u64, reader: &mut Reader) {
    if let Some(field) = fields.take(key) {
        let whole = |value: f64| value >= 1.0 && value.fract() == 0.0 && value <= 1e15;
        *target = checked(&field, whole, "a whole number from 1", reader).map_or(*target, |value| value as u64);
    }
}

/// The field's number, if it lies in its range.
fn checked(field: &Field, allowed: impl Fn(f64) -> bool, what: &str, reader: &mut Reader) -> Option<f64> {
    let value = field.number(reader)?;
    if !allowed(value) {
        let message = format!("`{}` cannot be {}", field.key, brief(value));
        reader.findings.mistake(MistakeCode::OutOfRange, field.place, message, format!("expected {what}"));
        return None;
    }
    Some(value)
}

/// The algorithm that a backend's own table asks for.
fn algorithm(fields: &mut Fields, backend: &BackendNames, reader: &mut Reader) -> Option<String> {
    let mut table = fields.take(backend.name).and_then(|field| field.table(reader))?;
    let names: Vec<&str> = [AUTO].iter().chain(backend.algorithms).copied().collect();
    let chosen = table.take("algorithm").and_then(|field| field.text(reader));
    let chosen = chosen.filter(|written| known(written, "algorithm", &names, reader));
    table.finish(reader);
    chosen.map(|written| written.text)
}

/// Whether the name is one of the list; a mistake otherwise.
fn known(written: &Written, what: &str, names: &[&str], reader: &mut Reader) -> bool {
    let found = names.contains(&written.text.as_str());
    if !found {
        let near = did_you_mean(&written.text, names.iter().copied());
        let help = near.unwrap_or_else(|| format!("known: {}", names.join(", ")));
        reader.findings.mistake(MistakeCode::UnknownChoice, written.place, format!("unknown {what} `{}`", written.text), help);
    }
    found
}
