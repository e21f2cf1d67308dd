//! What the numbers of reports are told in: the file's own units, or those it wants shown.

use std::collections::HashMap;

use super::{Dimension, System, Unit};

/// What can be asked to be shown in another unit, with what it measures.
pub const KINDS: [(&str, Dimension); 11] = [
    ("length", Dimension::LENGTH),
    ("area", Dimension::whole([2, 0, 0, 0])),
    ("volume", Dimension::whole([3, 0, 0, 0])),
    ("inertia", Dimension::whole([4, 0, 0, 0])),
    ("force", Dimension::FORCE),
    ("line_load", Dimension::whole([-1, 1, 0, 0])),
    ("moment", Dimension::MOMENT),
    ("stress", Dimension::STRESS),
    ("mass", Dimension::MASS),
    ("time", Dimension::TIME),
    ("frequency", Dimension::whole([0, 0, -1, 0])),
];

/// A unit that numbers are told in.
#[derive(Debug, Clone, PartialEq)]
pub struct Label {
    /// How many of it one of the file's own is.
    pub factor: f64,
    /// What it is called.
    pub name: String,
}

impl Label {
    /// Factor and name; 1 and nothing for numbers without a unit.
    pub fn parts(label: Option<Label>) -> (f64, String) {
        label.map_or_else(|| (1.0, String::new()), |label| (label.factor, label.name))
    }
}

/// Dimensions by name, and the units that are told.
#[derive(Debug, Clone, Default)]
pub struct Shown {
    /// What the file's numbers are in.
    pub system: System,
    /// Units to be shown instead, with their names.
    pub wanted: Vec<(Unit, String)>,
    /// Of variables, by the name that is declared: `x`; of those of sections by that of the dimension, `.b`, or by all of it, `support.b`.
    pub variables: HashMap<String, Dimension>,
    /// Of rows, by the names of their constraints.
    pub rows: HashMap<String, Dimension>,
    /// Of the objective.
    pub objective: Option<Dimension>,
}

impl Shown {
    /// What a variable such as `x[2]` is told in; `None` for plain numbers, and where nothing is known.
    ///
    /// ```
    /// use ribopt::units::{Dimension, Shown, System, Unit};
    /// let system = System::of(&[("length".into(), "m".into())]);
    /// let variables = [("b".to_owned(), Dimension::LENGTH)].into();
    /// let wanted = vec![(Unit::parse("mm").unwrap(), "mm".to_owned())];
    /// let shown = Shown { system, wanted, variables, ..Shown::default() };
    /// let label = shown.variable("b[2]").unwrap();
    /// assert_eq!((label.factor, label.name.as_str()), (1000.0, "mm"));
    /// ```
    pub fn variable(&self, name: &str) -> Option<Label> {
        self.label(self.of_variable(name)?)
    }

    /// What a row such as `stress#2[r1]` is told in.
    pub fn row(&self, name: &str) -> Option<Label> {
        self.label(*self.rows.get(stem(name))?)
    }

    /// What the objective is told in.
    pub fn objective(&self) -> Option<Label> {
        self.label(self.objective?)
    }

    /// The file's own unit of the objective.
    pub fn own_of_objective(&self) -> Option<String> {
        self.own(self.objective?)
    }

    /// The file's own unit of a variable.
    pub fn own_of_variable(&self, name: &str) -> Option<String> {
        self.own(self.of_variable(name)?)
    }

    fn of_variable(&self, name: &str) -> Option<Dimension> {
        let of_section = || name.rfind('.').and_then(|dot| self.variables.get(&name[dot..]));
        self.variables.get(name).or_else(|| self.variables.get(stem(name))).or_else(of_section).copied()
    }

    /// The file's own unit of a row.
    pub fn own_of_row(&self, name: &str) -> Option<String> {
        self.own(*self.rows.get(stem(name))?)
    }

    /// Each unit to be shown, with the own one that it stands for.
    pub fn instead(&self) -> impl Iterator<Item = (String, Label)> + '_ {
        self.wanted.iter().filter_map(|(unit, _)| Some((self.own(unit.dimension())?, self.label(unit.dimension())?)))
    }

    fn own(&self, dimension: Dimension) -> Option<String> {
        self.system.label(dimension).filter(|_| !dimension.is_none())
    }

    fn label(&self, dimension: Dimension) -> Option<Label> {
        match self.wanted.iter().find(|(unit, _)| unit.dimension() == dimension) {
            Some((unit, name)) => Some(Label { factor: self.system.shown(1.0, *unit).ok()?, name: name.clone() }),
            None => Some(Label { factor: 1.0, name: self.own(dimension)? }),
        }
    }
}

/// The name before an index, an item or the number of a part.
fn stem(name: &str) -> &str {
    name.split(['[', '#']).next().unwrap_or(name)
}
