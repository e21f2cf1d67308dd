//! A problem put together in Rust.

use std::fmt::Write;
use std::ops::RangeInclusive;

use super::answer::Answer;
use super::toml_text::{list, number, quoted};
use crate::run::{RunError, Subject, solve};

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

impl Value {
    /// The same with a start, where it is free.
    #[must_use]
    pub fn start(self, start: f64) -> Value {
        match self {
            Value::Free { lower, upper, .. } => Value::Free { lower, upper, start: Some(start) },
            fixed => fixed,
        }
    }

    fn text(&self) -> String {
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

/// A cross-section: its kind and dimensions, as `ribopt section` and docs/section-kinds.md list them.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Section {
    kind: String,
    dimensions: Vec<(String, Value)>,
    data: Vec<(String, f64)>,
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

/// A rib between two sections.
#[derive(Debug, Clone, PartialEq)]
pub struct Rib {
    from: String,
    to: String,
    length: f64,
    prismatoid: bool,
    data: Vec<(String, f64)>,
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

/// What is required: `"support.Ix >= 2.5e-4"`, once or for every item of a collection.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Constraint {
    require: String,
    collection: Option<String>,
    only: Vec<String>,
    condition: Option<String>,
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

/// A problem put together in Rust, in the words of the problem file; see the front page for an example.
///
/// Names and expressions are checked when it is solved: every mistake is told with its place in [`Problem::to_toml`].
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Problem {
    title: String,
    objective: Option<(&'static str, String)>,
    parameters: Vec<(String, Value)>,
    variables: Vec<(String, Value)>,
    definitions: Vec<(String, String)>,
    sections: Vec<(String, Section)>,
    ribs: Vec<(String, Rib)>,
    constraints: Vec<(String, Constraint)>,
    max_seconds: Option<f64>,
}

impl Problem {
    /// An empty problem. With ribs and no objective the volume is minimised.
    pub fn new(title: &str) -> Problem {
        Problem { title: title.into(), ..Problem::default() }
    }

    /// The objective.
    #[must_use]
    pub fn minimize(self, expression: &str) -> Problem {
        Problem { objective: Some(("minimize", expression.into())), ..self }
    }

    /// The objective, turned.
    #[must_use]
    pub fn maximize(self, expression: &str) -> Problem {
        Problem { objective: Some(("maximize", expression.into())), ..self }
    }

    /// A constant: a number, or an expression in other parameters.
    #[must_use]
    pub fn parameter(mut self, name: &str, value: impl Into<Value>) -> Problem {
        self.parameters.push((name.into(), value.into()));
        self
    }

    /// A free variable between bounds.
    #[must_use]
    pub fn variable(mut self, name: &str, value: impl Into<Value>) -> Problem {
        self.variables.push((name.into(), value.into()));
        self
    }

    /// A name for an expression.
    #[must_use]
    pub fn definition(mut self, name: &str, expression: &str) -> Problem {
        self.definitions.push((name.into(), expression.into()));
        self
    }

    /// A cross-section.
    #[must_use]
    pub fn section(mut self, name: &str, section: Section) -> Problem {
        self.sections.push((name.into(), section));
        self
    }

    /// A rib.
    #[must_use]
    pub fn rib(mut self, name: &str, rib: Rib) -> Problem {
        self.ribs.push((name.into(), rib));
        self
    }

    /// A constraint.
    #[must_use]
    pub fn require(mut self, name: &str, constraint: impl Into<Constraint>) -> Problem {
        self.constraints.push((name.into(), constraint.into()));
        self
    }

    /// Seconds for the whole run.
    #[must_use]
    pub fn max_seconds(self, seconds: f64) -> Problem {
        Problem { max_seconds: Some(seconds), ..self }
    }

    /// The problem as a file.
    pub fn to_toml(&self) -> String {
        let mut text = format!("title = {}\n", quoted(&self.title));
        if let Some((sense, expression)) = &self.objective {
            line(&mut text, &format!("{sense} = {}", quoted(expression)));
        }
        table(&mut text, "parameters", self.parameters.iter().map(|(name, value)| (name, value.text())));
        table(&mut text, "variables", self.variables.iter().map(|(name, value)| (name, value.text())));
        table(&mut text, "definitions", self.definitions.iter().map(|(name, expression)| (name, quoted(expression))));
        for (name, section) in &self.sections {
            line(&mut text, &format!("\n[sections.{}]\nkind = {}", quoted(name), quoted(&section.kind)));
            section.dimensions.iter().for_each(|(name, value)| entry(&mut text, name, &value.text()));
            data(&mut text, &section.data);
        }
        for (name, rib) in &self.ribs {
            let Rib { from, to, length, prismatoid, data: own } = rib;
            let (name, from, to) = (quoted(name), quoted(from), quoted(to));
            line(&mut text, &format!("\n[[ribs]]\nname = {name}\nfrom = {from}\nto = {to}\nlength = {}", number(*length)));
            if *prismatoid {
                line(&mut text, "volume = \"prismatoid\"");
            }
            data(&mut text, own);
        }
        for (name, constraint) in &self.constraints {
            line(&mut text, &format!("\n[[constraints]]\nname = {}\nrequire = {}", quoted(name), quoted(&constraint.require)));
            constraint.collection.iter().for_each(|collection| line(&mut text, &format!("for = {}", quoted(collection))));
            if !constraint.only.is_empty() {
                line(&mut text, &format!("only = {}", list(&constraint.only)));
            }
            constraint.condition.iter().for_each(|condition| line(&mut text, &format!("where = {}", quoted(condition))));
        }
        self.max_seconds.iter().for_each(|seconds| line(&mut text, &format!("\n[solver]\nmax_seconds = {}", number(*seconds))));
        text
    }

    /// Solves with all backends that are built in, and judges what they find.
    ///
    /// # Errors
    /// Every mistake of the problem, with its place in [`Problem::to_toml`]; no backend that takes it.
    pub fn solve(&self) -> Result<Answer, RunError> {
        let subject = self.subject()?;
        let outcome = solve::outcome(&subject)?;
        Ok(Answer::new(&subject, outcome))
    }

    /// The problem read, checked and assembled: what the other commands start from.
    ///
    /// # Errors
    /// Every mistake of the problem, with its place in [`Problem::to_toml`].
    pub fn subject(&self) -> Result<Subject, RunError> {
        Subject::of_text(&self.title, &self.to_toml())
    }
}

fn line(text: &mut String, line: &str) {
    // Writing to a string does not fail.
    let _ = writeln!(text, "{line}");
}

fn entry(text: &mut String, name: &str, value: &str) {
    line(text, &format!("{} = {value}", quoted(name)));
}

fn table<'a>(text: &mut String, name: &str, entries: impl Iterator<Item = (&'a String, String)>) {
    let mut begun = false;
    for (key, value) in entries {
        if !std::mem::replace(&mut begun, true) {
            line(text, &format!("\n[{name}]"));
        }
        entry(text, key, &value);
    }
}

fn data(text: &mut String, data: &[(String, f64)]) {
    if !data.is_empty() {
        let entries: Vec<String> = data.iter().map(|(name, value)| format!("{} = {}", quoted(name), number(*value))).collect();
        line(text, &format!("data = {{ {} }}", entries.join(", ")));
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_part_is_written_as_the_reader_takes_it() {
        let problem = Problem::new("A \"quoted\" title")
            .parameter("load", 3.0)
            .variable("t", Value::from(0.1..=f64::INFINITY).start(1.0))
            .definition("twice", "2*t")
            .section("left", Section::new("rectangle").with("b", 0.05..=0.4).with("h", 0.5).data("c", 7.0))
            .rib("only", Rib::prismatic("left", 2.0).prismatoid().data("d", 1.0))
            .require("thick", Constraint::new("b >= load*0.01*d/d").for_each("ribs").only("o*").filter("d > 0.5"))
            .require("t", "twice >= 1")
            .minimize("volume + t")
            .max_seconds(20.0);
        let text = problem.to_toml().replace("b >= load*0.01*d/d", "from.b >= load*0.01*d");
        let subject = Subject::of_text("test", &text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        let model = subject.model();
        assert_eq!(
            (model.variable_name(0), model.variable_name(1), model.row_name(0)),
            ("t".into(), "left.b".into(), "thick[only]".into())
        );
        assert_eq!((subject.about.title.as_str(), model.meta().upper[0]), ("A \"quoted\" title", f64::INFINITY));
    }

    #[test]
    fn a_wrong_name_is_told_with_its_line_and_a_remedy() {
        let problem = Problem::new("p").variable("depth", 0.1..=1.0).minimize("dept");
        let error = problem.solve().map(|answer| answer.message().to_owned()).unwrap_err().to_string();
        assert!(error.contains("did you mean `depth`?") && error.contains("p:2"), "{error}");
    }
}
