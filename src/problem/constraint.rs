//! Constraints and what they are repeated over.

use super::Formula;

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
    /// What both sides asked of the structure before they were written in what that follows from; empty where nothing was.
    pub asked: Vec<Formula>,
}

impl Constraint {
    /// The formulas of both its sides.
    pub fn formulas(&self) -> impl Iterator<Item = &Formula> {
        std::iter::once(&self.left).chain(self.right.formulas())
    }

    /// The same as they were asked for.
    pub fn asked(&self) -> impl Iterator<Item = &Formula> {
        let written = self.asked.is_empty().then(|| self.formulas());
        self.asked.iter().chain(written.into_iter().flatten())
    }

    /// Rows whose values are asked for: without a limit, a place or a text.
    pub fn unlimited(name: impl Into<String>, scope: Scope, left: Formula) -> Constraint {
        let right = Limit::AtMost(Formula::Constant(f64::INFINITY));
        let (place, text, detail) = (String::new(), String::new(), Box::default());
        Constraint { name: name.into(), detail, place, text, scope, left, right, asked: Vec::new() }
    }
}

/// What a row's left side is held against.
#[derive(Debug, Clone, PartialEq)]
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
