//! `ribopt compare` with every algorithm of NLopt's and argmin's over problems/ and, where it is there, the benchmark collection;
//! Dolan–Moré profiles as CSV and SVG in benches/results/profiles.
//!
//! `RIBOPT_BENCHMARKS` names the folder with benchmarks.json and to_toml.py; without it problems/ are run alone.

use std::env;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, ExitCode};

/// Of all algorithms together on one problem; global ones would search for ever.
const SECONDS_PER_PROBLEM: &str = "10";

fn main() -> ExitCode {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut files = problem_files(Path::new("problems"));
    let collection = PathBuf::from(env::var_os("RIBOPT_BENCHMARKS").unwrap_or_default());
    if collection.join("benchmarks.json").exists() {
        let mut convert = Command::new("python3");
        convert.arg(collection.join("to_toml.py")).arg(collection.join("benchmarks.json")).arg(folder.path());
        let converted = convert.status().is_ok_and(|status| status.success());
        assert!(converted, "{} could not be run", collection.join("to_toml.py").display());
        // Written wrong on purpose: its bounds cross.
        files.extend(problem_files(folder.path()).into_iter().filter(|path| !path.ends_with("inf_bounds.toml")));
    } else {
        eprintln!("no collection named by RIBOPT_BENCHMARKS: problems/ alone");
    }
    let mut compare = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    compare.args(["compare", "--profile", "benches/results/profiles", "--max-seconds", SECONDS_PER_PROBLEM]).args(files);
    let succeeded = compare.status().is_ok_and(|status| status.success());
    if succeeded { ExitCode::SUCCESS } else { ExitCode::FAILURE }
}

fn problem_files(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).expect("a readable folder");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}
