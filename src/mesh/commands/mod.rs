//! The stages as a command line wants them: paths and options in, files and a report out. No argument parsing here.
//!
//! Every command that writes an artefact also writes its report beside it as JSON (`lines.obj` → `lines.json`).

mod solids;
mod tables;

use std::path::{Path, PathBuf};

use serde::Serialize;

pub use solids::{plot, solids};

use super::closest::Surface;
use super::formats::{self, FormatError, ending};
use super::invariants::{Invariants, measure};
use super::network::{Network, NetworkError};
use super::section::{self, PieceReport, Plane};
use super::stations::StationError;
use super::weld::{WeldReport, weld};
use super::{Defect, Defects, PolygonMesh, QuadMesh, generate, reconstruct, ribs, smooth, stations, trace};

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

/// A mesh file, and whether its vertices are to be welded first.
#[derive(Debug, Clone, PartialEq)]
pub struct Source {
    /// The file.
    pub path: PathBuf,
    /// Join vertices within this distance; `None`: as they are.
    pub weld: Option<f64>,
}

impl Source {
    fn polygons(&self) -> Outcome<(PolygonMesh, Option<WeldReport>)> {
        let mesh = formats::read(&self.path)?;
        match self.weld {
            None => Ok((mesh, None)),
            Some(tolerance) if tolerance > 0.0 && tolerance.is_finite() => {
                let (mesh, report) = weld(mesh, tolerance);
                Ok((mesh, Some(report)))
            }
            Some(tolerance) => Err(CommandError::Weld(tolerance)),
        }
    }

    fn quads(&self) -> Outcome<QuadMesh> {
        let defects = |cause| CommandError::Defects { path: self.path.display().to_string(), cause };
        QuadMesh::new(self.polygons()?.0).map_err(defects)
    }
}

/// What `check` found.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct CheckReport {
    /// The file.
    pub file: String,
    /// Whether the mesh is a clean quad mesh.
    pub sound: bool,
    /// What a weld did, where one was asked for.
    pub weld: Option<WeldReport>,
    /// Every defect.
    pub defects: Vec<Defect>,
    /// The defects in words, as many as a person reads.
    pub message: String,
    /// The numbers of a sound mesh.
    pub invariants: Option<Invariants>,
}

/// `mesh check`: defects are the finding here, not an error.
///
/// # Errors
/// A file that cannot be read.
pub fn check(source: &Source) -> Outcome<CheckReport> {
    let file = source.path.display().to_string();
    let (mesh, weld) = source.polygons()?;
    Ok(match QuadMesh::new(mesh) {
        Ok(mesh) => CheckReport {
            file,
            sound: true,
            weld,
            defects: Vec::new(),
            message: "no defects".into(),
            invariants: Some(measure(&mesh)),
        },
        Err(defects) => {
            CheckReport { file, sound: false, weld, message: defects.to_string(), defects: defects.0, invariants: None }
        }
    })
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

/// `mesh trace`: lines as OBJ `l` elements, or as CSV `line,closed,point,vertex,x,y,z`.
///
/// # Errors
/// Bad files, defects.
pub fn trace_file(source: &Source, out: &Path) -> Outcome<trace::TraceReport> {
    let mesh = source.quads()?;
    let lines = trace::trace(&mesh);
    write_file(out, |mut file| match ending(out).as_str() {
        "obj" => {
            let named = lines.iter().enumerate().map(|(k, line)| (tables::line_name(k, line), line.vertices.as_slice()));
            formats::write_lines(&mut file, &mesh.positions, named)
        }
        _ => tables::lines(file, &mesh, &lines).map_err(std::io::Error::other),
    })?;
    let report = trace::report(&mesh, &lines);
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// `mesh slice MESH`: stations as CSV `line,closed,station,vertex,s,x,y,z,tx,ty,tz,nx,ny,nz`.
///
/// # Errors
/// Bad files, defects, undefined frames.
pub fn slice_file(source: &Source, longest: f64, out: &Path) -> Outcome<stations::StationReport> {
    let mesh = source.quads()?;
    let lines = stations::slice(&mesh, &trace::trace(&mesh), longest)?;
    write_file(out, |file| tables::stations(file, &lines).map_err(std::io::Error::other))?;
    let report = stations::report(&lines);
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// The pieces of one plane section.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct SectionReport {
    /// One by one.
    pub pieces: Vec<PieceReport>,
    /// Their area together.
    pub area: f64,
}

/// `mesh slice SOLID`: pieces as SVG, or as CSV `piece,area,cx,cy,Ix,Iy,Ixy,I1,I2,angle,holes`.
///
/// # Errors
/// Bad files, a face in the plane, open chains.
pub fn section_file(solid: &Source, plane: &Plane, out: &Path) -> Outcome<SectionReport> {
    let pieces = section::cut(&solid.polygons()?.0, plane)?;
    let numbers: Vec<PieceReport> = pieces.iter().map(|piece| piece.properties).collect();
    write_file(out, |file| match ending(out).as_str() {
        "svg" => file.write_all(tables::section_svg(&pieces).as_bytes()),
        _ => tables::pieces(file, &numbers).map_err(std::io::Error::other),
    })?;
    let report = SectionReport { area: numbers.iter().map(|piece| piece.area).sum(), pieces: numbers };
    write_report(&out.with_extension("json"), &report)?;
    Ok(report)
}

/// What `ribs_folder` made.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct RibsReport {
    /// The lines.
    pub trace: trace::TraceReport,
    /// The segments.
    pub stations: stations::StationReport,
    /// The problem.
    pub problem: ribs::Report,
}

/// `mesh ribs`: a problem folder; the report goes to its `mesh.json`.
///
/// # Errors
/// Bad files, defects, undefined frames, senseless limits.
pub fn ribs_folder(source: &Source, longest: f64, options: &ribs::Options, folder: &Path) -> Outcome<RibsReport> {
    let mesh = source.quads()?;
    let lines = trace::trace(&mesh);
    let sliced = stations::slice(&mesh, &lines, longest)?;
    let problem = ribs::write_problem(&Network::new(&sliced)?, options, folder)?;
    let report = RibsReport { trace: trace::report(&mesh, &lines), stations: stations::report(&sliced), problem };
    write_report(&folder.join("mesh.json"), &report)?;
    Ok(report)
}

/// `mesh new`: writes one of the meshes made by formula.
///
/// # Errors
/// An unknown name, a file that cannot be written.
pub fn new_file(name: &str, out: &Path) -> Outcome<Invariants> {
    let mesh = match name {
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
    };
    formats::write(out, &mesh, &[])?;
    let mesh = QuadMesh::new(mesh).map_err(|cause| CommandError::Defects { path: name.into(), cause })?;
    Ok(measure(&mesh))
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
