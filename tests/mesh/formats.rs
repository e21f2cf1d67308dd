//! Files as people have them (tests/data/mesh): formats, encodings, damage. Each the smallest of its kind, with its right result.

use std::fs;

use crate::program::{data, err, near, number, out, report, ribopt, traced};

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
