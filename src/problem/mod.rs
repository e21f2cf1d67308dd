//! The checked declaration of a problem: every name resolved, every size known, nothing of TOML left.
//!
//! Laid out column by column, so that a million ribs fit: strings and formulas are stored once and pointed at.

pub mod affine;
pub mod axial;
pub mod cells;
mod collections;
pub mod evaluate;
pub mod existence;
pub mod formula;
pub mod glob;
mod instance;
mod item_scope;
pub mod items;
pub mod kinks;
pub mod mentions;
pub mod names;
pub(crate) mod nearest;
pub mod order;
pub mod precheck;
pub mod profile;
mod range;
pub mod ratio;
pub mod resolve;
pub mod settings;
pub mod statics;
pub mod structure;
pub mod texts;
pub mod vanishing;
pub mod words;

use std::collections::HashMap;
use std::sync::Arc;

use crate::expression::ast::Collection;
use crate::geometry::polygon::Ring;
pub use crate::ribs::law::VolumeLaw;
use crate::sections;
pub use collections::sections_form;
pub use formula::{Formula, Property};
pub use profile::Profile;
pub use settings::Settings;
pub use structure::Structure;
use texts::Texts;

/// Everything a problem file says, checked.
#[derive(Debug, Clone, Default)]
pub struct Problem {
    /// `title`, or the file's stem.
    pub title: String,
    /// Unit labels for reports, e.g. `length = "m"`.
    pub units: Vec<(String, String)>,
    /// Minimise or maximise.
    pub sense: Sense,
    /// What is minimised or maximised.
    pub objective: Formula,
    /// How reports call the objective: the expression as written.
    pub objective_text: String,
    /// Scalar variables in their final order: `[variables]` (arrays element by element), then the sections' own.
    pub variables: Variables,
    /// `[definitions]`: name and value. They refer to one another by index, without cycles.
    pub definitions: Vec<(String, Formula)>,
    /// Formulas of computed section dimensions, pointed at by [`Dimension::Formula`].
    pub dimension_formulas: Vec<Formula>,
    /// `[profiles]`; their control values are variables.
    pub profiles: Vec<Profile>,
    /// Cross-sections.
    pub sections: Sections,
    /// Ribs.
    pub ribs: Ribs,
    /// Constraint declarations, in the file's order.
    pub constraints: Vec<Constraint>,
    /// The parameter `density`, which gives mass to volume in reports.
    pub density: Option<f64>,
    /// Variables in the place of minima, maxima and absolute values: the last ones of [`Problem::variables`], in order.
    /// The constraints that bound them come last, too.
    pub auxiliaries: Vec<kinks::Auxiliary>,
    /// What the ribs with nodes make up; `None` where there are none.
    pub structure: Option<Arc<structure::Structure>>,
    /// The number of the first input that stands for a deformation or a displacement, in the inner problem of a structure.
    pub first_input: u32,
    /// Whether members known by their basic forces have these for inputs, rather than deformations.
    pub inputs_are_forces: bool,
    /// What follows from it, see [`Problem::prepare`].
    pub statics: Option<Arc<statics::Statics>>,
    /// `[solver]`.
    pub settings: Settings,
    /// What the reader wants said: moved starts, unused data, …; already worded.
    pub warnings: Vec<String>,
}

impl Scope {
    /// How many rows it makes (before min, max and abs split any).
    pub fn rows(&self) -> usize {
        match self {
            Scope::Once => 1,
            Scope::Sections(items) | Scope::Ribs(items) | Scope::Nodes(items) => items.len(),
            Scope::RibGroups(groups) | Scope::SectionGroups(groups) | Scope::NodeGroups(groups) => groups.len(),
        }
    }
}

impl Problem {
    /// Works out what follows from the structure, where there is one: once everything else is known.
    pub fn prepare(&mut self) {
        self.statics = statics::Statics::of(self).map(Arc::new);
    }

    /// Whether the objective or a row asks what the structure does.
    pub fn analyses(&self) -> bool {
        let rows =
            self.constraints.iter().flat_map(|constraint| [&constraint.left].into_iter().chain(constraint.right.formulas()));
        let mut known = vec![None; self.definitions.len()];
        self.statics.is_some() && rows.chain([&self.objective]).any(|formula| formula.analyses(self, &mut known))
    }

    /// The name of scalar variable `j`: `depth`, `x[2]`, `support.b`.
    pub fn variable_name(&self, j: usize) -> String {
        match self.variables.origin[j] {
            Origin::Scalar(entry) => self.variables.declared[entry as usize].to_string(),
            Origin::Element(entry, index) => format!("{}[{index}]", self.variables.declared[entry as usize]),
            Origin::Input(at) => format!("input[{at}]"),
            Origin::Dimension(section, position) => {
                let form = sections::form(self.sections.form[section as usize]);
                format!("{}.{}", &self.sections.names[section as usize], form.dimensions[position as usize])
            }
        }
    }

    /// The name of the row that constraint `c` states for its item number `item`: `sag`, `sag[L0]`.
    pub fn row_name(&self, c: usize, item: usize) -> String {
        let Constraint { name, scope, detail, .. } = &self.constraints[c];
        let of = match scope {
            Scope::Once => "",
            Scope::Sections(items) => &self.sections.names[items[item] as usize],
            Scope::Ribs(items) => &self.ribs.names[items[item] as usize],
            Scope::Nodes(items) => self.item_name(Collection::Nodes, items[item]),
            Scope::RibGroups(groups) | Scope::SectionGroups(groups) | Scope::NodeGroups(groups) => &groups[item].0,
        };
        match (of.is_empty(), detail.is_empty()) {
            (true, true) => name.clone(),
            (false, true) => format!("{name}[{of}]"),
            (true, false) => format!("{name}[{detail}]"),
            (false, false) => format!("{name}[{of}, {detail}]"),
        }
    }

    /// The points of a section drawn by points: its own, then those of each hole; empty for others.
    pub fn outline(&self, section: u32) -> &[Ring] {
        self.sections.outlines.get(&section).map_or(&[], |rings| rings.as_slice())
    }

    /// The dimensions of section `s`, in the order of its form's names.
    pub fn dimensions(&self, s: usize) -> &[Dimension] {
        let first = &self.sections.first_dimension;
        &self.sections.dimensions[first[s] as usize..first[s + 1] as usize]
    }

    /// The dimension of section `s` given under this name; `None` for derived dimensions and properties.
    pub fn given_dimension(&self, s: u32, name: &str) -> Option<Dimension> {
        let form = sections_form(self, s as usize)?;
        let at = form.dimensions.iter().position(|given| *given == name)?;
        self.dimensions(s as usize).get(at).copied()
    }
}

/// The direction of the objective.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Sense {
    #[default]
    Minimize,
    Maximize,
}

/// Scalar variables, column by column.
#[derive(Debug, Clone, Default)]
pub struct Variables {
    /// Where each comes from; [`Problem::variable_name`] builds the name users see.
    pub origin: Vec<Origin>,
    /// Names of `[variables]` entries, pointed at by [`Origin`].
    pub declared: Vec<Box<str>>,
    /// Lower bounds, −∞ where open.
    pub lower: Vec<f64>,
    /// Upper bounds, +∞ where open.
    pub upper: Vec<f64>,
    /// Starting values, already inside the bounds.
    pub start: Vec<f64>,
    /// Magnitudes of the starts that were given, 0 where one was left out; may be shorter than the others where the last ones
    /// were left out.
    pub typical: Vec<f64>,
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
    /// A computed value: index into [`Problem::dimension_formulas`].
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

/// One `[[constraints]]` entry.
#[derive(Debug, Clone)]
pub struct Constraint {
    /// Its name; rows of a scoped one are `name[item]`, of an unnamed one `c1`, `c2`, ….
    pub name: String,
    /// What tells its rows from those of the same declaration at another case, station or point: `ULS, 0.5, top-left`; empty where it
    /// is spread over none.
    pub detail: Box<str>,
    /// Where it stands, ready to print: `file.toml:12`.
    pub place: String,
    /// The text of `require`, for reports.
    pub text: String,
    /// One row, or one per section, rib or group.
    pub scope: Scope,
    /// Left side (or the middle of a range). Inside a scope, item names are resolved to the `Own…` formulas.
    pub left: Formula,
    /// Right side. Where it has no variables its value is the row's limit.
    pub right: Limit,
}

/// What a row's left side is held against.
#[derive(Debug, Clone)]
#[allow(missing_docs)]
pub enum Limit {
    AtMost(Formula),
    AtLeast(Formula),
    Equal(Formula),
    Between(Formula, Formula),
}

impl Limit {
    /// Its formulas.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        self.sides().into_iter().flatten()
    }

    /// The limit from below and the one from above; for an equality both.
    pub fn sides(&self) -> [Option<&Formula>; 2] {
        match self {
            Limit::AtMost(limit) => [None, Some(limit)],
            Limit::AtLeast(limit) => [Some(limit), None],
            Limit::Equal(value) => [Some(value), Some(value)],
            Limit::Between(lower, upper) => [Some(lower), Some(upper)],
        }
    }
}

/// The items a constraint is repeated for.
#[derive(Debug, Clone)]
pub enum Scope {
    /// One row.
    Once,
    /// One row per chosen section, by index.
    Sections(Vec<u32>),
    /// One row per chosen rib, by index.
    Ribs(Vec<u32>),
    /// One row per group of ribs: label and members. Folds inside run over the members; plain data come from the first.
    RibGroups(Vec<(Box<str>, Vec<u32>)>),
    /// One row per group of sections.
    SectionGroups(Vec<(Box<str>, Vec<u32>)>),
    /// One row per chosen node, by index.
    Nodes(Vec<u32>),
    /// One row per group of nodes.
    NodeGroups(Vec<(Box<str>, Vec<u32>)>),
}
