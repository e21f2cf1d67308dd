//! Files: OBJ, PLY (ascii and binary), OFF, STL and, for lines alone, CSV and DXF in; OBJ, STL, VTU, GLB and DXF out. The
//! name's ending decides. docs/meshes.md lists what of each format is read.
//!
//! PLY is read by `ply-rs-bw`, STL read and written by `stl_io`. OBJ and OFF are read here: `tobj` 4.0 numbers vertices anew
//! per group, so shared vertices are lost, and its errors name no line. VTU is written here: `vtkio` is at 0.7.0-rc2.

mod csv_lines;
mod dxf_read;
mod dxf_write;
mod glb;
mod lexer;
mod obj_curve;
mod obj_read;
mod obj_write;
mod off;
mod off_binary;
mod ply;
mod stl;
mod vtu;
mod vtu_lines;

use std::io::Cursor;
use std::path::Path;

pub use csv_lines::read_csv;
pub use dxf_read::read_dxf;
pub use dxf_write::{DxfLine, write_dxf};
pub use glb::{Node, write_glb};
pub use obj_read::read_obj;
pub use obj_write::{write_lines, write_obj};
pub use off::read_off;
pub use ply::read_ply;
pub use stl::{read_stl, write_stl};
pub use vtu::{CellData, write_vtu};
pub use vtu_lines::{Polylines, Values, write_vtu_lines};

use super::{PolygonMesh, Vector};
use crate::files::{self, whole};

/// Why a file could not be read or written.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum FormatError {
    /// The operating system says no.
    #[error("{path}: {cause}; check its name, and that it can be read or written there")]
    Io { path: String, cause: std::io::Error },
    /// A reader found a mistake; the file's name is added by [`read`].
    #[error("line {line}: {cause}")]
    Line { line: usize, cause: String },
    /// A mistake that has no line (binary files, missing parts).
    #[error("{0}")]
    Content(String),
    /// One of the above, in this file.
    #[error("{path}: {cause}")]
    In { path: String, cause: Box<FormatError> },
    /// Nothing in it.
    #[error("{path}: the file is empty")]
    Empty { path: String },
    /// An ending that names no format.
    #[error("{path}: cannot tell the format from the ending; expected one of {expected}")]
    Ending { path: String, expected: &'static str },
}

impl FormatError {
    pub(super) fn line(line: usize, cause: impl Into<String>) -> Self {
        FormatError::Line { line, cause: cause.into() }
    }

    pub(super) fn io(path: &Path, cause: std::io::Error) -> Self {
        FormatError::Io { path: path.display().to_string(), cause }
    }
}

/// Largest magnitude of a coordinate: its cube is still a number.
pub const LARGEST: f64 = 1e100;

const READABLE: [&str; 6] = ["obj", "ply", "off", "stl", "csv", "dxf"];

/// Reads a mesh or lines; `.obj`, `.ply`, `.off`, `.stl`, `.csv` or `.dxf`.
///
/// # Errors
/// Every error names the file and, in text formats, the line.
pub fn read(path: &Path) -> Result<PolygonMesh, FormatError> {
    let kind = ending(path);
    if !READABLE.contains(&kind.as_str()) {
        let expected = ".obj, .ply, .off, .stl, .csv, .dxf";
        return Err(FormatError::Ending { path: path.display().to_string(), expected });
    }
    let bytes = files::read(path).map_err(|cause| FormatError::io(path, cause))?;
    if bytes.is_empty() {
        return Err(FormatError::Empty { path: path.display().to_string() });
    }
    let mesh = match kind.as_str() {
        "obj" => read_obj(bytes.as_slice()),
        "ply" => read_ply(bytes.as_slice()),
        "off" => read_off(bytes.as_slice()),
        "csv" => read_csv(bytes.as_slice()),
        "dxf" => read_dxf(bytes.as_slice()),
        _ => read_stl(&mut Cursor::new(bytes)),
    };
    mesh.map_err(|cause| FormatError::In { path: path.display().to_string(), cause: Box::new(cause) })
}

/// Whether `write` knows the ending.
///
/// # Errors
/// Where it does not.
pub fn check_writable(path: &Path) -> Result<(), FormatError> {
    if ["obj", "stl", "vtu"].contains(&ending(path).as_str()) {
        return Ok(());
    }
    Err(FormatError::Ending { path: path.display().to_string(), expected: ".obj, .stl, .vtu" })
}

/// Whether sized ribs can be written with this ending.
///
/// # Errors
/// Where they cannot.
pub fn check_ribs_writable(path: &Path) -> Result<(), FormatError> {
    if ["obj", "stl", "vtu", "glb", "dxf"].contains(&ending(path).as_str()) {
        return Ok(());
    }
    Err(FormatError::Ending { path: path.display().to_string(), expected: ".obj, .stl, .vtu, .glb, .dxf" })
}

/// Writes a mesh as `.obj`, `.stl` or `.vtu`, with numbers per face for the last.
///
/// # Errors
/// Where the ending names no format or the file cannot be written.
pub fn write(path: &Path, mesh: &PolygonMesh, data: &[CellData]) -> Result<(), FormatError> {
    check_writable(path)?;
    let written = whole::write(path, |mut out| match ending(path).as_str() {
        "obj" => write_obj(&mut out, mesh),
        "stl" => write_stl(&mut out, mesh),
        _ => write_vtu(&mut out, mesh, data),
    });
    written.map_err(|cause| FormatError::io(path, cause))
}

/// The lower-case ending of a file's name.
pub(crate) fn ending(path: &Path) -> String {
    path.extension().map(|e| e.to_string_lossy().to_lowercase()).unwrap_or_default()
}

/// A point whose coordinates are numbers of a usable size.
fn point(x: f64, y: f64, z: f64) -> Result<Vector, String> {
    let vector = Vector::new(x, y, z);
    if vector.iter().all(|c| c.abs() <= LARGEST) {
        Ok(vector)
    } else {
        Err(format!("the point ({x:?}, {y:?}, {z:?}) is not finite, or larger than {LARGEST:e}"))
    }
}

/// Refuses faces and ribs that point at vertices which are not there.
fn check_numbers(mesh: &PolygonMesh) -> Result<(), FormatError> {
    let count = mesh.vertices.len();
    for (f, face) in mesh.faces().enumerate() {
        if let Some(v) = face.iter().find(|&&v| v as usize >= count) {
            return Err(FormatError::Content(format!(
                "face {}: vertex number {v} (from 0), but there are {count} vertices",
                f + 1
            )));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
