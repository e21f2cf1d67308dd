//! The program on a folder of files, and what it says.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// A 4×3 grid as OBJ, its squares of size 1; `edit` changes the lines.
pub fn grid(edit: impl Fn(&mut Vec<String>)) -> String {
    let vertices = (0..4).flat_map(|y| (0..5).map(move |x| format!("v {x} {y} 0")));
    let quad =
        |x: usize, y: usize| [5 * y + x, 5 * y + x + 1, 5 * y + x + 6, 5 * y + x + 5].map(|v| (v + 1).to_string()).join(" ");
    let faces = (0..3).flat_map(|y| (0..4).map(move |x| (x, y))).map(|(x, y)| format!("f {}", quad(x, y)));
    let mut lines: Vec<String> = vertices.chain(faces).collect();
    edit(&mut lines);
    lines.join("\n") + "\n"
}

/// An empty folder with these files.
pub fn folder(files: &[(&str, String)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

/// Where the smallest files of each kind are.
pub fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mesh").join(name)
}

/// Runs it; `DATA/` is the folder of [`data`].
pub fn ribopt(folder: &Path, arguments: &str) -> Output {
    let data = data("");
    let words = arguments.split_whitespace().map(|word| word.replace("DATA/", data.to_str().unwrap()));
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    let output = command.current_dir(folder).args(words).stdin(Stdio::null()).output().unwrap();
    assert!(!err(&output).contains("panicked"), "{arguments}: {}", err(&output));
    output
}

/// The JSON of a stage that ends with this exit code.
pub fn report(folder: &Path, arguments: &str, code: i32) -> Value {
    let output = ribopt(folder, &format!("{arguments} --json"));
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}{}", out(&output), err(&output));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{arguments}: {error}: {}", out(&output)))
}

pub fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

pub fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

pub fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} is no number in {value}"))
}

pub fn near(a: f64, b: f64) -> bool {
    within(a, b, 1e-9)
}

/// Relatively.
pub fn within(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * b.abs()
}

/// What a stage says, exit code and standard error included.
pub fn said(files: &[(&str, String)], arguments: &str) -> String {
    let folder = folder(files);
    let output = ribopt(folder.path(), arguments);
    format!("exit code {}\n{}{}", output.status.code().unwrap(), out(&output), err(&output))
}

/// Lines, closed ones and edges.
pub fn traced(folder: &Path, arguments: &str) -> [f64; 3] {
    let found = report(folder, &format!("mesh trace {arguments}"), 0);
    ["/lines", "/closed", "/edges"].map(|name| number(&found, name))
}
