//! The whole program on a problem given as text.

use std::fs;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// The exit code and the result of `ribopt solve` with more arguments.
pub fn solve_with(problem: &str, arguments: &[&str]) -> (i32, Value) {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("problem.toml");
    fs::write(&file, problem).unwrap();
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    command.args(["solve", "--json", "--max-seconds", "60", "--out"]).arg(folder.path().join("out")).arg(&file).args(arguments);
    let output = command.output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    println!("{text}");
    (output.status.code().unwrap(), serde_json::from_str(&text).unwrap())
}

/// The same without more arguments.
pub fn solve(problem: &str) -> (i32, Value) {
    solve_with(problem, &[])
}
