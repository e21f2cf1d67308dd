//! The repository stands by itself: no reference leads out of it, and what the pages name is there.

use std::fs;
use std::path::{Path, PathBuf};

/// Pages that lie outside of the repository, by the words comments once pointed to them with.
const OUTSIDE: &[&str] =
    &["SPEC", "FORMULAS", "FIELD-NOTES", "STRUCTURES.md", "STRUCTURES-FORMULAS", "UX.md", "REVIEW.md", "LAYOUT.md"];
const OUTSIDE_PATHS: &[&str] = &["../shared", "/work/", "programming-algorithm"];

/// Where text is searched, from the repository's root.
const PLACES: &[&str] = &[
    "src",
    "docs",
    "tests",
    "examples",
    "benches",
    "fuzz",
    "problems",
    "python",
    "README.md",
    "CHANGELOG.md",
    "CONTRIBUTING.md",
];
const ENDINGS: &[&str] = &["rs", "md", "toml", "py", "csv"];

/// The table of numbers in docs/certificate.md is that of the code.
#[test]
fn what_the_certificate_measures_by_is_written_down() {
    let page = fs::read_to_string(root().join("docs/certificate.md")).unwrap();
    let written: Vec<&str> = page.lines().filter(|line| line.starts_with("| `")).collect();
    let row = |parameter: &ribopt::math::parameters::Parameter| {
        let meaning = parameter.meaning.trim().replace('|', "\\|");
        format!("| `{}.{}` | {} | {meaning} |", parameter.group, parameter.name, (parameter.value)())
    };
    let wanted: Vec<String> = ribopt::report::measured_by::all().map(row).collect();
    let missing: Vec<&str> = wanted.iter().map(String::as_str).filter(|row| !written.contains(row)).collect();
    assert!(missing.is_empty() && written.len() == wanted.len(), "the table should be\n{}", wanted.join("\n"));
}

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn texts() -> Vec<(PathBuf, String)> {
    let (mut found, mut open) = (Vec::new(), PLACES.iter().map(|place| root().join(place)).collect::<Vec<_>>());
    while let Some(path) = open.pop() {
        if path.is_dir() && !path.ends_with("target") && !path.ends_with("node_modules") {
            open.extend(fs::read_dir(path).unwrap().map(|entry| entry.unwrap().path()));
        } else if path.extension().is_some_and(|ending| ENDINGS.iter().any(|known| ending == *known)) {
            found.push((path.clone(), fs::read_to_string(path).unwrap_or_default()));
        }
    }
    found
}

#[test]
fn no_reference_leads_out_of_the_repository() {
    let mut wrong = Vec::new();
    for (path, text) in texts().into_iter().filter(|(path, _)| !path.ends_with("tests/repository/documentation.rs")) {
        for (number, line) in text.lines().enumerate() {
            let mut words =
                line.split(|c: char| !(c.is_ascii_alphanumeric() || "-_.".contains(c))).map(|word| word.trim_matches('.'));
            let named = words.any(|word| OUTSIDE.contains(&word)) || OUTSIDE_PATHS.iter().any(|outside| line.contains(outside));
            if named {
                wrong.push(format!("{}:{}: {line}", path.strip_prefix(root()).unwrap().display(), number + 1));
            }
        }
    }
    assert!(wrong.is_empty(), "references that lead out of the repository:\n{}", wrong.join("\n"));
}

/// Files and folders of the repository that stand in backquotes or links of the pages.
#[test]
fn every_file_the_pages_name_is_there() {
    let mut missing = Vec::new();
    for (page, text) in texts().into_iter().filter(|(path, _)| path.extension().is_some_and(|ending| ending == "md")) {
        for word in text.split(|c: char| c.is_whitespace() || "`()[]<>,;".contains(c)) {
            let name = word.trim_end_matches(['.', ':']).trim_start_matches("../");
            let is_path = ["src/", "tests/", "docs/", "benches/"].iter().any(|folder| name.starts_with(folder));
            let is_pattern = name.contains('*') || name.contains('…') || name.contains('#') || name.contains('{');
            if is_path && !is_pattern && !root().join(name).exists() {
                missing.push(format!("{}: {name}", page.strip_prefix(root()).unwrap().display()));
            }
        }
    }
    assert!(missing.is_empty(), "named but not there:\n{}", missing.join("\n"));
}

/// Links from page to page.
#[test]
fn links_between_pages_lead_somewhere() {
    let mut broken = Vec::new();
    for (page, text) in texts().into_iter().filter(|(path, _)| path.extension().is_some_and(|ending| ending == "md")) {
        for (at, _) in text.match_indices("](") {
            let target = text[at + 2..].split([')', '#', ' ']).next().unwrap();
            let here = page.parent().unwrap().join(target);
            if !target.is_empty() && !target.contains("://") && !here.exists() {
                broken.push(format!("{}: {target}", page.strip_prefix(root()).unwrap().display()));
            }
        }
    }
    assert!(broken.is_empty(), "links that lead nowhere:\n{}", broken.join("\n"));
}
