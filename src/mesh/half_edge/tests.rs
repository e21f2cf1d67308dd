use super::*;
use crate::mesh::defects::DefectKind::*;
use crate::mesh::formats::read_obj;
use crate::mesh::{generate, invariants};

const SQUARE: &str = "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 2 0 0\nv 2 1 0\nv 1 0 1\nv 1 1 1\n";

fn kinds(faces: &str) -> Vec<DefectKind> {
    let mesh = read_obj(format!("{SQUARE}{faces}").as_bytes()).unwrap();
    QuadMesh::new(mesh).map_err(|Defects(all)| all.iter().map(|d| d.kind).collect()).err().unwrap_or_default()
}

#[test]
fn every_defect_is_told_apart() {
    assert_eq!(kinds("f 1 2 3 4\nf 2 5 6 3"), []);
    assert_eq!(kinds(""), [Empty]);
    assert_eq!(kinds("f 1 2 3\nf 1 3 4"), [Triangulated]);
    assert_eq!(kinds("f 1 2 3 4\nf 2 5 3"), [NotAQuad]);
    assert_eq!(kinds("f 1 2 3 4\nf 2 5 6 3\nf 2 7 8 3"), [MoreThanTwoFaces]);
    assert_eq!(kinds("f 1 2 3 4\nf 2 3 6 5"), [InconsistentOrientation]);
    assert_eq!(kinds("f 1 2 3 3"), [ZeroEdge]);
    assert_eq!(kinds("f 1 2 3 2"), [ZeroArea]);
    assert_eq!(kinds("v 2 2 0\nv 1 2 0\nf 1 2 3 4\nf 3 6 9 10"), [BrokenFan]);
    assert_eq!(kinds("v 1 1 0\nf 1 2 3 4\nf 2 5 6 9"), [DuplicateVertices]);
    assert_eq!(kinds("f 1 2 3 4\nl 1 3"), [RibOffTheEdges]);
}

#[test]
fn the_message_names_faces_and_vertices_from_one() {
    let mesh = read_obj(format!("{SQUARE}f 1 2 3 4\nf 2 3 6 5").as_bytes()).unwrap();
    let message = QuadMesh::new(mesh).unwrap_err().to_string();
    assert!(message.contains("faces 1 2 run along the edge of vertices 2 3"), "{message}");
}

#[test]
fn spokes_turn_around_a_vertex() {
    let mesh = QuadMesh::new(generate::grid(2, 2, 1.0)).unwrap();
    assert_eq!(mesh.neighbours(4).count(), 4);
    assert_eq!(mesh.neighbours(1).collect::<Vec<_>>(), [2, 4, 0]);
    assert_eq!(mesh.neighbours(0).collect::<Vec<_>>(), [1, 3]);
}

#[test]
fn the_valence_identity_holds_on_every_generated_mesh() {
    let meshes = [
        generate::grid(5, 4, 1.0),
        generate::cube(4),
        generate::vault(6, 8, 10.0, 12.0, 3.0),
        generate::dome(5, 6.0, 4.0),
        generate::shell(4, 5),
    ];
    for mesh in meshes {
        let report = invariants::measure(&QuadMesh::new(mesh).unwrap());
        assert!(report.valence_identity, "{report:?}");
    }
}
