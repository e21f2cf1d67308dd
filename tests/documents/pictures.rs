//! `ribopt section` and `ribopt solve --plot`: properties and pictures.

use std::fs;
use std::path::Path;
use std::process::{Command, Output};

use serde_json::Value;

fn ribopt(arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_ribopt")).args(arguments).output().expect("the program runs")
}

fn whole_picture(path: &Path) {
    let svg = fs::read_to_string(path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    assert!(svg.starts_with("<svg") && svg.ends_with("</svg>\n"), "{}", path.display());
    assert!(!svg.contains("NaN") && !svg.contains("inf"), "{}", path.display());
}

#[test]
fn a_section_by_its_kind_in_json() {
    let output = ribopt(&["section", "--kind", "rectangle", "--dims", "b=0.2,h=0.5", "--json"]);
    assert_eq!(output.status.code(), Some(0));
    let sections: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(sections[0]["dimensions"]["h"], 0.5);
    assert_eq!(sections[0]["properties"]["A"], 0.1);
}

#[test]
fn a_polygon_with_holes_is_cut_out_and_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let svg = folder.path().join("hollow.svg");
    let points = "0 0; 4 0; 4 3; 0 3 | 1 1; 2 1; 2 2; 1 2 | 3 1; 3 2; 3.5 2; 3.5 1";
    let arguments = ["section", "--kind", "polygon", "--dims", "scale=2", "--points", points, "--json", "--svg"];
    let output = ribopt(&[&arguments[..], &[svg.to_str().expect("a path")]].concat());
    let sections: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert_eq!(sections[0]["properties"]["A"], 42.0);
    assert_eq!(
        (sections[0]["points"].as_array().map(Vec::len), sections[0]["holes"].as_array().map(Vec::len)),
        (Some(4), Some(2))
    );
    whole_picture(&svg);
}

#[test]
fn a_section_that_cannot_be_exits_with_1_and_says_why() {
    let output = ribopt(&["section", "--kind", "tube", "--dims", "d=0.2,t=0.11"]);
    assert_eq!(output.status.code(), Some(1));
    assert!(String::from_utf8_lossy(&output.stdout).contains("not valid: di is"));
}

#[test]
fn wrong_arguments_exit_with_2_and_name_the_remedy() {
    let cases: [(&[&str], &str); 7] = [
        (&["section", "--kind", "polyline", "--dims", "thickness=1", "--points", "0 0; 4 0 | 1 1; 2 1; 2 2"], "takes no holes"),
        (&["section", "--kind", "tub", "--dims", "d=1"], "did you mean `tube`"),
        (&["section", "--kind", "tube", "--dims", "d=1"], "give d, t"),
        (&["section", "--kind", "tube", "--dims", "d:1"], "NAME=NUMBER"),
        (&["section", "--kind", "polygon", "--dims", "scale=1"], "--points"),
        (&["section", "--kind", "polygon", "--dims", "scale=1", "--points", "0 0; 1 1; 1 0; 0 1"], "crosses or touches itself"),
        (&["section", "problems/tee-girder.toml", "beem"], "did you mean `beam`"),
    ];
    for (arguments, remedy) in cases {
        let output = ribopt(arguments);
        let message = String::from_utf8_lossy(&output.stderr).into_owned();
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {message}");
        assert!(message.contains(remedy), "{arguments:?}: {message}");
    }
}

#[test]
fn a_file_s_sections_at_the_answer_are_drawn() {
    let folder = tempfile::tempdir().expect("a folder");
    let out = folder.path().join("out");
    let solved = ribopt(&["solve", "problems/bspline-haunch.toml", "--plot", "--quiet", "--out", out.to_str().expect("a path")]);
    assert_eq!(solved.status.code(), Some(0));
    for name in ["convergence.svg", "sections.svg", "ribs.svg", "profiles.svg"] {
        whole_picture(&out.join(name));
    }
    let (answer, svg) = (out.join("result.json"), folder.path().join("root.svg"));
    let output = ribopt(&[
        "section",
        "problems/bspline-haunch.toml",
        "x0",
        "--answer",
        answer.to_str().expect("a path"),
        "--svg",
        svg.to_str().expect("a path"),
        "--json",
    ]);
    let sections: Value = serde_json::from_slice(&output.stdout).expect("JSON");
    let depth = sections[0]["dimensions"]["h"].as_f64().expect("a number");
    assert!((depth - 0.8899438).abs() < 1e-6, "{depth}");
    whole_picture(&svg);
}
