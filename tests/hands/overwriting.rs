//! Nothing of the user's is ever overwritten.

use std::fs;

use crate::place::{BOX, Place, RIBS, SECTIONS, TWO, X};

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
fn compare_spares_the_problems_and_their_tables() {
    let place = Place::new(&[("ov/s.csv", SECTIONS), ("ov/compare.csv", RIBS), ("ov/profile-seconds.svg", BOX)]);
    place.write("ov/p.toml", "[tables]\nsections = \"s.csv\"\nribs = \"compare.csv\"\n");
    for (problem, kept, text) in
        [("ov/p.toml", "ov/compare.csv", RIBS), ("ov/profile-seconds.svg", "ov/profile-seconds.svg", BOX)]
    {
        let (code, _, err) = place.said(&format!("compare {problem} --profile ./ov"));
        assert!(code == 2 && err.contains(kept) && err.contains("would be overwritten"), "{err}");
        assert_eq!(place.read(kept), text);
    }
    let (code, _, err) = place.said("compare ov/p.toml --profile elsewhere");
    assert!(code == 0 && place.read("elsewhere/compare.csv").starts_with("file,"), "{err}");
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
