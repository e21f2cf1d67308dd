//! The checked declaration of a problem: every name resolved, every size known, nothing of TOML left.
//!
//! Laid out column by column, so that a million ribs fit: strings and formulas are stored once and pointed at.

pub mod affine;
mod axial;
pub mod cells;
pub mod checks;

mod collections;
mod constraint;
mod data;
mod determinate;
pub mod evaluate;
pub mod existence;
pub mod formula;
pub mod glob;
mod instance;
mod item_scope;
pub mod items;
pub mod kinks;
pub mod mentions;
pub mod mistake_code;
pub mod modes;
pub mod names;
pub(crate) mod nearest;
pub mod order;
pub mod precheck;
pub mod profile;
pub mod range;
pub mod ratio;
pub mod resolve;
mod rewritten;
pub mod settings;
pub mod statics;
pub mod structure;
pub mod texts;
pub mod vanishing;
pub mod words;

use std::sync::Arc;

use crate::expression::ast::Collection;
use crate::geometry::polygon::Ring;
pub use crate::ribs::law::VolumeLaw;
use crate::sections;
pub use collections::sections_form;
pub use constraint::{Constraint, Limit, Scope};
pub use data::{Cells, Column, Dimension, Listed, Origin, Ribs, Sections, Variables};
pub use formula::{Formula, Property};
pub use profile::Profile;
pub use settings::Settings;
pub use structure::Structure;

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
    /// Variables whose values come from lists.
    pub listed: Vec<Listed>,
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
    /// Checks by design codes; their rows are among the constraints.
    pub checks: Vec<checks::Check>,
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
    /// Eigenvalues of the structure that are inputs after those of cases and combinations, in the inner problem of a structure.
    pub eigenvalues: Vec<modes::Eigenvalue>,
    /// Limits on eigenvalues that coincide, direction by direction.
    pub cuts: Arc<Vec<modes::Cut>>,
    /// What follows from it, see [`Problem::prepare`].
    pub statics: Option<Arc<statics::Statics>>,
    /// `[solver]`.
    pub settings: Settings,
    /// What the reader wants said: moved starts, unused data, …; already worded.
    pub warnings: Vec<String>,
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
