//! Binary OFF: 32-bit big-endian integers and floats.

use super::off::{Columns, push};
use super::{FormatError, check_numbers};
use crate::mesh::PolygonMesh;

/// Reads what follows the first line.
pub(super) fn read_binary(columns: Columns, body: &[u8]) -> Result<PolygonMesh, FormatError> {
    read(columns, &mut Words(body)).map_err(FormatError::Content)
}

struct Words<'a>(&'a [u8]);

impl Words<'_> {
    fn word(&mut self) -> Result<[u8; 4], String> {
        let (word, rest) = self.0.split_first_chunk::<4>().ok_or("the file ends before all announced numbers were read")?;
        self.0 = rest;
        Ok(*word)
    }

    fn count(&mut self) -> Result<u32, String> {
        Ok(u32::from_be_bytes(self.word()?))
    }

    fn float(&mut self) -> Result<f64, String> {
        Ok(f32::from_be_bytes(self.word()?).into())
    }
}

fn read(columns: Columns, words: &mut Words) -> Result<PolygonMesh, String> {
    let (vertices, faces, _edges) = (words.count()?, words.count()?, words.count()?);
    let mut mesh = PolygonMesh::default();
    let mut numbers = Vec::new();
    for _ in 0..vertices {
        numbers.clear();
        for _ in 0..columns.count() {
            numbers.push(words.float()?);
        }
        mesh.vertices.push(columns.point(&numbers)?);
    }
    let mut face = Vec::new();
    for _ in 0..faces {
        face.clear();
        for _ in 0..words.count()? {
            face.push(words.count()?);
        }
        for _ in 0..words.count()? {
            words.float()?;
        }
        push(&mut mesh, &face)?;
    }
    check_numbers(&mesh).map_err(|cause| cause.to_string())?;
    Ok(mesh)
}
