//! VTU, the XML form of VTK's unstructured grids (ParaView), as text.

use std::io::{self, Write};

use crate::mesh::PolygonMesh;

/// Numbers that go with the faces.
#[derive(Debug, Clone, PartialEq)]
pub struct CellData {
    /// The name ParaView shows.
    pub name: String,
    /// One number per face; NaN where a face has none.
    pub values: Vec<f64>,
}

/// Writes points, faces and their numbers; flagged edges become line cells (with NaN for every number). Faces with as many
/// corners stand together, lines first: readers make a block of every run of one kind.
///
/// # Errors
/// Those of the writer.
pub fn write_vtu(out: &mut impl Write, mesh: &PolygonMesh, data: &[CellData]) -> io::Result<()> {
    let cells = ordered(mesh);
    writeln!(out, "<?xml version=\"1.0\"?>")?;
    writeln!(out, "<VTKFile type=\"UnstructuredGrid\" version=\"1.0\" byte_order=\"LittleEndian\">\n<UnstructuredGrid>")?;
    writeln!(out, "<Piece NumberOfPoints=\"{}\" NumberOfCells=\"{}\">", mesh.vertices.len(), cells.len())?;
    writeln!(out, "<Points><DataArray type=\"Float64\" NumberOfComponents=\"3\" format=\"ascii\">")?;
    for v in &mesh.vertices {
        writeln!(out, "{} {} {}", v.x, v.y, v.z)?;
    }
    writeln!(out, "</DataArray></Points>\n<Cells>")?;
    write_cells(out, &cells)?;
    writeln!(out, "</Cells>\n<CellData>")?;
    for column in data {
        array(out, "Float64", &column.name)?;
        for (face, _) in &cells {
            match column.values.get(*face).filter(|value| value.is_finite()) {
                Some(value) => writeln!(out, "{value}")?,
                None => writeln!(out, "nan")?,
            }
        }
        writeln!(out, "</DataArray>")?;
    }
    writeln!(out, "</CellData>\n</Piece>\n</UnstructuredGrid>\n</VTKFile>")
}

/// Faces and flagged edges by number of corners, each with its number; edges are numbered past the last face.
fn ordered(mesh: &PolygonMesh) -> Vec<(usize, &[u32])> {
    let cells = mesh.faces().chain(mesh.ribs.iter().map(|rib| rib.as_slice()));
    let mut cells: Vec<(usize, &[u32])> = cells.enumerate().collect();
    cells.sort_by_key(|(_, corners)| corners.len());
    cells
}

fn write_cells(out: &mut impl Write, cells: &[(usize, &[u32])]) -> io::Result<()> {
    array(out, "Int64", "connectivity")?;
    for (_, cell) in cells {
        let words: Vec<String> = cell.iter().map(u32::to_string).collect();
        writeln!(out, "{}", words.join(" "))?;
    }
    writeln!(out, "</DataArray>")?;
    array(out, "Int64", "offsets")?;
    let mut end = 0;
    for (_, cell) in cells {
        end += cell.len();
        writeln!(out, "{end}")?;
    }
    writeln!(out, "</DataArray>")?;
    array(out, "UInt8", "types")?;
    for (_, cell) in cells {
        writeln!(out, "{}", cell_type(cell.len()))?;
    }
    writeln!(out, "</DataArray>")
}

/// VTK's numbers: line, triangle, quad, polygon.
fn cell_type(corners: usize) -> u8 {
    match corners {
        2 => 3,
        3 => 5,
        4 => 9,
        _ => 7,
    }
}

fn array(out: &mut impl Write, kind: &str, name: &str) -> io::Result<()> {
    let name = name.replace('&', "&amp;").replace('<', "&lt;").replace('"', "&quot;");
    writeln!(out, "<DataArray type=\"{kind}\" Name=\"{name}\" format=\"ascii\">")
}
