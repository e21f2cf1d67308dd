//! The ribs of a problem in space: where its nodes are, or by `geometry.csv` beside the problem file (as `ribopt mesh ribs` writes it), read
//! before the solve; solids and pictures of the sized ribs after it.

use std::collections::HashMap;
use std::path::{Path, PathBuf};

use thiserror::Error;

use super::{Subject, courses, sizing};
use crate::expression::ast::Collection;
use crate::files;
use crate::mesh::Vector;
use crate::mesh::commands::{self, CommandError};
use crate::mesh::formats::{self, FormatError};
use crate::mesh::network::{NetworkError, RibGeometry, read_geometry};
use crate::mesh::solids::{Report, SizedRib};
use crate::mesh::stations::Frame;
use crate::model::EvaluationError;
use crate::problem::Problem;
use crate::report::About;
use crate::report::pictures::{self, Load};
use crate::report::space;
use crate::report::structure::MemberPlace;

/// The table's name.
pub const GEOMETRY: &str = "geometry.csv";

/// A rib's length may differ from the distance of its ends by this much, relatively: numbers that were rounded when written.
const LENGTH: f64 = 1e-6;

/// Where every rib lies.
#[derive(Debug)]
pub struct Network {
    /// In the problem's order; `None`: where the design puts the nodes of a structure.
    table: Option<Vec<RibGeometry>>,
}

/// Why there are no solids and no picture.
#[derive(Debug, Error)]
#[allow(missing_docs)]
pub enum NetworkFailure {
    #[error(
        "{path}: {cause}; solids and pictures of ribs without nodes need this table, `ribopt mesh ribs` writes it beside the problem"
    )]
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
    /// Whether all ribs have nodes, or there is a table beside the problem file.
    pub fn is_known(problem_file: &Path, problem: &Problem) -> bool {
        have_nodes(problem) || problem_file.with_file_name(GEOMETRY).is_file()
    }

    /// By the nodes where all ribs have some; else reads the table beside the problem file and finds every rib in it. Ribs the problem
    /// does not have are left out.
    ///
    /// # Errors
    /// No table, a wrong one, one that places a rib twice or not at all, or with ends at another distance than its length.
    pub fn beside(problem_file: &Path, problem: &Problem) -> Result<Network, NetworkFailure> {
        if have_nodes(problem) {
            return Ok(Network { table: None });
        }
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
        Ok(Network { table: Some(ribs) })
    }

    /// The ribs at a point.
    ///
    /// # Errors
    /// Sections without an outline there, limits without a value.
    pub fn sized(&self, subject: &Subject, x: &[f64]) -> Result<Sized, NetworkFailure> {
        let by_nodes = || placed_by_nodes(subject.problem(), x);
        let own = if self.table.is_none() { by_nodes() } else { Vec::new() };
        sizing::size(subject, x, self.table.as_deref().unwrap_or(&own))
    }
}

/// Whether there are ribs, and all run between nodes.
fn have_nodes(problem: &Problem) -> bool {
    let ribs = problem.ribs.names.len();
    ribs > 0 && problem.structure.as_deref().is_some_and(|structure| structure.members.len() == ribs)
}

/// Every rib from node to node, but for rigid arms; on its line where it has a datum `line`, else on one of its own.
fn placed_by_nodes(problem: &Problem, x: &[f64]) -> Vec<RibGeometry> {
    let (Some(structure), Some(statics)) = (problem.structure.as_deref(), problem.statics.as_deref()) else { return Vec::new() };
    let mut members = courses::placed(problem, structure, statics, x).members;
    members.sort_by_key(|member| member.rib);
    let column = problem.ribs.data.iter().position(|column| column.name == "line");
    let line = |rib: usize| problem.label(Collection::Ribs, column? as u32, rib as u32).map(str::to_owned);
    let vector = |[x, y, z]: [f64; 3]| Vector::new(x, y, z);
    let place = |member: MemberPlace| {
        let [x, y, z] = member.axes.map(vector);
        RibGeometry {
            line: line(member.rib).unwrap_or_else(|| member.name.clone()),
            name: member.name,
            ends: member.ends.map(vector),
            frame: Frame { x, y, z },
            joints: member.nodes,
        }
    };
    members.into_iter().map(place).collect()
}

/// All ribs with their rings, numbers and utilisation at one point.
#[derive(Debug)]
pub struct Sized {
    /// One by one.
    pub ribs: Vec<SizedRib>,
    /// What uses each of them most.
    pub loads: Vec<Load>,
    /// The names of their sections.
    pub sections: Vec<String>,
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

    /// Writes what a page shows in space (JSON); nothing where there are too many ribs for a page, which comes back as false.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn write_view(&self, out: &Path) -> Result<bool, NetworkFailure> {
        if self.ribs.len() > space::MOST_RIBS {
            return Ok(false);
        }
        files::whole::write(out, |file| space::write(&self.ribs, &self.sections, &self.loads, file))
            .map_err(|cause| NetworkFailure::Picture { path: out.into(), cause })?;
        Ok(true)
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
