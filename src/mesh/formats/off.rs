//! OFF (Geomview): a keyword, three counts, points, faces.

use std::io::BufRead;

use super::lexer::{Lines, number};
use super::{FormatError, check_numbers, point};
use crate::mesh::PolygonMesh;

/// Reads an OFF file; colours and other columns after the vertex numbers are passed over.
///
/// # Errors
/// With the line: a missing keyword or count, a number that is none, fewer rows than announced, unknown vertices.
pub fn read_off(source: impl BufRead) -> Result<PolygonMesh, FormatError> {
    let mut lines = Lines::new(source);
    let header = content(&mut lines, "the keyword OFF")?;
    let rest = header.strip_prefix("OFF").ok_or_else(|| FormatError::line(lines.number, "expected the keyword OFF"))?;
    let counts = if rest.trim().is_empty() { content(&mut lines, "the counts")? } else { rest.trim().to_string() };
    let mut words = counts.split_ascii_whitespace();
    let mut count = |what| number::<usize>(&mut words, what).map_err(|cause| FormatError::line(lines.number, cause));
    let (vertices, faces) = (count("the number of vertices")?, count("the number of faces")?);

    let mut mesh = PolygonMesh::default();
    for _ in 0..vertices {
        let line = content(&mut lines, "a vertex")?;
        mesh.vertices.push(vertex(&line).map_err(|cause| FormatError::line(lines.number, cause))?);
    }
    for _ in 0..faces {
        let line = content(&mut lines, "a face")?;
        let face = face(&line, vertices).map_err(|cause| FormatError::line(lines.number, cause))?;
        mesh.push_face(&face);
    }
    check_numbers(&mesh)?;
    Ok(mesh)
}

/// The next line that holds anything.
fn content<R: BufRead>(lines: &mut Lines<R>, what: &str) -> Result<String, FormatError> {
    loop {
        match lines.next()? {
            Some(line) if line.trim().is_empty() => {}
            Some(line) => return Ok(line.trim().to_string()),
            None => return Err(FormatError::line(lines.number, format!("the file ends where {what} should stand"))),
        }
    }
}

fn vertex(line: &str) -> Result<crate::mesh::Vector, String> {
    let mut words = line.split_ascii_whitespace();
    let mut next = || number::<f64>(&mut words, "a coordinate");
    point(next()?, next()?, next()?)
}

fn face(line: &str, vertices: usize) -> Result<Vec<u32>, String> {
    let mut words = line.split_ascii_whitespace();
    let corners: usize = number(&mut words, "the number of corners")?;
    if corners < 3 {
        return Err(format!("a face needs at least three vertices, this one has {corners}"));
    }
    let mut face = Vec::new();
    for _ in 0..corners {
        let v: u32 = number(&mut words, "a vertex number")?;
        if v as usize >= vertices {
            return Err(format!("vertex {v} (from 0) is not there: the file has {vertices}"));
        }
        face.push(v);
    }
    Ok(face)
}
