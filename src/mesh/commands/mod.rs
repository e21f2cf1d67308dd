//! The stages as a command line wants them: paths and options in, files and a report out. No argument parsing here.
//!
//! Every command that writes an artefact also writes its report beside it as JSON (`lines.obj` → `lines.json`).

mod check;
mod lines;
mod solids;
mod tables;

use std::path::{Path, PathBuf};

use serde::Serialize;

pub use check::{CheckReport, check, check_mesh};
pub use lines::{Lines, RibsReport, ribs_folder, slice_file, trace_file};
pub use solids::solids;

use super::closest::Surface;
use super::formats::{self, FormatError, ending};
use super::graph::{self, Rule};
use super::invariants::{Invariants, measure};
use super::network::NetworkError;
use super::section::{self, Piece, PieceReport, Plane};
use super::stations::StationError;
use super::weld::{WeldReport, weld};
use super::{Defects, PolygonMesh, QuadMesh, generate, reconstruct, ribs, rounded, smooth};

/// Whatever stops a command; the message says what, where and what to do.
#[derive(Debug, thiserror::Error)]
#[allow(missing_docs)]
pub enum CommandError {
    #[error(transparent)]
    Format(#[from] FormatError),
    #[error("{path}: {cause}")]
    Defects { path: String, cause: Defects },
    #[error(transparent)]
    Reconstruct(#[from] reconstruct::ReconstructError),
    #[error(transparent)]
    Smooth(#[from] smooth::SmoothError),
    #[error(transparent)]
    Station(#[from] StationError),
    #[error(transparent)]
    Network(#[from] NetworkError),
    #[error(transparent)]
    Section(#[from] section::SectionError),
    #[error(transparent)]
    Ribs(#[from] ribs::RibsError),
    #[error(transparent)]
    Solid(#[from] super::solids::SolidError),
    #[error("the weld tolerance must be a positive number, not {0}")]
    Weld(f64),
    #[error("there is no mesh '{name}'; there are {known}")]
    UnknownMesh { name: String, known: String },
}

type Outcome<T> = Result<T, CommandError>;

/// A file of a mesh or of lines, and what is to be done with it first.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Source {
    /// The file.
    pub path: PathBuf,
    /// Join vertices within this distance; `None`: as they are.
    pub weld: Option<f64>,
    /// How edges are joined to lines.
    pub rule: Rule,
}

impl Source {
    fn polygons(&self) -> Outcome<(PolygonMesh, Option<WeldReport>)> {
        let (mut mesh, mut report) = (formats::read(&self.path)?, None);
        if let Some(tolerance) = self.weld {
            let (welded, what) = welded(mesh, tolerance)?;
            (mesh, report) = (welded, Some(what));
        }
        settle(&mut mesh);
        Ok((mesh, report))
    }

    fn quads(&self) -> Outcome<QuadMesh> {
        QuadMesh::new(self.polygons()?.0).map_err(|cause| self.defects(cause))
    }

    fn defects(&self, cause: Defects) -> CommandError {
        CommandError::Defects { path: self.path.display().to_string(), cause }
    }
}

/// A mesh with vertices within a distance joined.
///
/// # Errors
/// A tolerance that is no positive number.
pub fn welded(mesh: PolygonMesh, tolerance: f64) -> Outcome<(PolygonMesh, WeldReport)> {
    match tolerance > 0.0 && tolerance.is_finite() {
        true => Ok(weld(mesh, tolerance)),
        false => Err(CommandError::Weld(tolerance)),
    }
}

/// Drops corners that repeat their neighbour, takes flags to the vertices of faces, and notes what a user should know: what every stage
/// begins with.
pub fn settle(mesh: &mut PolygonMesh) {
    let repeated = mesh.drop_repeated_corners();
    if repeated > 0 {
        mesh.notes.push(format!("{repeated} faces repeat a corner; they count with the corners that are left"));
    }
    graph::settle_flags(mesh);
    if mesh.face_count() > 0 && mesh.ribs.is_empty() && mesh.faces().all(|face| face.len() == 3) {
        let note = "every face is a triangle, and every edge counts as a rib, diagonals too; if the mesh was triangulated when it \
                    was exported, export the quads, or flag the edges that carry ribs (OBJ l elements)";
        mesh.notes.push(note.into());
    }
}

/// A report with the invariants of the mesh that was written.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct Staged<T> {
    /// What the stage did.
    pub stage: T,
    /// The mesh it wrote.
    pub invariants: Invariants,
}

/// `mesh reconstruct`.
///
/// # Errors
/// Bad files, defects, an odd hole.
pub fn reconstruct_file(
    source: &Source,
    original: &Path,
    options: reconstruct::Options,
    out: &Path,
) -> Outcome<Staged<reconstruct::Report>> {
    let (mesh, stage) = reconstruct::reconstruct(source.quads()?, &formats::read(original)?, options)?;
    write_mesh(out, &mesh, stage)
}

/// `mesh smooth`.
///
/// # Errors
/// Bad files, defects, options out of range.
pub fn smooth_file(
    source: &Source,
    options: smooth::Options,
    project: Option<&Path>,
    out: &Path,
) -> Outcome<Staged<smooth::Report>> {
    let mut mesh = source.quads()?;
    let surface = project.map(formats::read).transpose()?.map(|surface| Surface::of_faces(&surface));
    let stage = smooth::smooth(&mut mesh, options, surface.as_ref())?;
    write_mesh(out, &mesh, stage)
}

fn write_mesh<T: Serialize>(out: &Path, mesh: &QuadMesh, stage: T) -> Outcome<Staged<T>> {
    formats::write(out, &mesh.to_polygons(), &[])?;
    let report = Staged { stage, invariants: measure(mesh) };
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// The pieces of one plane section.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SectionReport {
    /// One by one.
    pub pieces: Vec<PieceReport>,
    /// The area they cover: of pieces that overlap, of their union.
    pub area: f64,
    /// What is covered more than once, where solids run through one another.
    pub overlap: f64,
    /// What a user should know.
    pub notes: Vec<String>,
}

/// `mesh slice SOLID`: pieces as SVG, or as CSV `piece,area,cx,cy,Ix,Iy,Ixy,I1,I2,angle,holes`.
///
/// # Errors
/// Bad files, a face in the plane, open chains.
pub fn section_file(solid: &Source, plane: &Plane, out: &Path) -> Outcome<SectionReport> {
    let (pieces, report) = section(&solid.polygons()?.0, plane)?;
    write_file(out, |file| match ending(out).as_str() {
        "svg" => file.write_all(tables::section_svg(&pieces).as_bytes()),
        _ => tables::pieces(file, &report.pieces).map_err(std::io::Error::other),
    })?;
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// The section of a solid, and what is to be said of it.
///
/// # Errors
/// No faces, a face in the plane, open chains.
pub fn section(solid: &PolygonMesh, plane: &Plane) -> Outcome<(Vec<Piece>, SectionReport)> {
    let pieces = section::cut(solid, plane)?;
    let numbers: Vec<PieceReport> = pieces.iter().map(|piece| piece.properties).collect();
    let sum: f64 = numbers.iter().map(|piece| piece.area).sum();
    let area = section::union_area(&pieces).unwrap_or(sum);
    let report = SectionReport { pieces: numbers, area, overlap: sum - area, notes: section_notes(solid, plane, sum, area) };
    Ok((pieces, report))
}

fn section_notes(mesh: &PolygonMesh, plane: &Plane, sum: f64, area: f64) -> Vec<String> {
    let mut notes = mesh.notes.clone();
    if sum == 0.0 {
        let distances = || mesh.vertices.iter().map(|p| plane.distance(p));
        let (low, high) = (distances().fold(f64::INFINITY, f64::min), distances().fold(f64::NEG_INFINITY, f64::max));
        let [low, high] = [low, high].map(rounded);
        notes.push(format!("the plane misses the solid, which lies between {low} and {high} along its normal from it"));
    }
    if sum > area {
        notes.push(format!(
            "solids overlap: the pieces have {} together, {} of it is covered more than once, and the area is that of their union",
            rounded(sum),
            rounded(sum - area)
        ));
    }
    notes
}

/// `mesh new`: writes one of the meshes made by formula.
///
/// # Errors
/// An unknown name, a file that cannot be written.
pub fn new_file(name: &str, out: &Path) -> Outcome<Invariants> {
    let mesh = by_formula(name)?;
    formats::write(out, &mesh, &[])?;
    let mesh = QuadMesh::new(mesh).map_err(|cause| CommandError::Defects { path: name.into(), cause })?;
    Ok(measure(&mesh))
}

/// One of the meshes made by formula.
///
/// # Errors
/// An unknown name.
pub fn by_formula(name: &str) -> Outcome<PolygonMesh> {
    Ok(match name {
        "grid" => generate::grid(4, 3, 1.0),
        "cube" => generate::cube(3),
        "vault" => generate::vault(12, 14, 10.0, 14.0, 3.0),
        "small-vault" => generate::vault(6, 4, 6.0, 4.0, 1.5),
        "dome" => generate::dome(10, 8.0, 4.0),
        "shell" => generate::shell(16, 26),
        _ => {
            let known = "grid, cube, small-vault, vault, dome, shell".into();
            return Err(CommandError::UnknownMesh { name: name.into(), known });
        }
    })
}

/// Writes a report as JSON. Numbers that are none become null.
///
/// # Errors
/// A file that cannot be written.
pub fn write_report(path: &Path, report: &impl Serialize) -> Outcome<()> {
    write_file(path, |file| {
        serde_json::to_writer_pretty(&mut *file, report).map_err(std::io::Error::other)?;
        file.write_all(b"\n")
    })
}

fn write_file(path: &Path, write: impl FnOnce(&mut dyn std::io::Write) -> std::io::Result<()>) -> Outcome<()> {
    Ok(crate::files::whole::write(path, write).map_err(|cause| FormatError::io(path, cause))?)
}

#[cfg(test)]
mod tests;
