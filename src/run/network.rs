//! The ribs of a problem in space: `geometry.csv` beside the problem file (as `ribopt mesh ribs` writes it), read before the
//! solve; solids and pictures of the sized ribs after it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{Subject, sizing};
use crate::files;
use crate::mesh::commands::{self, CommandError};
use crate::mesh::formats::{self, FormatError};
use crate::mesh::network::{NetworkError, RibGeometry, read_geometry};
use crate::mesh::solids::{Report, SizedRib};
use crate::model::EvaluationError;
use crate::problem::Problem;
use crate::report::About;
use crate::report::pictures::{self, Load};

/// The table's name.
pub const GEOMETRY: &str = "geometry.csv";

/// A rib's length may differ from the distance of its ends by this much, relatively: numbers that were rounded when written.
const LENGTH: f64 = 1e-6;

/// Where every rib lies, in the problem's order.
#[derive(Debug)]
pub struct Network {
    ribs: Vec<RibGeometry>,
}

/// Why there are no solids and no picture.
#[derive(Debug, Error)]
#[allow(missing_docs)]
pub enum NetworkFailure {
    #[error("{path}: {cause}; solids and pictures of ribs need this table, `ribopt mesh ribs` writes it beside the problem")]
    Missing { path: PathBuf, cause: std::io::Error },
    #[error("{path}: {cause}; write it anew with `ribopt mesh ribs`")]
    Table { path: PathBuf, cause: NetworkError },
    #[error("{path} does not place rib '{rib}' of the problem; write both anew with `ribopt mesh ribs`")]
    Absent { path: PathBuf, rib: String },
    #[error("{path} places rib '{rib}' more than once; remove one of its rows")]
    Twice { path: PathBuf, rib: String },
    #[error("rib '{rib}' is {length} long in the problem, but its ends in {path} are {distance} apart; correct either")]
    Length { path: PathBuf, rib: String, length: f64, distance: f64 },
    #[error("section '{section}' has no outline at the point found: {cause}")]
    Section { section: String, cause: String },
    #[error("the limits have no values at the point found: {0}")]
    Evaluation(#[from] EvaluationError),
    #[error(transparent)]
    Output(#[from] FormatError),
    #[error(transparent)]
    Command(#[from] CommandError),
    #[error("cannot write {path}: {cause}; choose another folder with --out")]
    Picture { path: PathBuf, cause: std::io::Error },
}

impl Network {
    /// Whether there is a table beside the problem file.
    pub fn is_beside(problem_file: &Path) -> bool {
        problem_file.with_file_name(GEOMETRY).is_file()
    }

    /// Reads the table beside the problem file and finds every rib in it. Ribs the problem does not have are left out.
    ///
    /// # Errors
    /// No table, a wrong one, one that places a rib twice or not at all, or with ends at another distance than its length.
    pub fn beside(problem_file: &Path, problem: &Problem) -> Result<Network, NetworkFailure> {
        let path = problem_file.with_file_name(GEOMETRY);
        let file = files::open(&path).map_err(|cause| NetworkFailure::Missing { path: path.clone(), cause })?;
        let table = read_geometry(file).map_err(|cause| NetworkFailure::Table { path: path.clone(), cause })?;
        let mut places: HashMap<String, RibGeometry> = HashMap::with_capacity(table.len());
        for place in table {
            if let Some(first) = places.insert(place.name.clone(), place) {
                return Err(NetworkFailure::Twice { path, rib: first.name });
            }
        }
        let mut ribs = Vec::with_capacity(problem.ribs.names.len());
        for (name, &length) in problem.ribs.names.iter().zip(&problem.ribs.length) {
            let rib = || name.to_string();
            let place = places.remove(name).ok_or_else(|| NetworkFailure::Absent { path: path.clone(), rib: rib() })?;
            let distance = place.length();
            if (distance - length).abs() > LENGTH * length {
                return Err(NetworkFailure::Length { path, rib: rib(), length, distance });
            }
            ribs.push(place);
        }
        Ok(Network { ribs })
    }

    /// The ribs at a point.
    ///
    /// # Errors
    /// Sections without an outline there, limits without a value.
    pub fn sized(&self, subject: &Subject, x: &[f64]) -> Result<Sized, NetworkFailure> {
        sizing::size(subject, x, &self.ribs)
    }
}

/// All ribs with their rings, numbers and utilisation at one point.
#[derive(Debug)]
pub struct Sized {
    /// One by one.
    pub ribs: Vec<SizedRib>,
    /// What uses each of them most.
    pub loads: Vec<Load>,
    /// What their tags are called.
    pub tag_names: Vec<String>,
}

impl Sized {
    /// Writes closed solids to a file whose ending names the format, and a report beside it.
    ///
    /// # Errors
    /// Ends that cannot be lofted, a file that cannot be written.
    pub fn write_solids(&self, out: &Path) -> Result<Report, NetworkFailure> {
        Ok(commands::solids(&self.ribs, &self.tag_names, out)?)
    }

    /// Draws the network (SVG).
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_picture(&self, about: &About, out: &Path) -> Result<(), NetworkFailure> {
        let picture = pictures::network(&self.ribs, &self.loads, about);
        files::whole::write(out, |file| file.write_all(picture.as_bytes()))
            .map_err(|cause| NetworkFailure::Picture { path: out.into(), cause })
    }
}

/// Refuses a file for solids before anything is solved, where its ending names no format.
///
/// # Errors
/// An ending other than `.obj`, `.stl`, `.vtu`, `.glb` and `.dxf`.
pub fn check_ending(out: &Path) -> Result<(), NetworkFailure> {
    Ok(formats::check_ribs_writable(out)?)
}

#[cfg(test)]
mod tests;
