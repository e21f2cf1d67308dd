//! The shipped problem files read without a mistake or warning and say where they come from and what is known of their optimum.

use std::fs;
use std::path::PathBuf;

fn problem_files() -> Vec<PathBuf> {
    let entries = fs::read_dir("problems").expect("the folder of problems");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files
}

#[test]
fn each_reads_without_a_mistake_or_warning() {
    let files = problem_files();
    assert!(files.len() >= 10);
    for path in files {
        let input = ribopt::input::read(&path).unwrap_or_else(|mistakes| panic!("{mistakes}"));
        assert!(input.warnings.is_empty(), "{}: {:?}", path.display(), input.problem.warnings);
        assert_eq!(input.sha256.len(), 64);
    }
}

#[test]
fn each_names_its_source_and_its_optimum() {
    for path in problem_files() {
        let text = fs::read_to_string(&path).expect("a readable file");
        assert!(text.lines().any(|line| line.starts_with("# Source: ")), "{} names no source", path.display());
        let optimum = text.lines().find_map(|line| line.strip_prefix("# optimum: "));
        let optimum = optimum.unwrap_or_else(|| panic!("{} says nothing of its optimum", path.display()));
        assert!(optimum == "?" || optimum.parse::<f64>().is_ok(), "{}: optimum {optimum}", path.display());
    }
}
