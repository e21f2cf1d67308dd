//! `mesh ribs --structure`: grid shells under dead load and snow, read, analysed and sized.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use crate::program::{err, folder, number, out, report, ribopt, within};

/// A demo mesh as a structure.
fn written(folder: &Path, mesh: &str, options: &str) -> serde_json::Value {
    assert_eq!(ribopt(folder, &format!("mesh new {mesh} -o {mesh}.obj")).status.code(), Some(0));
    report(folder, &format!("mesh ribs {mesh}.obj --structure -o {mesh} {options}"), 0)
}

/// Sums of vertical forces by case.
fn loads(path: &Path) -> BTreeMap<String, f64> {
    let mut sums = BTreeMap::new();
    for line in fs::read_to_string(path).unwrap().lines().skip(1) {
        let cells: Vec<&str> = line.split(',').collect();
        *sums.entry(cells[0].to_owned()).or_insert(0.0) -= cells[4].parse::<f64>().unwrap();
    }
    sums
}

#[test]
fn demo_meshes_stand_and_their_supports_carry_what_acts_on_them() {
    for (mesh, options) in
        [("small-vault", "--supports lowest"), ("vault", "--kind tube"), ("dome", "--kind h-beam --sections line")]
    {
        let folder = folder(&[]);
        let path = folder.path();
        let found = written(path, mesh, &format!("{options} --dead 0.7 --snow 1.3"));
        let checked = report(path, &format!("mesh check {mesh}.obj"), 0);
        let area = number(&checked, "/invariants/area");
        assert!(within(number(&found, "/problem/structure/area"), area, 1e-12), "{mesh}");
        let sums = loads(&path.join(mesh).join("loads.csv"));
        assert!(within(sums["dead"], 0.7 * area, 1e-11), "{mesh}: {sums:?}");
        assert!(within(sums["snow"], 1.3 * number(&found, "/problem/structure/plan_area"), 1e-11), "{mesh}: {sums:?}");
        // No mechanism; what the ground carries is what acts.
        let analysed = report(path, &format!("analyse {mesh}/problem.toml"), 0);
        let reactions = analysed.pointer("/cases/snow/reactions").unwrap().as_object().unwrap();
        let up: f64 = reactions.values().map(|node| node["z"].as_f64().unwrap()).sum();
        assert!(within(up, sums["snow"], 1e-9), "{mesh}: {up} {sums:?}");
    }
}

#[test]
fn lines_alone_carry_loads_along_the_ribs() {
    let frame = "v 0 0 0\nv 0 0 3\nv 4 0 3\nv 4 0 0\nv 2 3 3\nl 1 2\nl 2 3\nl 3 4\nl 2 5\nl 3 5\n";
    let folder = folder(&[("frame.obj", frame.into())]);
    let path = folder.path();
    report(path, "mesh ribs frame.obj --structure -o frame --dead 2 --snow 3 --fixed", 0);
    let analysed = report(path, "analyse frame/problem.toml", 0);
    let reactions = analysed.pointer("/cases/snow/reactions").unwrap().as_object().unwrap();
    let up: f64 = reactions.values().map(|node| node["z"].as_f64().unwrap()).sum();
    // Nothing falls on the columns.
    assert!(within(up, 3.0 * (4.0 + 2.0 * 13f64.sqrt()), 1e-9), "{up}");
}

#[test]
fn a_small_vault_is_sized_certified_and_left_as_solids_and_pictures() {
    let folder = folder(&[]);
    let path = folder.path();
    written(
        path,
        "small-vault",
        "--supports lowest --sections one --snow 6 --thickness 0.01 --bounds b=0.01:0.3:0.05 --bounds h=0.02:0.5:0.1",
    );
    let solved =
        ribopt(path, "solve small-vault/problem.toml --backend argmin --starts 1 --plot --solids shell.vtu --out results");
    assert_eq!(solved.status.code(), Some(0), "{}{}", out(&solved), err(&solved));
    for name in ["displaced.svg", "forces.svg", "structure.vtu", "network.svg", "utilisation.csv", "limits.csv", "forces.csv"] {
        assert!(path.join("results").join(name).is_file(), "{name}");
    }
    let used = fs::read_to_string(path.join("results/utilisation.csv")).unwrap();
    assert_eq!(used.lines().count(), 58 + 1);
    let most = used.lines().skip(1).map(|line| line.split(',').nth(1).unwrap().parse::<f64>().unwrap()).fold(0.0, f64::max);
    assert!((most - 1.0).abs() < 1e-6, "some limit governs: {most}");
    let solids = fs::read_to_string(path.join("shell.vtu")).unwrap();
    assert!(solids.contains("\"ULS displacement\"") && solids.contains("\"ULS N\"") && solids.contains("\"utilisation\""));
}

#[test]
fn what_cannot_be_is_told() {
    let folder = folder(&[]);
    let path = folder.path();
    assert_eq!(ribopt(path, "mesh new cube -o cube.obj").status.code(), Some(0));
    for (arguments, expected) in [
        ("mesh ribs cube.obj --structure -o c", "--supports lowest"),
        ("mesh ribs cube.obj --structure --supports w7 -o c", "no node is called 'w7'"),
        ("mesh ribs cube.obj --structure --snow -1 -o c", "the snow load must be"),
        ("mesh ribs cube.obj --structure --sections many -o c", "station, symmetric, line, one"),
        ("mesh ribs cube.obj --structure --load 3 -o c", "cannot be used with"),
        ("mesh ribs cube.obj --snow 3 -o c", "--structure"),
    ] {
        let output = ribopt(path, arguments);
        assert!(output.status.code() == Some(2) && err(&output).contains(expected), "{arguments}: {}", err(&output));
    }
    assert!(!path.join("c").exists());
}
