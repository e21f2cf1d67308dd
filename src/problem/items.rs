//! Which sections and ribs a row speaks of.

use std::collections::BTreeSet;

use super::formula::Members;
use super::{Constraint, Formula, Problem, Scope};
use crate::expression::ast::Collection;

/// Sections and ribs, by index.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Items {
    /// Sections.
    pub sections: BTreeSet<u32>,
    /// Ribs.
    pub ribs: BTreeSet<u32>,
}

impl Constraint {
    /// What every row of this constraint names by itself: `support.Ix`, `haunch.volume`, the items a fold runs over. Totals such
    /// as `volume` name nothing.
    pub fn named(&self, problem: &Problem) -> Items {
        let mut walk = Walk { problem, items: Items::default(), definitions: BTreeSet::new() };
        walk.formula(&self.left);
        self.right.formulas().for_each(|formula| walk.formula(formula));
        walk.items
    }

    /// What its row number `row` is stated for: one item, or the members of a group.
    pub fn own(&self, row: usize) -> (Collection, &[u32]) {
        match &self.scope {
            Scope::Once => (Collection::Ribs, &[]),
            Scope::Sections(list) => (Collection::Sections, list.get(row..=row).unwrap_or_default()),
            Scope::Ribs(list) => (Collection::Ribs, list.get(row..=row).unwrap_or_default()),
            Scope::SectionGroups(groups) => (Collection::Sections, groups.get(row).map_or(&[], |group| &group.1)),
            Scope::RibGroups(groups) => (Collection::Ribs, groups.get(row).map_or(&[], |group| &group.1)),
            Scope::Nodes(list) => (Collection::Nodes, list.get(row..=row).unwrap_or_default()),
            Scope::NodeGroups(groups) => (Collection::Nodes, groups.get(row).map_or(&[], |group| &group.1)),
        }
    }
}

struct Walk<'a> {
    problem: &'a Problem,
    items: Items,
    /// Those already looked into.
    definitions: BTreeSet<u32>,
}

impl Walk<'_> {
    fn formula(&mut self, formula: &Formula) {
        match formula {
            Formula::SectionProperty(section, _) => _ = self.items.sections.insert(*section),
            Formula::RibVolume(rib) => _ = self.items.ribs.insert(*rib),
            Formula::Definition(index) if self.definitions.insert(*index) => {
                if let Some((_, definition)) = self.problem.definitions.get(*index as usize) {
                    self.formula(definition);
                }
            }
            Formula::Over { collection, members, body, .. } => {
                self.members(*collection, members);
                self.formula(body);
            }
            other => other.children().for_each(|part| self.formula(part)),
        }
    }

    /// Members of the row's own group are its own already.
    fn members(&mut self, collection: Collection, members: &Members) {
        let known = match collection {
            Collection::Sections => &mut self.items.sections,
            Collection::Ribs => &mut self.items.ribs,
            Collection::Nodes => return,
        };
        match members {
            Members::All => known.extend(0..self.problem.count(collection)),
            Members::Listed(list) => known.extend(list.iter()),
            Members::Group(_) => {}
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::problem::{Limit, Property};

    #[test]
    fn names_are_found_on_both_sides_and_in_definitions() {
        let depth = Formula::SectionProperty(3, Property("h".into()));
        let problem = Problem { definitions: vec![("depth".into(), depth)], ..Problem::default() };
        let constraint = Constraint {
            detail: Box::default(),
            name: "c".into(),
            place: String::new(),
            text: String::new(),
            scope: Scope::Ribs(vec![5, 7]),
            left: Formula::Definition(0),
            right: Limit::AtMost(Formula::RibVolume(2)),
            asked: Vec::new(),
        };
        let named = constraint.named(&problem);
        assert_eq!((named.sections, named.ribs), ([3].into(), [2].into()));
        assert_eq!(constraint.own(1), (Collection::Ribs, &[7][..]));
        assert!(constraint.own(2).1.is_empty());
    }
}
