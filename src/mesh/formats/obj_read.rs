//! Wavefront OBJ: `v`, `f` (polygons, negative numbers), `l` (rib flags), `g`/`o` (groups). Other lines are passed over.

use std::collections::HashMap;
use std::io::BufRead;

use super::lexer::{Lines, number};
use super::{FormatError, point};
use crate::mesh::{NONE, PolygonMesh};

/// Reads an OBJ file.
///
/// # Errors
/// With the line: a number that is none, a vertex that is not there (faces may come before their vertices only in files no
/// one should write; they are refused), a face of fewer than three vertices.
///
/// ```
/// let mesh = ribopt::mesh::formats::read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\n".as_bytes())?;
/// assert_eq!((mesh.face_count(), mesh.ribs.len()), (1, 1));
/// # Ok::<(), ribopt::mesh::formats::FormatError>(())
/// ```
pub fn read_obj(source: impl BufRead) -> Result<PolygonMesh, FormatError> {
    let mut lines = Lines::new(source);
    lines.continued = true;
    let mut reader = Reader { group: NONE, ..Default::default() };
    loop {
        let outcome = match lines.next()? {
            None => break,
            Some(line) => reader.line(line),
        };
        outcome.map_err(|cause| FormatError::line(lines.number, cause))?;
    }
    Ok(reader.finish())
}

#[derive(Default)]
struct Reader {
    mesh: PolygonMesh,
    known: HashMap<String, u32>,
    group: u32,
    face: Vec<u32>,
}

impl Reader {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || number::<f64>(&mut words, "a coordinate");
                self.mesh.vertices.push(point(next()?, next()?, next()?)?);
            }
            Some("f") => {
                self.numbers(words)?;
                if self.face.len() < 3 {
                    return Err(format!("a face needs at least three vertices, this one has {}", self.face.len()));
                }
                self.mesh.push_face(&self.face);
                self.mesh.group_of.push(self.group);
            }
            Some("l") => {
                self.numbers(words)?;
                if self.face.len() < 2 {
                    return Err("an l element needs at least two vertices".into());
                }
                self.mesh.ribs.extend(self.face.windows(2).map(|pair| [pair[0], pair[1]]));
            }
            Some("g" | "o") => self.name(words.collect::<Vec<_>>().join(" ")),
            _ => {}
        }
        Ok(())
    }

    /// The vertex numbers of a face or line element, into `face`; `7/1/3` counts as 7, −1 is the latest vertex.
    fn numbers<'a>(&mut self, words: impl Iterator<Item = &'a str>) -> Result<(), String> {
        self.face.clear();
        let count = self.mesh.vertices.len() as i64;
        for word in words {
            let head = word.split('/').next().unwrap_or(word);
            let written: i64 = head.parse().map_err(|_| format!("expected a vertex number, found '{word}'"))?;
            let index = if written < 0 { count.saturating_add(written) } else { written - 1 };
            if index < 0 || index >= count {
                return Err(format!("vertex {written} is not there: {count} vertices come before this line"));
            }
            self.face.push(index as u32);
        }
        Ok(())
    }

    fn name(&mut self, name: String) {
        let groups = &mut self.mesh.groups;
        self.group = *self.known.entry(name).or_insert_with_key(|name| {
            groups.push(name.clone());
            groups.len() as u32 - 1
        });
    }

    fn finish(mut self) -> PolygonMesh {
        if self.mesh.groups.is_empty() {
            self.mesh.group_of = Vec::new();
        }
        self.mesh
    }
}
