//! PLY, ascii and binary, by `ply-rs-bw`.

use std::borrow::Cow;
use std::io::Read;

use ply_rs_bw::parser::{ParseError, Parser, Reader};
use ply_rs_bw::ply::{Header, Property, PropertyAccess, PropertyAccessResult};

use super::lexer::{bytes, decode};
use super::{FormatError, check_numbers, point};
use crate::mesh::PolygonMesh;

/// Reads a PLY file: elements `vertex` (x, y, z), `face` (`vertex_indices` or `vertex_index`) and, as rib flags, `edge`
/// (`vertex1`, `vertex2`). Other elements and properties are passed over.
///
/// # Errors
/// What `ply-rs-bw` finds, with the line where the file has lines; missing coordinates; unknown vertices.
pub fn read_ply(source: impl Read) -> Result<PolygonMesh, FormatError> {
    let bytes = bytes(source)?;
    let bytes = with_line_feeds(&bytes)?;
    let mut reader = Reader::new(&*bytes);
    let header = Parser::<Row>::new().read_header(&mut reader).map_err(explain)?;
    check_header(&header)?;
    let mut mesh = PolygonMesh::default();
    for (name, element) in &header.elements {
        let rows = Parser::<Row>::new().read_payload_for_element(&mut reader, element, &header).map_err(explain)?;
        for row in rows {
            row.join(name, &mut mesh).map_err(FormatError::Content)?;
        }
    }
    check_numbers(&mesh)?;
    Ok(mesh)
}

/// The file with lines ended by LF alone, and without a byte-order mark; of a binary file the header only.
fn with_line_feeds(bytes: &[u8]) -> Result<Cow<'_, [u8]>, FormatError> {
    let bytes = bytes.strip_prefix(b"\xEF\xBB\xBF").unwrap_or(bytes);
    if !bytes.starts_with(b"ply") {
        // UTF-16, or no PLY at all, which the library names.
        return Ok(Cow::Owned(decode(bytes)?.replace("\r\n", "\n").replace('\r', "\n").into_bytes()));
    }
    let end: &[u8] = match bytes.get(3..) {
        Some([b'\r', b'\n', ..]) => b"\r\n",
        Some([b'\r', ..]) => b"\r",
        _ => return Ok(Cow::Borrowed(bytes)),
    };
    let last = [b"end_header", end].concat();
    let Some(at) = bytes.windows(last.len()).position(|window| window == last) else { return Ok(Cow::Borrowed(bytes)) };
    let (header, body) = bytes.split_at(at + last.len());
    let header = String::from_utf8_lossy(header).replace("\r\n", "\n").replace('\r', "\n");
    let body = match header.contains("format ascii") {
        true => String::from_utf8_lossy(body).replace("\r\n", "\n").replace('\r', "\n").into_bytes(),
        false => body.to_vec(),
    };
    Ok(Cow::Owned([header.into_bytes(), body].concat()))
}

/// An element without properties takes no bytes, so that a lie about its count would never end.
fn check_header(header: &Header) -> Result<(), FormatError> {
    match header.elements.iter().find(|(_, element)| element.properties.is_empty() && element.count > 0) {
        Some((name, _)) => Err(FormatError::Content(format!("element '{name}' has no properties"))),
        None => Ok(()),
    }
}

fn explain(error: ParseError) -> FormatError {
    // The library's message repeats its own line number and the offending line; the first line of it says what is wrong.
    let text = error.to_string();
    let cause = text.lines().next().unwrap_or_default().trim_start_matches("Line ").to_string();
    match error.line() {
        Some(line) => FormatError::line(line, cause.trim_start_matches(|c: char| c.is_ascii_digit() || c == ':').trim()),
        None => FormatError::Content(cause),
    }
}

/// One row of any element. NaN marks what was not there.
struct Row {
    position: [f64; 3],
    ends: [Option<u32>; 2],
    face: Vec<u32>,
}

impl Row {
    fn join(self, element: &str, mesh: &mut PolygonMesh) -> Result<(), String> {
        match element {
            "vertex" => mesh.vertices.push(point(self.position[0], self.position[1], self.position[2])?),
            "face" if self.face.len() < 3 => {
                return Err(format!("face {} has fewer than three usable vertex numbers", mesh.face_count() + 1));
            }
            "face" => mesh.push_face(&self.face),
            "edge" => match self.ends {
                [Some(a), Some(b)] if (a.max(b) as usize) < mesh.vertices.len() => mesh.ribs.push([a, b]),
                _ => return Err(format!("edge {} does not name two vertices of the file", mesh.ribs.len() + 1)),
            },
            _ => {}
        }
        Ok(())
    }
}

impl PropertyAccess for Row {
    fn new() -> Self {
        Row { position: [f64::NAN; 3], ends: [None; 2], face: Vec::new() }
    }

    fn set_property(&mut self, name: &str, property: Property) -> PropertyAccessResult {
        match (name, property) {
            ("x", value) => self.position[0] = scalar(&value),
            ("y", value) => self.position[1] = scalar(&value),
            ("z", value) => self.position[2] = scalar(&value),
            ("vertex1", value) => self.ends[0] = index(scalar(&value)),
            ("vertex2", value) => self.ends[1] = index(scalar(&value)),
            ("vertex_indices" | "vertex_index", list) => self.face = list_of(list).unwrap_or_default(),
            _ => return PropertyAccessResult::Ignored,
        }
        PropertyAccessResult::Set
    }
}

fn scalar(property: &Property) -> f64 {
    match *property {
        Property::Char(v) => v.into(),
        Property::UChar(v) => v.into(),
        Property::Short(v) => v.into(),
        Property::UShort(v) => v.into(),
        Property::Int(v) => v.into(),
        Property::UInt(v) => v.into(),
        Property::Float(v) => v.into(),
        Property::Double(v) => v,
        _ => f64::NAN,
    }
}

fn index(value: f64) -> Option<u32> {
    (value >= 0.0 && value < u32::MAX.into() && value.fract() == 0.0).then_some(value as u32)
}

fn list_of(property: Property) -> Option<Vec<u32>> {
    fn all<T: TryInto<u32>>(list: Vec<T>) -> Option<Vec<u32>> {
        list.into_iter().map(|v| v.try_into().ok()).collect()
    }
    match property {
        Property::ListChar(list) => all(list),
        Property::ListUChar(list) => all(list),
        Property::ListShort(list) => all(list),
        Property::ListUShort(list) => all(list),
        Property::ListInt(list) => all(list),
        Property::ListUInt(list) => all(list),
        _ => None,
    }
}
