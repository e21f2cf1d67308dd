//! `ribopt mesh …` and `ribopt solve --solids`: the whole program, stage by stage, on small meshes.

use std::fs;
use std::path::Path;
use std::process::{Command, Output, Stdio};

use serde_json::Value;
use tempfile::TempDir;

/// A 4×3 grid as OBJ, its squares of size 1; `edit` changes the lines.
fn grid(edit: impl Fn(&mut Vec<String>)) -> String {
    let vertices = (0..4).flat_map(|y| (0..5).map(move |x| format!("v {x} {y} 0")));
    let quad =
        |x: usize, y: usize| [5 * y + x, 5 * y + x + 1, 5 * y + x + 6, 5 * y + x + 5].map(|v| (v + 1).to_string()).join(" ");
    let faces = (0..3).flat_map(|y| (0..4).map(move |x| (x, y))).map(|(x, y)| format!("f {}", quad(x, y)));
    let mut lines: Vec<String> = vertices.chain(faces).collect();
    edit(&mut lines);
    lines.join("\n") + "\n"
}

/// An empty folder with these files.
fn folder(files: &[(&str, String)]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, text) in files {
        fs::write(folder.path().join(name), text).unwrap();
    }
    folder
}

fn ribopt(folder: &Path, arguments: &str) -> Output {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    let output = command.current_dir(folder).args(arguments.split_whitespace()).stdin(Stdio::null()).output().unwrap();
    assert!(!err(&output).contains("panicked"), "{arguments}: {}", err(&output));
    output
}

/// The JSON of a stage that ends with this exit code.
fn report(folder: &Path, arguments: &str, code: i32) -> Value {
    let output = ribopt(folder, &format!("{arguments} --json"));
    assert_eq!(output.status.code(), Some(code), "{arguments}: {}{}", out(&output), err(&output));
    serde_json::from_slice(&output.stdout).unwrap_or_else(|error| panic!("{arguments}: {error}: {}", out(&output)))
}

fn out(output: &Output) -> String {
    String::from_utf8(output.stdout.clone()).unwrap()
}

fn err(output: &Output) -> String {
    String::from_utf8(output.stderr.clone()).unwrap()
}

fn number(value: &Value, path: &str) -> f64 {
    value.pointer(path).and_then(Value::as_f64).unwrap_or_else(|| panic!("{path} is no number in {value}"))
}

fn near(a: f64, b: f64, tolerance: f64) -> bool {
    (a - b).abs() <= tolerance * b.abs()
}

/// What a stage says, exit code and standard error included.
fn said(files: &[(&str, String)], arguments: &str) -> String {
    let folder = folder(files);
    let output = ribopt(folder.path(), arguments);
    format!("exit code {}\n{}{}", output.status.code().unwrap(), out(&output), err(&output))
}

#[test]
fn check_counts_a_grid() {
    let folder = folder(&[("grid.obj", grid(|_| {}))]);
    let found = report(folder.path(), "mesh check grid.obj", 0);
    let numbers = ["vertices", "edges", "faces", "euler_characteristic", "valence_sum"]
        .map(|name| number(&found, &format!("/invariants/{name}")));
    assert_eq!(numbers, [20.0, 31.0, 12.0, 1.0, 4.0]);
    assert_eq!(found["invariants"]["boundary_loops"], serde_json::json!([14]));
    insta::assert_snapshot!(said(&[("grid.obj", grid(|_| {}))], "mesh check grid.obj"));
}

#[test]
fn check_names_every_defect_with_its_faces() {
    let defective = grid(|lines| {
        lines[20] = "f 1 6 7 2".into(); // turned over
        lines.push("v 0 0 1\nv 1 0 1\nv 7 7 7\nv 8 7 7".into());
        lines.push("f 1 2 22 21".into()); // along a boundary edge
        lines.push("f 23 24 23 24".into());
    });
    insta::assert_snapshot!(said(&[("bad.obj", defective)], "mesh check bad.obj"));
}

#[test]
fn triangles_are_told_apart() {
    let triangles = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3\nf 1 3 4\n";
    insta::assert_snapshot!(said(&[("t.obj", triangles.into())], "mesh check t.obj"));
    let refused = said(&[("t.obj", triangles.into())], "mesh smooth t.obj -o s.obj");
    assert!(refused.starts_with("exit code 2") && refused.contains("triangulated"), "{refused}");
}

#[test]
fn a_weld_is_only_done_when_asked() {
    let split = grid(|lines| {
        lines.insert(20, "v 1.0000001 1 0".into());
        let last = lines.len() - 1;
        lines[last - 11] = "f 1 2 21 6".into();
    });
    let folder = folder(&[("split.obj", split)]);
    let torn = report(folder.path(), "mesh check split.obj", 1);
    assert_eq!(torn["defects"][0]["kind"], "broken-fan");
    let welded = report(folder.path(), "mesh check split.obj --weld 1e-5", 0);
    assert_eq!((number(&welded, "/weld/joined"), number(&welded, "/invariants/edges")), (1.0, 31.0));
}

#[test]
fn reconstruct_fills_a_corner_and_twice_equals_once() {
    let holed = grid(|lines| _ = lines.remove(20));
    let folder = folder(&[("whole.obj", grid(|_| {})), ("holed.obj", holed)]);
    let path = folder.path();
    let once = report(path, "mesh reconstruct holed.obj --original whole.obj -o once.obj", 0);
    assert_eq!((number(&once, "/stage/faces_added"), number(&once, "/invariants/euler_characteristic")), (1.0, 1.0));
    assert_eq!(once, serde_json::from_slice::<Value>(&fs::read(path.join("once.json")).unwrap()).unwrap());
    let twice = report(path, "mesh reconstruct once.obj --original whole.obj -o twice.obj", 0);
    assert_eq!(number(&twice, "/stage/faces_added"), 0.0);
    assert_eq!(fs::read(path.join("once.obj")).unwrap(), fs::read(path.join("twice.obj")).unwrap());
}

#[test]
fn smoothing_damps_the_checkerboard_unless_it_is_the_notes_step() {
    let rough = grid(|lines| {
        for (at, line) in lines.iter_mut().enumerate().take(20) {
            let (x, y) = (at % 5, at / 5);
            *line = format!("v {x} {y} {}", if (x + y) % 2 == 0 { 0.1 } else { -0.1 });
        }
    });
    let folder = folder(&[("rough.obj", rough), ("flat.obj", grid(|_| {}))]);
    for method in ["laplacian", "gauss-seidel", "taubin"] {
        let smoothed =
            report(folder.path(), &format!("mesh smooth rough.obj -o {method}.obj --method {method} --iterations 20"), 0);
        assert!(number(&smoothed, "/stage/roughness/1") < 0.6 * number(&smoothed, "/stage/roughness/0"), "{method}: {smoothed}");
        assert_eq!(number(&smoothed, "/stage/free"), 6.0);
    }
    let projected = report(folder.path(), "mesh smooth rough.obj -o p.obj --slide --features 30 --project flat.obj", 0);
    assert!(number(&projected, "/stage/sliding") > 0.0);
    insta::assert_snapshot!(said(&[("g.obj", grid(|_| {}))], "mesh smooth g.obj -o s.obj --relaxation 1.5"));
}

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
        assert!(near(number(&cut, "/area"), 1.0, 1e-14) && near(number(&cut, "/pieces/0/ix"), 1.0 / 12.0, 1e-13), "{cut}");
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
            assert!(near(number(&built, volume), number(&solved, "/objective"), 1e-12), "{kind}: {built}");
        }
        assert!(number(&built, "/largest_model_difference") < 1e-12);
        // The two lines cross at one vertex.
        assert_eq!(number(&built, "/overlapping_joints"), 1.0);
        let picture = fs::read_to_string(path.join("out/network.svg")).unwrap();
        assert_eq!(picture.matches("<title>").count(), 7);
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
            assert!(near(number(&built, volume), number(&solved, "/volume/prismatoid"), 1e-12), "{kind}: {built}");
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
        assert!(near(number(&made, "/problem/length"), length, 1e-12) && near(number(&traced, "/length"), length, 1e-12));
    }
}

#[test]
fn wrong_requests_exit_with_2_and_say_what_to_do() {
    let grid = [("grid.obj", grid(|_| {})), ("p.toml", "[variables]\nx = { lower = 0, upper = 1 }\n[[sections]]\n".into())];
    let requests = [
        "mesh check nothing.obj",
        "mesh check grid.txt",
        "mesh check grid.obj --weld 0",
        "mesh trace grid.obj -o lines.txt",
        "mesh slice grid.obj -o s.csv",
        "mesh slice grid.obj --segments 0 -o s.csv",
        "mesh slice grid.obj --plane w=1 -o s.csv",
        "mesh ribs grid.obj --kind polygon -o out",
        "mesh ribs grid.obj --bounds tf=1:2 -o out",
        "mesh ribs grid.obj --bounds h=2:1 -o out",
        "mesh ribs grid.obj --load -1 -o out",
        "mesh new sphere -o s.obj",
        "mesh new dome -o s.ply",
        "solve p.toml --solids s.ply",
    ];
    let said: Vec<String> = requests.map(|request| format!("$ ribopt {request}\n{}", said(&grid, request))).into();
    insta::assert_snapshot!(said.join("\n"));
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

/// Files that are no meshes: exit code 2 (or 1 where `check` finds defects), a message, no panic.
#[test]
fn hostile_files() {
    let long = "f ".to_string() + &"1 ".repeat(100_000);
    let files: Vec<(&str, Vec<u8>)> = vec![
        ("empty.obj", vec![]),
        ("noise.obj", (0..4096u32).map(|k| (k.wrapping_mul(2654435761) >> 13) as u8).collect()),
        ("noise.ply", (0..4096u32).map(|k| (k.wrapping_mul(2654435761) >> 11) as u8).collect()),
        ("noise.stl", (0..4096u32).map(|k| (k.wrapping_mul(2654435761) >> 9) as u8).collect()),
        ("noise.off", (0..4096u32).map(|k| (k.wrapping_mul(2654435761) >> 7) as u8).collect()),
        ("nan.obj", b"v nan 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n".to_vec()),
        ("huge.obj", b"v 1e308 0 0\nv 1 0 0\nv 1 1 0\nv 0 1e308 0\nf 1 2 3 4\n".to_vec()),
        ("number.obj", b"v 0 0 0\nf 1 2 3 99999999999999999999\n".to_vec()),
        ("zero.obj", b"v 0 0 0\nf 0 0 0 0\n".to_vec()),
        ("negative.obj", b"v 0 0 0\nf -1 -2 -3 -4\n".to_vec()),
        ("long.obj", [b"v 0 0 0\n".to_vec(), long.into_bytes()].concat()),
        ("claims.off", b"OFF\n4000000000 4000000000 0\n".to_vec()),
        ("claims.ply", b"ply\nformat ascii 1.0\nelement vertex 4000000000\nproperty float x\nend_header\n".to_vec()),
        ("claims.stl", [vec![0; 80], vec![255; 4]].concat()),
        ("truncated.ply", b"ply\nformat binary_little_endian 1.0\nelement vertex 2\nproperty float x\n".to_vec()),
    ];
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in &files {
        fs::write(folder.path().join(name), bytes).unwrap();
        for (stage, codes) in [("check", &[1, 2][..]), ("trace", &[2][..])] {
            let arguments =
                if stage == "check" { format!("mesh check {name}") } else { format!("mesh trace {name} -o lines.csv") };
            let output = ribopt(folder.path(), &arguments);
            let code = output.status.code();
            assert!(code.is_some_and(|code| codes.contains(&code)), "{arguments}: {code:?} {}{}", out(&output), err(&output));
            assert!(out(&output).len() + err(&output).len() > 0, "{arguments} says nothing");
        }
        assert!(!folder.path().join("lines.csv").exists(), "{name}");
    }
}
