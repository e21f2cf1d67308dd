//! What a problem is declared with: variables, sections, ribs and their data.

use super::VolumeLaw;
use super::texts::Texts;
use crate::geometry::polygon::Ring;
use std::collections::HashMap;
use std::sync::Arc;

/// Scalar variables, column by column.
#[derive(Debug, Clone, Default)]
pub struct Variables {
    /// Where each comes from; [`super::Problem::variable_name`] builds the name users see.
    pub origin: Vec<Origin>,
    /// Names of `[variables]` entries, pointed at by [`Origin`].
    pub declared: Vec<Box<str>>,
    /// Lower bounds, −∞ where open.
    pub lower: Vec<f64>,
    /// Those declared `positive`, ascending: their lower bound of 0 closes what is open there, and no minimum lies on it.
    pub positive: Vec<u32>,
    /// Upper bounds, +∞ where open.
    pub upper: Vec<f64>,
    /// Starting values, already inside the bounds.
    pub start: Vec<f64>,
    /// Magnitudes of the starts that were given, 0 where one was left out; may be shorter than the others where the last ones
    /// were left out.
    pub typical: Vec<f64>,
}

/// Where a scalar variable comes from (names of six million variables are not kept as text).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Origin {
    /// `depth`: an entry of [`Variables::declared`].
    Scalar(u32),
    /// `x[2]`: an entry of [`Variables::declared`] and its index, counted from 1.
    Element(u32, u32),
    /// `support.b`: a section and the position of the dimension in its form.
    Dimension(u32, u8),
    /// What a structure's formulas take besides the design: a deformation or a displacement, by number.
    Input(u32),
}

/// One dimension of one section, or one given number of it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Dimension {
    /// A fixed number.
    Constant(f64),
    /// Exactly one variable (its own, or a link such as `h = "depth"`).
    Variable(u32),
    /// A computed value: index into [`super::Problem::dimension_formulas`].
    Formula(u32),
}

/// Cross-sections, column by column. Section `s` has the dimensions
/// `dimensions[first_dimension[s] .. first_dimension[s + 1]]`, in the order of its form's names.
#[derive(Debug, Clone, Default)]
pub struct Sections {
    /// Names.
    pub names: Texts,
    /// Number for [`crate::sections::form`]: the kind and which of its dimensions are given.
    pub form: Vec<u16>,
    /// Offsets into `dimensions`, one more than sections.
    pub first_dimension: Vec<u32>,
    /// Dimensions of all sections.
    pub dimensions: Vec<Dimension>,
    /// Rings of points (the polygon's or line's, then the holes') for kinds that have them, by section.
    pub outlines: HashMap<u32, Arc<Vec<Ring>>>,
    /// Data columns.
    pub data: Vec<Column>,
}

/// Ribs, column by column.
#[derive(Debug, Clone, Default)]
pub struct Ribs {
    /// Names.
    pub names: Texts,
    /// Section at the left end.
    pub from: Vec<u32>,
    /// Section at the right end (the same for a prismatic rib).
    pub to: Vec<u32>,
    /// Lengths, positive.
    pub length: Vec<f64>,
    /// Volume laws.
    pub law: Vec<VolumeLaw>,
    /// Data columns.
    pub data: Vec<Column>,
}

/// Variables that take the numbers of one row of a list together: a variable and its values, or the dimensions of a catalogue's section.
#[derive(Debug, Clone, PartialEq)]
pub struct Listed {
    /// What reports call it: the variable, or the section.
    pub name: String,
    /// The variables.
    pub variables: Vec<u32>,
    /// The rows, a number per variable.
    pub rows: Vec<Vec<f64>>,
    /// Names of the rows; empty where they have none.
    pub names: Vec<String>,
}

/// One data column of sections or ribs.
#[derive(Debug, Clone)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its cells.
    pub cells: Cells,
}

/// The cells of a column. Numbers are NaN where a row has none; texts are indices into `labels`, `u32::MAX` where none.
#[derive(Debug, Clone)]
#[allow(missing_docs)]
pub enum Cells {
    Numbers(Vec<f64>),
    Labels { labels: Vec<Box<str>>, of: Vec<u32> },
}

impl Variables {
    /// Leaves out all but the first `count`.
    pub fn truncate(&mut self, count: usize) {
        self.origin.truncate(count);
        for column in [&mut self.lower, &mut self.upper, &mut self.start] {
            column.truncate(count);
        }
    }
}
