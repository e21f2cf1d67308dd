//! Mesh → ribs → solve → solids, for five meshes like those people publish: a saddle net, a dome with a pole, a triangulated shell, a
//! line truss, branching tubes. Made here, independently of `ribopt::mesh::generate`.

use std::collections::{BTreeMap, BTreeSet};
use std::fmt::Write;
use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{number, report};

/// z = (x² − y²)/20 over a square of 8 m, 4 × 4 quads.
fn saddle_net() -> String {
    let mut text = String::new();
    for j in 0..5 {
        for i in 0..5 {
            let (x, y) = (f64::from(2 * i - 4), f64::from(2 * j - 4));
            writeln!(text, "v {x} {y} {}", (x * x - y * y) / 20.0).unwrap();
        }
    }
    for j in 0..4 {
        for i in 0..4 {
            let v = 5 * j + i + 1;
            writeln!(text, "f {v} {} {} {}", v + 1, v + 6, v + 5).unwrap();
        }
    }
    text
}

/// Eight meridians, three rings, triangles at the pole.
fn dome_with_pole() -> String {
    let mut text = String::new();
    for ring in 0..3 {
        let (z, r) = (f64::from(ring) * 0.5).sin_cos();
        for k in 0..8 {
            let (s, c) = (f64::from(k) * std::f64::consts::FRAC_PI_4).sin_cos();
            writeln!(text, "v {} {} {}", 5.0 * r * c, 5.0 * r * s, 5.0 * z).unwrap();
        }
    }
    text.push_str("v 0 0 5\n");
    for k in 0..8 {
        let next = (k + 1) % 8;
        for ring in 0..2 {
            let at = |k: u32| 8 * ring + k + 1;
            writeln!(text, "f {} {} {} {}", at(k), at(next), at(next) + 8, at(k) + 8).unwrap();
        }
        writeln!(text, "f {} {} 25", 17 + k, 17 + next).unwrap();
    }
    text
}

/// A barrel over 6 m, every cell two triangles, as OFF.
fn triangulated_shell() -> String {
    let (columns, rows) = (6, 3);
    let mut text = format!("OFF\n{} {} 0\n", (columns + 1) * (rows + 1), 2 * columns * rows);
    for j in 0..=rows {
        for i in 0..=columns {
            let (s, c) = ((f64::from(i) / f64::from(columns) - 0.5) * 2.0).sin_cos();
            writeln!(text, "{} {} {}", 4.0 * s, 1.5 * f64::from(j), 4.0 * c).unwrap();
        }
    }
    for j in 0..rows {
        for i in 0..columns {
            let v = (columns + 1) * j + i;
            writeln!(text, "3 {v} {} {}\n3 {v} {} {}", v + 1, v + columns + 2, v + columns + 2, v + columns + 1).unwrap();
        }
    }
    text
}

/// A Warren girder of four panels, each member a LINE of a drawing.
fn line_truss() -> String {
    let mut text = String::from("0\nSECTION\n2\nENTITIES\n");
    let mut line = |a: [f64; 2], b: [f64; 2]| {
        let _ = write!(text, "0\nLINE\n8\n0\n10\n{}\n20\n0\n30\n{}\n11\n{}\n21\n0\n31\n{}\n", a[0], a[1], b[0], b[1]);
    };
    for k in 0..4 {
        let x = 1.5 * f64::from(k);
        line([x, 0.0], [x + 1.5, 0.0]);
        line([x, 0.0], [x + 0.75, 1.2]);
        line([x + 0.75, 1.2], [x + 1.5, 0.0]);
        if k < 3 {
            line([x + 0.75, 1.2], [x + 2.25, 1.2]);
        }
    }
    text + "0\nENDSEC\n0\nEOF\n"
}

/// Square tubes along x and, from their middle, along y and z; open at their ends.
fn branching_tubes() -> String {
    let cells: BTreeSet<[i32; 3]> =
        [[0, 0, 0], [1, 0, 0], [2, 0, 0], [3, 0, 0], [4, 0, 0], [2, 1, 0], [2, 2, 0], [2, 0, 1], [2, 0, 2]].into();
    let ends = [([0, 0, 0], [-1, 0, 0]), ([4, 0, 0], [1, 0, 0]), ([2, 2, 0], [0, 1, 0]), ([2, 0, 2], [0, 0, 1])];
    let (mut numbers, mut points, mut faces) = (BTreeMap::new(), String::new(), String::new());
    for cell in &cells {
        for axis in 0..3 {
            for side in [0, 1] {
                let mut out = [0; 3];
                out[axis] = 2 * side - 1;
                let beyond = [0, 1, 2].map(|c| cell[c] + out[c]);
                if cells.contains(&beyond) || ends.contains(&(*cell, out)) {
                    continue;
                }
                let (u, v) = ((axis + 1) % 3, (axis + 2) % 3);
                let mut corners = [[0, 0], [1, 0], [1, 1], [0, 1]];
                if side == 0 {
                    corners.reverse();
                }
                faces.push('f');
                for [i, j] in corners {
                    let mut p = *cell;
                    p[axis] += side;
                    p[u] += i;
                    p[v] += j;
                    let next = numbers.len() + 1;
                    let at = *numbers.entry(p).or_insert_with(|| {
                        writeln!(points, "v {} {} {}", p[0], p[1], p[2]).unwrap();
                        next
                    });
                    write!(faces, " {at}").unwrap();
                }
                faces.push('\n');
            }
        }
    }
    points + &faces
}

/// Every rib becomes a solid of the volume the model gives it, in every format.
fn goes_round(name: &str, text: String, lines: f64) {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    fs::write(path.join(name), text).unwrap();
    let checked = report(path, &format!("mesh check {name}"), 0);
    let edges = number(&checked, "/invariants/rib_edges");
    let made = report(path, &format!("mesh ribs {name} -o r"), 0);
    assert_eq!((number(&made, "/problem/ribs"), number(&made, "/problem/lines")), (edges, lines), "{name}");
    let length = edges * number(&checked, "/invariants/edge_lengths/mean");
    assert!((number(&made, "/problem/length") / length - 1.0).abs() < 1e-12, "{name}");
    let solids: String = ["obj", "stl", "vtu", "glb", "dxf"].map(|ending| format!(" --solids s.{ending}")).concat();
    let solved = report(path, &format!("solve r/problem.toml --backend argmin --out out --plot{solids}"), 0);
    assert_eq!(solved["status"], "certified", "{name}");
    let built: Value = serde_json::from_slice(&fs::read(path.join("s.json")).unwrap()).unwrap();
    assert_eq!(number(&built, "/solids"), edges);
    assert!((number(&built, "/volume") / number(&solved, "/objective") - 1.0).abs() < 1e-10, "{name}: {built}");
    assert!(number(&built, "/largest_model_difference") < 1e-9, "{name}");
    read_glb(&path.join("s.glb"), edges as usize, number(&built, "/volume"));
    // The drawing holds the same network.
    let drawn = report(path, "mesh ribs s.dxf -o again", 0);
    assert_eq!(number(&drawn, "/problem/ribs"), edges, "{name}");
    let picture = fs::read_to_string(path.join("out/network.svg")).unwrap();
    // A title per rib, and its own.
    assert_eq!(picture.matches("<title>").count(), edges as usize + 1);
}

/// By the crate `gltf`: a named node per rib with its numbers, and the solids' volume.
fn read_glb(path: &Path, ribs: usize, volume: f64) {
    let gltf::Gltf { document, blob } = gltf::Gltf::open(path).unwrap();
    let blob = blob.unwrap();
    let root = document.default_scene().unwrap().nodes().next().unwrap();
    assert_eq!(root.children().count(), ribs);
    let mut sum = 0.0;
    for node in root.children() {
        assert!(node.name().is_some_and(|name| name.starts_with('L') && name.contains("_r")), "{:?}", node.name());
        let extras: Value = serde_json::from_str(node.extras().as_ref().unwrap().get()).unwrap();
        assert!(["utilisation", "area", "length", "volume"].iter().all(|name| extras[name].is_number()), "{extras}");
        let primitive = node.mesh().unwrap().primitives().next().unwrap();
        let colour = primitive.material().pbr_metallic_roughness().base_color_factor();
        assert!(colour.iter().all(|c| (0.0..=1.0).contains(c)));
        let reader = primitive.reader(|_| Some(&blob));
        let points: Vec<[f64; 3]> = reader.read_positions().unwrap().map(|p| p.map(f64::from)).collect();
        let indices: Vec<usize> = reader.read_indices().unwrap().into_u32().map(|v| v as usize).collect();
        for triangle in indices.chunks(3) {
            let [a, b, c] = [points[triangle[0]], points[triangle[1]], points[triangle[2]]];
            sum += (a[0] * (b[1] * c[2] - b[2] * c[1]) - a[1] * (b[0] * c[2] - b[2] * c[0]) + a[2] * (b[0] * c[1] - b[1] * c[0]))
                / 6.0;
        }
    }
    // Warped sides are bilinear in the model, and two triangles here.
    assert!((sum / volume - 1.0).abs() < 1e-2, "{sum} {volume}");
}

#[test]
fn saddle_nets_go_round() {
    goes_round("saddle.obj", saddle_net(), 10.0);
}

#[test]
fn domes_with_poles_go_round() {
    goes_round("dome.obj", dome_with_pole(), 11.0);
}

#[test]
fn triangulated_shells_go_round() {
    // Seven along the barrel, four across, eight diagonals.
    goes_round("shell.off", triangulated_shell(), 19.0);
}

#[test]
fn line_trusses_go_round() {
    // Two chords, eight diagonals.
    goes_round("truss.dxf", line_truss(), 10.0);
}

#[test]
fn branching_tubes_go_round() {
    let text = branching_tubes();
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("t.obj"), &text).unwrap();
    let traced = report(folder.path(), "mesh trace t.obj -o l.obj", 0);
    // Four ends: no lid, four loops.
    assert_eq!(report(folder.path(), "mesh check t.obj", 0)["invariants"]["boundary_loops"], serde_json::json!([4, 4, 4, 4]));
    goes_round("tubes.obj", text, number(&traced, "/lines"));
}
