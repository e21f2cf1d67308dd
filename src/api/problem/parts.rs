//! What a problem is made of: sections, ribs, values, constraints.

use super::super::toml_text::{number, quoted};
use std::ops::RangeInclusive;

/// What a dimension or a variable is: a number, a free variable between bounds, or an expression.
#[derive(Debug, Clone, PartialEq)]
pub enum Value {
    /// Fixed.
    Number(f64),
    /// Free between bounds (±∞ where open), from a start where one is given.
    Free {
        /// Lower bound.
        lower: f64,
        /// Upper bound.
        upper: f64,
        /// Where to begin.
        start: Option<f64>,
    },
    /// An expression in other names: `"2*b"`.
    Expression(String),
}

/// A cross-section: its kind and dimensions, as `ribopt section` and docs/section-kinds.md list them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    pub(super) kind: String,
    pub(super) dimensions: Vec<(String, Value)>,
    pub(super) data: Vec<(String, f64)>,
}

/// A rib between two sections.
#[derive(Debug, Clone, PartialEq)]
pub struct Rib {
    pub(super) from: String,
    pub(super) to: String,
    pub(super) length: f64,
    pub(super) prismatoid: bool,
    pub(super) data: Vec<(String, f64)>,
}

/// What is required: `"support.Ix >= 2.5e-4"`, once or for every item of a collection.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Constraint {
    pub(super) require: String,
    pub(super) collection: Option<String>,
    pub(super) only: Vec<String>,
    pub(super) condition: Option<String>,
}

impl Value {
    /// The same with a start, where it is free.
    #[must_use]
    pub fn start(self, start: f64) -> Value {
        match self {
            Value::Free { lower, upper, .. } => Value::Free { lower, upper, start: Some(start) },
            fixed => fixed,
        }
    }

    pub(super) fn text(&self) -> String {
        match self {
            Value::Number(value) => number(*value),
            Value::Expression(text) => quoted(text),
            Value::Free { lower, upper, start } => {
                let ends = [("lower", Some(*lower)), ("upper", Some(*upper)), ("start", *start)];
                // An end that is open is left out.
                let given = ends.into_iter().filter_map(|(key, value)| Some((key, value.filter(|value| !value.is_infinite())?)));
                let entries: Vec<String> = given.map(|(key, value)| format!("{key} = {}", number(value))).collect();
                format!("{{ {} }}", entries.join(", "))
            }
        }
    }
}

impl From<f64> for Value {
    fn from(value: f64) -> Value {
        Value::Number(value)
    }
}

impl From<RangeInclusive<f64>> for Value {
    fn from(range: RangeInclusive<f64>) -> Value {
        Value::Free { lower: *range.start(), upper: *range.end(), start: None }
    }
}

impl From<&str> for Value {
    fn from(text: &str) -> Value {
        Value::Expression(text.into())
    }
}

impl Section {
    /// A section of this kind: `rectangle`, `h-beam`, …
    pub fn new(kind: &str) -> Section {
        Section { kind: kind.into(), ..Section::default() }
    }

    /// One dimension: a number, a range, or an expression.
    #[must_use]
    pub fn with(mut self, dimension: &str, value: impl Into<Value>) -> Section {
        self.dimensions.push((dimension.into(), value.into()));
        self
    }

    /// A number of your own, for constraints.
    #[must_use]
    pub fn data(mut self, name: &str, value: f64) -> Section {
        self.data.push((name.into(), value));
        self
    }
}

impl Rib {
    /// A rib whose ends are these sections.
    pub fn between(from: &str, to: &str, length: f64) -> Rib {
        Rib { from: from.into(), to: to.into(), length, prismatoid: false, data: Vec::new() }
    }

    /// A rib with the same section throughout.
    pub fn prismatic(section: &str, length: f64) -> Rib {
        Rib::between(section, section, length)
    }

    /// Its volume by the prismatoid law instead of the frustum's.
    #[must_use]
    pub fn prismatoid(self) -> Rib {
        Rib { prismatoid: true, ..self }
    }

    /// A number of your own, for constraints.
    #[must_use]
    pub fn data(mut self, name: &str, value: f64) -> Rib {
        self.data.push((name.into(), value));
        self
    }
}

impl Constraint {
    /// This comparison.
    pub fn new(require: &str) -> Constraint {
        Constraint { require: require.into(), ..Constraint::default() }
    }

    /// Once per item of `sections` or `ribs`; the item's own names come first.
    #[must_use]
    pub fn for_each(self, collection: &str) -> Constraint {
        Constraint { collection: Some(collection.into()), ..self }
    }

    /// Only items whose name matches one of these patterns (`*` and `?`).
    #[must_use]
    pub fn only(mut self, pattern: &str) -> Constraint {
        self.only.push(pattern.into());
        self
    }

    /// Only items of which this comparison of data and parameters holds.
    #[must_use]
    pub fn filter(self, condition: &str) -> Constraint {
        Constraint { condition: Some(condition.into()), ..self }
    }
}

impl From<&str> for Constraint {
    fn from(require: &str) -> Constraint {
        Constraint::new(require)
    }
}
