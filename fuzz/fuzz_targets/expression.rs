//! Any text as an expression, a requirement and a condition; what parses is resolved, compiled and evaluated.
#![no_main]

mod exercise;

use std::fmt::Write;
use std::path::PathBuf;
use std::sync::LazyLock;

use libfuzzer_sys::fuzz_target;
use ribopt::expression::parse::{SyntaxError, parse, parse_condition, parse_requirement};

static PATH: LazyLock<PathBuf> = LazyLock::new(|| exercise::folder().join("expression.toml"));

/// Names for the text to use, whatever it is.
const AROUND: &str = r#"
[parameters]
p = [0.5, 2, 3]
n = 2
[variables]
x = { size = 3, lower = 0.1, upper = 9, start = [1, 2, 3] }
y = { lower = -2, upper = 5 }
z = {}
[sections.a]
kind = "rectangle"
b = { lower = 0.05, upper = 0.40, start = 0.20 }
h = "2*b"
data = { k = 0.5, line = "L0" }
[sections.c]
kind = "rectangle"
b = { lower = 0.05, upper = 0.40 }
h = 0.5
data = { k = 2, line = "L1" }
[[ribs]]
name = "r"
from = "a"
to = "c"
length = 3.0
data = { c = 1.2, line = "L0" }
"#;

fuzz_target!(|text: &str| {
    let expression = has_good_places(text, parse(text));
    let requirement = has_good_places(text, parse_requirement(text));
    let condition = has_good_places(text, parse_condition(text));
    let quoted = quoted(text);
    if expression {
        solve_like(&format!("minimize = {quoted}\n{AROUND}[definitions]\nd = {quoted}\n"));
    }
    if requirement {
        solve_like(&format!(
            "minimize = \"volume\"\n{AROUND}[[constraints]]\nname = \"one\"\nrequire = {quoted}\n\
             [[constraints]]\nname = \"each\"\nfor = \"sections\"\nrequire = {quoted}\n"
        ));
    }
    if condition {
        solve_like(&format!(
            "minimize = \"volume\"\n{AROUND}[[constraints]]\nname = \"some\"\nfor = \"sections\"\nwhere = {quoted}\nrequire = \"h <= 8*b\"\n"
        ));
    }
});

/// Whether it parsed; every mistake's place must lie in the text.
fn has_good_places<T>(text: &str, outcome: Result<T, Vec<SyntaxError>>) -> bool {
    let Err(mistakes) = outcome else { return true };
    assert!(!mistakes.is_empty());
    for mistake in mistakes {
        assert!(text.get(mistake.span.start..mistake.span.end).is_some(), "{mistake:?} is outside the text");
    }
    false
}

fn solve_like(file: &str) {
    std::fs::write(&*PATH, file).expect("a writable folder");
    exercise::exercise(&PATH);
}

/// The text as a TOML string.
fn quoted(text: &str) -> String {
    let mut out = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => out.extend(['\\', c]),
            c if c.is_control() => write!(out, "\\u{:04X}", u32::from(c)).expect("text takes text"),
            c => out.push(c),
        }
    }
    out + "\""
}
