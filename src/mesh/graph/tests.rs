use super::*;
use crate::mesh::formats::read_obj;
use crate::mesh::trace::report;

fn graph(text: &str, rule: Rule) -> Graph {
    Graph::new(read_obj(text.as_bytes()).unwrap(), rule).unwrap()
}

fn counts(graph: &Graph) -> [usize; 3] {
    let report = report(graph, &graph.lines());
    [report.lines, report.closed, report.edges]
}

/// A hexagonal fan around vertex 1, and a ring of twice as many triangles around it.
fn hexagon() -> String {
    let mut text = String::from("v 0 0 0\n");
    for ring in 1..3 {
        for k in 0..6 * ring {
            let (corner, along) = (k / ring, f64::from(k % ring) / f64::from(ring));
            let at = |k: i32| (f64::from(k) * std::f64::consts::FRAC_PI_3).sin_cos();
            let ((s, c), (t, d)) = (at(corner), at(corner + 1));
            let r = f64::from(ring);
            text += &format!("v {} {} 0\n", r * (c * (1.0 - along) + d * along), r * (s * (1.0 - along) + t * along));
        }
    }
    for k in 0..6 {
        let (a, b) = (2 + k, 2 + (k + 1) % 6);
        let (p, q, r) = (8 + 2 * k, 9 + 2 * k, 8 + (2 * k + 2) % 12);
        text += &format!("f 1 {a} {b}\nf {a} {p} {q}\nf {a} {q} {b}\nf {b} {q} {r}\n");
    }
    text
}

#[test]
fn a_regular_triangulation_has_straight_lines() {
    let shell = graph(&hexagon(), Rule::Auto);
    // Three through the middle, six of two edges on either side of them, six sides of the rim.
    assert_eq!((shell.rule(), counts(&shell)), (Rule::Straight, [15, 0, 42]));
    assert_eq!(counts(&graph(&hexagon(), Rule::Edges)), [42, 0, 42]);
}

#[test]
fn lines_end_where_two_continuations_are_alike() {
    // Five triangles around a vertex: every spoke has two that turn by 36°.
    let mut text = String::from("v 0 0 0\n");
    for k in 0..5 {
        let (s, c) = (f64::from(k) * std::f64::consts::TAU / 5.0).sin_cos();
        text += &format!("v {c} {s} 0\n");
    }
    (0..5).for_each(|k| text += &format!("f 1 {} {}\n", 2 + k, 2 + (k + 1) % 5));
    assert_eq!(counts(&graph(&text, Rule::Auto)), [10, 0, 10]);
}

#[test]
fn polylines_are_lines_and_single_edges_go_straight_on() {
    let points: String = (0..5).map(|x| format!("v {x} 0 0\n")).collect();
    assert_eq!(counts(&graph(&format!("{points}l 1 2\nl 2 3\nl 4 3\nl 4 5\n"), Rule::Auto)), [1, 0, 4]);
    assert_eq!(counts(&graph(&format!("{points}l 1 2 3\nl 3 4 5\n"), Rule::Auto)), [2, 0, 4]);
    assert_eq!(counts(&graph(&format!("{points}l 1 2 3\nl 3 4 5\n"), Rule::Edges)), [4, 0, 4]);
    // Named one by one, single edges are lines.
    assert_eq!(counts(&graph(&format!("{points}g a\nl 1 2\ng b\nl 2 3\n"), Rule::Auto)), [2, 0, 2]);
    // Given twice, once.
    let twice = graph(&format!("{points}l 1 2 3\nl 2 3 4\n"), Rule::Auto);
    assert_eq!((counts(&twice), twice.notes.len()), ([2, 0, 3], 1));
}

#[test]
fn rings_close_as_polylines_and_as_edges() {
    let ring = |n: u32| -> String {
        (0..n)
            .map(|k| (f64::from(k) * std::f64::consts::TAU / f64::from(n)).sin_cos())
            .map(|(s, c)| format!("v {c} {s} 0\n"))
            .collect()
    };
    assert_eq!(counts(&graph(&(ring(4) + "l 1 2 3 4 1\n"), Rule::Auto)), [1, 1, 4]);
    let edges: String = (0..8).map(|k| format!("l {} {}\n", k + 1, (k + 1) % 8 + 1)).collect();
    assert_eq!(counts(&graph(&(ring(8) + &edges), Rule::Auto)), [1, 1, 8]);
}

#[test]
fn points_of_lines_at_one_place_are_one_joint() {
    let graph = graph("v 0 0 0\nv 1 0 0\nv 1 0 -0\nv 2 0 0\nv 1 1 0\nv 1 1 0\nl 1 2\nl 3 4\nl 5 6\n", Rule::Auto);
    assert_eq!((counts(&graph), graph.notes.len()), ([1, 0, 2], 1), "{:?}", graph.notes);
}

#[test]
fn flags_of_curves_with_points_of_their_own_lie_on_the_faces_edges() {
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 0\nv 1 0 0\nf 1 2 3\nf 1 3 4\nl 5 6\n";
    assert_eq!(counts(&graph(text, Rule::Auto)), [1, 0, 1]);
    let off = read_obj(text.replace("l 5 6", "l 2 4").as_bytes()).unwrap();
    assert_eq!(Graph::new(off, Rule::Auto).unwrap_err().0[0].kind, DefectKind::RibOffTheEdges);
}
