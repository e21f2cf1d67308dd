//! In safe hands: nothing is lost, nothing hangs, what is shown is what happened. Each case is one that a user met.

use std::fs;
use std::io::Write;
use std::path::Path;
use std::process::{Command, Output, Stdio};
use std::time::{Duration, Instant};

use serde_json::Value;
use tempfile::TempDir;

const BOX: &str = include_str!("../src/sections/examples/box.toml");
/// A girder whose best design argmin finds by a second opinion.
const TAPERED: &str = include_str!("data/tapered.toml");
const X: &str = "minimize = \"x\"\n[variables]\nx = { lower = 1, upper = 2 }\ny = { lower = 0, upper = 1 }\n";
const TWO: &str = "[tables]\nsections = \"s.csv\"\nribs = \"r.csv\"\n";
const SECTIONS: &str = "name,kind,b,h.lower,h.upper\ns0,rectangle,1,1,2\n";
const RIBS: &str = "name,section,length\nr0,s0,1\n";
/// Hard enough to keep solvers busy for long.
const LONG: &str =
    "minimize = \"sum((x - 0.3)^2) - 0.1*sum(cos(25*x))\"\n[variables]\nx = { size = 40, lower = -5, upper = 5, start = 2.5 }\n";

struct Place(TempDir);

impl Place {
    fn new(files: &[(&str, &str)]) -> Place {
        let place = Place(tempfile::tempdir().expect("a folder"));
        files.iter().for_each(|(name, text)| place.write(name, text));
        place
    }

    fn write(&self, name: &str, text: &str) {
        let path = self.0.path().join(name);
        fs::create_dir_all(path.parent().expect("a folder")).expect("a folder");
        fs::write(path, text).expect("a writable folder");
    }

    fn read(&self, name: &str) -> String {
        fs::read_to_string(self.0.path().join(name)).unwrap_or_default()
    }

    fn has(&self, name: &str) -> bool {
        self.0.path().join(name).exists()
    }

    fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
        command.current_dir(self.0.path()).args(arguments.split_whitespace()).stdin(Stdio::null());
        command
    }

    fn run(&self, arguments: &str) -> Output {
        self.command(arguments).output().expect("ribopt runs")
    }

    /// Exit code, standard output, standard error.
    fn said(&self, arguments: &str) -> (i32, String, String) {
        let output = self.run(arguments);
        let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
        (output.status.code().unwrap_or(-1), text(&output.stdout), text(&output.stderr))
    }

    fn json(&self, arguments: &str) -> Value {
        let output = self.run(arguments);
        serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", String::from_utf8_lossy(&output.stderr)))
    }

    /// A column of a CSV.
    fn column(&self, file: &str, name: &str) -> Vec<String> {
        let mut reader = csv::Reader::from_path(self.0.path().join(file)).expect("a table");
        let at = reader.headers().expect("a header").iter().position(|header| header == name).expect("the column");
        reader.records().map(|record| record.expect("a row")[at].to_owned()).collect()
    }
}

// 1: nothing of the user's is ever overwritten.

#[test]
fn no_output_takes_the_place_of_an_input() {
    let place = Place::new(&[("b.svg", BOX), ("ov/p.toml", TWO), ("ov/s.csv", SECTIONS), ("ov/r.csv", RIBS)]);
    place.write("ov/q.toml", "[tables]\nsections = \"variables.csv\"\nribs = \"sizes.csv\"\n");
    place.write("ov/variables.csv", SECTIONS);
    place.write("ov/sizes.csv", RIBS);
    place.write("ov/geometry.csv", "rib\n");
    place.write("in/result.json", BOX);
    place.write("v.obj", "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n");
    let before = |name: &str| place.read(name);
    let names = ["b.svg", "ov/s.csv", "ov/variables.csv", "ov/sizes.csv", "ov/geometry.csv", "in/result.json", "v.obj"];
    let old: Vec<String> = names.iter().map(|name| before(name)).collect();
    for (arguments, kept) in [
        ("section b.svg --svg ./b.svg", "b.svg"),
        ("solve ov/q.toml --out ov", "ov/variables.csv"),
        ("solve ov/p.toml --solids ov/s.stl", "ov/s.csv"),
        ("solve ov/p.toml --solids ov/geometry.obj", "ov/geometry.csv"),
        ("solve in/result.json --out in", "in/result.json"),
        ("mesh smooth v.obj -o v.obj", "v.obj"),
    ] {
        let (code, _, err) = place.said(arguments);
        assert_eq!(code, 2, "{arguments}: {err}");
        assert!(err.contains(kept) && err.contains("would be overwritten"), "{arguments}: {err}");
    }
    assert_eq!(old, names.iter().map(|name| before(name)).collect::<Vec<_>>());
}

#[test]
fn a_picture_has_an_ending_of_its_own() {
    let place = Place::new(&[("b.toml", BOX)]);
    let (code, _, err) = place.said("section b.toml --svg out.txt");
    assert!(code == 2 && err.contains("ends in .svg"), "{err}");
}

#[test]
fn the_answer_started_from_is_not_overwritten() {
    let place = Place::new(&[("x.toml", X)]);
    assert_eq!(place.said("solve x.toml -q").0, 0);
    let old = place.read("results/x/result.json");
    let (code, _, err) = place.said("solve x.toml -q --start results/x/result.json");
    assert!(code == 2 && err.contains("--out") || err.contains("choose another"), "{err}");
    assert_eq!(place.read("results/x/result.json"), old);
    assert_eq!(place.said("solve x.toml -q --start results/x/variables.csv --out other").0, 0);
}

#[test]
fn mesh_ribs_keeps_what_was_edited() {
    let place = Place::new(&[]);
    assert_eq!(place.said("mesh new grid -o g.obj").0, 0);
    assert_eq!(place.said("mesh ribs g.obj -o g").0, 0);
    assert_eq!(place.said("mesh ribs g.obj --load 7 -o g").0, 0, "what was not edited is written anew");
    let edited = place.read("g/problem.toml") + "# my own edits\n";
    place.write("g/problem.toml", &edited);
    let (code, _, err) = place.said("mesh ribs g.obj -o g");
    assert!(code == 2 && err.contains("g/problem.toml") && err.contains("--force"), "{err}");
    assert_eq!(place.read("g/problem.toml"), edited);
    assert_eq!(place.said("mesh ribs g.obj -o g --force").0, 0);
    assert!(!place.read("g/problem.toml").contains("my own edits"));
}

#[test]
fn a_certified_answer_outlives_a_run_that_ends_early() {
    let place = Place::new(&[("b.toml", BOX)]);
    assert_eq!(place.said("solve b.toml -q --plot").0, 0);
    let files = ["result.json", "variables.csv", "log-argmin.csv", "sections.svg"].map(|name| format!("results/b/{name}"));
    let old: Vec<String> = files.iter().map(|name| place.read(name)).collect();
    let (code, out, _) = place.said("solve b.toml --max-evaluations 1");
    assert_eq!(code, 5);
    assert!(out.contains("results/b/interrupted"), "{out}");
    assert_eq!(old, files.iter().map(|name| place.read(name)).collect::<Vec<_>>());
    assert!(place.read("results/b/interrupted/result.json").contains("limit-reached"));
}

#[test]
fn the_answer_is_shown_though_it_cannot_be_written() {
    let place = Place::new(&[("b.toml", BOX)]);
    fs::create_dir_all(place.0.path().join("out/result.json")).expect("a folder");
    let (code, out, err) = place.said("solve b.toml --out out");
    assert!(code == 2 && err.contains("result.json"), "{err}");
    assert!(out.contains("certified") && out.contains("volume = "), "{out}");
}

#[test]
fn results_of_another_file_are_named() {
    let place = Place::new(&[("a/b.toml", BOX), ("c/b.toml", &BOX.replace("title = \"", "title = \"Another "))]);
    assert_eq!(place.said("solve a/b.toml -q --plot").0, 0);
    let (code, _, err) = place.said("solve c/b.toml -q");
    assert!(code == 0 && err.contains("a/b.toml"), "{err}");
    assert!(!place.has("results/b/sections.svg"), "pictures of the other file go");
}

// 2: every run ends when told.

#[cfg(unix)]
fn ended_by_one_signal(child: &mut std::process::Child) -> Option<i32> {
    std::thread::sleep(Duration::from_millis(300));
    Command::new("kill").args(["-TERM", &child.id().to_string()]).status().expect("kill");
    let until = Instant::now() + Duration::from_secs(20);
    while Instant::now() < until {
        if let Some(status) = child.try_wait().expect("a child") {
            return status.code();
        }
        std::thread::sleep(Duration::from_millis(20));
    }
    child.kill().expect("a child");
    None
}

#[cfg(unix)]
#[test]
fn a_blocked_read_ends_at_the_first_signal() {
    let place = Place::new(&[("b.toml", BOX)]);
    Command::new("mkfifo").arg(place.0.path().join("ff")).status().expect("mkfifo");
    for arguments in ["solve ff", "solve -", "solve b.toml --start ff", "verify b.toml ff", "compare ff"] {
        let mut child = place.command(arguments).stdin(Stdio::piped()).stderr(Stdio::null()).spawn().expect("a child");
        assert_eq!(ended_by_one_signal(&mut child), Some(5), "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn commands_that_were_interrupted_say_so() {
    let place = Place::new(&[("long.toml", LONG)]);
    for arguments in ["compare long.toml", "solve long.toml --starts 100000"] {
        let mut child = place.command(arguments).stdout(Stdio::null()).stderr(Stdio::null()).spawn().expect("a child");
        assert_eq!(ended_by_one_signal(&mut child), Some(5), "{arguments}");
    }
}

#[cfg(unix)]
#[test]
fn files_without_end_are_not_read_without_limit() {
    let place = Place::new(&[("b.toml", BOX), ("ov/p.toml", TWO), ("ov/s.csv", SECTIONS), ("ov/r.csv", RIBS)]);
    for name in ["zero.obj", "zero.ply", "zero.off", "zero.stl", "zero.csv", "zero.json", "ov/geometry.csv"] {
        std::os::unix::fs::symlink("/dev/zero", place.0.path().join(name)).expect("a link");
    }
    for arguments in [
        "mesh check zero.obj",
        "mesh check zero.ply",
        "mesh check zero.off",
        "verify b.toml zero.csv",
        "verify b.toml zero.json",
        "solve b.toml --start zero.csv",
        "solve ov/p.toml --solids s.obj",
        "check zero.csv",
    ] {
        let begun = Instant::now();
        let (code, _, err) = place.said(arguments);
        assert!(code == 2 && begun.elapsed() < Duration::from_secs(60), "{arguments}: {code} {err}");
    }
}

#[cfg(target_os = "linux")]
#[test]
fn sizes_that_cannot_fit_are_refused_with_the_estimate() {
    let place = Place::new(&[("big.toml", "minimize = \"sum(x)\"\n[variables]\nx = { size = 1e8, lower = 0 }\n")]);
    let limited = format!("ulimit -v 8000000; exec {} check big.toml", env!("CARGO_BIN_EXE_ribopt"));
    let output = Command::new("sh").args(["-c", &limited]).current_dir(place.0.path()).output().expect("sh");
    let err = String::from_utf8_lossy(&output.stderr);
    assert!(output.status.code() == Some(2) && err.contains("30.0 GB"), "{err}");
    place.write("big.toml", "minimize = \"sum(x)\"\n[variables]\nx = { size = 1e300, lower = 0 }\n");
    let (code, _, err) = place.said("check big.toml");
    assert!(code == 2 && err.contains("1e300") && err.len() < 1000, "{err}");
}

// 3: what is shown is what happened.

#[test]
fn the_log_has_the_rows_of_the_run_that_gave_the_answer() {
    let place = Place::new(&[("tapered.toml", TAPERED)]);
    let result = place.json("solve tapered.toml --json --plot");
    for (solution, backend) in
        result["solutions"].as_array().expect("solutions").iter().map(|one| (one, one["backend"].as_str().expect("a name")))
    {
        let log = format!("results/tapered/log-{backend}.csv");
        let attempt = solution["attempt"].as_u64().expect("an attempt").to_string();
        let rows: Vec<f64> = place
            .column(&log, "attempt")
            .into_iter()
            .zip(place.column(&log, "objective"))
            .filter(|(own, _)| *own == attempt)
            .map(|(_, objective)| objective.parse().expect("a number"))
            .collect();
        let objective = solution["objective"].as_f64().expect("a number");
        assert!(rows.len() > 1, "{backend}");
        assert!((rows[rows.len() - 1] / objective - 1.0).abs() < 1e-9, "{backend}: {rows:?} {objective}");
    }
    // Where a backend ran more than once, the picture says which of its runs it draws.
    let runs =
        place.column("results/tapered/log-argmin.csv", "attempt").into_iter().collect::<std::collections::BTreeSet<_>>().len();
    assert_eq!(place.read("results/tapered/convergence.svg").contains("argmin, run"), runs > 1);
}

#[test]
fn every_rib_of_a_line_is_drawn() {
    let section =
        |k: u32| format!("[sections.s{k}]\nkind = \"rectangle\"\nb = 20\nh = {{ lower = {}, upper = 600 }}\n", 100 - 10 * k);
    let rib = |k: u32, line: &str| format!("[[ribs]]\nname = \"r{k}\"\nsection = \"s{k}\"\nlength = 500\n{line}\n");
    let all = |line: &str| (1..=5).map(section).chain((1..=5).map(|k| rib(k, line))).collect::<String>();
    let place = Place::new(&[("line.toml", &all("data = { line = \"L0\" }")), ("apart.toml", &all(""))]);
    for (file, words) in [("line", "L0, 5 ribs"), ("apart", "Along the ribs: 5 lines")] {
        let (code, _, err) = place.said(&format!("solve {file}.toml -q --plot"));
        assert_eq!(code, 0, "{err}");
        let svg = place.read(&format!("results/{file}/ribs.svg"));
        assert!(svg.contains(words), "{svg}");
    }
    // The whole cantilever of five segments.
    assert!(place.read("results/line/ribs.svg").contains(">2500<"));
}

#[test]
fn pictures_carry_title_units_dimensions_and_dark_colours() {
    let place = Place::new(&[("b.toml", BOX)]);
    assert_eq!(place.said("solve b.toml -q --plot").0, 0);
    for name in ["convergence.svg", "sections.svg", "ribs.svg"] {
        let svg = place.read(&format!("results/b/{name}"));
        assert!(svg.contains("Box girder") && svg.contains("prefers-color-scheme: dark") && svg.contains("<title>"), "{name}");
    }
    assert!(place.read("results/b/sections.svg").contains("dimensions in mm"));
    assert!(place.read("results/b/sections.svg").contains("tw "));
    assert!(place.read("results/b/ribs.svg").contains("height, in mm"));
}

#[test]
fn pictures_of_an_earlier_run_go() {
    let place = Place::new(&[("b.toml", BOX)]);
    assert_eq!(place.said("solve b.toml -q --plot").0, 0);
    assert_eq!(place.said("solve b.toml -q --backend argmin").0, 0);
    for name in ["sections.svg", "ribs.svg", "convergence.svg", "log-nlopt.csv"] {
        assert!(!place.has(&format!("results/b/{name}")), "{name}");
    }
}

#[test]
fn section_says_that_it_shows_the_start() {
    let place = Place::new(&[("b.toml", BOX)]);
    let (_, out, _) = place.said("section b.toml");
    assert!(out.starts_with("At the start, not at an answer"), "{out}");
    place.write("short.csv", "name,value\ncell.b,200\n");
    let (code, _, err) = place.said("section b.toml --answer short.csv");
    assert!(code == 2 && !err.contains("verify"), "{err}");
}

// 5: utilisation, sizes, volumes.

#[test]
fn every_limit_is_told_with_its_use() {
    let place = Place::new(&[("t.toml", TAPERED)]);
    let (code, out, err) = place.said("solve t.toml");
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("Utilisation") && out.contains("by section and rib"), "{out}");
    let percents = place.column("results/t/utilisation.csv", "percent");
    let names = place.column("results/t/utilisation.csv", "name");
    let at =
        |name: &str| percents[names.iter().position(|known| known == name).expect("the row")].parse::<f64>().expect("a number");
    assert!((at("bending quarter") - 100.0).abs() < 1e-6 && at("bending mid") < 60.0);
    // mid.hw >= end.hw, both of which vary.
    assert!((at("taper") - 100.0 * 200.0 / 1197.65).abs() < 0.01, "{}", at("taper"));
    assert!(names.contains(&"web c/t[mid]".to_owned()));
}

#[test]
fn sizes_hold_linked_ones_and_volumes_the_mass() {
    let place = Place::new(&[("i.toml", include_str!("../src/sections/examples/i-section.toml"))]);
    place.write("t.toml", TAPERED);
    let result = place.json("solve i.toml --json");
    let (mass, volume) = (result["mass"].as_f64().expect("a mass"), result["volume"]["total"].as_f64().expect("a volume"));
    assert!((mass / (7.85e-6 * volume) - 1.0).abs() < 1e-12);
    assert_eq!(place.column("results/i/volumes.csv", "mass").len(), 1);
    assert_eq!(place.said("solve t.toml -q").0, 0);
    let (names, given) = (place.column("results/t/sizes.csv", "name"), place.column("results/t/sizes.csv", "given"));
    let of = |name: &str| given[names.iter().position(|known| known == name).expect("the size")].as_str().to_owned();
    assert_eq!((of("b").as_str(), of("hw").as_str(), of("Ix").as_str()), ("linked", "variable", "derived"));
}

// 6: the language says what it can.

#[test]
fn a_requirement_over_arrays_is_a_row_per_element() {
    let place = Place::new(&[("l.toml", include_str!("../src/input/examples/load-cases.toml"))]);
    let result = place.json("solve l.toml --json");
    assert_eq!(result["status"], "certified", "{result:#}");
    let names: Vec<&str> =
        result["constraints"].as_array().expect("rows").iter().filter_map(|row| row["name"].as_str()).collect();
    assert!(names.iter().any(|name| name.starts_with("stress") && name.ends_with("[span 2]")), "{names:?}");
    let global = "minimize = \"h\"\n[parameters]\nM = [1, 4, 2]\n[variables]\nh = { lower = 0.1, upper = 9 }\n[[constraints]]\nname = \"m\"\nrequire = \"M/h <= 2\"\n";
    place.write("g.toml", global);
    let result = place.json("solve g.toml --json");
    assert_eq!(result["constraints"].as_array().map(Vec::len), Some(3));
    assert!((result["objective"].as_f64().expect("a number") - 2.0).abs() < 1e-6);
    place.write("g.toml", &global.replace("<= 2\"", "<= [1, 2]\"").replace("[1, 2]", "N").replace("M = [", "N = [1, 2]\nM = ["));
    let (code, _, err) = place.said("check g.toml");
    assert!(code == 2 && err.contains("do not go together") || err.contains("arrays of"), "{err}");
}

#[test]
fn set_fixes_a_variable() {
    let place = Place::new(&[("b.toml", BOX)]);
    let result = place.json("solve b.toml --json --set cell.tw=8");
    assert_eq!(
        (result["variables"]["cell.tw"].as_f64(), result["problem"]["changes"][0].as_str()),
        (Some(8.0), Some("cell.tw=8"))
    );
    let (code, _, err) = place.said("solve b.toml --set cell.tq=8");
    assert!(code == 2 && err.contains("did you mean") || err.contains("fixes a variable"), "{err}");
}

#[test]
fn a_dash_reads_standard_input() {
    let place = Place::new(&[]);
    let mut child = place.command("solve - --json").stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("a child");
    child.stdin.take().expect("a pipe").write_all(X.as_bytes()).expect("a pipe");
    let output = child.wait_with_output().expect("an end");
    assert_eq!(output.status.code(), Some(0));
    assert!(place.has("results/stdin/result.json"));
}

#[test]
fn help_lists_the_examples_and_the_reference() {
    let (code, out, _) = Place::new(&[]).said("new --help");
    assert!(code == 0 && out.contains("load-cases") && out.contains("expressions.md"), "{out}");
}

// 7: foreign tables.

#[test]
fn semicolons_tabs_and_decimal_commas_are_read() {
    let foreign = |separator: &str| {
        SECTIONS
            .replace(',', separator)
            .replace(&format!("{separator}1{separator}1{separator}2"), &format!("{separator}0,5{separator}0,25{separator}2"))
    };
    for separator in [";", "\t"] {
        let place = Place::new(&[("p.toml", TWO), ("s.csv", &foreign(separator)), ("r.csv", &RIBS.replace(',', separator))]);
        let (code, _, err) = place.said("solve p.toml -q");
        assert!(code == 0 && err.contains("separated by") && err.contains("read as 0.5"), "{err}");
        let result: Value = serde_json::from_str(&place.read("results/p/result.json")).expect("JSON");
        assert!((result["objective"].as_f64().expect("a number") - 0.125).abs() < 1e-9, "{result:#}");
    }
}

#[test]
fn what_follows_from_a_table_that_did_not_load_is_left_out() {
    let constrained = format!("{TWO}[[constraints]]\nfor = \"sections\"\nrequire = \"Ix >= 1\"\n");
    let place = Place::new(&[("p.toml", &constrained), ("s.csv", "nome,kind,b\na,rectangle,1\n"), ("r.csv", RIBS)]);
    let result = place.json("check p.toml --json");
    let messages: Vec<&str> =
        result["mistakes"].as_array().expect("mistakes").iter().filter_map(|one| one["message"].as_str()).collect();
    assert_eq!(messages, ["the table lacks the column `name`"]);
    place.write("s.csv", "name,kind,b,h\n\"s0,rectangle,1,1\n");
    let (_, _, err) = place.said("check p.toml");
    assert!(err.contains("does not close") && !err.contains("there is no section"), "{err}");
    place.write("s.csv", "name,kind,b,h\ns0\n");
    assert!(place.said("check p.toml").2.contains("this row has 1 field, the header 4"));
}

// 8: plain words.

#[test]
fn infinite_numbers_are_refused_but_as_bounds() {
    let file = |a: &str, upper: &str| {
        format!(
            "minimize = \"x\"\n[parameters]\na = {a}\n[variables]\nx = {{ lower = 0, upper = {upper} }}\n[[constraints]]\nrequire = \"x >= a\"\n"
        )
    };
    let place = Place::new(&[("open.toml", &file("1", "inf"))]);
    assert_eq!(place.said("solve open.toml -q").0, 0);
    for (a, upper) in [("1e400", "9"), ("inf", "9"), ("1", "1e400")] {
        place.write("bad.toml", &file(a, upper));
        let result = place.json("check bad.toml --json");
        assert_eq!(result["mistakes"].as_array().map(Vec::len), Some(1), "{a} {upper}: {result:#}");
    }
    let table = Place::new(&[("p.toml", TWO), ("s.csv", &SECTIONS.replace(",1,2", ",1,1e309")), ("r.csv", RIBS)]);
    assert!(table.said("check p.toml").2.contains("is not finite"));
}

#[test]
fn texts_of_the_file_do_not_steer_the_terminal_or_a_spreadsheet() {
    let file = "title = \"\\u001b[31mred\\u0007\"\nminimize = \"x\"\nunits = { length = \"m\\u001b[2J\" }\n[variables]\nx = { lower = 0, upper = 1 }\n\
                [[constraints]]\nname = \"=cmd|'/c calc'!A1\"\nrequire = \"x >= 0.5\"\n[[constraints]]\nname = \"new\\nline\"\nrequire = \"x >= 0.25\"\n";
    let place = Place::new(&[("e.toml", file)]);
    let (code, out, err) = place.said("solve e.toml");
    assert_eq!(code, 0);
    assert!((out + &err).chars().all(|c| c == '\n' || !c.is_control()));
    assert!(place.read("results/e/constraints.csv").contains("'=cmd|"));
}

#[test]
fn a_name_of_64_kilobytes_is_no_panic() {
    let file = format!(
        "minimize = \"x\"\n[variables]\nx = {{ lower = 0, upper = 1 }}\n{} = {{ lower = 0, upper = 1 }}\n",
        "y".repeat(65_536)
    );
    let place = Place::new(&[("n.toml", &file)]);
    for command in ["solve n.toml", "bounds n.toml"] {
        let (code, out, err) = place.said(command);
        assert!(code <= 1 && !err.contains("panicked"), "{command}: {err}");
        assert!(out.lines().all(|line| line.chars().count() < 1000), "{command}");
    }
}

#[test]
fn a_warning_does_not_echo_a_whole_expression() {
    let product = vec!["log(x - 1)"; 2000].join("*");
    let file = format!("minimize = \"{product}\"\n[variables]\nx = {{ lower = 0, upper = 3, start = 0.5 }}\n");
    let (_, _, err) = Place::new(&[("w.toml", &file)]).said("solve w.toml -q --max-seconds 1");
    assert!(err.lines().all(|line| line.chars().count() < 600), "{} characters", err.len());
}

#[test]
fn words_say_what_is_meant() {
    let place = Place::new(&[("b.toml", BOX)]);
    let (_, out, _) = place.said("solve b.toml");
    assert!(
        out.contains("argmin: converged") && out.contains("relative to their sizes") && !out.contains("no further progress"),
        "{out}"
    );
    let (code, out, _) = place.said("solve b.toml --algorithm lbfgs");
    assert!(
        code == 0 && out.contains("nlopt was not run") && out.contains("refused") && !out.contains("did not get there"),
        "{out}"
    );
    place.write("z.toml", &format!("{X}[solver]\nconstraint_tolerance = 0\noptimality_tolerance = 1e300\n"));
    let (_, _, err) = place.said("check z.toml");
    assert!(err.contains("neither of them") && err.contains("1e300") && !err.contains("0000000000"), "{err}");
    // A plate thickness shared under its own name hides nothing.
    place.write("t.toml", TAPERED);
    assert!(!place.said("check t.toml").2.contains("hides"));
}

#[test]
fn check_names_kinks() {
    let file = "minimize = \"max(x)\"\n[variables]\nx = { size = 300, lower = 0, upper = 5, start = 3 }\n";
    let (code, out, _) = Place::new(&[("k.toml", file)]).said("check k.toml");
    assert!(code == 0 || out.contains("kinks left in the objective"), "{out}");
}

#[test]
fn a_mesh_cut_short_says_so() {
    let place = Place::new(&[]);
    fs::write(place.0.path().join("bomb.stl"), [&[0_u8; 80][..], &1000_u32.to_le_bytes(), &[0; 30]].concat()).expect("a file");
    let (code, _, err) = place.said("mesh check bomb.stl");
    assert!(code == 2 && err.contains("cut short"), "{err}");
}

#[test]
fn tools_that_mutate_and_interrupt_are_there() {
    for tool in ["fuzz/mutate.py", "fuzz/signals.py"] {
        assert!(Path::new(env!("CARGO_MANIFEST_DIR")).join(tool).is_file(), "{tool}");
    }
}
