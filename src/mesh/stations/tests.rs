use super::*;
use crate::mesh::QuadMesh;
use crate::mesh::{generate, trace::trace};

fn sliced(mesh: crate::mesh::PolygonMesh, longest: f64) -> (QuadMesh, Vec<StationLine>) {
    let mesh = QuadMesh::new(mesh).unwrap();
    let lines = slice(&mesh, &trace(&mesh), longest).unwrap();
    (mesh, lines)
}

#[test]
fn segments_cover_the_edges_and_keep_their_vertices() {
    let (mesh, lines) = sliced(generate::dome(8, 6.0, 4.0), 0.4);
    let report = report(&lines);
    let total: f64 = (0..mesh.edge_count() as u32).map(|e| mesh.edge_length(e)).sum();
    assert!((report.length / total - 1.0).abs() < 1e-13);
    assert!(report.longest <= 0.4 && report.largest_turn < 45.0, "{report:?}");
    let mut kept: Vec<u32> = lines.iter().flat_map(|line| &line.stations).map(|s| s.vertex).filter(|&v| v != NONE).collect();
    kept.sort_unstable();
    kept.dedup();
    assert_eq!(kept.len(), mesh.vertex_count());
}

#[test]
fn frames_are_orthonormal_and_right_handed() {
    let (_, lines) = sliced(generate::shell(4, 6), 0.5);
    for station in lines.iter().flat_map(|line| &line.stations) {
        let Frame { x, y, z } = station.frame;
        assert!((x.cross(&y) - z).norm() < 1e-14 && x.dot(&y).abs() < 1e-14 && (z.norm() - 1.0).abs() < 1e-14);
    }
}

#[test]
fn a_closed_line_ends_in_its_first_frame() {
    let (_, lines) = sliced(generate::cube(3), 1.0);
    let closed = lines.iter().find(|line| line.closed).unwrap();
    let (first, last) = (closed.stations.first().unwrap(), closed.stations.last().unwrap());
    assert_eq!((first.position, first.frame), (last.position, last.frame));
}

#[test]
fn a_normal_that_cancels_is_an_error() {
    // Two faces folded flat onto one another: their vector areas cancel along the common edge.
    let text = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nf 2 1 6 5\n";
    let mesh = crate::mesh::formats::read_obj(text.as_bytes());
    let mut mesh = mesh.unwrap();
    mesh.vertices[4].z = 1e-17;
    mesh.vertices[5].z = 1e-17;
    let mesh = QuadMesh::new(mesh).unwrap();
    let error = slice(&mesh, &trace(&mesh), 1.0).unwrap_err();
    assert!(matches!(error, StationError::NoFrame { .. }), "{error}");
}
