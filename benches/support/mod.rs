//! Problems to measure: the shipped ones, and rows of ribs of any length.
#![allow(dead_code, reason = "each bench target uses a part")]

use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

use ribopt::run::Subject;
use tempfile::TempDir;

/// The shipped problem files, in a fixed order. They live as long as the process, as divan's arguments must.
pub fn problems() -> Vec<&'static str> {
    let entries = fs::read_dir("problems").expect("run from the crate's folder");
    let mut files: Vec<PathBuf> = entries.map(|entry| entry.expect("a readable folder").path()).collect();
    files.retain(|path| path.extension().is_some_and(|extension| extension == "toml"));
    files.sort();
    files.into_iter().map(|path| &*path.display().to_string().leak()).collect()
}

pub fn read(path: impl AsRef<Path>) -> Subject {
    Subject::read(path.as_ref(), &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// A kind of section with the columns of its free dimensions: name, lower bound, upper bound.
pub type Kind = (&'static str, &'static [(&'static str, f64, f64)]);

pub const RECTANGLE: Kind = ("rectangle", &[("b", 0.05, 0.4), ("h", 0.1, 1.2)]);
pub const H_BEAM: Kind = ("h-beam", &[("tw", 0.005, 0.02), ("hw", 0.1, 1.0), ("b", 0.05, 0.4), ("tf", 0.005, 0.05)]);

/// A continuous row of `ribs` ribs, each from one section to the next, with a least stiffness per section: a problem file with
/// its tables in a folder that goes with the value returned.
pub fn row_of_ribs(ribs: usize, (kind, dimensions): Kind) -> (TempDir, PathBuf) {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let mut sections = String::from("name,kind");
    for (name, ..) in dimensions {
        write!(sections, ",{name}.lower,{name}.upper").expect("a string");
    }
    for k in 0..=ribs {
        write!(sections, "\ns{k},{kind}").expect("a string");
        for (_, lower, upper) in dimensions {
            write!(sections, ",{lower},{upper}").expect("a string");
        }
    }
    let row = |k: usize| format!("\nr{k},s{k},s{},{}", k + 1, 2.0 + (k % 7) as f64 / 10.0);
    let table = format!("name,from,to,length{}", (0..ribs).map(row).collect::<String>());
    let problem = "title = \"A row of ribs\"\n[tables]\nsections = \"sections.csv\"\nribs = \"ribs.csv\"\n\
                   [[constraints]]\nname = \"stiff\"\nfor = \"sections\"\nrequire = \"Ix >= 2e-4\"\n";
    let path = folder.path().join("problem.toml");
    for (name, text) in [("sections.csv", sections.as_str()), ("ribs.csv", &table), ("problem.toml", problem)] {
        fs::write(folder.path().join(name), text).expect("a writable folder");
    }
    (folder, path)
}
