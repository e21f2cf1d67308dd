//! DXF (ASCII): LINE, LWPOLYLINE and POLYLINE of the section ENTITIES as lines. Read here: pairs of a group code and a value,
//! a line each; the `dxf` crate brings eleven others for what is not needed.

use std::collections::BTreeMap;
use std::io::Read;

use super::lexer::{Lines, bytes, decode};
use super::{FormatError, point};
use crate::mesh::{PolygonMesh, Vector};

/// Reads the lines of a drawing. Other entities are counted in the mesh's notes; bulges of polylines are taken as straight.
///
/// # Errors
/// With the line: a group code or a coordinate that is no number. Binary files are named.
pub fn read_dxf(source: impl Read) -> Result<PolygonMesh, FormatError> {
    let bytes = bytes(source)?;
    if bytes.starts_with(b"AutoCAD Binary DXF") {
        return Err(FormatError::Content("this is a binary DXF; save it as ASCII (R12 will do)".into()));
    }
    let text = decode(&bytes)?;
    let mut lines = Lines::new(&text);
    let mut reader = Reader::default();
    let mut section = String::new();
    let mut begins = false;
    while let Some(code) = lines.raw() {
        let code = code.trim();
        if code.is_empty() && lines.raw().is_none() {
            break;
        }
        let number: i32 =
            code.parse().map_err(|_| FormatError::line(lines.number, format!("expected a group code, found '{code}'")))?;
        let value = lines.raw().unwrap_or_default().trim();
        match (number, value) {
            (0, "SECTION") => begins = true,
            (2, name) if begins => (section, begins) = (name.to_string(), false),
            (0, "ENDSEC") => section.clear(),
            _ => {}
        }
        if section == "ENTITIES" {
            let outcome = if number == 0 { reader.begin(value) } else { reader.pair(number, value) };
            outcome.map_err(|cause| FormatError::line(lines.number, cause))?;
        }
    }
    reader.begin("").map_err(|cause| FormatError::line(lines.number, cause))?;
    Ok(reader.finish())
}

/// Entities that come with others and say nothing by themselves.
const SILENT: [&str; 4] = ["", "SEQEND", "ENDSEC", "VIEWPORT"];

#[derive(Default)]
struct Reader {
    mesh: PolygonMesh,
    entity: String,
    /// Coordinates of the entity's points; of a LINE its two ends.
    points: Vec<[f64; 3]>,
    /// The points of a POLYLINE so far, from its VERTEX entities.
    polyline: Option<Vec<[f64; 3]>>,
    elevation: f64,
    closed: bool,
    bulged: bool,
    passed_over: BTreeMap<String, usize>,
    bulges: usize,
}

impl Reader {
    fn pair(&mut self, code: i32, value: &str) -> Result<(), String> {
        let number = || value.parse::<f64>().map_err(|_| format!("expected a number after group code {code}, found '{value}'"));
        match (self.entity.as_str(), code) {
            ("LINE", 10 | 20 | 30 | 11 | 21 | 31) => {
                self.points.resize(2, [0.0; 3]);
                self.points[(code % 10) as usize][(code / 10 - 1) as usize] = number()?;
            }
            ("LWPOLYLINE", 10) => self.points.push([number()?, 0.0, 0.0]),
            ("LWPOLYLINE" | "VERTEX", 20 | 30) => {
                let value = number()?;
                self.points.last_mut().ok_or("a coordinate comes before the first one")?[(code / 10 - 1) as usize] = value;
            }
            ("VERTEX", 10) => self.points.push([number()?, 0.0, 0.0]),
            ("LWPOLYLINE", 38) => self.elevation = number()?,
            ("LWPOLYLINE" | "POLYLINE", 70) => self.closed = number()? as i64 & 1 == 1,
            // Splines' control points, and the faces and meshes some polylines are.
            ("VERTEX", 70) if number()? as i64 & (16 | 128) != 0 => self.points.clear(),
            ("LWPOLYLINE" | "VERTEX", 42) => self.bulged |= number()? != 0.0,
            _ => {}
        }
        Ok(())
    }

    /// An entity begins, and the one before it is complete.
    fn begin(&mut self, entity: &str) -> Result<(), String> {
        let points = std::mem::take(&mut self.points);
        match self.entity.as_str() {
            "LINE" => {
                let [a, b] = [0, 1].map(|k| points.get(k).copied().unwrap_or_default());
                let (a, b) = (self.vertex(a)?, self.vertex(b)?);
                self.mesh.ribs.push([a, b]);
            }
            "LWPOLYLINE" => {
                let elevation = self.elevation;
                self.line(points.into_iter().map(|p| [p[0], p[1], elevation]).collect())?;
            }
            "POLYLINE" => self.polyline = Some(Vec::new()),
            "VERTEX" => self.polyline.get_or_insert_default().extend(points),
            other if !SILENT.contains(&other) => *self.passed_over.entry(other.into()).or_default() += 1,
            _ => {}
        }
        if entity != "VERTEX"
            && let Some(points) = self.polyline.take()
        {
            self.line(points)?;
        }
        if !["VERTEX", "SEQEND"].contains(&entity) {
            (self.elevation, self.closed) = (0.0, false);
        }
        self.entity = entity.into();
        Ok(())
    }

    fn line(&mut self, mut points: Vec<[f64; 3]>) -> Result<(), String> {
        self.bulges += usize::from(std::mem::take(&mut self.bulged));
        points.dedup();
        let mut line = points.into_iter().map(|p| self.vertex(p)).collect::<Result<Vec<u32>, String>>()?;
        if self.closed {
            line.extend(line.first().copied());
        }
        if line.len() > 1 {
            self.mesh.push_line(&line);
        }
        Ok(())
    }

    fn vertex(&mut self, [x, y, z]: [f64; 3]) -> Result<u32, String> {
        let position: Vector = point(x, y, z)?;
        self.mesh.vertices.push(position);
        Ok(self.mesh.vertices.len() as u32 - 1)
    }

    fn finish(mut self) -> PolygonMesh {
        if self.bulges > 0 {
            self.mesh.notes.push(format!("arcs in {} polylines taken as straight", self.bulges));
        }
        if !self.passed_over.is_empty() {
            let words: Vec<String> = self.passed_over.iter().map(|(name, count)| format!("{count} {name}")).collect();
            self.mesh.notes.push(format!("passed over, for only lines and polylines are read: {}", words.join(", ")));
        }
        self.mesh
    }
}
