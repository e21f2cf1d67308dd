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
    same_optimum(&file, &in_repository("tests/data/ten-bar-by-hand.toml"), 1_593.180_91);
}

#[test]
fn the_tower_of_25_bars_is_545_pounds_either_way() {
    let (structure, by_hand) = ("problems/tower-25-bars.toml", "tests/data/tower-25-bars-by-hand.toml");
    same_optimum(&in_repository(structure), &in_repository(by_hand), 545.162_710_2);
}

/// A mast of two segments that carries what lies outboard of each: sums that run over the other ribs, by a datum of the row's own.
#[test]
fn a_sum_may_name_the_item_outside_it() {
    let section = |name: &str| {
        format!("[sections.{name}]\nkind = \"rectangle\"\nb = 0.1\nh = {{ lower = 0.05, upper = 2, start = 0.5 }}\n")
    };
    let rib = |name: &str, section: &str, x: f64, line: &str| {
        format!("[[ribs]]\nname = \"{name}\"\nsection = \"{section}\"\nlength = 5\ndata = {{ x = {x}, line = \"{line}\" }}\n")
    };
    let text = format!(
        "minimize = \"volume\"\n{}{}{}{}{}[definitions]\npairs = \"sum(ribs: sum(ribs where line == outer.line and x > outer.x: x - outer.x))\"\n\
         [[constraints]]\nname = \"root\"\nfor = \"ribs\"\n\
         require = \"(10*(10 - x) + sum(ribs where x > outer.x and line == outer.line: 78*volume*(x + 2.5 - outer.x)))/from.Wx <= 100e3\"\n",
        section("a"),
        section("b"),
        rib("r1", "a", 0.0, "mast"),
        rib("r2", "b", 5.0, "mast"),
        rib("other", "b", 7.0, "beside"),
    );
    let input = ribopt::input::read_text("mast.toml", &text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert!(input.warnings.is_empty(), "{:?}", input.problem.warnings);
    let subject = Subject::of_text("mast.toml", &text).unwrap();
    let found = outcome(&subject).unwrap();
    assert_eq!(found.status, Status::Certified, "{}", found.message);
    // r2 carries 10·5 alone; r1 its own 10·10 and the weight of r2 at 7.5.
    let outer = (6.0 * 50.0 / 0.1 / 100e3f64).sqrt();
    let inner = (6.0 * (100.0 + 78.0 * 0.1 * outer * 5.0 * 7.5) / 0.1 / 100e3).sqrt();
    assert!((found.x[0] - inner).abs() < 1e-8 && (found.x[1] - outer).abs() < 1e-8, "{:?}", found.x);
}

#[test]
fn without_an_item_outside_outer_is_a_mistake() {
    let text = "minimize = \"sum(ribs: outer.length*volume)\"\n[sections.a]\nkind = \"rectangle\"\nb = 0.1\n\
                h = { lower = 0.05, upper = 2 }\n[[ribs]]\nname = \"r\"\nsection = \"a\"\nlength = 5\n";
    let message = ribopt::input::read_text("x.toml", text).unwrap_err().to_string();
    assert!(message.contains("no item outside"), "{message}");
}
