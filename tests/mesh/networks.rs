//! Networks of ribs, rings, poles and units (tests/data/mesh): each the smallest of its kind, with its right result.

use std::fmt::Write;
use std::fs;

use serde_json::Value;

use crate::program::{data, err, near, number, report, ribopt, traced};

/// m05: a ring's halves are beams side by side, not one after the other; where the file begins it does not matter.
#[test]
fn a_ring_sags_as_each_of_its_halves() {
    let folder = tempfile::tempdir().unwrap();
    report(folder.path(), "mesh ribs DATA/ring.obj -o ring", 0);
    let table = fs::read_to_string(folder.path().join("ring/ribs.csv")).unwrap();
    let mut sums = std::collections::BTreeMap::<String, [f64; 2]>::new();
    for row in table.lines().skip(1) {
        let cells: Vec<&str> = row.split(',').collect();
        let [line, span, sag] = [cells[5], cells[6], cells[7]];
        let sum = sums.entry(line.into()).or_default();
        *sum = [span.parse().unwrap(), sum[1] + sag.parse::<f64>().unwrap()];
    }
    assert_eq!(sums.len(), 10);
    // The octagon is 6.123 around, its half 3.061; the uprights are 2.
    let [lengths, rings]: [Vec<[f64; 2]>; 2] = [2.0, 8.0 * 0.765_366_865 / 2.0]
        .map(|span: f64| sums.values().copied().filter(|[own, _]| (own / span - 1.0).abs() < 1e-6).collect());
    assert_eq!((lengths.len(), rings.len()), (8, 2));
    for [span, sag] in rings {
        assert!(near(sag, 5.0 * span.powi(4) / 384.0), "{sag}");
    }
    // The limit in full use: the answer's uniform ring has I = 5·q·S³·ratio/(384·E), where the taper leaves it free.
    let solved = report(folder.path(), "solve ring/problem.toml --backend argmin --out out --set load=200", 0);
    assert_eq!(solved["status"], "certified");
}

/// m09–m12: networks are traced, read back, and become problems.
#[test]
fn networks_go_through() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let expected = [
        ("triangles-flagged", [2.0, 0.0, 5.0]),
        ("triangulated-gridshell", [11.0, 0.0, 23.0]),
        ("lines-only", [3.0, 0.0, 8.0]),
        ("rhino-curves", [1.0, 0.0, 1.0]),
        ("dome-pole", [16.0, 4.0, 96.0]),
    ];
    for (name, counts) in expected {
        for ending in ["obj", "csv", "dxf"] {
            assert_eq!(traced(path, &format!("DATA/{name}.obj -o l.{ending}")), counts, "{name}");
            let back = traced(path, &format!("l.{ending} -o back.obj"));
            // DXF lines are edges, which are joined anew where they run straight on.
            assert!(back == counts || ending == "dxf" && back[2] == counts[2], "{name}.{ending}: {back:?}");
        }
        let made = report(path, &format!("mesh ribs DATA/{name}.obj -o {name}"), 0);
        assert_eq!((number(&made, "/problem/ribs"), number(&made, "/problem/lines")), (counts[2], counts[0]), "{name}");
    }
    assert_eq!(traced(path, "DATA/triangulated-gridshell.obj --lines edges -o l.csv"), [23.0, 0.0, 23.0]);
    // What is read back runs the same way, so that names are the same.
    report(path, "mesh trace DATA/lines-only.obj -o l.obj", 0);
    report(path, "mesh trace l.obj -o again.obj", 0);
    assert_eq!(fs::read(path.join("l.obj")).unwrap(), fs::read(path.join("again.obj")).unwrap());
}

/// m12 of a higher degree: a quarter circle as a rational curve, divided; its ends are the control points.
#[test]
fn curves_are_divided_and_end_where_they_should() {
    let folder = tempfile::tempdir().unwrap();
    let half = std::f64::consts::FRAC_1_SQRT_2;
    let arc = format!(
        "v 1 0 0\nv 1 1 0 {half}\nv 0 1 0\nv 0 0 0\ncstype rat bspline\ndeg 2\ncurv 0 1 1 2 3\nparm u 0 0 0 1 1 1\nend\nl 3 4\n"
    );
    fs::write(folder.path().join("arc.obj"), arc).unwrap();
    let found = report(folder.path(), "mesh trace arc.obj -o l.csv", 0);
    assert_eq!((number(&found, "/lines"), number(&found, "/edges"), number(&found, "/ends")), (2.0, 9.0, 3.0));
    // A chord of the eighth part of a quarter circle is short of its arc by 1.6e-3.
    assert!((number(&found, "/length") - 1.0 - std::f64::consts::FRAC_PI_2).abs() < 4e-3, "{found}");
}

/// m13: lines end at the pole; the same dome with quads that repeat the pole.
#[test]
fn lines_end_at_poles() {
    let folder = tempfile::tempdir().unwrap();
    let found = report(folder.path(), "mesh check DATA/dome-pole.obj", 0);
    let counts = ["triangles", "quads", "corner_sum"].map(|name| number(&found, &format!("/invariants/{name}")));
    assert_eq!((counts, &found["invariants"]["valence_identity"]), ([12.0, 36.0, -12.0], &Value::Bool(true)));
    let text = fs::read_to_string(data("dome-pole.obj")).unwrap();
    let repeated: String = text
        .lines()
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            ["f", a, b, c] => format!("f {a} {b} {c} {c}\n"),
            _ => format!("{line}\n"),
        })
        .collect();
    fs::write(folder.path().join("repeated.obj"), repeated).unwrap();
    assert_eq!(traced(folder.path(), "repeated.obj -o l.csv"), traced(folder.path(), "DATA/dome-pole.obj -o l.csv"));
    assert!(report(folder.path(), "mesh check repeated.obj", 0)["notes"][0].as_str().unwrap().contains("12 faces repeat"));
}

/// m17: a mesh in millimetres is noticed, and --unit sets mesh, bounds and loads together.
#[test]
fn units_go_together() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let warned = report(path, "mesh ribs DATA/millimetres.obj -o wrong", 0);
    assert!(warned["problem"]["warnings"][0].as_str().unwrap().contains("upper bound of h"), "{warned}");
    let made = report(path, "mesh ribs DATA/millimetres.obj --unit mm -o mm", 0);
    assert_eq!(made["problem"]["warnings"], serde_json::json!([]));
    // The same in metres: the same volume.
    let metres: String = fs::read_to_string(data("millimetres.obj"))
        .unwrap()
        .lines()
        .map(|line| match line.split(' ').collect::<Vec<_>>()[..] {
            ["v", x, y, z] => {
                let [x, y, z] = [x, y, z].map(|c| c.parse::<f64>().unwrap() / 1000.0);
                format!("v {x} {y} {z}\n")
            }
            _ => format!("{line}\n"),
        })
        .collect();
    fs::write(path.join("metres.obj"), metres).unwrap();
    report(path, "mesh ribs metres.obj --unit m -o m", 0);
    let [mm, m] = ["mm", "m"].map(|unit| {
        let solved = report(path, &format!("solve {unit}/problem.toml --backend argmin --out out-{unit}"), 0);
        assert_eq!(solved["status"], "certified");
        number(&solved, "/objective")
    });
    assert!((mm / m / 1e9 - 1.0).abs() < 1e-6, "{mm} {m}");
    // Lower bounds above an edge.
    let tall = report(path, "mesh ribs metres.obj --bounds b=2:3 -o tall", 0);
    assert!(tall["problem"]["warnings"][0].as_str().unwrap().contains("lower bound of b"), "{tall}");
}

/// Tables and drawings of lines.
#[test]
fn lines_of_tables_and_drawings() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let tables = [
        ("x0,y0,z0,x1,y1,z1\n0,0,0,1,0,0\n1,0,0,2,0,0\n2,0,0,2,1,0\n", [2.0, 0.0, 3.0]),
        ("x1;y1;z1;x2;y2;z2\n0;0;0;1;0;0\n1;0;0;2;0;0\n", [1.0, 0.0, 2.0]),
        ("0,0,0,1,0,0\n1,0,0,2,0,0\n", [1.0, 0.0, 2.0]),
        ("line,x,y,z\na,0,0,0\na,1,0,0\na,1,1,0\na,0,0,0\nb,5,0,0\nb,6,0,0\n", [2.0, 1.0, 4.0]),
    ];
    for (text, counts) in tables {
        fs::write(path.join("t.csv"), text).unwrap();
        assert_eq!(traced(path, "t.csv -o l.obj"), counts, "{text}");
    }
    fs::write(path.join("t.csv"), "a,b\n1,2\n").unwrap();
    assert!(err(&ribopt(path, "mesh check t.csv")).contains("name them so"));
    let polyline = "0\nSECTION\n2\nENTITIES\n0\nPOLYLINE\n8\n0\n66\n1\n70\n9\n10\n0\n20\n0\n30\n0\n\
                    0\nVERTEX\n8\n0\n10\n0\n20\n0\n30\n1\n0\nVERTEX\n8\n0\n10\n1\n20\n0\n30\n1\n0\nVERTEX\n8\n0\n10\n1\n20\n1\n30\n1\n0\nSEQEND\n\
                    0\nLWPOLYLINE\n8\n0\n90\n3\n70\n0\n38\n1\n10\n1\n20\n1\n10\n2\n20\n1\n10\n3\n20\n1\n\
                    0\nCIRCLE\n8\n0\n10\n0\n20\n0\n40\n1\n0\nENDSEC\n0\nEOF\n";
    fs::write(path.join("d.dxf"), polyline).unwrap();
    let found = report(path, "mesh trace d.dxf -o l.obj", 0);
    assert_eq!(["/lines", "/closed", "/edges"].map(|name| number(&found, name)), [2.0, 1.0, 5.0], "{found}");
    assert!(found["notes"][0].as_str().unwrap().contains("1 CIRCLE"), "{found}");
    fs::write(path.join("b.dxf"), b"AutoCAD Binary DXF\r\n\x1a\0").unwrap();
    assert!(err(&ribopt(path, "mesh check b.dxf")).contains("binary DXF"));
}

/// Wavy grids side by side, none of which touches another: what is certified one by one is certified together.
fn wavy(parts: usize) -> String {
    let (nx, ny) = (10, 8);
    let (mut points, mut faces) = (String::new(), String::new());
    for part in 0..parts {
        for (j, i) in (0..=ny).flat_map(|j| (0..=nx).map(move |i| (j, i))) {
            let (x, y, shift) = (i as f64, j as f64, part as f64);
            let at = [
                x + 0.35 * (1.7 * x + 0.9 * y + shift).sin() + shift * (nx + 5) as f64,
                y + 0.35 * (2.3 * y + 0.7 * x + shift).cos(),
                0.5 * (0.3 * x).sin() * (0.4 * y).cos(),
            ];
            writeln!(points, "v {} {} {}", at[0], at[1], at[2]).unwrap();
        }
        for (j, i) in (0..ny).flat_map(|j| (0..nx).map(move |i| (j, i))) {
            let first = part * (nx + 1) * (ny + 1) + j * (nx + 1) + i + 1;
            writeln!(faces, "f {first} {} {} {}", first + 1, first + nx + 2, first + nx + 1).unwrap();
        }
    }
    points + &faces
}

/// m06.
#[test]
fn parts_that_are_certified_are_certified_together() {
    let folder = tempfile::tempdir().unwrap();
    let mut volumes = Vec::new();
    for parts in [1, 3] {
        fs::write(folder.path().join("w.obj"), wavy(parts)).unwrap();
        assert_eq!(ribopt(folder.path(), "mesh ribs w.obj -o w").status.code(), Some(0));
        let solved = report(folder.path(), "solve w/problem.toml --backend argmin --out out", 0);
        assert_eq!(solved["status"], "certified");
        volumes.push(number(&solved, "/objective"));
    }
    assert!(volumes[1] > 2.0 * volumes[0], "{volumes:?}");
}
