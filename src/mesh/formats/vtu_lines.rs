//! VTU of polylines: points with numbers and vectors, line cells with numbers.

use std::io::{self, Write};

use super::vtu::{array, begin, cells_of};

/// Polylines of equally many points each, one after the other.
#[derive(Debug, Clone, PartialEq)]
pub struct Polylines {
    /// All points.
    pub points: Vec<[f64; 3]>,
    /// Points of one line.
    pub per_line: usize,
}

/// Numbers that go with points or cells.
#[derive(Debug, Clone, PartialEq)]
pub struct Values {
    /// The name ParaView shows.
    pub name: String,
    /// Numbers of one point or cell.
    pub components: usize,
    /// All of them; NaN where there is none.
    pub values: Vec<f64>,
}

/// Writes the lines, a cell between neighbouring points.
///
/// # Errors
/// Those of the writer.
pub fn write_vtu_lines(out: &mut impl Write, lines: &Polylines, by_point: &[Values], by_cell: &[Values]) -> io::Result<()> {
    let count = lines.points.len() as u32;
    let per_line = lines.per_line.max(1) as u32;
    let ends = (0..count).filter(|at| (at + 1) % per_line != 0).map(|at| [at, at + 1]);
    let cells: Vec<[u32; 2]> = ends.collect();
    begin(out, lines.points.len(), cells.len())?;
    writeln!(out, "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">")?;
    for [x, y, z] in &lines.points {
        writeln!(out, "{x} {y} {z}")?;
    }
    writeln!(out, "</DataArray></Points>\n<Cells>")?;
    cells_of(out, &cells)?;
    writeln!(out, "</Cells>\n<PointData>")?;
    by_point.iter().try_for_each(|values| columns(out, values))?;
    writeln!(out, "</PointData>\n<CellData>")?;
    by_cell.iter().try_for_each(|values| columns(out, values))?;
    writeln!(out, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

fn columns(out: &mut impl Write, column: &Values) -> io::Result<()> {
    array(out, "Float64", &column.name, column.components)?;
    for one in column.values.chunks(column.components.max(1)) {
        let words: Vec<String> =
            one.iter().map(|value| if value.is_finite() { value.to_string() } else { "nan".into() }).collect();
        writeln!(out, "{}", words.join(" "))?;
    }
    writeln!(out, "</DataArray>")
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn lines_do_not_run_into_one_another() {
        let points = (0..6).map(|at| [f64::from(at), 0.0, 0.0]).collect();
        let by_cell = Values { name: "a<b".into(), components: 1, values: vec![1.0, f64::NAN, 3.0, 4.0] };
        let mut text = Vec::new();
        write_vtu_lines(&mut text, &Polylines { points, per_line: 3 }, &[], &[by_cell]).unwrap();
        let text = String::from_utf8(text).unwrap();
        assert!(text.contains("NumberOfPoints=\"6\" NumberOfCells=\"4\""), "{text}");
        assert!(text.contains("0 1\n1 2\n3 4\n4 5\n") && text.contains("a&lt;b") && text.contains("1\nnan\n3\n4\n"), "{text}");
    }
}
