//! Numbers with units: read as the same problem as the numbers they stand for, in whatever base units, and inferred where nothing is said.

use std::fs;

use ribopt::input::{Input, read, read_text};
use ribopt::run::{Subject, solve};
use tempfile::tempdir;

/// A rib with its numbers as `[E, fy, length, least width, largest width, M, sag]`.
fn rib(units: &str, numbers: [&str; 7]) -> String {
    let [young, fy, length, least, largest, moment, sag] = numbers;
    format!(
        r#"
units = {units}
[parameters]
E = {young}
fy = {fy}
[sections.s]
kind = "rectangle"
b = {{ lower = {least}, upper = {largest} }}
h = {{ lower = {least}, upper = "2*{largest_inside}" }}
[[ribs]]
name = "r"
section = "s"
length = {length}
data = {{ M = {moment} }}
[[constraints]]
name = "bending"
for = "ribs"
require = "M/from.Wx <= fy"
[[constraints]]
name = "sag"
for = "ribs"
require = "M*length^2/(10*E*from.Ix) <= {sag}"
[[constraints]]
name = "slender"
for = "sections"
require = "h <= 4*b"
"#,
        largest_inside = largest.trim_matches('"')
    )
}

fn quantities(units: &str) -> String {
    rib(units, ["\"210 GPa\"", "\"235 N/mm²\"", "\"6 m\"", "\"20 mm\"", "\"40 cm\"", "\"40 kN·m\"", "2 cm"])
}

fn input(text: &str) -> Input {
    read_text("rib.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

fn optimum(text: &str) -> f64 {
    let subject = Subject::of_text("rib.toml", text).unwrap_or_else(|error| panic!("{error}"));
    let outcome = solve::outcome(&subject).unwrap_or_else(|error| panic!("{error}"));
    outcome.objective.expect("a volume")
}

#[test]
fn quantities_are_the_numbers_they_stand_for() {
    let metres = "{ length = \"m\", force = \"kN\" }";
    let plain = rib(metres, ["210e6", "235e3", "6", "0.02", "0.4", "40", "0.02"]);
    let (measured, plain) = (input(&quantities(metres)), input(&plain));
    assert_eq!(measured.problem.variables.lower, plain.problem.variables.lower);
    assert_eq!(measured.problem.variables.upper, plain.problem.variables.upper);
    assert_eq!(measured.problem.ribs.length, plain.problem.ribs.length);
    for (measured, plain) in measured.problem.constraints.iter().zip(&plain.problem.constraints) {
        assert_eq!((&measured.left, format!("{:?}", measured.right)), (&plain.left, format!("{:?}", plain.right)));
    }
    assert!(measured.dimensions.quantities && !plain.dimensions.quantities);
    assert!(measured.warnings.is_empty(), "{:?}", measured.warnings);
}

#[test]
fn the_optimum_is_the_same_in_any_base_units() {
    let metres = optimum(&quantities("{ length = \"m\", force = \"kN\" }"));
    let millimetres = optimum(&quantities("{ length = \"mm\", force = \"N\" }"));
    let inches = optimum(&quantities("{ length = \"in\", force = \"kip\" }"));
    assert!((millimetres / metres * 1e-9 - 1.0).abs() < 1e-9);
    assert!((inches * 0.0254_f64.powi(3) / metres - 1.0).abs() < 1e-9);
}

#[test]
fn headers_with_units_convert_numbers() {
    let folder = tempdir().unwrap();
    let write = |name: &str, text: &str| fs::write(folder.path().join(name), text).unwrap();
    write("sections.csv", "name;kind;b [mm];h.lower [mm];h.upper [m]\ns;rectangle;62,5;100;0,8\n");
    write("ribs.csv", "name,section,length [mm],M [N*mm],line\nr,s,3000,4e7,L0\n");
    let problem = "units = { length = \"m\", force = \"kN\" }\n[tables]\nsections = \"sections.csv\"\nribs = \"ribs.csv\"\n\
                   [[constraints]]\nfor = \"ribs\"\nrequire = \"M/from.Wx <= 15 MPa\"\n";
    write("problem.toml", problem);
    let input = read(&folder.path().join("problem.toml")).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    assert_eq!(input.problem.variables.lower, [0.1]);
    assert_eq!(input.problem.variables.upper, [0.8]);
    assert_eq!(input.problem.ribs.length, [3.0]);
    assert_eq!(format!("{:?}", input.problem.ribs.data[0].cells), "Numbers([40.0])");
}

#[test]
fn dimensions_of_bare_numbers_follow_from_formulas() {
    let text = rib("{ length = \"m\", force = \"kN\" }", ["210e6", "235e3", "6", "0.02", "0.4", "40", "20 mm"]);
    let dimensions = input(&text).dimensions;
    let of = |name: &str| {
        let found = dimensions.measured.iter().find(|measured| measured.name == name).unwrap();
        found.dimension.map(|dimension| dimension.to_string())
    };
    // Nothing says what M is, or E: only that E is M over length³.
    assert_eq!(of("E"), None);
    let known = text.replace("M = 40", "M = \"40 kN*m\"");
    let dimensions = input(&known).dimensions;
    let measured = dimensions.measured.iter().find(|measured| measured.name == "E").unwrap();
    let dimension = measured.dimension.unwrap();
    assert_eq!(dimension.to_string(), "force/length²");
    let spoken = dimensions.units.spoken(measured.value.unwrap(), dimension).unwrap();
    assert_eq!(spoken, (210.0, "GPa".into()));
}

#[test]
fn a_number_that_would_have_a_dimension_is_doubted() {
    let text = quantities("{ length = \"m\", force = \"kN\" }").replace("*length^2/(10", "*length/(10");
    let warnings = input(&text).warnings;
    assert_eq!(warnings.len(), 1, "{warnings:?}");
    assert_eq!(warnings[0].message, "the formula holds only if this number is 1/length");
}

#[test]
fn units_do_not_change_what_old_files_mean() {
    // A text of data with blanks is a text; names that look like units are names.
    let text = "minimize = \"m*t/s\"\n[variables]\nm = { lower = 1 }\nt = { lower = 1 }\ns = { lower = 1, upper = 2 }\n";
    let input = read_text("old.toml", text).unwrap();
    assert!(!input.dimensions.quantities);
}

#[test]
fn a_name_hidden_in_a_unit_is_warned_of() {
    let text = "units = { length = \"m\", force = \"kN\" }\nminimize = \"x\"\n[parameters]\nt = 2\n[variables]\nx = { lower = 1 }\n\
                [[constraints]]\nrequire = \"x >= value(5 kN/t, 'kN/t')\"\n";
    let messages: Vec<String> =
        read_text("hidden.toml", text).map(|input| input.warnings).unwrap_or_default().into_iter().map(|w| w.message).collect();
    assert!(messages.contains(&"`t` is a part of the unit here, not what has this name".to_owned()), "{messages:?}");
}

#[test]
fn dimensions_of_one_name_have_the_units_of_their_kinds() {
    let text = r#"
units = { length = "m" }
minimize = "beam.b + beam.r + oval.b + oval.r*beam.h"
[sections.beam]
kind = "h-beam"
tw = 0.01
b = { lower = 0.1, upper = 0.3 }
tf = 0.02
h = 0.4
r = { lower = 0.01, upper = 0.02 }
[sections.oval]
kind = "superellipse"
a = 0.1
b = { lower = 0.1, upper = 0.3 }
r = { lower = 2.0, upper = 3.0 }
"#;
    let subject = Subject::of_text("units.toml", text).unwrap_or_else(|mistakes| panic!("{mistakes}"));
    let unit = |name: &str| subject.about.shown.own_of_variable(name);
    let metres = || Some("m".to_owned());
    assert_eq!([unit("beam.b"), unit("beam.r"), unit("oval.b"), unit("oval.r")], [metres(), metres(), metres(), None]);
}
