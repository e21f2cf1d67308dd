//! `ribopt mesh check`, `reconstruct`, `smooth`, and files that are no meshes.

use std::fs;

use serde_json::Value;

use crate::program::{err, folder, grid, number, out, report, ribopt, said};

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
