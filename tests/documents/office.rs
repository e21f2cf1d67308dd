//! What an office needs of a run: units in every report, lists in tables, a schedule as a workbook, hints.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use super::support::workbook::part;
use serde_json::Value;

fn ribopt(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ribopt")).current_dir(folder).args(arguments).output().unwrap()
}

fn text(bytes: &[u8]) -> String {
    String::from_utf8_lossy(bytes).into_owned()
}

/// A purlin with everything in units, told in others than its own.
const PURLIN: &str = r#"
title = "Purlin"
units = { length = "m", force = "kN" }
show = { stress = "MPa", length = "mm", volume = "dm^3" }
[parameters]
fm = "14.8 MPa"
q = "3 kN/m"
[sections.s]
kind = "rectangle"
b = { lower = "60 mm", upper = "200 mm" }
h = { lower = "100 mm", upper = "400 mm" }
[[ribs]]
name = "main"
section = "s"
length = "4.5 m"
[[constraints]]
name = "bending"
for = "ribs"
require = "q*length^2/8/from.Wx <= fm"
[[constraints]]
name = "slender"
for = "sections"
require = "h <= 5*b"
"#;

#[test]
fn reports_tell_units_as_they_are_wanted_and_results_the_files_own() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("purlin.toml"), PURLIN).unwrap();
    let output = ribopt(folder.path(), &["solve", "purlin.toml", "--report", "--out", "run"]);
    let said = text(&output.stdout);
    assert!(output.status.success(), "{said}{}", text(&output.stderr));
    let line = |begin: &str| {
        said.lines().find(|line| line.trim_start().starts_with(begin)).unwrap_or_else(|| panic!("{begin}:\n{said}"))
    };
    assert!(line("s.b").ends_with("mm") && line("s.b").contains(" 200 "), "{said}");
    assert!(line("volume =").ends_with("dm^3"), "{said}");
    // A limit of 14.8 MPa, and its price in dm³ per MPa: a thousandth part of a MPa is one kN/m², of a m³ one dm³.
    assert!(line("bending[main]").contains("14.8") && line("bending[main]").ends_with("MPa"), "{said}");
    let result: Value = serde_json::from_str(&fs::read_to_string(folder.path().join("run/result.json")).unwrap()).unwrap();
    let row = |name: &str| result["constraints"].as_array().unwrap().iter().find(|row| row["name"] == name).unwrap().clone();
    assert_eq!((row("bending[main]")["unit"].as_str(), row("bending[main]")["upper"].as_f64()), (Some("kN/m²"), Some(14_800.0)));
    assert_eq!(result["bounds"][0]["unit"], "m");
    assert_eq!(result["problem"]["show"]["kN/m²"][0], "MPa");
    let page = fs::read_to_string(folder.path().join("run/report.html")).unwrap();
    assert!(page.contains("<td>MPa</td>") && page.contains("<td>mm</td>"));
    let per_unit = |said: &str| said.split_whitespace().nth(4).unwrap().parse::<f64>().unwrap();
    let priced = row("bending[main]")["sensitivity"].as_f64().unwrap() * 1000.0 * 1000.0;
    assert!((per_unit(line("bending[main]")) / priced - 1.0).abs() < 1e-4, "{priced}: {said}");
    // The page and the network are ribopt's own, and give way to those of the next run.
    let again = ribopt(folder.path(), &["solve", "purlin.toml", "--report", "--out", "run", "--quiet"]);
    assert!(again.status.success(), "{}", text_of(&again));
}

#[test]
fn a_tiny_lower_bound_that_governs_is_hinted_at() {
    let folder = tempfile::tempdir().unwrap();
    let file = |lower: &str| {
        let text = format!(
            "minimize = \"x + 1/y\"\n[variables]\nx = {{ lower = {lower}, upper = 5, start = 1 }}\ny = {{ lower = 1, upper = 2 }}\n"
        );
        fs::write(folder.path().join("tiny.toml"), text).unwrap();
        text_of(&ribopt(folder.path(), &["solve", "tiny.toml", "--quiet"]))
    };
    let text_of_hint = file("1e-6");
    assert!(text_of_hint.contains("x (1e-6) rests on its lower bound, tiny beside the start"), "{text_of_hint}");
    assert!(!file("0.5").contains("tiny"));
    assert!(!file("0").contains("tiny"));
}

fn text_of(output: &Output) -> String {
    text(&output.stdout) + &text(&output.stderr)
}

#[test]
fn tables_of_sections_have_lists() {
    let folder = tempfile::tempdir().unwrap();
    let table = "name,kind,b.lower [mm],b.upper [mm],b.step [mm],h.values [mm]\ns,rectangle,60,200,20,100 160 220 300\n";
    fs::write(folder.path().join("sections.csv"), table).unwrap();
    let head = PURLIN.split("[sections.s]").next().unwrap();
    let tail = PURLIN.split("[[ribs]]").nth(1).unwrap();
    fs::write(folder.path().join("list.toml"), format!("{head}\n[tables]\nsections = \"sections.csv\"\n[[ribs]]{tail}")).unwrap();
    let output = ribopt(folder.path(), &["solve", "list.toml", "--json"]);
    let result: Value = serde_json::from_slice(&output.stdout).unwrap_or_else(|_| panic!("{}", text_of(&output)));
    assert_eq!(result["status"], "certified", "{}", result["message"]);
    // W ≥ 3·4.5²/8/14800 = 5.131e-4 m³, h ≤ 5·b: of all pairs 80 × 220 is the smallest area with W enough.
    let (b, h) = (result["variables"]["s.b"].as_f64().unwrap(), result["variables"]["s.h"].as_f64().unwrap());
    let best = [60, 80, 100, 120, 140, 160, 180, 200]
        .into_iter()
        .flat_map(|b| [100, 160, 220, 300].map(|h| (b, h)))
        .filter(|&(b, h)| h <= 5 * b && f64::from(b * h * h) / 6e9 >= 3.0 * 4.5 * 4.5 / 8.0 / 14_800.0)
        .min_by_key(|&(b, h)| b * h)
        .unwrap();
    assert_eq!(((1000.0 * b).round() as i32, (1000.0 * h).round() as i32), best);
    let twice = table.replace("100 160 220 300", "100 x");
    fs::write(folder.path().join("sections.csv"), twice).unwrap();
    let refused = text_of(&ribopt(folder.path(), &["check", "list.toml"]));
    assert!(refused.contains("mistake[units]: the column has a unit, and this is no number"), "{refused}");
}

#[test]
fn the_schedule_is_a_workbook_with_every_rib() {
    let folder = tempfile::tempdir().unwrap();
    let root = Path::new(env!("CARGO_MANIFEST_DIR"));
    let problem = root.join("problems/portal-frame.toml");
    let solve = |out: &str| {
        let output = ribopt(folder.path(), &["solve", problem.to_str().unwrap(), "--quiet", "--schedule", out]);
        assert!(output.status.success(), "{}", text_of(&output));
        folder.path().join(out)
    };
    let first = solve("first.xlsx");
    assert_eq!(fs::read(&first).unwrap(), fs::read(solve("second.xlsx")).unwrap(), "the same file every time");
    let strings = part(&first, "xl/sharedStrings.xml");
    for word in ["column1", "rafter1", "length [m]", "volume [m³]", "mass [t]", "hw from", "utilisation", "governs", "certified"]
    {
        assert!(strings.contains(word), "{word} is missing: {strings}");
    }
    let sheets = part(&first, "xl/workbook.xml");
    assert!(sheets.contains("\"ribs\"") && sheets.contains("\"sections\"") && sheets.contains("\"origin\""), "{sheets}");
    // A header and four ribs.
    assert_eq!(part(&first, "xl/worksheets/sheet1.xml").matches("<row ").count(), 5);
    let refused = ribopt(folder.path(), &["solve", problem.to_str().unwrap(), "--schedule", "ribs.csv"]);
    assert_eq!(refused.status.code(), Some(2), "{}", text_of(&refused));
    assert!(text_of(&refused).contains("ends in .xlsx"));
}
