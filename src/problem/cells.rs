//! Which data cells a formula uses, and which of them are empty.

use super::formula::Members;
use super::item_scope::ItemScope;
use super::{Cells, Formula, Problem};
use crate::expression::ast::Collection;

/// A data column in use.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Use {
    /// Of sections or ribs.
    pub collection: Collection,
    /// Which column.
    pub column: u32,
    /// Items used whose cells are empty, ascending.
    pub empty: Vec<u32>,
}

/// The columns a formula uses when it is evaluated for the items of `scope`.
pub fn uses(problem: &Problem, formula: &Formula, scope: Option<&ItemScope>) -> Vec<Use> {
    let members = scope.map_or(&[][..], |scope| &scope.members);
    let mut walk = Walk { problem, collection: scope.map(|scope| scope.collection), members, found: Vec::new() };
    walk.formula(formula);
    walk.found
}

struct Walk<'a> {
    problem: &'a Problem,
    /// The collection whose own names hold.
    collection: Option<Collection>,
    members: &'a [u32],
    found: Vec<Use>,
}

impl Walk<'_> {
    fn formula(&mut self, formula: &Formula) {
        match formula {
            Formula::OwnData(column) => {
                if let Some(collection) = self.collection {
                    let members = self.members.to_vec();
                    self.note(collection, *column, members);
                }
            }
            Formula::EndData(end, column) => {
                let ribs = &self.problem.ribs;
                let ends = if *end == super::formula::End::From { &ribs.from } else { &ribs.to };
                let sections = self.members.iter().filter_map(|&r| ends.get(r as usize).copied()).collect();
                self.note(Collection::Sections, *column, sections);
            }
            Formula::Over { collection, members, body, .. } => self.over(*collection, members, body),
            other => other.children().for_each(|part| self.formula(part)),
        }
    }

    fn over(&mut self, collection: Collection, members: &Members, body: &Formula) {
        let inside: Vec<u32> = match members {
            Members::All => (0..self.problem.count(collection)).collect(),
            Members::Listed(list) => list.to_vec(),
            Members::Group(None) => self.members.to_vec(),
            Members::Group(Some(list)) => {
                self.members.iter().copied().filter(|index| list.binary_search(index).is_ok()).collect()
            }
        };
        let mut walk = Walk { problem: self.problem, collection: Some(collection), members: &inside, found: Vec::new() };
        walk.formula(body);
        self.found.extend(walk.found);
    }

    fn note(&mut self, collection: Collection, column: u32, members: Vec<u32>) {
        let empty = |&index: &u32| match self.problem.columns(collection).get(column as usize).map(|column| &column.cells) {
            Some(Cells::Numbers(numbers)) => numbers.get(index as usize).is_none_or(|value| value.is_nan()),
            _ => false,
        };
        let mut empty: Vec<u32> = members.into_iter().filter(empty).collect();
        empty.sort_unstable();
        empty.dedup();
        self.found.push(Use { collection, column, empty });
    }
}
