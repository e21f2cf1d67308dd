//! OFF (Geomview, `man oogl`): an optional keyword [ST][C][N][4]OFF, three counts, points, faces. The format is free: numbers
//! may stand on any lines. Colours of faces end with the line, and some programs add columns to points without saying so, so
//! lines are looked at where they help.

use std::io::Read;

use super::lexer::{Lines, bytes, decode, number};
use super::off_binary::read_binary;
use super::{FormatError, check_numbers, point};
use crate::mesh::{PolygonMesh, Vector};

/// Numbers that go with every point, by the keyword.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Columns {
    /// A fourth, homogeneous coordinate.
    pub homogeneous: bool,
    /// Normal, colour and texture coordinates, passed over.
    pub others: usize,
    pub colour: bool,
}

impl Columns {
    /// The keyword's prefixes, in the format's order.
    fn of(keyword: &str) -> Result<Columns, String> {
        let unknown = || format!("expected the keyword OFF, found '{keyword}'");
        let mut rest = keyword.strip_suffix("OFF").ok_or_else(unknown)?;
        let mut columns = Columns::default();
        let mut take = |prefix: &str| {
            let after = rest.strip_prefix(prefix);
            rest = after.unwrap_or(rest);
            after.is_some()
        };
        columns.others += if take("ST") { 2 } else { 0 };
        columns.colour = take("C");
        columns.others += if take("N") { 3 } else { 0 };
        columns.homogeneous = take("4");
        match rest {
            "" => Ok(columns),
            "n" => Err("nOFF has points of any dimension; give them three coordinates, as OFF".into()),
            _ => Err(unknown()),
        }
    }

    /// Numbers of a point, four of them for a colour.
    pub fn count(self) -> usize {
        3 + usize::from(self.homogeneous) + self.others + if self.colour { 4 } else { 0 }
    }

    /// The point of its first numbers.
    pub fn point(self, numbers: &[f64]) -> Result<Vector, String> {
        match *numbers {
            [x, y, z, w, ..] if self.homogeneous => point(x / w, y / w, z / w),
            [x, y, z, ..] => point(x, y, z),
            _ => Err("a coordinate is missing".into()),
        }
    }
}

/// Reads an OFF file; normals, colours and texture coordinates are passed over. Faces of two corners are lines that carry
/// ribs.
///
/// # Errors
/// With the line: an unknown keyword, a missing count, a number that is none, fewer numbers than announced, unknown vertices.
pub fn read_off(source: impl Read) -> Result<PolygonMesh, FormatError> {
    let bytes = bytes(source)?;
    if let Some((columns, body)) = binary(&bytes)? {
        return read_binary(columns, body);
    }
    let text = decode(&bytes)?;
    let mut tokens = Tokens::new(&text);
    let columns = header(&mut tokens)?;
    let (vertices, faces) = (tokens.count("the number of vertices")?, tokens.count("the number of faces")?);
    tokens.count("the number of edges")?;
    let mut mesh = PolygonMesh::default();
    read_points(&mut tokens, columns, vertices, &mut mesh)?;
    read_faces(&mut tokens, faces, &mut mesh)?;
    check_numbers(&mesh)?;
    Ok(mesh)
}

/// The columns and the body of a binary file: its first line is the keyword and BINARY.
fn binary(bytes: &[u8]) -> Result<Option<(Columns, &[u8])>, FormatError> {
    let Some(end) = bytes.iter().take(80).position(|&byte| byte == b'\n') else { return Ok(None) };
    let Ok(line) = std::str::from_utf8(&bytes[..end]) else { return Ok(None) };
    let mut words = line.split_ascii_whitespace();
    match (words.next(), words.next()) {
        (Some(keyword), Some("BINARY")) => {
            let columns = Columns::of(keyword).map_err(|cause| FormatError::line(1, cause))?;
            Ok(Some((columns, &bytes[end + 1..])))
        }
        _ => Ok(None),
    }
}

/// The keyword; a file may begin with the counts.
fn header(tokens: &mut Tokens) -> Result<Columns, FormatError> {
    let word = tokens.peek("the keyword OFF")?;
    if word.bytes().all(|byte| byte.is_ascii_digit()) {
        return Ok(Columns::default());
    }
    // The counts may follow the keyword without a space.
    let end = word.find("OFF").map_or(word.len(), |at| at + 3);
    let (keyword, rest) = word.split_at(end);
    let columns = Columns::of(keyword).map_err(|cause| tokens.error(cause))?;
    tokens.replace_first(rest);
    Ok(columns)
}

/// Where every point has a line of its own, its first numbers count and the others do not; elsewhere as many numbers are
/// read as the keyword announces.
fn read_points(tokens: &mut Tokens, columns: Columns, count: usize, mesh: &mut PolygonMesh) -> Result<(), FormatError> {
    let by_line = tokens.are_lines_alike(count);
    let mut numbers = Vec::new();
    for _ in 0..count {
        numbers.clear();
        let wanted = if by_line { 3 + usize::from(columns.homogeneous) } else { columns.count() };
        for _ in 0..wanted {
            numbers.push(tokens.number::<f64>("a coordinate")?);
        }
        if by_line {
            tokens.finish_line();
        }
        mesh.vertices.push(columns.point(&numbers).map_err(|cause| tokens.error(cause))?);
    }
    Ok(())
}

/// What follows a face's last vertex on its line is its colour, unless there are more faces than lines.
fn read_faces(tokens: &mut Tokens, count: usize, mesh: &mut PolygonMesh) -> Result<(), FormatError> {
    let has_lines = tokens.lines_left() >= count;
    let mut face = Vec::new();
    for _ in 0..count {
        let corners: usize = tokens.number("the number of corners")?;
        face.clear();
        for _ in 0..corners {
            let v: u32 = tokens.number("a vertex number")?;
            if v as usize >= mesh.vertices.len() {
                return Err(tokens.error(format!("vertex {v} (from 0) is not there: the file has {}", mesh.vertices.len())));
            }
            face.push(v);
        }
        if has_lines {
            tokens.finish_line();
        }
        push(mesh, &face).map_err(|cause| tokens.error(cause))?;
    }
    Ok(())
}

/// A face, or a line of two corners.
pub(super) fn push(mesh: &mut PolygonMesh, face: &[u32]) -> Result<(), String> {
    match *face {
        [a, b] => mesh.ribs.push([a, b]),
        [] | [_] => return Err(format!("a face needs at least three vertices, this one has {}", face.len())),
        _ => mesh.push_face(face),
    }
    Ok(())
}

/// The words of a text, and the lines they stand on.
struct Tokens<'a> {
    lines: Vec<(usize, &'a str)>,
    /// The line that `words` is the rest of.
    at: usize,
    words: std::str::SplitAsciiWhitespace<'a>,
}

impl<'a> Tokens<'a> {
    fn new(text: &'a str) -> Self {
        let mut source = Lines::new(text);
        let mut lines = Vec::new();
        while let Some(line) = source.raw() {
            let line = line.split_once('#').map_or(line, |(line, _)| line).trim();
            if !line.is_empty() {
                lines.push((source.number, line));
            }
        }
        let first = lines.first().map_or("", |line| line.1);
        Tokens { words: first.split_ascii_whitespace(), lines, at: 0 }
    }

    fn error(&self, cause: impl Into<String>) -> FormatError {
        let last = self.lines.last().map_or(0, |line| line.0);
        FormatError::line(self.lines.get(self.at).map_or(last, |line| line.0), cause)
    }

    fn next_line(&mut self) {
        self.at += 1;
        self.words = self.lines.get(self.at).map_or("", |line| line.1).split_ascii_whitespace();
    }

    /// Passes over what is left of the line whose first words were read.
    fn finish_line(&mut self) {
        let rest = self.lines.get(self.at).map_or(0, |line| line.1.split_ascii_whitespace().count());
        if self.words.clone().count() < rest {
            self.next_line();
        }
    }

    fn settle(&mut self, what: &str) -> Result<(), FormatError> {
        while self.words.clone().next().is_none() {
            if self.at >= self.lines.len() {
                return Err(self.error(format!("the file ends where {what} should stand")));
            }
            self.next_line();
        }
        Ok(())
    }

    fn peek(&mut self, what: &str) -> Result<&'a str, FormatError> {
        self.settle(what)?;
        Ok(self.words.clone().next().unwrap_or_default())
    }

    /// Takes the first word and puts another in its place, if there is any of it.
    fn replace_first(&mut self, rest: &'a str) {
        self.words.next();
        if let Some(line) = self.lines.get_mut(self.at).filter(|_| !rest.is_empty()) {
            line.1 = line.1.split_once(rest).map_or(line.1, |(before, _)| &line.1[before.len()..]);
            self.words = line.1.split_ascii_whitespace();
        }
    }

    fn number<T: std::str::FromStr>(&mut self, what: &str) -> Result<T, FormatError> {
        self.settle(what)?;
        number(&mut self.words, what).map_err(|cause| self.error(cause))
    }

    fn count(&mut self, what: &str) -> Result<usize, FormatError> {
        self.number(what)
    }

    /// Whether the next lines, so many, hold as many words each, three or more.
    fn are_lines_alike(&mut self, count: usize) -> bool {
        if self.words.clone().next().is_none() {
            self.next_line();
        }
        let Some(next) = self.at.checked_add(count).and_then(|end| self.lines.get(self.at..end)) else { return false };
        let words = |line: &(usize, &str)| line.1.split_ascii_whitespace().count();
        let first = next.first().map_or(0, words);
        first >= 3 && next.iter().all(|line| words(line) == first)
    }

    /// Lines from this one on.
    fn lines_left(&self) -> usize {
        let begun = usize::from(self.words.clone().next().is_none());
        self.lines.len().saturating_sub(self.at + begun)
    }
}
