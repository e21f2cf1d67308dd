//! Trusses whose equilibrium was written out by hand, displacements as variables, and the same as structures of a few lines: one optimum.

use std::path::{Path, PathBuf};

use ribopt::crosscheck::{Outcome, Status};
use ribopt::run::Subject;
use ribopt::run::solve::outcome;

const TEN_BARS: &str = r#"
minimize = "mass"
[structure]
plane = "xy"
joints = "pinned"
[materials]
aluminium = { E = 1e7, density = 0.1, limit = 25e3 }
[nodes]
1 = [720, 360]
2 = [720, 0]
3 = [360, 360]
4 = [360, 0]
5 = [0, 360]
6 = [0, 0]
[supports]
5 = "pinned"
6 = "pinned"
[tables]
sections = "sections.csv"
ribs = "ribs.csv"
[[loads]]
case = "P"
nodes = ["2", "4"]
force = [0, -1e5]
[[constraints]]
name = "stress"
for = "ribs"
require = "-material.limit <= stress(P, 0.5) <= material.limit"
"#;

fn solved(file: &Path) -> Outcome {
    let subject = Subject::read(file, &[]).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    let found = outcome(&subject).unwrap_or_else(|error| panic!("{}: {error}", file.display()));
    assert_eq!(found.status, Status::Certified, "{}: {}", file.display(), found.message);
    found
}

fn same_optimum(structure: &Path, by_hand: &Path, known: f64) {
    let objective = |file: &Path| solved(file).objective.unwrap();
    let (short, long) = (objective(structure), objective(by_hand));
    assert!((short / known - 1.0).abs() < 1e-8 && (long / known - 1.0).abs() < 1e-8, "{short} {long} {known}");
    let lines = |file: &Path| std::fs::read_to_string(file).unwrap().lines().filter(|line| !line.trim().is_empty()).count();
    let (short, long) = (lines(structure), lines(by_hand));
    assert!(short < long, "{short} lines against {long}");
}

fn in_repository(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

#[test]
fn ten_bars_under_stress_limits_are_1593_pounds_either_way() {
    let folder = tempfile::tempdir().unwrap();
    let ends = [(5, 3), (3, 1), (6, 4), (4, 2), (3, 4), (1, 2), (5, 4), (6, 3), (3, 2), (4, 1)];
    let sections = (1..=10).map(|bar| format!("A{bar},general,0.1,40,5\n")).collect::<String>();
    let ribs = ends.iter().zip(1..).map(|((start, end), bar)| format!("b{bar},{start},{end},A{bar}\n")).collect::<String>();
    std::fs::write(folder.path().join("sections.csv"), format!("name,kind,A.lower,A.upper,A.start\n{sections}")).unwrap();
    std::fs::write(folder.path().join("ribs.csv"), format!("name,start,end,section\n{ribs}")).unwrap();
    let file = folder.path().join("problem.toml");
    std::fs::write(&file, TEN_BARS).unwrap();
    same_optimum(&file, &in_repository("tests/data/ten-bar-by-hand.toml"), 1593.180_91);
}

#[test]
fn the_tower_of_25_bars_is_545_pounds_either_way() {
    let (structure, by_hand) = ("problems/tower-25-bars.toml", "tests/data/tower-25-bars-by-hand.toml");
    same_optimum(&in_repository(structure), &in_repository(by_hand), 545.162_710_2);
}
