//! What loads and supports act on: names and patterns, expanded to numbers once each.

use std::collections::HashMap;
use std::sync::Arc;

use super::super::Assembly;
use crate::input::source::Written;
use crate::problem::glob::matches;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::texts::Texts;

/// Nodes or ribs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Target {
    Nodes,
    Ribs,
}

/// Patterns expanded so far, and names in alphabetical order, so that a pattern's fixed beginning is looked up.
#[derive(Default)]
pub(super) struct Targets {
    expanded: HashMap<(Target, String), Arc<Vec<u32>>>,
    sorted: HashMap<Target, Vec<u32>>,
}

/// Whether a text stands for several names.
pub(super) fn is_pattern(text: &str) -> bool {
    text.contains(['*', '?'])
}

impl Targets {
    /// The numbers of the names that match, ascending.
    fn expand(&mut self, target: Target, pattern: &str, names: &Texts) -> Arc<Vec<u32>> {
        let key = (target, pattern.to_owned());
        if let Some(known) = self.expanded.get(&key) {
            return known.clone();
        }
        let sorted = self.sorted.entry(target).or_insert_with(|| {
            let mut numbers: Vec<u32> = (0..names.len() as u32).collect();
            numbers.sort_unstable_by_key(|&number| &names[number as usize]);
            numbers
        });
        let beginning = pattern.split(['*', '?']).next().unwrap_or_default();
        let from = sorted.partition_point(|&number| names[number as usize] < *beginning);
        let candidates = sorted[from..].iter().take_while(|&&number| names[number as usize].starts_with(beginning));
        let mut found: Vec<u32> = candidates.copied().filter(|&number| matches(pattern, &names[number as usize])).collect();
        found.sort_unstable();
        let found = Arc::new(found);
        self.expanded.insert(key, found.clone());
        found
    }
}

impl Assembly<'_> {
    /// The nodes or ribs a name or pattern stands for; a mistake where there is none.
    pub(super) fn targets(&mut self, target: Target, written: &Written) -> Arc<Vec<u32>> {
        let text = written.text.as_str();
        let (names, exact) = match target {
            Target::Nodes => {
                let names = &self.building.structure.nodes.names;
                (names, self.names.nodes.find(names, text))
            }
            Target::Ribs => (&self.problem.ribs.names, self.names.ribs.find(&self.problem.ribs.names, text)),
        };
        if let Some(number) = exact {
            return Arc::new(vec![number]);
        }
        if !is_pattern(text) {
            self.unknown_target(target, written);
            return Arc::default();
        }
        let found = self.building.targets.expand(target, text, names);
        if found.is_empty() && !self.building.incomplete {
            let (what, help) = (word(target), did_you_mean(text, names.iter().take(10_000)));
            let message = format!("pattern `{text}` matches no {what}");
            self.findings.mistake(
                MistakeCode::UnknownItem,
                written.place,
                message,
                help.unwrap_or_else(|| "`*` stands for any letters, `?` for one".into()),
            );
        }
        found
    }

    fn unknown_target(&mut self, target: Target, written: &Written) {
        if target == Target::Nodes {
            self.unknown_node(&written.text, written.place);
            return;
        }
        if self.without.table {
            return; // perhaps it stands in what could not be read
        }
        let near = did_you_mean(&written.text, self.problem.ribs.names.iter().take(10_000));
        let help = near.unwrap_or_else(|| "declare it under [[ribs]] or in the table of ribs".into());
        self.findings.mistake(MistakeCode::UnknownItem, written.place, format!("there is no rib `{}`", written.text), help);
    }

    /// All targets of a list, each once, in the order of the list.
    pub(super) fn all_targets(&mut self, target: Target, list: &[Written]) -> Vec<u32> {
        let mut all: Vec<u32> = Vec::new();
        for written in list {
            all.extend_from_slice(&self.targets(target, written));
        }
        if list.len() > 1 {
            let mut seen = std::collections::HashSet::new();
            all.retain(|number| seen.insert(*number));
        }
        all
    }
}

pub(super) fn word(target: Target) -> &'static str {
    match target {
        Target::Nodes => "node",
        Target::Ribs => "rib",
    }
}
