//! `[[constraints]]`.

use crate::expression::ast::Collection;
use crate::input::declaration::{ConstraintEntry, Name};
use crate::input::fields::{Field, Fields, Reader};
use crate::input::source::Written;
use crate::problem::mistake_code::MistakeCode;

/// One constraint.
pub(super) fn constraint(mut fields: Fields, reader: &mut Reader) -> ConstraintEntry {
    let place = fields.place;
    let mut text = |key| fields.take(key).and_then(|field: Field| field.text(reader));
    let name = text("name").map(|written| Name { text: written.text, place: written.place });
    let repeated = text("for");
    let (kind, filter, by) = (text("kind"), text("where"), text("by"));
    let only = fields.take("only").map(|field| field.texts(reader)).unwrap_or_default();
    let cases = fields.take("cases").map(|field| field.texts(reader)).unwrap_or_default();
    let what = name.as_ref().map_or("a constraint".to_owned(), |name| format!("constraint `{}`", name.text));
    let require = fields.require("require", &what, reader).and_then(|field| field.text(reader));
    fields.finish(reader);
    let (index, repeated) = match repeated {
        Some(written) if written.text.contains(" in ") => (Some(written), None),
        repeated => (None, repeated),
    };
    let scoped = repeated.is_some();
    let repeated = repeated.and_then(|written| collection(&written, reader));
    if !scoped {
        let filters = [&kind, &filter, &by].into_iter().flatten().chain(&only);
        for written in filters {
            let help = "add for = \"sections\" or for = \"ribs\"";
            reader.findings.mistake(
                MistakeCode::Scope,
                written.place,
                format!("{what} chooses among items, but has no `for`"),
                help,
            );
        }
    }
    // With a wrong `for` nothing is known of the names that hold.
    let require = require.filter(|_| !scoped || repeated.is_some());
    ConstraintEntry { name, place, repeated, index, only, kind, filter, by, cases, require }
}

fn collection(written: &Written, reader: &mut Reader) -> Option<Collection> {
    match written.text.as_str() {
        "ribs" => Some(Collection::Ribs),
        "sections" => Some(Collection::Sections),
        "nodes" => Some(Collection::Nodes),
        other => {
            let message = format!("`for` is \"{other}\"");
            reader.findings.mistake(
                MistakeCode::UnknownChoice,
                written.place,
                message,
                "expected \"sections\", \"ribs\", \"nodes\" or \"i in 1..N\"",
            );
            None
        }
    }
}
