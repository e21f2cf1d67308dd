//! `[[constraints]]`: the items each is repeated for, and its rows.

use std::collections::HashMap;
use std::sync::Arc;

use super::Assembly;
use crate::expression::Span;
use crate::expression::ast::Collection;
use crate::expression::parse::{parse_condition, parse_range};
use crate::input::declaration::{ConstraintEntry, Name};
use crate::input::source::{Place, Written};
use crate::problem::glob::matches;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::nearest::did_you_mean;
use crate::problem::resolve::{Chosen, ItemFilter, ItemScope, Stage};
use crate::problem::{Cells, Constraint, Formula, Limit, Scope};
use crate::sections;

impl Assembly<'_> {
    /// All constraints, in the file's order.
    pub(super) fn constraints(&mut self, entries: &[ConstraintEntry]) {
        let mut names: HashMap<String, Place> = HashMap::new();
        for (at, entry) in entries.iter().enumerate() {
            let name = entry.name.as_ref().map_or_else(|| format!("c{}", at + 1), |name| name.text.clone());
            self.new_row_name(entry, &name, &mut names);
            self.constraint(entry, name);
        }
    }

    fn new_row_name(&mut self, entry: &ConstraintEntry, name: &str, names: &mut HashMap<String, Place>) {
        let place = entry.name.as_ref().map_or(entry.place, |name: &Name| name.place);
        if let Some(first) = names.insert(name.to_owned(), place) {
            let help = format!("the first is declared at {}; rename one of them", self.spoken(first));
            self.findings.mistake(MistakeCode::DuplicateName, place, format!("two constraints are called `{name}`"), help);
        }
    }

    /// What responses leave to the row, and the index it is stated for.
    pub(super) fn chosen(&self) -> Chosen<'_> {
        let index = self.index.as_ref().map(|(name, number)| (name.as_str(), *number));
        Chosen { index, ..self.choice.chosen() }
    }

    /// `for = "i in 1..N"`: the rows of every number, called by it.
    fn indexed(&mut self, entry: &ConstraintEntry, written: &Written, name: &str) {
        let Some((index, ends)) = self.parsed(written, parse_range) else { return };
        let span = Span { start: 0, end: written.text.len() };
        let Some(numbers) = self.resolved(written, None, Stage::Constants, |resolver| resolver.range(&ends, span)) else {
            return;
        };
        let before = self.findings.mistakes();
        for number in numbers {
            self.index = Some((index.clone(), number as f64));
            self.rows_of(entry, format!("{name}[{number}]"));
            // What is wrong with one row is wrong with all.
            if self.findings.mistakes() > before {
                break;
            }
        }
        self.index = None;
    }

    fn constraint(&mut self, entry: &ConstraintEntry, name: String) {
        match &entry.index {
            Some(written) => self.indexed(entry, written, &name),
            None => self.rows_of(entry, name),
        }
    }

    fn rows_of(&mut self, entry: &ConstraintEntry, name: String) {
        let scoped = match entry.repeated {
            Some(collection) => match self.scope(entry, collection, &name) {
                Some(scope) => Some(scope),
                None => return,
            },
            None if entry.only.is_empty() && entry.by.is_none() => None,
            None => return, // `for` is wrong or missing: a mistake already
        };
        let (item_scope, scope) = match scoped {
            Some((item_scope, scope)) => (Some(item_scope), scope),
            None => (None, Scope::Once),
        };
        let Some(require) = &entry.require else { return };
        let place = self.spoken(entry.place);
        let Some(spread) = self.spread(entry, require, item_scope.as_ref()) else { return };
        for (choice, ribs) in spread {
            let (items, scope) = match (&item_scope, &scope, ribs) {
                (Some(_), Scope::Ribs(_), Some(ribs)) => {
                    (Some(ItemScope::of(&self.problem, Collection::Ribs, ribs.clone())), Scope::Ribs(ribs))
                }
                (Some(_), Scope::Sections(_), Some(list)) => {
                    (Some(ItemScope::of(&self.problem, Collection::Sections, list.clone())), Scope::Sections(list))
                }
                (Some(_), Scope::Nodes(_), Some(list)) => {
                    (Some(ItemScope::of(&self.problem, Collection::Nodes, list.clone())), Scope::Nodes(list))
                }
                _ => (item_scope.clone(), scope.clone()),
            };
            let detail: Box<str> = choice.detail.clone();
            self.choice = choice;
            let rows = self.requirement(require, items.as_ref(), &scope, &name);
            self.choice = Default::default();
            for (name, left, right) in rows {
                let (place, text, detail) = (place.clone(), require.text.clone(), detail.clone());
                let row = Constraint { name, detail, place, text, scope: scope.clone(), left, right, asked: Vec::new() };
                match &scope {
                    Scope::RibGroups(groups) if row.left.is_of_line() => self.by_line(&row, groups, entry),
                    _ => self.problem.constraints.push(row),
                }
            }
        }
    }

    /// Rows of the ribs of each line, which take their sag from the chord of the line's ends.
    fn by_line(&mut self, row: &Constraint, groups: &[(Box<str>, Vec<u32>)], entry: &ConstraintEntry) {
        for (label, ribs) in groups {
            let Some(chord) = self.problem.structure.as_deref().and_then(|structure| structure.chord(ribs)) else {
                let message = format!("the ribs of line `{label}` do not make up one open line");
                let help =
                    "sag is taken from the chord of a line's ends: a ring or a branch has none; choose the ribs by `where`";
                self.findings.mistake(MistakeCode::Group, entry.place, message, help);
                continue;
            };
            let listed = Arc::new(ribs.clone());
            let there = |formula: &Formula| formula.in_line(&listed, chord);
            let right = match &row.right {
                Limit::AtMost(limit) => Limit::AtMost(there(limit)),
                Limit::AtLeast(limit) => Limit::AtLeast(there(limit)),
                Limit::Equal(value) => Limit::Equal(there(value)),
                Limit::Between(lower, upper) => Limit::Between(there(lower), there(upper)),
            };
            let (left, scope) = (there(&row.left), Scope::Ribs(ribs.clone()));
            self.problem.constraints.push(Constraint { scope, left, right, ..row.clone() });
        }
    }

    /// The chosen items; `None` where none are left (a warning) or after a mistake.
    fn scope(&mut self, entry: &ConstraintEntry, collection: Collection, name: &str) -> Option<(ItemScope, Scope)> {
        let mut scope = ItemScope::all(&self.problem, collection);
        if !entry.only.is_empty() {
            self.warn_idle_patterns(&entry.only, &scope);
            let wanted = |item: &str| entry.only.iter().any(|pattern| matches(&pattern.text, item));
            scope = self.thinned(&scope, |assembly, index| wanted(assembly.problem.item_name(collection, index)));
        }
        if let Some(kind) = &entry.kind {
            let kind = self.kind(&kind.text, kind.place)?.name();
            let is_kind = |form: u16| sections::kind_of(form).name() == kind;
            scope = self.thinned(&scope, |assembly, index| assembly.problem.kind_of(collection, index).is_some_and(is_kind));
        }
        if let Some(written) = &entry.filter {
            let members = self.filtered(written, &scope)?;
            scope = ItemScope::of(&self.problem, collection, members);
        }
        if scope.members.is_empty() {
            let place = entry.name.as_ref().map_or(entry.place, |name| name.place);
            let message = format!("constraint `{name}` concerns nothing: no item is chosen");
            self.findings.warning(MistakeCode::NothingChosen, place, message, "it is left out");
            return None;
        }
        let rows = match (&entry.by, collection) {
            (Some(by), _) => self.groups(by, &mut scope)?,
            (None, Collection::Sections) => Scope::Sections(scope.members.clone()),
            (None, Collection::Ribs) => Scope::Ribs(scope.members.clone()),
            (None, Collection::Nodes) => Scope::Nodes(scope.members.clone()),
        };
        Some((scope, rows))
    }

    fn thinned(&self, scope: &ItemScope, keep: impl Fn(&Self, u32) -> bool) -> ItemScope {
        let members = scope.members.iter().copied().filter(|&index| keep(self, index)).collect();
        ItemScope::of(&self.problem, scope.collection, members)
    }

    fn warn_idle_patterns(&mut self, patterns: &[Written], scope: &ItemScope) {
        for pattern in patterns {
            let hit = |&index: &u32| matches(&pattern.text, self.problem.item_name(scope.collection, index));
            if !scope.members.iter().any(hit) {
                let names = scope.members.iter().take(10_000).map(|&index| self.problem.item_name(scope.collection, index));
                let help = did_you_mean(&pattern.text, names);
                self.findings.warning(
                    MistakeCode::NothingChosen,
                    pattern.place,
                    format!("pattern `{}` matches nothing", pattern.text),
                    help,
                );
            }
        }
    }

    fn filtered(&mut self, written: &Written, scope: &ItemScope) -> Option<Vec<u32>> {
        let tree = self.parsed(written, parse_condition)?;
        let filter = self.resolved(written, Some(scope), Stage::All, |resolver| resolver.condition(&tree))?;
        match filter.choose(&self.problem, scope) {
            Ok(members) => Some(members),
            Err(message) => {
                self.findings.mistake(MistakeCode::EmptyCell, written.place, message, ItemFilter::REMEDY);
                None
            }
        }
    }

    /// Groups by the values of a data column, in the order in which they first occur.
    fn groups(&mut self, by: &Written, scope: &mut ItemScope) -> Option<Scope> {
        let collection = scope.collection;
        let columns = self.problem.columns(collection);
        let Some(at) = columns.iter().position(|column| column.name == by.text) else {
            let help = did_you_mean(&by.text, columns.iter().map(|column| &*column.name));
            let help = help.unwrap_or_else(|| "`by` names a datum of the items".into());
            self.findings.mistake(MistakeCode::UnknownItem, by.place, format!("there is no datum `{}`", by.text), help);
            return None;
        };
        let label = |index: u32| match &columns[at].cells {
            Cells::Labels { .. } => self.problem.label(collection, at as u32, index).map(str::to_owned),
            Cells::Numbers(numbers) => numbers.get(index as usize).filter(|value| !value.is_nan()).map(f64::to_string),
        };
        let mut numbers: HashMap<String, usize> = HashMap::new();
        let mut groups: Vec<(Box<str>, Vec<u32>)> = Vec::new();
        let mut empty = Vec::new();
        for &index in &scope.members {
            let Some(label) = label(index) else {
                empty.push(index);
                continue;
            };
            let group = *numbers.entry(label).or_insert_with_key(|label| {
                groups.push((label.as_str().into(), Vec::new()));
                groups.len() - 1
            });
            groups[group].1.push(index);
        }
        self.used.push((collection, at as u32));
        if let Some(&first) = empty.first() {
            self.empty_cell(collection, first, &by.text, empty.len(), &format!("`by` at {}", self.spoken(by.place)));
            return None;
        }
        scope.grouped = true;
        Some(match collection {
            Collection::Ribs => Scope::RibGroups(groups),
            Collection::Sections => Scope::SectionGroups(groups),
            Collection::Nodes => Scope::NodeGroups(groups),
        })
    }

    /// The mistake of an empty cell that is used, at its row.
    pub(super) fn empty_cell(&mut self, collection: Collection, item: u32, column: &str, count: usize, user: &str) {
        let (word, places) = match collection {
            Collection::Sections => ("section", self.section_places.as_slice()),
            Collection::Ribs => ("rib", self.rib_places.as_slice()),
            Collection::Nodes => ("node", self.node_places()),
        };
        let place = places.get(item as usize).copied().unwrap_or(Place::Whole);
        let name = self.problem.item_name(collection, item);
        let more = if count > 1 { format!(" (and of {} more)", count - 1) } else { String::new() };
        let message = format!("`{column}` of {word} `{name}`{more} is empty, but {user} uses it");
        self.findings.mistake(
            MistakeCode::EmptyCell,
            place,
            message,
            "fill the cell, or choose among the items with `only` or `where`",
        );
    }
}
