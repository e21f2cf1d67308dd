//! Formulas of one item with its own names spelt out, so that they mean the same anywhere.

use std::sync::Arc;

use super::evaluate::{Evaluation, Item};
use super::formula::{Members, Response, Subject};
use super::range::end_section;
use super::{Constraint, Formula, Limit, Problem, Scope};
use crate::expression::ast::Collection;

impl Problem {
    /// `formula` of this item and its group, as a formula without names of its own; `None` where a number is missing.
    pub fn instance(&self, formula: &Formula, item: Item, group: &[u32]) -> Option<Formula> {
        let go = |inner: &Formula| self.instance(inner, item, group);
        let boxed = |inner: &Formula| go(inner).map(Box::new);
        Some(match formula {
            Formula::OwnProperty(property) => match item {
                Item::Section(section) => Formula::SectionProperty(section, property.clone()),
                _ => return None,
            },
            Formula::EndProperty(end, property) => Formula::SectionProperty(end_section(self, *end, item)?, property.clone()),
            Formula::OwnVolume => match item {
                Item::Rib(rib) => Formula::RibVolume(rib),
                _ => return None,
            },
            Formula::OwnLength | Formula::OwnData(_) | Formula::OwnMaterial(_) | Formula::EndData(..) => {
                Formula::Constant(Evaluation::constants(self).value(formula, item)?)
            }
            Formula::Profile(profile, at) => {
                let s = Evaluation::constants(self).value(at, item)?;
                self.profiles.get(*profile as usize)?.at(s)?
            }
            Formula::Response(response) => {
                let subject = match (response.subject, item) {
                    (Subject::Own, Item::Rib(rib)) => Subject::Rib(rib),
                    (Subject::Own, Item::Node(node)) => Subject::Node(node),
                    (Subject::Own, _) => return None,
                    (named, _) => named,
                };
                Formula::Response(Arc::new(Response { subject, ..Response::clone(response) }))
            }
            Formula::Unary(op, inner) => Formula::Unary(*op, boxed(inner)?),
            Formula::Binary(op, left, right) => Formula::Binary(*op, boxed(left)?, boxed(right)?),
            Formula::Fold(fold, list) => Formula::Fold(*fold, list.iter().map(go).collect::<Option<_>>()?),
            Formula::Over { fold, collection, members: Members::Group(thinned), body } => {
                let chosen = |index: &u32| thinned.as_ref().is_none_or(|list| list.binary_search(index).is_ok());
                let members = Members::Listed(Arc::new(group.iter().copied().filter(chosen).collect()));
                Formula::Over { fold: *fold, collection: *collection, members, body: Arc::clone(body) }
            }
            global => global.clone(),
        })
    }

    /// One row of a repeated constraint, written out; `None` where a number is missing.
    pub fn one_row(&self, constraint: &Constraint, at: usize) -> Option<Constraint> {
        let (item, group) = constraint.scope.item(at);
        let scope = match &constraint.scope {
            Scope::Once => Scope::Once,
            Scope::Sections(items) => Scope::Sections(vec![items[at]]),
            Scope::Ribs(items) => Scope::Ribs(vec![items[at]]),
            Scope::RibGroups(groups) => Scope::RibGroups(vec![groups[at].clone()]),
            Scope::SectionGroups(groups) => Scope::SectionGroups(vec![groups[at].clone()]),
            Scope::Nodes(items) => Scope::Nodes(vec![items[at]]),
            Scope::NodeGroups(groups) => Scope::NodeGroups(vec![groups[at].clone()]),
        };
        let written = |formula: &Formula| self.instance(formula, item, group);
        let right = match &constraint.right {
            Limit::AtMost(limit) => Limit::AtMost(written(limit)?),
            Limit::AtLeast(limit) => Limit::AtLeast(written(limit)?),
            Limit::Equal(value) => Limit::Equal(written(value)?),
            Limit::Between(lower, upper) => Limit::Between(written(lower)?, written(upper)?),
        };
        Some(Constraint { scope, left: written(&constraint.left)?, right, ..constraint.clone() })
    }

    /// A fold over items written out, one formula per item; `None` where they are the members of a group that is not known.
    pub fn instances(&self, collection: Collection, members: &Members, body: &Formula) -> Option<Vec<Formula>> {
        let one = |index: u32| self.instance(body, Item::of(collection, index), &[]);
        match members {
            Members::All => (0..self.count(collection)).map(one).collect(),
            Members::Listed(list) => list.iter().copied().map(one).collect(),
            Members::Group(_) => None,
        }
    }
}

impl Scope {
    /// The item that row `at` is stated for, and the members of its group.
    pub fn item(&self, at: usize) -> (Item, &[u32]) {
        match self {
            Scope::Once => (Item::None, &[]),
            Scope::Sections(items) => (Item::Section(items[at]), &[]),
            Scope::Ribs(items) => (Item::Rib(items[at]), &[]),
            Scope::Nodes(items) => (Item::Node(items[at]), &[]),
            Scope::RibGroups(groups) => (groups[at].1.first().map_or(Item::None, |&rib| Item::Rib(rib)), &groups[at].1),
            Scope::SectionGroups(groups) => (groups[at].1.first().map_or(Item::None, |&s| Item::Section(s)), &groups[at].1),
            Scope::NodeGroups(groups) => (groups[at].1.first().map_or(Item::None, |&node| Item::Node(node)), &groups[at].1),
        }
    }
}
