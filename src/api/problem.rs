//! A problem put together in Rust.

mod parts;

use super::answer::Answer;
use super::toml_text::{list, number, quoted};
use crate::run::{RunError, Subject, solve};
pub use parts::{Constraint, Rib, Section, Value};
use std::fmt::Write as _;

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
