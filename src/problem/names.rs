//! The one name space of variables, parameters, definitions, sections and ribs.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use hashbrown::HashTable;
use hashbrown::hash_table::Entry;

use super::Problem;
use super::texts::Texts;

/// What a name stands for, and its number among its kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
#[allow(missing_docs)]
pub enum Entity {
    Parameter(u32),
    /// An entry of `[variables]`, scalar or array.
    Variable(u32),
    /// An entry of `[definitions]`.
    Definition(u32),
    Section(u32),
    Rib(u32),
}

impl Entity {
    /// The word for it in messages.
    pub fn word(self) -> &'static str {
        match self {
            Entity::Parameter(_) => "parameter",
            Entity::Variable(_) => "variable",
            Entity::Definition(_) => "definition",
            Entity::Section(_) => "section",
            Entity::Rib(_) => "rib",
        }
    }
}

/// Finds a name among millions without keeping a second copy of any: a table of numbers, found by the hashes of their names.
#[derive(Debug, Default)]
pub struct NameIndex {
    numbers: HashTable<u32>,
}

impl NameIndex {
    /// The number of `name` in `names`.
    pub fn find(&self, names: &Texts, name: &str) -> Option<u32> {
        self.numbers.find(hash(name), |&number| names[number as usize] == *name).copied()
    }

    /// Enters the name that stands at `number` of `names`, or brings back the number it already has.
    pub fn enter(&mut self, names: &Texts, number: u32) -> Result<(), u32> {
        let name = &names[number as usize];
        let is_known = |&known: &u32| names[known as usize] == *name;
        match self.numbers.entry(hash(name), is_known, |&known| hash(&names[known as usize])) {
            Entry::Occupied(known) => Err(*known.get()),
            Entry::Vacant(place) => {
                place.insert(number);
                Ok(())
            }
        }
    }
}

fn hash(name: &str) -> u64 {
    let mut hasher = DefaultHasher::new();
    name.hash(&mut hasher);
    hasher.finish()
}

/// All names of a problem.
#[derive(Debug, Default)]
pub struct Names {
    declared: HashMap<Box<str>, Entity>,
    /// Names of sections, by [`super::Sections::names`].
    pub sections: NameIndex,
    /// Names of ribs, by [`super::Ribs::names`].
    pub ribs: NameIndex,
    /// Names of nodes, by [`super::structure::Nodes::names`]: a name space of their own.
    pub nodes: NameIndex,
}

impl Names {
    /// What a name stands for.
    pub fn find(&self, problem: &Problem, name: &str) -> Option<Entity> {
        let section = || self.sections.find(&problem.sections.names, name).map(Entity::Section);
        let rib = || self.ribs.find(&problem.ribs.names, name).map(Entity::Rib);
        self.declared.get(name).copied().or_else(section).or_else(rib)
    }

    /// Declares a parameter, variable or definition; the name must be free.
    pub fn declare(&mut self, name: &str, entity: Entity) {
        self.declared.insert(name.into(), entity);
    }

    /// Names to suggest, in a fixed order: all declared ones, and the first ten thousand sections and ribs.
    pub fn suggestions<'a>(&'a self, problem: &'a Problem) -> Vec<&'a str> {
        let mut declared: Vec<&str> = self.declared.keys().map(|name| &**name).collect();
        declared.sort_unstable();
        let items = problem.sections.names.iter().take(10_000).chain(problem.ribs.names.iter().take(10_000));
        declared.into_iter().chain(items).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_is_found_and_no_other() {
        let (mut names, mut index) = (Texts::default(), NameIndex::default());
        assert_eq!(index.find(&names, "r0"), None);
        for number in 0..3000 {
            names.push(&format!("r{number}"));
            assert_eq!(index.enter(&names, number), Ok(()));
        }
        names.push("r17");
        assert_eq!(index.enter(&names, 3000), Err(17));
        assert!((0..3000).all(|number| index.find(&names, &format!("r{number}")) == Some(number)));
        assert_eq!(index.find(&names, "r3000"), None);
    }
}
