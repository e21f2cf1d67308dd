//! The whole program: exit codes, files, what stands on standard output and what does not.

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

/// The exit code of `solve` on a problem, and the status in its JSON.
fn verdict(problem: &str, options: &str) -> (i32, String) {
    let folder = folder(problem);
    let output = ribopt(&folder, &format!("solve rib.toml --json {options}"));
    assert!(!err(&output).contains("panicked"), "{}", err(&output));
    (code(&output), json(&output)["status"].as_str().unwrap().to_string())
}

#[test]
fn a_solved_problem_exits_with_0_and_leaves_its_files() {
    let folder = folder(RIB);
    let output = ribopt(&folder, "solve rib.toml");
    assert_eq!(code(&output), 0, "{}{}", out(&output), err(&output));
    let results = folder.path().join("results/rib");
    for name in ["result.json", "variables.csv", "constraints.csv", "log-argmin.csv"] {
        assert!(fs::metadata(results.join(name)).unwrap().len() > 0, "{name}");
    }
    assert!(fs::read_dir(&results).unwrap().all(|file| !file.unwrap().path().display().to_string().ends_with("unfinished")));
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
fn sensitivity_is_minus_the_multiplier_for_both_senses() {
    for (objective, sign) in [("minimize = \"x\"", 1.0), ("maximize = \"-x\"", -1.0)] {
        let problem =
            format!("{objective}\n[variables]\nx = {{ lower = 0, upper = 9 }}\n[[constraints]]\nrequire = \"x >= 2\"\n");
        let value = json(&ribopt(&folder(&problem), "solve rib.toml --json"));
        let row = &value["constraints"][0];
        let (multiplier, sensitivity) = (row["multiplier"].as_f64().unwrap(), row["sensitivity"].as_f64().unwrap());
        assert!((sensitivity - sign).abs() < 1e-6, "{row}");
        assert_eq!(sensitivity, -multiplier);
        assert!((value["objective"].as_f64().unwrap() - 2.0 * sign).abs() < 1e-6, "{value}");
    }
}

#[test]
fn every_verdict_has_its_exit_code() {
    let infeasible = "minimize = \"x\"\n[variables]\nx = { lower = 0, upper = 1 }\n[[constraints]]\nrequire = \"x >= 2\"\n";
    assert_eq!(verdict(infeasible, ""), (3, "infeasible".into()));
    let unbounded = "minimize = \"x + y^2\"\n[variables]\nx = { start = 1 }\ny = { start = 1 }\n";
    assert_eq!(verdict(unbounded, ""), (4, "unbounded".into()));
    let not_attained = "minimize = \"exp(-x)\"\n[variables]\nx = { start = 1 }\n";
    assert_eq!(verdict(not_attained, ""), (4, "not-attained".into()));
    assert_eq!(verdict(LONG, "--max-evaluations 1"), (5, "limit-reached".into()));
    let no_number = "minimize = \"sqrt(-1 - x^2)\"\n[variables]\nx = { lower = -1, upper = 1 }\n";
    assert_eq!(verdict(no_number, ""), (6, "invalid-value".into()));
    assert_eq!(verdict("minimize = \"y\"\n[variables]\nx = { lower = 0 }\n", ""), (2, "invalid-input".into()));
}

#[test]
fn mistakes_of_the_file_are_told_and_nothing_is_written() {
    let folder = folder("minimize = \"depht\"\n[variables]\ndepth = { lower = 2, upper = 1 }\n");
    let output = ribopt(&folder, "solve rib.toml --json");
    let value = json(&output);
    assert_eq!((code(&output), value["status"].as_str()), (2, Some("invalid-input")));
    let mistakes = value["mistakes"].as_array().unwrap();
    assert_eq!(mistakes.len(), 2, "{value}");
    assert!(
        mistakes.iter().all(|mistake| mistake["file"] == "rib.toml" && mistake["line"].is_u64() && mistake["column"].is_u64())
    );
    assert!(!folder.path().join("results").exists());
    assert!(err(&output).contains("rib.toml:"), "{}", err(&output));
}

#[test]
fn a_wrong_command_line_exits_with_2() {
    let folder = folder(RIB);
    for arguments in [
        "solve",
        "solve missing.toml",
        "solve rib.toml --backend ipopt",
        "solve rib.toml --algorithm simplex",
        "solve rib.toml --optimality-tolerance 2",
        "solve rib.toml --max-seconds -1",
        "solve rib.toml --starts 0",
        "solve rib.toml --set nobody=1",
        "solve rib.toml --set left.b.upper",
        "solve rib.toml --start missing.json",
        "solve rib.toml --out /dev/null/results",
        "verify rib.toml missing.csv",
        "frobnicate",
        "new cube",
    ] {
        let output = ribopt(&folder, arguments);
        assert_eq!((code(&output), output.stdout.len()), (2, 0), "{arguments}: {}", out(&output));
        assert!(!err(&output).is_empty() && !err(&output).contains("panicked"), "{arguments}: {}", err(&output));
        let output = ribopt(&folder, &format!("{arguments} --json"));
        assert_eq!(code(&output), 2, "{arguments}");
        assert!(!json(&output)["mistakes"].as_array().unwrap().is_empty(), "{arguments}");
    }
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
fn logs_read_back_bit_for_bit() {
    let folder = folder(RIB);
    assert_eq!(code(&ribopt(&folder, "solve rib.toml")), 0);
    let mut logs = 0;
    for entry in fs::read_dir(folder.path().join("results/rib")).unwrap() {
        let path = entry.unwrap().path();
        if !path.file_name().unwrap().to_string_lossy().starts_with("log-") {
            continue;
        }
        logs += 1;
        let mut reader = csv::Reader::from_path(&path).unwrap();
        let header: Vec<String> = reader.headers().unwrap().iter().map(String::from).collect();
        let columns =
            "iteration,evaluations,objective,feasibility,optimality,step_norm,seconds,attempt,left.b,left.h,right.b,right.h";
        assert_eq!(header.join(","), columns);
        let mut rows = 0;
        for record in reader.records() {
            rows += 1;
            let counts = [0, 1, 7];
            let record = record.unwrap();
            let numbers = record.iter().enumerate().filter(|(at, cell)| !counts.contains(at) && !cell.is_empty());
            for (_, cell) in numbers {
                assert_eq!(format!("{:?}", cell.parse::<f64>().unwrap()), cell);
            }
        }
        assert!(rows > 0, "{}", path.display());
    }
    assert!(logs >= 1);
}

#[test]
fn two_runs_into_one_folder_do_not_mix() {
    let folder = folder(RIB);
    let results = folder.path().join("results/rib");
    fs::create_dir_all(&results).unwrap();
    let lock = File::create(results.join(".lock")).unwrap();
    lock.lock().unwrap();
    let output = ribopt(&folder, "solve rib.toml");
    assert_eq!(code(&output), 2);
    assert!(err(&output).contains("another run") && err(&output).contains("--out"), "{}", err(&output));
    drop(lock);
    assert_eq!(code(&ribopt(&folder, "solve rib.toml")), 0);
}

#[cfg(unix)]
#[test]
fn an_interrupted_run_stops_with_its_best_point_and_whole_rows() {
    let folder = folder(LONG);
    let arguments = if cfg!(feature = "nlopt") { "solve rib.toml --backend nlopt --algorithm isres --json" } else { return };
    let child = command(folder.path(), arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let log = folder.path().join("results/rib/log-nlopt.csv");
    let rows = || fs::read_to_string(&log).map_or(0, |text| text.lines().count());
    for _ in 0..600 {
        if rows() > 3 {
            break;
        }
        std::thread::sleep(std::time::Duration::from_millis(50));
    }
    assert!(rows() > 3, "the log is current while the run goes on");
    assert!(Command::new("kill").args(["-INT", &child.id().to_string()]).status().unwrap().success());
    let output = child.wait_with_output().unwrap();
    assert_eq!((code(&output), json(&output)["status"].as_str()), (5, Some("interrupted")));
    let text = fs::read_to_string(&log).unwrap();
    let cells = text.lines().next().unwrap().split(',').count();
    assert!(text.ends_with('\n') && text.lines().all(|line| line.split(',').count() == cells));
}

#[cfg(unix)]
#[test]
fn a_reader_that_goes_away_is_no_panic() {
    let folder = folder(RIB);
    for arguments in ["solve rib.toml", "solve rib.toml --json", "schema", "new", "check rib.toml", "--help"] {
        let mut child = command(folder.path(), arguments).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        assert_eq!((code(&output), err(&output)), (0, String::new()), "{arguments}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn a_full_disk_is_told() {
    let folder = folder(RIB);
    for arguments in ["solve rib.toml", "schema"] {
        let full = File::options().write(true).open("/dev/full").unwrap();
        let output = command(folder.path(), arguments).stdout(full).output().unwrap();
        assert_eq!(code(&output), 2, "{arguments}");
        assert!(err(&output).contains("cannot write to standard output"), "{}", err(&output));
    }
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
