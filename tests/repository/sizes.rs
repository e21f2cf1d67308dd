//! Files and functions stay short enough to be read at once.

use std::fs;
use std::path::{Path, PathBuf};

use super::rust_files;

/// Lines of a file, tests and comments included.
const LONGEST_FILE: usize = 300;
/// Lines of a function, signature and closing brace included.
const LONGEST_FUNCTION: usize = 60;

#[test]
fn no_file_is_longer_than_300_lines() {
    let long: Vec<String> = sources()
        .iter()
        .map(|(path, text)| (path, text.lines().count()))
        .filter(|(_, lines)| *lines > LONGEST_FILE)
        .map(|(path, lines)| format!("{}: {lines}", path.display()))
        .collect();
    assert!(long.is_empty(), "split these by subject:\n{}", long.join("\n"));
}

#[test]
fn no_function_is_longer_than_60_lines() {
    let mut long = Vec::new();
    for (path, text) in sources() {
        for (name, first, lines) in functions(&text).into_iter().filter(|(_, _, lines)| *lines > LONGEST_FUNCTION) {
            long.push(format!("{}:{first}: {name}, {lines} lines", path.display()));
        }
    }
    assert!(long.is_empty(), "split these by subject:\n{}", long.join("\n"));
}

#[test]
fn functions_are_counted_from_the_signature_to_the_brace() {
    let text = "fn short() {}\n\nimpl A {\n    pub(super) const fn two(\n        a: u8,\n    ) -> u8 {\n        a\n    }\n\n    fn declared(&self);\n}\n";
    let counted: Vec<(String, usize)> = functions(text).into_iter().map(|(name, _, lines)| (name, lines)).collect();
    assert_eq!(counted, [("short".to_owned(), 1), ("two".to_owned(), 5), ("declared".to_owned(), 1)]);
}

/// Name, first line and number of lines of every function, as rustfmt lays them out: the closing brace stands under the signature.
fn functions(text: &str) -> Vec<(String, usize, usize)> {
    let lines: Vec<&str> = text.lines().collect();
    let mut found = Vec::new();
    for (at, line) in lines.iter().enumerate() {
        let indent = &line[..line.len() - line.trim_start().len()];
        let Some(name) = declared(line.trim_start()) else { continue };
        let ends = |line: &&str| {
            let rest = line.strip_prefix(indent);
            rest == Some("}") || (rest.is_some_and(|rest| !rest.starts_with(' ')) && (line.ends_with(';') || line.ends_with('}')))
        };
        let last = lines[at..].iter().position(ends).unwrap_or(0);
        found.push((name.to_owned(), at + 1, last + 1));
    }
    found
}

/// The name of the function a line begins, if it begins one.
fn declared(line: &str) -> Option<&str> {
    let (before, after) = line.split_once("fn ")?;
    let words = before.split_whitespace();
    let is_signature = words.clone().all(|word| {
        word.starts_with("pub")
            || ["const", "unsafe", "async", "extern", "\"C\"", "in", "super)", "super::super)"].contains(&word)
            || word.ends_with(')')
    });
    let end = after.find(|c: char| !(c.is_alphanumeric() || c == '_'))?;
    (is_signature && end > 0).then(|| &after[..end])
}

fn sources() -> Vec<(PathBuf, String)> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let folders = ["src", "tests", "examples", "benches", "python/src"].map(|folder| root.join(folder));
    let with_text = |path: PathBuf| (path.strip_prefix(root).unwrap().to_owned(), fs::read_to_string(&path).unwrap());
    rust_files(folders).into_iter().map(with_text).collect()
}
