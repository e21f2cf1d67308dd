//! Lines in tables (CSV): a segment per row, or the points of polylines, such as `ribopt mesh trace -o lines.csv` writes.

use std::io::Read;

use super::lexer::{bytes, decode};
use super::{FormatError, point};
use crate::mesh::{PolygonMesh, Vector};

/// Names of the columns of a segment's ends.
const ENDS: [[&str; 6]; 3] =
    [["x0", "y0", "z0", "x1", "y1", "z1"], ["x1", "y1", "z1", "x2", "y2", "z2"], ["xa", "ya", "za", "xb", "yb", "zb"]];

/// Names of the column that tells polylines apart.
const LINE: [&str; 5] = ["line", "polyline", "curve", "name", "id"];

/// Reads a table of segments (columns x0, y0, z0, x1, y1, z1, or x1 … z2, or xa … zb; without a header six or four numbers) or of
/// polylines (`line`, x, y, z; rows with one `line` in sequence are one). z may be left out. Commas, semicolons or tabs.
///
/// # Errors
/// With the row's line: columns that are neither, a number that is none.
pub fn read_csv(source: impl Read) -> Result<PolygonMesh, FormatError> {
    let bytes = bytes(source)?;
    let text = decode(&bytes)?.replace("\r\n", "\n").replace('\r', "\n");
    let first = text.lines().find(|line| !line.trim().is_empty()).unwrap_or_default();
    let delimiter = [b';', b'\t', b','].into_iter().find(|&d| first.bytes().any(|byte| byte == d)).unwrap_or(b',');
    let is_data = first.split(char::from(delimiter)).all(|cell| cell.trim().parse::<f64>().is_ok());
    let mut table = csv::ReaderBuilder::new();
    table.delimiter(delimiter).has_headers(!is_data).trim(csv::Trim::All).comment(Some(b'#'));
    let mut table = table.from_reader(text.as_bytes());
    let header: Vec<String> = match is_data {
        true => Vec::new(),
        false => table.headers().map_err(|cause| explain(&cause))?.iter().map(str::to_lowercase).collect(),
    };
    let form = if is_data { Columns::unnamed(first.split(char::from(delimiter)).count()) } else { Columns::named(&header) };
    let form = form.map_err(|cause| FormatError::line(1, cause))?;
    let mut reader = Reader::default();
    for record in table.records() {
        let record = record.map_err(|cause| explain(&cause))?;
        let line = record.position().map_or(0, |at| at.line() as usize);
        reader.row(&form, &record).map_err(|cause| FormatError::line(line, cause))?;
    }
    reader.finish();
    Ok(reader.mesh)
}

fn explain(error: &csv::Error) -> FormatError {
    match error.position() {
        Some(at) => FormatError::line(at.line() as usize, error.to_string()),
        None => FormatError::Content(error.to_string()),
    }
}

/// Which columns hold what.
enum Columns {
    Segments([Option<usize>; 6]),
    Points { line: usize, at: [Option<usize>; 3] },
}

impl Columns {
    fn unnamed(count: usize) -> Result<Columns, String> {
        match count {
            6 => Ok(Columns::Segments([0, 1, 2, 3, 4, 5].map(Some))),
            4 => Ok(Columns::Segments([Some(0), Some(1), None, Some(2), Some(3), None])),
            _ => Err(format!("a row of {count} numbers is no segment; give six or four, or name the columns")),
        }
    }

    fn named(header: &[String]) -> Result<Columns, String> {
        let column = |name: &str| header.iter().position(|known| known == name);
        // x1 stands in two of the forms: the one whose four plane coordinates are all there is meant.
        for names in ENDS {
            let found = names.map(column);
            if [0, 1, 3, 4].iter().all(|&k| found[k].is_some()) {
                return Ok(Columns::Segments(found));
            }
        }
        let at = ["x", "y", "z"].map(column);
        match LINE.iter().find_map(|name| column(name)) {
            Some(line) if at[0].is_some() && at[1].is_some() => Ok(Columns::Points { line, at }),
            _ => Err("the table has neither columns x0, y0, z0, x1, y1, z1 nor line, x, y, z; name them so".into()),
        }
    }
}

#[derive(Default)]
struct Reader {
    mesh: PolygonMesh,
    /// The polyline being read.
    name: String,
    points: Vec<u32>,
}

impl Reader {
    fn row(&mut self, form: &Columns, record: &csv::StringRecord) -> Result<(), String> {
        match form {
            Columns::Segments(columns) => {
                let [a, b, c, d, e, f] = columns.map(|column| cell(record, column));
                let first = self.vertex(point(a?, b?, c?)?);
                let second = self.vertex(point(d?, e?, f?)?);
                self.mesh.ribs.push([first, second]);
            }
            Columns::Points { line, at } => {
                let name = record.get(*line).unwrap_or_default();
                if name != self.name || self.points.is_empty() {
                    self.finish();
                    self.name = name.into();
                }
                let [x, y, z] = at.map(|column| cell(record, column));
                let v = self.vertex(point(x?, y?, z?)?);
                self.points.push(v);
            }
        }
        Ok(())
    }

    fn vertex(&mut self, p: Vector) -> u32 {
        self.mesh.vertices.push(p);
        self.mesh.vertices.len() as u32 - 1
    }

    fn finish(&mut self) {
        if self.points.len() > 1 {
            self.mesh.push_line(&self.points);
        }
        self.points.clear();
    }
}

/// A number; 0 where there is no such column.
fn cell(record: &csv::StringRecord, column: Option<usize>) -> Result<f64, String> {
    let Some(column) = column else { return Ok(0.0) };
    let text = record.get(column).unwrap_or_default();
    text.parse().map_err(|_| format!("expected a coordinate, found '{text}'"))
}
