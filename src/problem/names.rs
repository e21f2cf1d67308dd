//! The one name space of variables, parameters, definitions, sections and ribs.

use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use super::Problem;

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

/// Finds a name among millions without keeping a second copy of any: hash → number of the item.
#[derive(Debug, Default)]
pub struct NameIndex {
    slots: HashMap<u64, u32>,
}

impl NameIndex {
    /// The number of `name` in `names`.
    pub fn find(&self, names: &[Box<str>], name: &str) -> Option<u32> {
        self.slot(names, name).ok()
    }

    /// Enters the name that stands at `number` of `names`, or brings back the number it already has.
    pub fn enter(&mut self, names: &[Box<str>], number: u32) -> Result<(), u32> {
        match self.slot(names, &names[number as usize]) {
            Ok(known) => Err(known),
            Err(key) => {
                self.slots.insert(key, number);
                Ok(())
            }
        }
    }

    /// The name's number, or the free key it would get: names with equal hashes take neighbouring keys.
    fn slot(&self, names: &[Box<str>], name: &str) -> Result<u32, u64> {
        let mut hasher = DefaultHasher::new();
        name.hash(&mut hasher);
        let mut key = hasher.finish();
        while let Some(&number) = self.slots.get(&key) {
            if &*names[number as usize] == name {
                return Ok(number);
            }
            key = key.wrapping_add(1);
        }
        Err(key)
    }
}

/// All names of a problem.
#[derive(Debug, Default)]
pub struct Names {
    declared: HashMap<Box<str>, Entity>,
    /// Names of sections, by [`super::Sections::names`].
    pub sections: NameIndex,
    /// Names of ribs, by [`super::Ribs::names`].
    pub ribs: NameIndex,
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
        declared.into_iter().chain(items.map(|name| &**name)).collect()
    }
}
