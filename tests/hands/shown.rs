//! What is shown is what happened: logs, pictures, tables of utilisation and sizes.

use crate::place::{BOX, Place, TAPERED};

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
fn a_network_tells_where_it_is_used_and_what_governs() {
    let place = Place::new(&[]);
    assert_eq!(place.said("mesh new vault -o v.obj").0, 0);
    assert_eq!(place.said("mesh ribs v.obj --unit m -o v").0, 0);
    assert_eq!(place.said("solve v/problem.toml -q --plot --backend argmin").0, 0);
    let svg = place.read("results/v/network.svg");
    // Every line governs: sizes are what tells.
    assert!(svg.contains("362 ribs, coloured by the area of their sections (all are used alike)"), "{}", &svg[..1000]);
    assert!(svg.contains("prefers-color-scheme: dark") && svg.contains("<title>") && svg.contains(" m²"));
    assert!(svg.contains("paler: seen from the inner side"), "its far side turns its back");
    assert_eq!(place.said("solve v/problem.toml -q --backend argmin").0, 0);
    assert!(!place.has("results/v/network.svg"), "a picture of an earlier run");
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

#[test]
fn every_limit_is_told_with_its_use() {
    let place = Place::new(&[("t.toml", TAPERED)]);
    let (code, out, err) = place.said("solve t.toml");
    assert_eq!(code, 0, "{err}");
    assert!(out.contains("Utilisation") && out.contains("by section and rib"), "{out}");
    let percents = place.column("results/t/limits.csv", "percent");
    let names = place.column("results/t/limits.csv", "name");
    let at =
        |name: &str| percents[names.iter().position(|known| known == name).expect("the row")].parse::<f64>().expect("a number");
    assert!((at("bending quarter") - 100.0).abs() < 1e-6 && at("bending mid") < 60.0);
    // mid.hw >= end.hw, both of which vary.
    assert!((at("taper") - 100.0 * 200.0 / 1197.65).abs() < 0.01, "{}", at("taper"));
    assert!(names.contains(&"web c/t[mid]".to_owned()));
}

#[test]
fn sizes_hold_linked_ones_and_volumes_the_mass() {
    let place = Place::new(&[("i.toml", include_str!("../../src/sections/examples/i-section.toml"))]);
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
