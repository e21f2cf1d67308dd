//! What files may hold: arrays, changes on the command line, tables of other programs.

use std::io::Write;
use std::process::Stdio;

use serde_json::Value;

use crate::place::{BOX, Place, RIBS, SECTIONS, TWO, X};

#[test]
fn a_requirement_over_arrays_is_a_row_per_element() {
    let place = Place::new(&[("l.toml", include_str!("../../src/input/examples/load-cases.toml"))]);
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
