//! `ribopt mesh …` on files as people have them (tests/data/mesh): each the smallest of its kind, with its right result.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output, Stdio};

use serde_json::Value;

fn data(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/data/mesh").join(name)
}

fn ribopt(folder: &Path, arguments: &str) -> Output {
    let data = data("");
    let words = arguments.split_whitespace().map(|word| word.replace("DATA/", data.to_str().unwrap()));
    let mut command = Command::new(env!("CARGO_BIN_EXE_ribopt"));
    let output = command.current_dir(folder).args(words).stdin(Stdio::null()).output().unwrap();
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

fn near(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-9 * b.abs()
}

/// Lines, closed ones and edges.
fn traced(folder: &Path, arguments: &str) -> [f64; 3] {
    let found = report(folder, &format!("mesh trace {arguments}"), 0);
    ["/lines", "/closed", "/edges"].map(|name| number(&found, name))
}

/// m01, m02: the missing cell ends at the corner the original has, with one quad.
#[test]
fn a_missing_corner_ends_at_the_known_corner() {
    let folder = tempfile::tempdir().unwrap();
    for (name, area) in [("corner", 8.75), ("corner4", 15.75)] {
        let arguments = format!("mesh reconstruct DATA/{name}.obj --original DATA/{name}-ref.obj -o out.obj");
        let once = report(folder.path(), &arguments, 0);
        assert_eq!((number(&once, "/stage/faces_added"), number(&once, "/stage/largest_move")), (1.0, 0.0));
        assert!(near(number(&once, "/invariants/area"), area), "{once}");
        assert_eq!(report(folder.path(), "mesh check out.obj", 0)["defects"], serde_json::json!([]));
    }
}

/// A notch whose cell no quad on the original can fill is left, mentioned, and the exit code says so.
#[test]
fn a_notch_that_cannot_be_filled_is_told() {
    let folder = tempfile::tempdir().unwrap();
    // The original is missing the cell's outer half: a triangle lies there.
    let grid = fs::read_to_string(data("corner.obj")).unwrap();
    fs::write(folder.path().join("half.obj"), format!("{grid}f 11 15 12\n")).unwrap();
    let found = report(folder.path(), "mesh reconstruct DATA/corner.obj --original half.obj -o out.obj", 1);
    assert_eq!((number(&found, "/stage/faces_added"), &found["stage"]["open"]), (0.0, &serde_json::json!([[15, 11, 12]])));
    let words = out(&ribopt(folder.path(), "mesh reconstruct DATA/corner.obj --original half.obj -o out.obj"));
    assert!(words.contains("left open") && words.contains("15, 11, 12"), "{words}");
}

/// m03: what the original leaves open stays open.
#[test]
fn a_plate_with_a_hole_keeps_it() {
    let folder = tempfile::tempdir().unwrap();
    report(folder.path(), "mesh reconstruct DATA/annulus.obj --original DATA/annulus.obj -o out.obj", 0);
    let found = report(folder.path(), "mesh check out.obj", 0);
    assert_eq!((number(&found, "/invariants/faces"), number(&found, "/invariants/euler_characteristic")), (32.0, 0.0));
    // Without one of its cells at the hole, that one comes back and no more.
    let text = fs::read_to_string(data("annulus.obj")).unwrap().replace("f 1 17 18 2\n", "");
    fs::write(folder.path().join("torn.obj"), text).unwrap();
    let torn = report(folder.path(), "mesh reconstruct torn.obj --original DATA/annulus.obj -o out.obj", 0);
    assert_eq!((number(&torn, "/stage/faces_added"), number(&torn, "/stage/vertices_added")), (1.0, 0.0));
}

/// m04, m15: byte-order marks, UTF-16 and old line ends give the same mesh.
#[test]
fn encodings_and_line_ends_do_not_matter() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(traced(folder.path(), "DATA/utf16.obj -o l.csv"), [7.0, 0.0, 17.0]);
    let marked = report(folder.path(), "mesh check DATA/bom.obj", 0);
    assert_eq!((number(&marked, "/invariants/area"), number(&marked, "/invariants/unused_vertices")), (4.0, 1.0));
    let off = fs::read_to_string(data("coff.off")).unwrap();
    let ply = "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n\
               property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n";
    let dxf = "0\nSECTION\n2\nENTITIES\n0\nLINE\n8\n0\n10\n0\n20\n0\n11\n2\n21\n0\n0\nENDSEC\n0\nEOF\n";
    let obj = fs::read_to_string(data("lines-only.obj")).unwrap();
    let csv = "x0,y0,x1,y1\n0,0,1,0\n1,0,2,0\n";
    for (name, text) in [("a.off", off.as_str()), ("a.ply", ply), ("a.dxf", dxf), ("a.obj", &obj), ("a.csv", csv)] {
        let plain = text.as_bytes().to_vec();
        let utf16 = || text.encode_utf16().flat_map(u16::to_le_bytes);
        let variants = [
            plain.clone(),
            [b"\xEF\xBB\xBF", plain.as_slice()].concat(),
            text.replace('\n', "\r").into_bytes(),
            text.replace('\n', "\r\n").into_bytes(),
            b"\xFF\xFE".iter().copied().chain(utf16()).collect(),
        ];
        let found: Vec<[f64; 3]> = variants
            .into_iter()
            .map(|bytes| {
                fs::write(folder.path().join(name), bytes).unwrap();
                traced(folder.path(), &format!("{name} -o l.csv"))
            })
            .collect();
        assert!(found.iter().all(|counts| *counts == found[0]), "{name}: {found:?}");
    }
}

/// m04: a statement that is none and may have been a vertex or a face is never passed over.
#[test]
fn damaged_statements_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let quad = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\n";
    for damaged in ["V 5 5 5", "v5 5 5", "\u{feff}v 5 5 5", "v\u{a0}5 5 5", "5 5 5", "ff 1 2 3", "v,5,5,5", "F 1 2 3", "f1 2 3"] {
        fs::write(folder.path().join("d.obj"), format!("{quad}{damaged}\n")).unwrap();
        let output = ribopt(folder.path(), "mesh check d.obj");
        assert!(output.status.code() == Some(2) && err(&output).contains("line 6"), "{damaged}: {}", err(&output));
    }
    for harmless in ["s off", "usemtl stone", "vt 0 0", "a remark without its mark", "# v 5 5 5", "mtllib a.mtl", "p 1"] {
        fs::write(folder.path().join("d.obj"), format!("{quad}{harmless}\n")).unwrap();
        report(folder.path(), "mesh check d.obj", 0);
    }
}

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

/// m07, m08 and the format's other forms.
#[test]
fn off_is_a_free_format_of_many_kinds() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(traced(folder.path(), "DATA/split.off -o l.csv"), [7.0, 0.0, 17.0]);
    assert_eq!(traced(folder.path(), "DATA/coff.off -o l.csv"), [7.0, 0.0, 17.0]);
    let texts = [
        "OFF 4 1 0 0 0 0 1 0 0 1 1 0 0 1 0 4 0 1 2 3",
        "4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n",
        "OFF\n4 1 0\n0 0 0 9 9 9\n1 0 0 9 9 9\n1 1 0 9 9 9\n0 1 0 9 9 9\n4 0 1 2 3 255 0 0\n",
        "NOFF\n4 1 0\n0 0 0 0 0 1\n1 0 0 0 0 1\n1 1 0 0 0 1\n0 1 0 0 0 1\n4 0 1 2 3\n",
        "NOFF 4 1 0 0 0 0 0 0 1 1 0 0 0 0 1 1 1 0 0 0 1 0 1 0 0 0 1 4 0 1 2 3",
        "STOFF\n4 1 0\n0 0 0 0 0\n1 0 0 1 0\n1 1 0 1 1\n0 1 0 0 1\n4 0 1 2 3\n",
        "STCNOFF # all of it\n4 1 0\n0 0 0 0 0 1 1 0 0 1 0 0\n1 0 0 0 0 1 1 0 0 1 1 0\n1 1 0 0 0 1 1 0 0 1 1 1\n0 1 0 0 0 1 1 0 0 1 0 1\n4 0 1 2 3\n",
        "4OFF\n4 1 0\n0 0 0 2\n2 0 0 2\n2 2 0 2\n0 2 0 2\n4 0 1 2 3\n",
    ];
    for text in texts {
        fs::write(folder.path().join("a.off"), text).unwrap();
        let found = report(folder.path(), "mesh check a.off", 0);
        assert_eq!((number(&found, "/invariants/area"), number(&found, "/invariants/faces")), (1.0, 1.0), "{text}");
    }
    let mut binary = b"COFF BINARY\n".to_vec();
    [4u32, 1, 4].iter().for_each(|count| binary.extend(count.to_be_bytes()));
    for [x, y] in [[0f32, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]] {
        [x, y, 0.0, 1.0, 0.0, 0.0, 1.0].iter().for_each(|value| binary.extend(value.to_be_bytes()));
    }
    [4u32, 0, 1, 2, 3, 1].iter().for_each(|value| binary.extend(value.to_be_bytes()));
    binary.extend(0.5f32.to_be_bytes());
    fs::write(folder.path().join("b.off"), &binary).unwrap();
    assert_eq!(number(&report(folder.path(), "mesh check b.off", 0), "/invariants/area"), 1.0);
    binary.truncate(binary.len() - 6);
    fs::write(folder.path().join("b.off"), &binary).unwrap();
    assert_eq!(ribopt(folder.path(), "mesh check b.off").status.code(), Some(2));
    fs::write(folder.path().join("n.off"), "nOFF\n5\n1 0 0\n0 0 0 0 0\n").unwrap();
    assert!(err(&ribopt(folder.path(), "mesh check n.off")).contains("nOFF"));
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

/// m14: named with the edge it lies on.
#[test]
fn a_hanging_node_is_named() {
    let folder = tempfile::tempdir().unwrap();
    let found = report(folder.path(), "mesh check DATA/hanging-node.obj", 1);
    assert_eq!(found["defects"][0]["kind"], "hanging-node");
    assert_eq!(
        (&found["defects"][0]["vertices"], &found["defects"][0]["faces"]),
        (&serde_json::json!([5, 2, 3]), &serde_json::json!([1]))
    );
    assert_eq!(number(&found, "/invariants/faces"), 3.0);
    let refused = err(&ribopt(folder.path(), "mesh ribs DATA/hanging-node.obj -o r"));
    assert!(refused.contains("vertex 5 hangs on the edge 2 3 of face 1"), "{refused}");
}

/// m16: what overlaps counts once, and is told; a plane that misses is told.
#[test]
fn sections_of_overlapping_solids_are_a_union() {
    let folder = tempfile::tempdir().unwrap();
    let cut = report(folder.path(), "mesh slice DATA/overlap.obj --plane z=0.5 -o s.csv", 0);
    assert!(near(number(&cut, "/area"), 1.0) && near(number(&cut, "/overlap"), 0.16), "{cut}");
    // Partly outside: the union of [0, 1]² and [0.2, 1.2] × [0.2, 0.6].
    let text = fs::read_to_string(data("overlap.obj")).unwrap().replace("v 0.6 ", "v 1.2 ");
    fs::write(folder.path().join("out.obj"), text).unwrap();
    let cut = report(folder.path(), "mesh slice out.obj --plane z=0.5 -o s.csv", 0);
    assert!(near(number(&cut, "/area"), 1.08) && near(number(&cut, "/overlap"), 0.32), "{cut}");
    let missed = report(folder.path(), "mesh slice DATA/overlap.obj --plane z=5 -o s.csv", 0);
    assert!(missed["notes"][0].as_str().unwrap().contains("misses"), "{missed}");
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
