//! STL (binary out, both in), by `stl_io`. The format holds single precision.

use std::io::{self, Read, Seek, Write};

use stl_io::{Normal, Triangle, Vertex};

use super::{FormatError, point};
use crate::mesh::{PolygonMesh, Vector, unit};

/// Reads an STL file; vertices with the same bits are one.
///
/// # Errors
/// What `stl_io` finds, and points that are no numbers.
pub fn read_stl<R: Read + Seek>(source: &mut R) -> Result<PolygonMesh, FormatError> {
    let stl = stl_io::read_stl(source).map_err(|cause| match cause.kind() {
        io::ErrorKind::UnexpectedEof => {
            FormatError::Content("the file ends before all the triangles it announces: it was cut short, copy it again".into())
        }
        _ => FormatError::Content(cause.to_string()),
    })?;
    let mut mesh = PolygonMesh::default();
    for vertex in &stl.vertices {
        let [x, y, z] = vertex.0.map(f64::from);
        mesh.vertices.push(point(x, y, z).map_err(FormatError::Content)?);
    }
    for face in &stl.faces {
        mesh.push_face(&face.vertices.map(|v| v as u32));
    }
    Ok(mesh)
}

/// Writes a binary STL. Planar faces become fans, other quads four triangles about their centre (so that the volume under
/// the bilinear patch is kept). Faces of more than four corners are to be triangulated before.
///
/// # Errors
/// Those of the writer.
pub fn write_stl(out: &mut impl Write, mesh: &PolygonMesh) -> io::Result<()> {
    let triangles: Vec<Triangle> = (0..mesh.face_count()).flat_map(|f| triangles_of(mesh, f)).map(triangle).collect();
    stl_io::write_stl(out, triangles.iter())
}

fn triangles_of(mesh: &PolygonMesh, f: usize) -> Vec<[Vector; 3]> {
    let points: Vec<Vector> = mesh.points(f).collect();
    if points.len() == 4 && !is_flat(&points) {
        let centre = mesh.centre(f);
        return (0..4).map(|k| [points[k], points[(k + 1) % 4], centre]).collect();
    }
    points.windows(2).skip(1).map(|pair| [points[0], pair[0], pair[1]]).collect()
}

/// Whether four points lie in a plane, to 1e−7 of their size (the precision of the format).
fn is_flat(p: &[Vector]) -> bool {
    let (a, b, c) = (p[1] - p[0], p[2] - p[0], p[3] - p[0]);
    let size = a.norm().max(b.norm()).max(c.norm());
    a.cross(&b).dot(&c).abs() <= 1e-7 * size.powi(3)
}

fn triangle(corners: [Vector; 3]) -> Triangle {
    let normal = unit((corners[1] - corners[0]).cross(&(corners[2] - corners[0]))).unwrap_or_default();
    let single = |v: Vector| [v.x as f32, v.y as f32, v.z as f32];
    Triangle { normal: Normal::new(single(normal)), vertices: corners.map(|corner| Vertex::new(single(corner))) }
}
