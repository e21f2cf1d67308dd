//! The house keeps its order: every `use crate::` goes strictly down.

use std::fs;
use std::path::{Path, PathBuf};

use super::rust_files;

/// Rooms from the top of the house to the ground; a room may use those on lower floors only.
const FLOORS: &[&[&str]] = &[
    &["main"],
    &["cli", "api"],
    &["study"],
    &["run"],
    &["input", "report", "log"],
    &["crosscheck", "discrete"],
    &["backends", "certificate"],
    &["recession", "solvers"],
    &["model"],
    &["problem"],
    &["mesh", "structure"],
    &["ribs"],
    &["sections"],
    &["geometry", "splines", "expression"],
    &["linear_algebra"],
    &["math", "files", "units"],
];

/// Arrows between rooms of one floor that the sketch allows.
const SIDEWAYS: &[(&str, &str)] = &[("report", "log"), ("geometry", "splines")];

/// Libraries and the only rooms that may name them.
const LIBRARIES: &[(&str, &[&str])] = &[
    ("nlopt", &["backends/nlopt"]),
    ("argmin", &["backends/argmin"]),
    ("toml", &["input", "study"]),
    ("clap", &["cli"]),
    ("clap_complete", &["cli"]),
    ("clap_mangen", &["cli"]),
    ("ctrlc", &["cli"]),
    ("csv", &["input", "log", "report", "mesh", "study"]),
    ("feral", &["linear_algebra"]),
    ("maud", &["report"]),
    ("rust_xlsxwriter", &["report"]),
];

#[test]
fn arrows_point_down() {
    let mut wrong = Vec::new();
    for (file, room) in sources() {
        let Some(floor) = floor_of(&room) else { continue };
        for (line, other) in used_rooms(&file) {
            let down = floor_of(&other).is_none_or(|below| below > floor);
            if other != room && !down && !SIDEWAYS.contains(&(room.as_str(), other.as_str())) {
                wrong.push(format!("{}:{line}: {room} uses {other}", file.display()));
            }
        }
    }
    assert!(wrong.is_empty(), "arrows that point up:\n{}", wrong.join("\n"));
}

#[test]
fn every_room_has_its_floor() {
    for (file, room) in sources() {
        assert!(room == "lib" || floor_of(&room).is_some(), "{}: room {room} is on no floor", file.display());
    }
}

#[test]
fn libraries_stay_in_their_rooms() {
    let mut wrong = Vec::new();
    for (file, _) in sources() {
        let path = file.strip_prefix(source_folder()).unwrap().to_string_lossy().replace('\\', "/");
        for (number, line) in fs::read_to_string(&file).unwrap().lines().enumerate() {
            let code = line.split("//").next().unwrap();
            for (library, rooms) in LIBRARIES {
                let named = code.contains(&format!("use {library}::")) || code.contains(&format!("use {library} as"));
                if named && !rooms.iter().any(|room| path.starts_with(room)) {
                    wrong.push(format!("{path}:{}: {library}", number + 1));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "libraries out of their rooms:\n{}", wrong.join("\n"));
}

#[test]
fn unsafe_stands_in_the_one_file_that_speaks_to_nlopt() {
    for (file, _) in sources() {
        let text = fs::read_to_string(&file).unwrap();
        let has = text.lines().any(|line| line.split("//").next().unwrap().contains("unsafe "));
        assert!(!has || file.ends_with("backends/nlopt/ffi.rs"), "unsafe in {}", file.display());
    }
}

fn source_folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("src")
}

/// Every source file with its room: the first part of its path below src.
fn sources() -> Vec<(PathBuf, String)> {
    let root = source_folder();
    let with_room = |path: PathBuf| {
        let first = path.strip_prefix(&root).unwrap().components().next().unwrap();
        let room = Path::new(first.as_os_str()).file_stem().unwrap().to_string_lossy().into_owned();
        (path, room)
    };
    rust_files([source_folder()]).into_iter().map(with_room).collect()
}

fn floor_of(room: &str) -> Option<usize> {
    FLOORS.iter().position(|floor| floor.contains(&room))
}

/// Rooms named after `crate::` in the code (tests included, documentation not), with line numbers.
fn used_rooms(file: &Path) -> Vec<(usize, String)> {
    let text = fs::read_to_string(file).unwrap();
    let mut used = Vec::new();
    for (number, line) in text.lines().enumerate() {
        let code = line.split("//").next().unwrap();
        for (at, _) in code.match_indices("crate::") {
            let rest = &code[at + "crate::".len()..];
            let names: Vec<&str> = match rest.strip_prefix('{') {
                Some(list) => list.split(['}', ',']).map(str::trim).collect(),
                None => vec![rest],
            };
            for name in names {
                let end = name.find(|c: char| !c.is_alphanumeric() && c != '_').unwrap_or(name.len());
                used.push((number + 1, name[..end].to_string()));
            }
        }
    }
    used
}
