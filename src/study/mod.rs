//! Many runs of one problem: a study file names what is varied; every point becomes a row of one table.
//!
//! The unit of work is a *chain*: a few points, solved one after the other, each from the answer before it. A chain is a pure function of the
//! study, so that it does not matter who works on it, when, or how often: any worker writes the same file (but for seconds). Workers on one
//! machine or on many share nothing but the study's folder. docs/studies.md is the reference.

mod axis;
mod declaration;
mod designs;
mod front;
mod layout;
mod merge;
mod mistakes;
mod pictures;
mod point;
mod points_file;
mod problem;
mod rank;
mod reading;
mod retry;
mod row;
mod sensitivity;
mod slurm;
mod store;
mod table;
mod work;

use std::path::PathBuf;

use thiserror::Error;

pub use declaration::OnFailure;
pub use front::{Tangent, lower_bound, tangents};
pub use merge::merge;
pub use pictures::pictures;
pub use rank::Share;
pub use retry::retry;
pub use row::Row;
pub use slurm::{Submission, submit};
pub use store::{Store, StoreError, TABLE};
pub use table::Table;
pub use work::{Ended, Request, Seen, work};

use crate::input::Additions;
use crate::model::Class;
use crate::problem::Sense;
use crate::run::RunError;
use layout::Layout;

/// Points of a study at the most: its table is put together in memory.
pub(crate) const MOST_POINTS: u32 = 1_000_000;

/// Variables that have a column of their own.
const MOST_LISTED: usize = 50;

/// A study that was read.
#[derive(Debug, Clone, Default)]
pub struct Study {
    /// Its file.
    pub file: PathBuf,
    /// The problem it varies.
    pub problem: PathBuf,
    /// The problem's title.
    pub title: String,
    /// Minimise or maximise.
    pub sense: Sense,
    /// What is proved about the problem at the first point.
    pub class: Class,
    /// Unit labels of the problem.
    pub units: Vec<(String, String)>,
    /// What is asked for at every point, beside what tables have anyway.
    pub quantities: Vec<Quantity>,
    /// The first variables of the problem.
    pub variables: Vec<String>,
    /// How points are solved.
    pub options: Options,
    /// SHA-256 of everything that decides a row, in hexadecimal.
    pub fingerprint: String,
    has_ribs: bool,
    problem_sha256: String,
    layout: Layout,
}

/// `[run]`
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Options {
    /// What follows a point that brings no answer.
    pub on_failure: OnFailure,
    /// Of every point; the problem's own limit where there is none.
    pub max_seconds: Option<f64>,
    /// Every this many points of a chain a nonlinear problem starts cold as well.
    pub cold_every: u32,
}

/// An expression that every row has a column for.
#[derive(Debug, Clone, PartialEq)]
pub struct Quantity {
    /// The column's name.
    pub column: String,
    /// What it is called among the problem's definitions.
    pub name: String,
    /// The expression.
    pub text: String,
}

/// What one run of the problem changes.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Point {
    /// Counted from 0 in the order of the table.
    pub number: usize,
    /// The value of every varied name; `None` leaves the file's.
    pub values: Vec<Option<f64>>,
}

/// Why a study could not be worked on.
#[derive(Debug, Error)]
pub enum StudyError {
    /// The study or its problem is wrong.
    #[error(transparent)]
    Run(#[from] RunError),
    /// The study's folder.
    #[error(transparent)]
    Store(#[from] StoreError),
    /// The problem was changed while the study was under way.
    #[error("{0} or one of its tables has changed since the study began; begin anew with --fresh")]
    Changed(PathBuf),
    /// A point failed and the study says to stop then.
    #[error("point {point}: {message}; the study stops at failures ([run] on_failure)")]
    Stopped {
        /// The point's number.
        point: usize,
        /// What came of it.
        message: String,
    },
    /// Anything else that was asked for and cannot be.
    #[error("{0}")]
    Request(String),
}

impl Study {
    /// The varied names.
    pub fn names(&self) -> Vec<&str> {
        self.layout.names()
    }

    /// How many points there are, where that is known beforehand; of a front, how many are asked for.
    pub fn points(&self) -> usize {
        match &self.layout {
            Layout::Points(points) => points.points.len(),
            Layout::Front(front) => front.points,
        }
    }

    /// The two objectives of a front.
    pub fn objectives(&self) -> Option<&[String; 2]> {
        match &self.layout {
            Layout::Points(_) => None,
            Layout::Front(front) => Some(&front.objectives),
        }
    }

    /// Whether the points are all combinations of the axes' values.
    pub fn is_grid(&self) -> bool {
        matches!(&self.layout, Layout::Points(points) if points.is_grid)
    }

    /// Whether every point but the first moves one name alone.
    pub fn is_centered(&self) -> bool {
        matches!(&self.layout, Layout::Points(points) if points.is_centered)
    }

    /// What a point makes of the problem.
    fn additions(&self, point: &Point) -> Additions {
        let definitions = self.quantities.iter().map(|quantity| (quantity.name.clone(), quantity.text.clone())).collect();
        match &self.layout {
            Layout::Points(points) => {
                let pairs = points.axes.iter().zip(&point.values);
                let changes = pairs.filter_map(|(axis, value)| value.map(|value| format!("{}={value:?}", axis.name))).collect();
                Additions { changes, definitions, ..Additions::default() }
            }
            Layout::Front(front) => Additions { definitions, ..front.additions(point) },
        }
    }

    /// The largest magnitude a varied name takes on.
    fn size(&self, axis: usize) -> f64 {
        match &self.layout {
            Layout::Points(points) => points.axes.get(axis).map_or(0.0, axis::Axis::size),
            Layout::Front(_) => 0.0,
        }
    }
}
