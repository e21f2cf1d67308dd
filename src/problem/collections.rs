//! Sections, ribs and nodes looked at alike.

use super::texts::Texts;
use super::{Cells, Column, Problem};
use crate::expression::ast::Collection;
use crate::sections::{self, Form};

impl Problem {
    /// How many there are.
    pub fn count(&self, collection: Collection) -> u32 {
        self.item_names(collection).len() as u32
    }

    /// The name of a section, rib or node.
    pub fn item_name(&self, collection: Collection, index: u32) -> &str {
        self.item_names(collection).get(index as usize).unwrap_or_default()
    }

    /// Data columns of sections, ribs or nodes.
    pub fn columns(&self, collection: Collection) -> &[Column] {
        match collection {
            Collection::Sections => &self.sections.data,
            Collection::Ribs => &self.ribs.data,
            Collection::Nodes => self.structure.as_ref().map_or(&[], |structure| &structure.nodes.data),
        }
    }

    /// The text in a cell; `None` where it is empty or a number.
    pub fn label(&self, collection: Collection, column: u32, index: u32) -> Option<&str> {
        match &self.columns(collection).get(column as usize)?.cells {
            Cells::Labels { labels, of } => labels.get(*of.get(index as usize)? as usize).map(|label| &**label),
            Cells::Numbers(_) => None,
        }
    }

    /// The number of the form of a section, or of the section at a rib's left end; a node has none.
    pub fn kind_of(&self, collection: Collection, index: u32) -> Option<u16> {
        let section = match collection {
            Collection::Sections => index,
            Collection::Ribs => *self.ribs.from.get(index as usize)?,
            Collection::Nodes => return None,
        };
        self.sections.form.get(section as usize).copied()
    }

    fn item_names(&self, collection: Collection) -> &Texts {
        match collection {
            Collection::Sections => &self.sections.names,
            Collection::Ribs => &self.ribs.names,
            Collection::Nodes => self.structure.as_ref().map_or(Texts::NONE, |structure| &structure.nodes.names),
        }
    }
}

/// The form in which the dimensions of section `s` are given.
pub fn sections_form(problem: &Problem, s: usize) -> Option<&'static Form> {
    problem.sections.form.get(s).map(|&number| sections::form(number))
}
