//! Wavefront OBJ: `v`, `f` (polygons, negative numbers), `l` and `curv` (lines that carry ribs), `g`/`o` (groups). Other
//! statements of the format are passed over; a line that is none of them and holds numbers is a mistake.

use std::collections::HashMap;
use std::io::Read;

use super::lexer::{Lines, bytes, decode, number};
use super::obj_curve::Curve;
use super::{FormatError, point};
use crate::mesh::{NONE, PolygonMesh};

/// Statements of the format that say nothing about points, faces and lines.
const PASSED_OVER: &[&str] = &[
    "vt",
    "vn",
    "vp",
    "p",
    "s",
    "mg",
    "mtllib",
    "usemtl",
    "maplib",
    "usemap",
    "bevel",
    "c_interp",
    "d_interp",
    "lod",
    "shadow_obj",
    "trace_obj",
    "ctech",
    "stech",
    "surf",
    "curv2",
    "trim",
    "hole",
    "scrv",
    "sp",
    "con",
    "bmat",
    "step",
    "call",
    "csh",
    "bsp",
    "bzp",
    "cdc",
    "cdp",
    "res",
    "end",
];

/// Reads an OBJ file.
///
/// # Errors
/// With the line: a number that is none, a vertex that is not there (faces may come before their vertices only in files no
/// one should write; they are refused), a face of fewer than three vertices, a statement the format does not have that
/// looks like a damaged `v`, `f` or `l`.
///
/// ```
/// let mesh = ribopt::mesh::formats::read_obj("v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nf 1 2 3 4\nl 1 2\n".as_bytes())?;
/// assert_eq!((mesh.face_count(), mesh.ribs.len()), (1, 1));
/// # Ok::<(), ribopt::mesh::formats::FormatError>(())
/// ```
pub fn read_obj(source: impl Read) -> Result<PolygonMesh, FormatError> {
    let bytes = bytes(source)?;
    let text = decode(&bytes)?;
    let mut lines = Lines::new(&text);
    lines.continued = true;
    let mut reader = Reader { group: NONE, ..Default::default() };
    loop {
        let outcome = match lines.next() {
            None => break,
            Some(line) => reader.line(line),
        };
        outcome.map_err(|cause| FormatError::line(lines.number, cause))?;
    }
    reader.finish().map_err(|cause| FormatError::line(lines.number, cause))
}

#[derive(Default)]
struct Reader {
    mesh: PolygonMesh,
    /// Fourth coordinates of vertices that have exactly four: weights of rational curves.
    weights: HashMap<u32, f64>,
    known: HashMap<String, u32>,
    group: u32,
    face: Vec<u32>,
    /// The group of every line element, and where it stands in `mesh.ribs`.
    elements: Vec<(u32, [u32; 2])>,
    curve: Curve,
    /// Curves of other kinds than Bézier and B-spline.
    unknown_curves: usize,
}

impl Reader {
    fn line(&mut self, line: &str) -> Result<(), String> {
        let mut words = line.split_ascii_whitespace();
        match words.next() {
            Some("v") => {
                let mut next = || number::<f64>(&mut words, "a coordinate");
                self.mesh.vertices.push(point(next()?, next()?, next()?)?);
                if let (Some(weight), None) = (words.next(), words.next()) {
                    let weight = weight.parse().map_err(|_| format!("expected a weight, found '{weight}'"))?;
                    if weight != 1.0 {
                        self.weights.insert(self.mesh.vertices.len() as u32 - 1, weight);
                    }
                }
            }
            Some("f" | "fo") => {
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
                self.element();
            }
            Some("g" | "o") => self.name(words.collect::<Vec<_>>().join(" ")),
            Some("cstype") => {
                self.finish_curve()?;
                self.curve = Curve::of_type(words);
            }
            Some("deg") => self.curve.degree = number(&mut words, "a degree")?,
            Some("curv") => {
                self.finish_curve()?;
                self.curve.range = [number(&mut words, "a parameter")?, number(&mut words, "a parameter")?];
                self.numbers(words)?;
                self.curve.controls.clone_from(&self.face);
            }
            Some("parm") => self.curve.parameters(words)?,
            Some("end") => self.finish_curve()?,
            Some(keyword) if !PASSED_OVER.contains(&keyword) => refuse_damaged(keyword, words)?,
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

    /// The vertices in `face` as a line element.
    fn element(&mut self) {
        let first = self.mesh.ribs.len() as u32;
        self.mesh.ribs.extend(self.face.windows(2).map(|pair| [pair[0], pair[1]]));
        self.elements.push((self.group, [first, self.mesh.ribs.len() as u32]));
    }

    fn finish_curve(&mut self) -> Result<(), String> {
        if self.curve.controls.is_empty() {
            return Ok(());
        }
        let weight = |v: u32| self.weights.get(&v).copied().unwrap_or(1.0);
        match self.curve.polyline(&mut self.mesh.vertices, weight)? {
            Some(line) => {
                self.face = line;
                self.element();
            }
            None => self.unknown_curves += 1,
        }
        self.curve.controls.clear();
        Ok(())
    }

    fn name(&mut self, name: String) {
        let groups = &mut self.mesh.groups;
        self.group = *self.known.entry(name).or_insert_with_key(|name| {
            groups.push(name.clone());
            groups.len() as u32 - 1
        });
    }

    fn finish(mut self) -> Result<PolygonMesh, String> {
        self.finish_curve()?;
        if self.mesh.groups.is_empty() {
            self.mesh.group_of = Vec::new();
        }
        // An element of several edges is a whole line, and so is one that has a group to itself.
        let mut members: HashMap<u32, usize> = HashMap::new();
        self.elements.iter().for_each(|(group, _)| *members.entry(*group).or_default() += 1);
        let is_whole = |(group, [first, end]): &(u32, [u32; 2])| end - first > 1 || *group != NONE && members[group] == 1;
        self.mesh.wholes = self.elements.iter().filter(|element| is_whole(element)).map(|element| element.1).collect();
        if self.unknown_curves > 0 {
            let note = format!("{} curves passed over: neither Bézier nor B-spline", self.unknown_curves);
            self.mesh.notes.push(note);
        }
        Ok(self.mesh)
    }
}

/// A statement the format does not have is passed over as a remark in words, but not where it may have been a point, a face
/// or a line: its letters are v, f or l, or numbers follow.
fn refuse_damaged<'a>(keyword: &str, mut words: impl Iterator<Item = &'a str>) -> Result<(), String> {
    let letters: String = keyword.chars().filter(char::is_ascii_alphabetic).map(|c| c.to_ascii_lowercase()).collect();
    let is_number = |word: &str| word.split('/').all(|part| part.is_empty() || part.parse::<f64>().is_ok());
    let first = words.next();
    let numbers = first.is_some_and(is_number) && words.all(is_number);
    let meant = match letters.as_str() {
        "v" | "f" | "l" => Some(letters.as_str()),
        _ => None,
    };
    if meant.is_none() && !numbers && !is_number(keyword) {
        return Ok(());
    }
    let keyword = keyword.escape_debug();
    Err(match meant {
        Some(meant) => format!("OBJ has no statement '{keyword}'; was '{meant} ' meant? A remark starts with #"),
        None => format!("OBJ has no statement '{keyword}'; correct the line, or put # before it if it is a remark"),
    })
}
