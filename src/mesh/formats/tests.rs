use std::io::Cursor;

use proptest::prelude::*;

use super::*;
use crate::mesh::generate;

fn obj(text: &str) -> Result<PolygonMesh, String> {
    read_obj(text.as_bytes()).map_err(|error| error.to_string())
}

#[test]
fn obj_reads_back_what_it_wrote() {
    let mut mesh = generate::dome(4, 3.3, 1.7);
    mesh.ribs = vec![[0, 1], [1, 2]];
    let mut text = Vec::new();
    write_obj(&mut text, &mesh).unwrap();
    let back = read_obj(text.as_slice()).unwrap();
    assert_eq!((&back.vertices, &back.ribs), (&mesh.vertices, &mesh.ribs));
    assert!(back.faces().eq(mesh.faces()));
}

#[test]
fn obj_knows_groups_negative_numbers_and_long_lines() {
    let mesh = obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\ng roof\nf -4/1/1 -3 \\\n -2 -1\nl 1 2 3\n").unwrap();
    assert_eq!(mesh.face(0), [0, 1, 2, 3]);
    assert_eq!((mesh.groups.as_slice(), mesh.ribs.as_slice()), (["roof".to_string()].as_slice(), [[0, 1], [1, 2]].as_slice()));
}

#[test]
fn obj_errors_name_the_line() {
    assert_eq!(obj("v 0 0 0\nv 1 x 0\n").unwrap_err(), "line 2: expected a coordinate, found 'x'");
    assert_eq!(obj("v 0 0 0\nf 1 2 3\n").unwrap_err(), "line 2: vertex 2 is not there: 1 vertices come before this line");
    assert_eq!(obj("v 0 0 nan").unwrap_err(), "line 1: the point (0.0, 0.0, NaN) is not finite, or larger than 1e100");
}

#[test]
fn off_and_ply_give_the_same_quad() {
    let off = "OFF # a comment\n4 1 0\n0 0 0\n1 0 0\n1 1 0\n0 1 0\n\n4 0 1 2 3 255 0 0\n";
    let head = "element vertex 4\nproperty float x\nproperty float y\nproperty float z\n\
                element face 1\nproperty list uchar int vertex_indices\nend_header\n";
    let ascii = format!("ply\nformat ascii 1.0\n{head}0 0 0\n1 0 0\n1 1 0\n0 1 0\n4 0 1 2 3\n");
    let mut binary = format!("ply\nformat binary_little_endian 1.0\n{head}").into_bytes();
    for value in [0f32, 0., 0., 1., 0., 0., 1., 1., 0., 0., 1., 0.] {
        binary.extend(value.to_le_bytes());
    }
    binary.push(4);
    (0..4i32).for_each(|v| binary.extend(v.to_le_bytes()));
    let expected = read_off(off.as_bytes()).unwrap();
    assert_eq!(expected.face(0), [0, 1, 2, 3]);
    assert_eq!(read_ply(ascii.as_bytes()).unwrap(), expected);
    assert_eq!(read_ply(binary.as_slice()).unwrap(), expected);
}

#[test]
fn ply_errors_name_the_line_and_lies_about_counts_are_refused() {
    let text = "ply\nformat ascii 1.0\nelement vertex 2\nproperty float x\nproperty float y\nproperty float z\nend_header\n0 0 0\n0 b 0\n";
    let message = read_ply(text.as_bytes()).unwrap_err().to_string();
    assert!(message.starts_with("line 9: "), "{message}");
    let endless = "ply\nformat binary_little_endian 1.0\nelement vertex 99999999999\nend_header\n";
    assert_eq!(read_ply(endless.as_bytes()).unwrap_err().to_string(), "element 'vertex' has no properties");
}

#[test]
fn stl_reads_back_what_it_wrote() {
    let cube = generate::cube(2);
    let mut bytes = Vec::new();
    write_stl(&mut bytes, &cube).unwrap();
    let back = read_stl(&mut Cursor::new(bytes)).unwrap();
    assert_eq!((back.vertices.len(), back.face_count()), (cube.vertices.len(), 2 * cube.face_count()));
    assert_eq!(back.volume(), 1.0);
}

/// Bytes that look enough like a file to get past its first line.
fn hostile() -> impl Strategy<Value = Vec<u8>> {
    let words = prop::sample::select(vec![
        "v ",
        "f ",
        "l ",
        "1 ",
        "-1 ",
        "4 ",
        "0 ",
        "1e999 ",
        "nan ",
        "99999999999999999999 ",
        "\n",
        "\n",
        "\\\n",
        "OFF\n",
        "ply\n",
        "format ascii 1.0\n",
        "format binary_big_endian 1.0\n",
        "element vertex 3\n",
        "element face 4294967295\n",
        "end_header\n",
        "property float x\n",
        "property list uchar int vertex_indices\n",
        "solid a\n",
        "facet normal 0 0 1\n",
        "outer loop\n",
        "vertex 0 0 0\n",
        "cstype bspline\n",
        "cstype rat bezier\n",
        "deg 2\n",
        "curv 0 1 ",
        "parm u 0 0 1 1 ",
        "end\n",
        "COFF BINARY\n",
        "0\n",
        "10\n",
        "20\n",
        "70\n",
        "SECTION\n",
        "ENTITIES\n",
        "LINE\n",
        "VERTEX\n",
        "LWPOLYLINE\n",
        "x0,y0,x1,y1\n",
        "line,x,y\n",
        ",",
        "\r",
        "\0",
        "#",
        "/",
        "é",
    ]);
    let text = prop::collection::vec(words, 0..60).prop_map(|words| words.concat().into_bytes());
    prop_oneof![prop::collection::vec(any::<u8>(), 0..300), text]
}

proptest! {
    #[test]
    fn readers_never_panic(bytes in hostile()) {
        let _ = read_obj(bytes.as_slice());
        let _ = read_off(bytes.as_slice());
        let _ = read_ply(bytes.as_slice());
        let _ = read_stl(&mut Cursor::new(&bytes));
        let _ = read_csv(bytes.as_slice());
        let _ = read_dxf(bytes.as_slice());
        let _ = read_dxf([b"0\nSECTION\n2\nENTITIES\n".as_slice(), &bytes].concat().as_slice());
        let _ = read_csv([b"line,x,y,z\n".as_slice(), &bytes].concat().as_slice());
        let _ = read_obj([b"v 0 0 0\nv 1 0 0\nv 1 1 0\n".as_slice(), &bytes].concat().as_slice());
        let _ = read_off([b"OFF\n".as_slice(), &bytes].concat().as_slice());
        let _ = read_ply([b"ply\nformat ascii 1.0\n".as_slice(), &bytes].concat().as_slice());
    }

    #[test]
    fn whatever_reads_is_checked_without_panic(faces in prop::collection::vec(prop::array::uniform4(0u32..8), 0..8)) {
        let vertices = (0..8).map(|i| Vector::new(f64::from(i % 2), f64::from(i / 2 % 2), f64::from(i / 4))).collect();
        let mesh = PolygonMesh::from_quads(vertices, &faces);
        let measured = crate::mesh::invariants::measure_any(&mesh);
        let _ = crate::mesh::graph::Graph::new(mesh.clone(), crate::mesh::graph::Rule::Auto).map(|graph| graph.lines());
        if let Ok(mesh) = crate::mesh::QuadMesh::new(mesh) {
            let exact = crate::mesh::invariants::measure(&mesh);
            prop_assert!(exact.valence_identity && measured.valence_identity);
            prop_assert_eq!(
                (exact.valence_sum, exact.components, exact.boundary_loops.iter().sum::<usize>()),
                (measured.valence_sum, measured.components, measured.boundary_loops.iter().sum::<usize>())
            );
        }
    }
}
