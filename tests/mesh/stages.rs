//! `ribopt mesh trace`, `slice`, `ribs` and `ribopt solve --solids`: stage by stage, on small meshes.

use std::fs;

use serde_json::Value;

use crate::program::{err, folder, grid, number, report, ribopt, within};

#[test]
fn trace_finds_the_lines_of_formulas() {
    let folder = folder(&[("grid.obj", grid(|_| {}))]);
    let path = folder.path();
    let of_grid = report(path, "mesh trace grid.obj -o grid_lines.obj", 0);
    assert_eq!((number(&of_grid, "/lines"), number(&of_grid, "/edges")), (9.0, 31.0));
    report(path, "mesh new cube -o cube.obj", 0);
    let of_cube = report(path, "mesh trace cube.obj -o lines.csv", 0);
    assert_eq!(["/lines", "/closed", "/edges"].map(|name| number(&of_cube, name)), [18.0, 6.0, 108.0]);
    let table = fs::read_to_string(path.join("lines.csv")).unwrap();
    assert!(table.starts_with("line,closed,point,vertex,x,y,z\n") && table.lines().count() == 1 + 108 + 18);
    assert!(fs::read_to_string(path.join("grid_lines.obj")).unwrap().lines().filter(|line| line.starts_with("l ")).count() >= 9);
}

#[test]
fn flagged_edges_alone_carry_ribs() {
    let folder = folder(&[("grid.obj", grid(|lines| lines.push("l 6 7 8 9 10".into())))]);
    let traced = report(folder.path(), "mesh trace grid.obj -o lines.obj", 0);
    assert_eq!((number(&traced, "/lines"), number(&traced, "/edges"), &traced["flagged_only"]), (1.0, 4.0, &Value::Bool(true)));
}

#[test]
fn slices_bound_the_segments_and_cut_solids() {
    let folder = folder(&[("grid.obj", grid(|_| {}))]);
    let path = folder.path();
    let sliced = report(path, "mesh slice grid.obj --segments 0.4 -o stations.csv", 0);
    assert_eq!(number(&sliced, "/segments"), 93.0);
    assert!((number(&sliced, "/length") - 31.0).abs() < 1e-12);
    assert!(number(&sliced, "/longest") <= 0.4);
    report(path, "mesh new cube -o cube.obj", 0);
    for plane in ["z=0.3", "0.5,0.5,0.3:0,0,1"] {
        let cut = report(path, &format!("mesh slice cube.obj --plane {plane} -o cut.csv"), 0);
        assert!(within(number(&cut, "/area"), 1.0, 1e-14) && within(number(&cut, "/pieces/0/ix"), 1.0 / 12.0, 1e-13), "{cut}");
    }
    report(path, "mesh slice cube.obj --plane x=0.5 -o cut.svg", 0);
    assert!(fs::read_to_string(path.join("cut.svg")).unwrap().starts_with("<svg"));
    let coplanar = ribopt(path, "mesh slice cube.obj --plane z=0 -o cut.csv");
    assert_eq!(coplanar.status.code(), Some(2));
    insta::assert_snapshot!(err(&coplanar));
}

/// From the vault to solids: lengths, volumes, files. Few ribs, so that a debug build is quick.
#[test]
fn from_a_mesh_to_solids() {
    let folder = folder(&[("grid.obj", grid(|lines| lines.extend(["l 6 7 8 9 10".to_string(), "l 3 8 13 18".to_string()])))]);
    let path = folder.path();
    for kind in ["rectangle", "h-beam", "tee", "box", "circle", "tube", "superellipse"] {
        let made = report(path, &format!("mesh ribs grid.obj --kind {kind} --segments 1 --load 60 -o {kind}"), 0);
        assert_eq!((number(&made, "/problem/ribs"), number(&made, "/problem/length")), (7.0, 7.0));
        let solids = "--solids s.obj --solids s.stl --solids s.vtu";
        let solved = report(path, &format!("solve {kind}/problem.toml --out out {solids} --plot"), 0);
        assert_eq!(solved["status"], "certified");
        let built: Value = serde_json::from_slice(&fs::read(path.join("s.json")).unwrap()).unwrap();
        assert_eq!(number(&built, "/solids"), 7.0);
        for volume in ["/volume", "/model_volume", "/prismatoid_volume"] {
            assert!(within(number(&built, volume), number(&solved, "/objective"), 1e-12), "{kind}: {built}");
        }
        assert!(number(&built, "/largest_model_difference") < 1e-12);
        // The two lines cross at one vertex.
        assert_eq!(number(&built, "/overlapping_joints"), 1.0);
        let picture = fs::read_to_string(path.join("out/network.svg")).unwrap();
        // A title per rib, and its own.
        assert_eq!(picture.matches("<title>").count(), 8);
        let vtu = fs::read_to_string(path.join("s.vtu")).unwrap();
        assert!(
            ["utilisation", "area", "length", "volume"].iter().all(|name| vtu.contains(&format!("Name=\"{name}\""))),
            "{vtu}"
        );
        let at_bounds = solved["bounds"].as_array().unwrap().iter().filter(|bound| bound["active"] == "lower").count();
        assert!(at_bounds < solved["bounds"].as_array().unwrap().len() / 2, "{kind}: the optimum is more than the lower bounds");
    }
}

/// Kinds drawn by points, from tables of their own: a polygon with a hole, lines with one thickness and with one per segment.
#[test]
fn solids_of_sections_drawn_by_points() {
    let folder = folder(&[("grid.obj", grid(|lines| lines.push("l 6 7 8 9 10".into())))]);
    let path = folder.path();
    report(path, "mesh ribs grid.obj --segments 1 -o r", 0);
    let names: Vec<String> = fs::read_to_string(path.join("r/sections.csv")).unwrap().lines().skip(1).map(first_cell).collect();
    let channel = "0.05 0; 0 0; 0 0.2; 0.05 0.2";
    let tables = [
        (
            "polygon",
            "scale_x.lower,scale_x.upper,scale_y.lower,scale_y.upper,points",
            "0.1,9,0.1,9,0 0; .1 0; .1 .2; 0 .2 | .03 .05; .07 .05; .05 .1",
        ),
        ("polyline", "thickness.lower,thickness.upper,points", &format!("0.001,0.03,{channel}")),
        (
            "polyline",
            "thickness[1],thickness[2].lower,thickness[2].upper,thickness[3],points",
            &format!("0.01,0.001,0.03,0.01,{channel}"),
        ),
    ];
    for (kind, header, cells) in tables {
        let rows: String = names.iter().map(|name| format!("{name},{kind},{cells}\n")).collect();
        fs::write(path.join("r/sections.csv"), format!("name,kind,{header}\n{rows}")).unwrap();
        let constraint = "[[constraints]]\nname = 'stiff'\nfor = 'sections'\nrequire = 'Ix >= 3e-5'\n";
        let tables = "[tables]\nsections = 'sections.csv'\nribs = 'ribs.csv'\n";
        fs::write(path.join("r/problem.toml"), format!("{constraint}{tables}")).unwrap();
        let solved = report(path, "solve r/problem.toml --out out --solids s.stl --solids s.obj", 0);
        let built: Value = serde_json::from_slice(&fs::read(path.join("s.json")).unwrap()).unwrap();
        for volume in ["/volume", "/model_volume", "/prismatoid_volume"] {
            assert!(within(number(&built, volume), number(&solved, "/volume/prismatoid"), 1e-12), "{kind}: {built}");
        }
    }
}

fn first_cell(row: &str) -> String {
    row.split(',').next().unwrap_or_default().into()
}

/// Lines that share no section are problems of their own: NLopt takes the vault apart, and agrees with the other backend.
#[test]
fn independent_lines_are_solved_one_by_one() {
    let folder = folder(&[]);
    let path = folder.path();
    report(path, "mesh new small-vault -o vault.obj", 0);
    report(path, "mesh ribs vault.obj -o vault", 0);
    let solved = report(path, "solve vault/problem.toml", 0);
    assert_eq!((&solved["status"], &solved["agreement"]["agree"]), (&"certified".into(), &true.into()), "{solved}");
    let by_nlopt = &solved["solutions"][0];
    assert!(by_nlopt["message"].as_str().unwrap().contains("9 independent components"), "{by_nlopt}");
}

#[test]
fn a_rib_in_full_use_says_so() {
    let folder = folder(&[("grid.obj", grid(|lines| lines.push("l 6 7 8 9 10".into())))]);
    let path = folder.path();
    report(path, "mesh ribs grid.obj --load 60 -o flat", 0);
    report(path, "solve flat/problem.toml --backend argmin --solids s.stl", 0);
    let tags = fs::read_to_string(path.join("s.csv")).unwrap();
    let mut rows = tags.lines().map(|row| row.split(',').collect::<Vec<_>>());
    assert_eq!(rows.next().unwrap()[..3], ["rib", "utilisation", "area"]);
    for row in rows {
        assert!((row[1].parse::<f64>().unwrap() - 1.0).abs() < 1e-6, "{row:?}");
    }
}

#[test]
fn the_same_input_gives_the_same_bytes() {
    let folder = folder(&[]);
    let path = folder.path();
    for at in ["a", "b"] {
        report(path, &format!("mesh new dome -o {at}/dome.obj"), 0);
        report(path, &format!("mesh ribs {at}/dome.obj -o {at}/dome"), 0);
    }
    for name in ["dome.obj", "dome/problem.toml", "dome/sections.csv", "dome/ribs.csv", "dome/geometry.csv", "dome/mesh.json"] {
        let [a, b] = ["a", "b"].map(|at| fs::read(path.join(at).join(name)).unwrap());
        assert!(a == b, "{name}");
    }
}

#[test]
fn lengths_of_ribs_are_those_of_the_edges() {
    let folder = folder(&[]);
    let path = folder.path();
    for name in ["vault", "dome", "shell"] {
        report(path, &format!("mesh new {name} -o {name}.obj"), 0);
        let traced = report(path, &format!("mesh trace {name}.obj -o lines.csv"), 0);
        let made = report(path, &format!("mesh ribs {name}.obj -o {name}"), 0);
        let checked = report(path, &format!("mesh check {name}.obj"), 0);
        let edges = number(&checked, "/invariants/rib_edges");
        assert_eq!((number(&made, "/problem/ribs"), number(&traced, "/edges")), (edges, edges));
        let length = edges * number(&checked, "/invariants/edge_lengths/mean");
        assert!(within(number(&made, "/problem/length"), length, 1e-12) && within(number(&traced, "/length"), length, 1e-12));
    }
}

#[test]
fn solids_without_a_place_are_told_before_the_solve() {
    let folder = folder(&[("grid.obj", grid(|_| {}))]);
    let path = folder.path();
    report(path, "mesh ribs grid.obj -o flat", 0);
    fs::remove_file(path.join("flat/geometry.csv")).unwrap();
    let output = ribopt(path, "solve flat/problem.toml --out out --solids s.obj");
    assert_eq!((output.status.code(), path.join("out").exists()), (Some(2), false));
    insta::assert_snapshot!(err(&output));
}
