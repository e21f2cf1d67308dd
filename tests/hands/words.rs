//! Plain words.

use std::fs;

use crate::place::{BOX, Place, RIBS, SECTIONS, TAPERED, TWO, X};

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
fn limits_that_are_reached_at_once_are_told_in_a_line() {
    let place = Place::new(&[("b.toml", BOX)]);
    let (code, out, _) = place.said("solve b.toml --max-seconds 0");
    let said = out.lines().find(|line| line.starts_with("limit-reached:")).unwrap_or_default();
    assert!(code == 5 && said.contains("the time limit is reached") && said.chars().count() < 200, "{out}");
    assert!(!said.contains("of its scale") && out.contains("raise max_seconds"), "{out}");
}

#[test]
fn huge_numbers_are_no_rows_of_digits() {
    let file = "minimize = \"x\"\n[parameters]\nM = 1e306\n[variables]\nx = { lower = 1, upper = 9 }\n\
                [[constraints]]\nname = \"stress\"\nrequire = \"M/x^2 <= 235\"\n";
    let (code, out, _) = Place::new(&[("m.toml", file)]).said("solve m.toml --max-seconds 5");
    assert!(code == 1 || code == 3, "{out}");
    assert!(!out.contains("000000000000") && !out.contains("by little"), "{out}");
}

#[test]
fn a_unit_after_a_number_is_no_forgotten_product() {
    let file = X.replace("y = {", "z = {") + "[[constraints]]\nrequire = \"x + 2.5 m <= 3\"\n";
    let (_, _, err) = Place::new(&[("u.toml", &file)]).said("check u.toml");
    assert!(err.contains("in which unit of length") && !err.contains("product"), "{err}");
}

#[test]
fn two_units_of_length_are_doubted() {
    let file = |b: &str, h: &str, length: &str| {
        format!(
            "[sections.a]\nkind = \"rectangle\"\nb = {b}\nh = {h}\n[[ribs]]\nname = \"r\"\nsection = \"a\"\nlength = {length}\n\
             [[constraints]]\nrequire = \"a.h >= a.b\"\n"
        )
    };
    let (narrow, deep, small) = ("{ lower = 0.1, upper = 0.4 }", "{ lower = 100, upper = 1000 }", "{ lower = 0.2, upper = 0.9 }");
    for (text, doubt) in [
        (file(narrow, deep, "3"), Some("a.h is at least 100, more than the longest line of ribs, 3")),
        (file(narrow, small, "30000"), Some("no dimension exceeds 0.9 (a.h)")),
        (file(narrow, small, "3"), None),
        (file(narrow, small, "300"), None),
    ] {
        let (code, _, err) = Place::new(&[("m.toml", &text)]).said("check m.toml");
        assert_eq!(code, 0, "{err}");
        assert!(doubt.map_or(err.is_empty(), |doubt| err.contains(doubt) && err.contains("in one unit?")), "{err}");
    }
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
