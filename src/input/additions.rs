//! What a command adds to a file before it is checked: numbers changed, expressions of its own.

use super::declaration::{ConstraintEntry, Declaration, DefinitionEntry, Name};
use super::fields::Scalar;
use super::source::{Argument, Place, Written};
use crate::problem::Sense;

/// Changes of a file's numbers, and what is asked beside what the file asks.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Additions {
    /// As by `--set`: `NAME.lower=VALUE`, `NAME.upper=VALUE`, `NAME.start=VALUE` for a variable (`depth`, `x`, `x[2]`, `support.b`),
    /// `NAME=VALUE` for a parameter.
    pub changes: Vec<String>,
    /// Constant expressions, whose numbers are told by [`super::Input::constants`].
    pub constants: Vec<String>,
    /// Names and expressions, as under `[definitions]`.
    pub definitions: Vec<(String, String)>,
    /// What is minimised in the place of the file's objective.
    pub minimize: Option<String>,
    /// Names and requirements, as under `[[constraints]]`.
    pub rows: Vec<(String, String)>,
}

/// What is added to a file is the study's.
const STUDY: &str = "study";

impl Additions {
    /// Nothing but changes of numbers.
    pub fn changing(changes: &[String]) -> Additions {
        Additions { changes: changes.to_vec(), ..Additions::default() }
    }

    /// All texts, in the order of their numbers.
    pub(super) fn arguments(&self) -> Vec<Argument<'_>> {
        let changes = self.changes.iter().map(|text| Argument { origin: "--set", text });
        changes.chain(self.added().map(|text| Argument { origin: STUDY, text })).collect()
    }

    fn added(&self) -> impl Iterator<Item = &str> {
        let constants = self.constants.iter();
        let definitions = self.definitions.iter().map(|(_, text)| text);
        let rows = self.rows.iter().map(|(_, text)| text);
        constants.chain(definitions).chain(&self.minimize).chain(rows).map(String::as_str)
    }

    /// A text with its place among the arguments.
    fn written(&self, at: usize, text: &str) -> Written {
        let number = (self.changes.len() + at) as u16;
        Written { text: text.to_owned(), place: Place::Argument { number, start: 0, end: text.len() as u32 }, inside: None }
    }

    /// The constants, to be computed.
    pub(super) fn constants(&self) -> Vec<Scalar> {
        self.constants.iter().enumerate().map(|(at, text)| Scalar::Expression(self.written(at, text))).collect()
    }

    /// Puts the expressions among those of the file.
    pub(super) fn declare(&self, declared: &mut Declaration) {
        let mut at = self.constants.len();
        let mut next = |text: &str| {
            at += 1;
            self.written(at - 1, text)
        };
        for (name, text) in &self.definitions {
            let written = next(text);
            let name = Name { text: name.clone(), place: written.place };
            declared.definitions.push((name, DefinitionEntry::One(Scalar::Expression(written))));
        }
        if let Some(text) = &self.minimize {
            declared.objective = Some((Sense::Minimize, Some(next(text))));
        }
        for (name, text) in &self.rows {
            let written = next(text);
            declared.constraints.push(ConstraintEntry::once(Name { text: name.clone(), place: written.place }, written));
        }
    }
}
