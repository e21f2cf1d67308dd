//! The whole program: exit codes, files, what stands on standard output and what does not.

mod documents;
mod files;
mod verdicts;

use std::fs::{self, File};
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// One tapered rib of rectangles with a stiffness and a slenderness limit.
const RIB: &str = r#"
title = "One rib"
units = { length = "m" }

[sections.left]
kind = "rectangle"
b = { lower = 0.05, upper = 0.4, start = 0.2 }
h = { lower = 0.1, upper = 0.6, start = 0.3 }

[sections.right]
kind = "rectangle"
b = { lower = 0.05, upper = 0.4, start = 0.2 }
h = { lower = 0.1, upper = 0.6, start = 0.3 }

[[ribs]]
name = "only"
from = "left"
to = "right"
length = 3.0

[[constraints]]
name = "stiff"
require = "left.Ix >= 1e-4"

[[constraints]]
name = "slender"
for = "sections"
require = "h <= 4*b"
"#;

/// The note's H beam given by web height and overall height.
const H_BEAM: &str = r#"
[sections.s]
kind = "h-beam"
b1 = { lower = 5, upper = 20 }
h1 = { lower = 50, upper = 100 }
b2 = { lower = 50, upper = 120 }
h2 = { lower = 110, upper = 200 }

[[ribs]]
name = "only"
section = "s"
length = 1.0
"#;

/// Hard enough to keep a solver busy until it is interrupted.
const LONG: &str = r#"
minimize = "sum((x - 0.3)^2) - 0.1*sum(cos(25*x))"
[variables]
x = { size = 40, lower = -5, upper = 5, start = 2.5 }
"#;

/// A folder with one problem file, `rib.toml`.
fn folder(problem: &str) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("rib.toml"), problem).unwrap();
    folder
}

fn command(folder: &Path, arguments: &str) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    command.current_dir(folder).args(arguments.split_whitespace()).stdin(Stdio::null());
    command
}

fn ribopt(folder: &TempDir, arguments: &str) -> Output {
    command(folder.path(), arguments).output().unwrap()
}

fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn json(output: &Output) -> Value {
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{error}: {}", out(output)))
}

#[test]
fn the_summary_reads_well() {
    let folder = folder(RIB);
    let text = out(&ribopt(&folder, "solve rib.toml --backend argmin"));
    // The table of backends holds timings; the gap to the lower bound is rounding, different from machine to machine.
    let untimed = text.split("\n\n").filter(|paragraph| !paragraph.contains("seconds")).collect::<Vec<_>>().join("\n\n");
    insta::assert_snapshot!(untimed.lines().filter(|line| !line.starts_with("within ")).collect::<Vec<_>>().join("\n"));
}

#[test]
fn without_a_terminal_there_are_no_control_characters() {
    let output = ribopt(&folder(RIB), "solve rib.toml");
    for text in [out(&output), err(&output)] {
        assert!(text.chars().all(|c| c == '\n' || !c.is_control()), "{text}");
    }
}

#[test]
fn json_is_the_only_thing_on_standard_output() {
    let folder = folder(RIB);
    let output = ribopt(&folder, "solve rib.toml --json");
    let value = json(&output);
    assert_eq!((value["format"].as_str(), value["status"].as_str()), (Some("ribopt-result/1"), Some("certified")));
    assert_eq!(value["problem"]["sha256"].as_str().unwrap().len(), 64);
    assert_eq!(output.stdout, fs::read(folder.path().join("results/rib/result.json")).unwrap());
    let quiet = ribopt(&folder, "solve rib.toml --quiet");
    assert_eq!((code(&quiet), quiet.stdout.len()), (0, 0));
}

#[test]
fn messages_of_a_wrong_command_line() {
    let folder = folder(RIB);
    let told = |arguments: &str| format!("$ ribopt {arguments}\n{}", err(&ribopt(&folder, arguments)));
    insta::assert_snapshot!(
        [
            "solve rib.toml --algorithm simplex --backend argmin",
            "solve rib.toml --out /dev/null/results",
            "solve rib.toml --start missing.json",
            "solve rib.toml --optimality-tolerance 2",
        ]
        .map(told)
        .join("\n")
    );
}

#[test]
fn an_answer_verifies_and_another_point_does_not() {
    let folder = folder(RIB);
    assert_eq!(code(&ribopt(&folder, "solve rib.toml")), 0);
    let good = ribopt(&folder, "verify rib.toml results/rib/result.json");
    assert_eq!(code(&good), 0, "{}", out(&good));
    fs::write(folder.path().join("point.csv"), "name,value\nleft.b,0.2\nleft.h,0.3\nright.b,0.2\nright.h,0.3\n").unwrap();
    let poor = ribopt(&folder, "verify rib.toml point.csv --json");
    assert_eq!((code(&poor), json(&poor)["status"].as_str()), (1, Some("uncertified")));
    let again = ribopt(&folder, "solve rib.toml --start results/rib/result.json --out again");
    assert_eq!(code(&again), 0, "{}", err(&again));
}

#[test]
fn changes_of_the_command_line_count() {
    let folder = folder(RIB);
    let objective = |arguments: &str| json(&ribopt(&folder, arguments))["objective"].as_f64().unwrap();
    let given = objective("solve rib.toml --json");
    assert!(objective("solve rib.toml --json --set left.b.lower=0.1 --set left.h.upper=0.2") > given * 1.01);
}

#[test]
fn rectangles_end_at_lower_bounds_and_the_web_of_an_h_does_not() {
    let rectangles = ribopt(&folder(RIB), "bounds rib.toml --strict");
    assert_eq!(code(&rectangles), 0, "{}", out(&rectangles));
    let beam = folder(H_BEAM);
    let output = ribopt(&beam, "bounds rib.toml");
    assert_eq!(code(&output), 0, "{}", out(&output));
    assert!(out(&output).contains("a taller web takes the place of flange"), "{}", out(&output));
    insta::assert_snapshot!(out(&output));
    assert_eq!(code(&ribopt(&beam, "bounds rib.toml --strict")), 1);
}

#[test]
fn check_tells_class_sizes_and_derivatives() {
    let output = ribopt(&folder(RIB), "check rib.toml");
    assert_eq!(code(&output), 0, "{}{}", out(&output), err(&output));
    for part in ["class: ", "4 variables", "3 constraint rows", "0 disagree", "worst: "] {
        assert!(out(&output).contains(part), "{part}: {}", out(&output));
    }
}

#[test]
fn compare_shows_every_solver_and_draws_profiles() {
    let folder = folder(RIB);
    let output = ribopt(&folder, "compare rib.toml --profile profile --max-seconds 20");
    assert_eq!(code(&output), 0, "{}", err(&output));
    assert!(out(&output).contains("argmin interior-point"), "{}", out(&output));
    for name in
        ["compare.csv", "profile-evaluations.csv", "profile-evaluations.svg", "profile-seconds.csv", "profile-seconds.svg"]
    {
        assert!(fs::metadata(folder.path().join("profile").join(name)).unwrap().len() > 0, "{name}");
    }
}

#[test]
fn the_examples_are_good_problem_files() {
    for kind in ["", "rectangle", "h-beam"] {
        let example = ribopt(&folder(RIB), &format!("new {kind}"));
        assert_eq!(code(&example), 0, "{kind}: {}", err(&example));
        let solved = ribopt(&folder(&out(&example)), "solve rib.toml");
        assert_eq!((code(&solved), err(&solved)), (0, String::new()), "{kind}: {}", out(&solved));
    }
}

#[test]
fn the_schema_is_json() {
    let schema = json(&ribopt(&folder(RIB), "schema"));
    assert!(schema["$schema"].is_string() && schema["properties"]["sections"].is_object());
}

#[test]
fn help_is_on_standard_output() {
    for arguments in ["--help", "--version", "solve --help", "compare --help", "bounds --help", "verify --help"] {
        let output = ribopt(&folder(RIB), arguments);
        assert_eq!((code(&output), err(&output)), (0, String::new()), "{arguments}");
        assert!(out(&output).contains("ribopt"));
    }
}
