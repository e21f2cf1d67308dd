//! A folder of files, and the program run on them.

use std::fs;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

pub const BOX: &str = include_str!("../../src/sections/examples/box.toml");
/// A girder whose best design argmin finds by a second opinion.
pub const TAPERED: &str = include_str!("../data/tapered.toml");
pub const X: &str = "minimize = \"x\"\n[variables]\nx = { lower = 1, upper = 2 }\ny = { lower = 0, upper = 1 }\n";
pub const TWO: &str = "[tables]\nsections = \"s.csv\"\nribs = \"r.csv\"\n";
pub const SECTIONS: &str = "name,kind,b,h.lower,h.upper\ns0,rectangle,1,1,2\n";
pub const RIBS: &str = "name,section,length\nr0,s0,1\n";
/// Hard enough to keep solvers busy for long.
pub const LONG: &str =
    "minimize = \"sum((x - 0.3)^2) - 0.1*sum(cos(25*x))\"\n[variables]\nx = { size = 40, lower = -5, upper = 5, start = 2.5 }\n";

pub struct Place(pub TempDir);

impl Place {
    pub fn new(files: &[(&str, &str)]) -> Place {
        let place = Place(tempfile::tempdir().expect("a folder"));
        files.iter().for_each(|(name, text)| place.write(name, text));
        place
    }

    pub fn write(&self, name: &str, text: &str) {
        let path = self.0.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a writable folder");
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.path().join(name)).unwrap_or_default()
    }

    pub fn has(&self, name: &str) -> bool {
        self.0.path().join(name).exists()
    }

    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
        command.current_dir(self.0.path()).args(arguments.split_whitespace()).stdin(Stdio::null());
        command
    }

    pub fn run(&self, arguments: &str) -> Output {
        self.command(arguments).output().expect("ribopt runs")
    }

    /// Exit code, standard output, standard error.
    pub fn said(&self, arguments: &str) -> (i32, String, String) {
        let output = self.run(arguments);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
    }

    pub fn json(&self, arguments: &str) -> Value {
        let output = self.run(arguments);
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
    }

    /// A column of a CSV.
    pub fn column(&self, file: &str, name: &str) -> Vec<String> {
        let mut reader = csv::Reader::from_path(self.0.path().join(file)).expect("a table");
        let at = reader.headers().expect("a header").iter().position(|header| header == name).expect("the column");
        reader.records().map(|record| record.expect("a row")[at].to_owned()).collect()
    }
}
