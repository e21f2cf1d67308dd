//! Studies: the whole program on study files, alone, killed, resumed, side by side.

mod failures;
mod workers;

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use ribopt::study::{Request, Share, Store, Study, Table, work};
use tempfile::TempDir;

/// A rib whose least volume is known: b·h²/6 ≥ M/f and h ≤ 4b give b = (6M/16f)^⅓, and V = 4b²·3.
const RIB: &str = r#"
minimize = "volume"
[parameters]
M = 40.0
f = 8e3
slender = 4
[sections.s]
kind = "rectangle"
b = { lower = 0.01, upper = 1.0 }
h = { lower = 0.01, upper = 2.0 }
[[ribs]]
name = "r"
section = "s"
length = 3.0
[[constraints]]
name = "bending"
require = "M/s.Wx <= f"
[[constraints]]
name = "slender"
require = "s.h <= slender*s.b"
"#;

const STUDY: &str = r#"
problem = "rib.toml"
[vary]
M = { from = 10, to = "8*10", count = 9 }
slender = { values = [3, 4] }
[report]
quantities = { weight = "7.85*volume" }
"#;

fn folder(study: &str) -> TempDir {
    let folder = TempDir::new().unwrap();
    fs::write(folder.path().join("rib.toml"), RIB).unwrap();
    fs::write(folder.path().join("study.toml"), study).unwrap();
    folder
}

fn sweep(folder: &Path, arguments: &[&str]) -> Output {
    command(folder, arguments).output().unwrap()
}

fn command(folder: &Path, arguments: &[&str]) -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    command.current_dir(folder).args(["sweep", "study.toml", "--out", "out"]).args(arguments);
    command
}

fn said(output: &Output) -> String {
    String::from_utf8_lossy(&output.stdout).into_owned() + &String::from_utf8_lossy(&output.stderr)
}

type Line = BTreeMap<String, String>;

fn table(folder: &Path) -> Vec<Line> {
    let mut reader = csv::Reader::from_path(folder.join("out/table.csv")).unwrap();
    reader.deserialize().collect::<Result<_, _>>().unwrap()
}

/// The table without its seconds, the one thing that no two runs share.
fn without_seconds(folder: &Path) -> Vec<Line> {
    let mut rows = table(folder);
    rows.iter_mut().for_each(|row| drop(row.remove("seconds")));
    rows
}

fn number(row: &Line, name: &str) -> f64 {
    row.get(name).unwrap_or_else(|| panic!("no column {name}")).parse().unwrap_or_else(|_| panic!("{name}: {:?}", row[name]))
}

/// The least volume, and its derivatives by M and by slender = k: V = 3·k·b², b³ = 6M/(k²f).
fn known(row: &Line) -> (f64, f64, f64) {
    let (moment, k) = (number(row, "M"), number(row, "slender"));
    let volume = 3.0 * k * (6.0 * moment / (k * k * 8e3)).powf(2.0 / 3.0);
    (volume, volume * 2.0 / 3.0 / moment, -volume / 3.0 / k)
}

#[test]
fn every_point_is_a_row_with_what_it_costs() {
    let folder = folder(STUDY);
    let output = sweep(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    assert!(said(&output).contains("18 points: 18 certified"), "{}", said(&output));
    let rows = table(folder.path());
    assert_eq!(rows.len(), 18);
    for (at, row) in rows.iter().enumerate() {
        assert_eq!((number(row, "point") as usize, row["status"].as_str(), row["scope"].as_str()), (at, "certified", "global"));
        let (volume, by_moment, by_slenderness) = known(row);
        let near = |name: &str, value: f64, tolerance: f64| {
            let found = number(row, name);
            assert!((found - value).abs() <= tolerance * value.abs(), "{name} {found} {value} {row:?}");
        };
        near("objective", volume, 1e-8);
        near("volume", volume, 1e-8);
        near("weight", 7.85 * volume, 1e-8);
        near("lower_bound", volume, 1e-6);
        near("sensitivity:M", by_moment, 1e-6);
        near("sensitivity:slender", by_slenderness, 1e-6);
        assert!(row["governs"].contains("bending") && row["governs"].contains("slender"), "{row:?}");
    }
    // The last axis is the fastest; the longest is the chain's.
    assert_eq!((number(&rows[1], "slender"), number(&rows[2], "M")), (4.0, 18.75));
    assert_eq!(rows.iter().filter(|row| row["start"] == "warm").count(), 16);
    let report = Command::new(env!("CARGO_BIN_EXE_ribopt")).current_dir(folder.path()).args(["report", "out"]).output().unwrap();
    assert!(report.status.success(), "{}", said(&report));
    let page = fs::read_to_string(folder.path().join("out/report.html")).unwrap();
    assert!(
        page.contains("18: 18 certified")
            && page.contains("data:image/svg+xml")
            && page.contains("problem = &quot;rib.toml&quot;")
    );
    for picture in ["course.svg", "map.svg"] {
        assert!(fs::read_to_string(folder.path().join("out").join(picture)).unwrap().contains("</svg>"));
    }
}

#[test]
fn designs_other_than_grids() {
    for (design, points) in [
        ("method = \"zip\"", 4),
        ("method = \"centered\"", 9),
        ("method = \"latin-hypercube\"\nsamples = 7\nseed = 3", 7),
        ("method = \"sobol\"\nsamples = 8", 8),
        ("method = \"random\"\nsamples = 5", 5),
    ] {
        let folder = folder(&format!(
            "problem = \"rib.toml\"\n[vary]\nM = {{ from = 10, to = 80, count = 4, scale = \"log\" }}\nslender = {{ values = [2, 3, 4, 5] }}\n[design]\n{design}\n"
        ));
        let output = sweep(folder.path(), &[]);
        assert_eq!(output.status.code(), Some(0), "{design}: {}", said(&output));
        let rows = table(folder.path());
        assert_eq!(rows.len(), points, "{design}");
        for row in rows.iter().filter(|row| !row["M"].is_empty() && !row["slender"].is_empty()) {
            assert!((number(row, "objective") / known(row).0 - 1.0).abs() < 1e-8, "{design}");
        }
    }
    let listed = folder("problem = \"rib.toml\"\n[design]\nmethod = \"list\"\ntable = \"points.csv\"\n");
    fs::write(listed.path().join("points.csv"), "M, slender\n10, 3\n2*20,\n").unwrap();
    let output = sweep(listed.path(), &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let rows = table(listed.path());
    assert_eq!((number(&rows[1], "M"), rows[1]["slender"].as_str()), (40.0, ""));
}

/// The front of volume against deflection: V = 3bh, w = 1/(b·h³) within b ≤ 1, h ≤ 2: a geometric program.
#[test]
fn a_front_has_tangents_and_a_proved_bound() {
    let study = "problem = \"rib.toml\"\n[pareto]\nminimize = [\"volume\", \"1/s.Ix\"]\npoints = 12\n";
    let folder = folder(study);
    let output = sweep(folder.path(), &[]);
    assert_eq!(output.status.code(), Some(0), "{}", said(&output));
    let rows = table(folder.path());
    assert_eq!(rows.len(), 12);
    // Where the limit L = 1/Ix decides, h = 4b: Ix = 64b⁴/12, V = 12b² = 12·√(12/(64·L)).
    for row in rows.iter().filter(|row| !row["limit"].is_empty() && row["governs"].contains("limit")) {
        let limit = number(row, "limit");
        let deep = |limit: f64| 12.0 * (12.0 / (64.0 * limit)).sqrt();
        if deep(limit) < 12.0 * 0.25 {
            assert!((number(row, "first") / deep(limit) - 1.0).abs() < 1e-7, "{row:?}");
            let slope = -deep(limit) / (2.0 * limit);
            assert!((number(row, "sensitivity:limit") / slope - 1.0).abs() < 1e-5, "{row:?}");
        }
    }
    let picture = fs::read_to_string(folder.path().join("out/front.svg")).unwrap();
    assert!(picture.contains("no feasible point is possible"), "{picture}");
    let again = self::folder(study);
    assert!(sweep(again.path(), &["--jobs", "1"]).status.success());
    assert_eq!(without_seconds(again.path()), without_seconds(folder.path()));
}

#[test]
fn the_examples_are_certified() {
    for name in ["sag-and-width", "volume-against-sag", "what-moves-most"] {
        let study = Study::read(Path::new(&format!("examples/studies/{name}.toml"))).unwrap_or_else(|error| panic!("{error}"));
        let folder = TempDir::new().unwrap();
        let store = Store::open(&study, folder.path(), false).unwrap();
        let request = Request { jobs: 0, share: Share::default(), interrupt: None, watch: &|_| {} };
        work(&study, &store, &request).unwrap();
        let table = Table::of(&study, &store);
        assert_eq!((table.missing, table.rows.len()), (0, study.points()), "{name}");
        for row in &table.rows {
            assert!(!row.has_failed(), "{name}: {row:?}");
        }
        assert!(!ribopt::study::pictures(&study, &table).is_empty());
    }
}
