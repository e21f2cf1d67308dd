//! The JSON Schema before a validator that is not ours: what is right passes, and each mistake is told once.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use serde_json::Value;

fn validator() -> jsonschema::Validator {
    jsonschema::validator_for(&ribopt::input::schema()).expect("a schema")
}

/// A TOML text as the JSON that editors hold against the schema.
fn json(text: &str) -> Value {
    let table = toml::from_str::<toml::Table>(text).unwrap_or_else(|error| panic!("{error}\n{text}"));
    let mut value = serde_json::to_value(table).unwrap();
    finite(&mut value);
    value
}

/// JSON has no infinity, which becomes null: a number stands for it.
fn finite(value: &mut Value) {
    match value {
        Value::Null => *value = Value::from(1e308),
        Value::Array(list) => list.iter_mut().for_each(finite),
        Value::Object(map) => map.values_mut().for_each(finite),
        _ => {}
    }
}

/// What the validator says, a line a message.
fn said(validator: &jsonschema::Validator, text: &str) -> Vec<String> {
    validator.iter_errors(&json(text)).map(|error| format!("{}: {error}", error.instance_path())).collect()
}

fn files(folder: &str) -> Vec<PathBuf> {
    let mut found: Vec<PathBuf> = fs::read_dir(Path::new(env!("CARGO_MANIFEST_DIR")).join(folder))
        .unwrap()
        .map(|entry| entry.unwrap().path())
        .filter(|path| path.extension().is_some_and(|ending| ending == "toml"))
        .collect();
    found.sort();
    found
}

#[test]
fn what_is_right_passes() {
    let validator = validator();
    for path in ["problems", "tests/extra", "examples/language", "examples/lists"].into_iter().flat_map(files) {
        let said = said(&validator, &fs::read_to_string(&path).unwrap());
        assert!(said.is_empty(), "{}:\n{}", path.display(), said.join("\n"));
    }
    for name in ribopt::input::examples() {
        let said = said(&validator, &ribopt::input::example(Some(name)).unwrap());
        assert!(said.is_empty(), "{name}:\n{}", said.join("\n"));
    }
}

/// Files with as many mistakes as the number says, which is how many messages there are.
const COUNTS: &[(usize, &str)] = &[
    // A misspelt key in each of three sections of other kinds: 15 messages once, and 140.
    (
        3,
        r#"
        [sections]
        a = { kind = "rectangle", b = { lowr = 0.1 }, h = 0.3 }
        b = { kind = "h-beam", tw = 0.01, b = 0.2, hw = 0.3, tf = { lower = 0.01, uper = 0.02 } }
        c = { kind = "box", b = 0.2, h = { lower = 0.2, step = true }, tw = 0.01, tf = 0.01 }
        "#,
    ),
    (1, r#"sections.a = { kind = "rectangel", b = 1, h = 2 }"#),
    (1, r#"sections.a = { b = 1, h = 2 }"#),
    (1, r#"sections.a = { kind = "rectangle", b = 1 }"#),
    (1, r#"sections.a = { kind = "rectangle", b = 1, h = 2, t = 3 }"#),
    // An H beam by hw and tf, by h and hw, and in the note's names, each with one dimension missing.
    (1, r#"sections.a = { kind = "h-beam", tw = 0.01, b = 0.2, hw = 0.3 }"#),
    (1, r#"sections.a = { kind = "h-beam", tw = 0.01, h = 0.2, hw = 0.3 }"#),
    (1, r#"sections.a = { kind = "h-beam", b1 = 0.01, b2 = 0.2, h1 = 0.3 }"#),
    (1, r#"sections.a = { kind = "catalogue" }"#),
    (1, r#"catalogues.ipe = { fil = "ipe.csv", file = "ipe.csv" }"#),
    (1, r#"catalogues.ipe = 3"#),
    (2, r#"ribs = [{ name = "r", from = "a", length = 3 }, { name = "q", section = "a" }]"#),
    (1, r#"ribs = [{ name = "r", section = "a", from = "a", length = 3 }]"#),
    (1, r#"ribs = [{ name = "r", section = "a", start = "n" }]"#),
    (
        2,
        r#"ribs = [{ name = "r", section = "a", length = 3, hinges = "all" }, { name = "q", section = "a", length = 3, hinges = { star = "My" } }]"#,
    ),
    (2, r#"nodes = { a = [1], b = { at = [1, 2], date = 3 } }"#),
    (3, r#"supports = { a = "pined", b = ["q"], c = { fixed = "pinned" } }"#),
    (1, r#"supports.a = { fix = "pined" }"#),
    (1, r#"checks = [{ code = "Euler", ribs = "*", cases = "*", buckling = { y = "hold", z = "held" } }]"#),
    (1, r#"checks = [{ code = "Euler", ribs = "*", cases = "*", buckling = { y = { lenth = 3, length = 2 }, z = "held" } }]"#),
    (
        1,
        r#"checks = [{ code = "Euler", ribs = "*", cases = "*", buckling = { y = "held", z = "held" }, ltb = { length = 2, C1 = 1 } }]"#,
    ),
    (2, "minimize = 3\nvariables.x = { lower = true }"),
    (1, "minimize = \"x\"\nmaximize = \"x\""),
    (1, "solver.nlopt.algorithm = \"slsp\""),
];

#[test]
fn each_mistake_is_told_once() {
    let validator = validator();
    for (count, text) in COUNTS {
        let said = said(&validator, text);
        assert_eq!(said.len(), *count, "{text}\n{}", said.join("\n"));
    }
}

/// The schema complains of no more keys of a file with mistakes than the reader does: keys that one table lacks are one mistake there, and
/// so is all that is wrong within one value.
#[test]
fn bad_files_have_no_more_messages_than_mistakes() {
    let validator = validator();
    for path in files("tests/bad") {
        let Ok(text) = fs::read_to_string(&path) else { continue };
        if toml::from_str::<toml::Table>(&text).is_err() {
            continue;
        }
        let instance = json(&text);
        let places = validator.iter_errors(&instance).map(|error| {
            let place = error.instance_path().to_string();
            place.split('/').take(4).collect::<Vec<_>>().join("/")
        });
        let places: BTreeSet<String> = places.collect();
        let mistakes = ribopt::input::read(&path).unwrap_err();
        assert!(places.len() <= mistakes.list.len(), "{}: {places:?}\nbeside\n{mistakes}", path.display());
    }
}
