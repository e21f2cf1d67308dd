//! Definitions whose elements follow from those before them: `v = { for = "i in 1..N", first = 0, value = "v[i-1] + a[i-1]*dt" }`.

use super::Assembly;
use crate::expression::Span;
use crate::expression::ast::Ast;
use crate::expression::parse::parse_range;
use crate::input::declaration::{DefinitionEntry, Name, SequenceEntry};
use crate::input::fields::Scalar;
use crate::problem::Formula;
use crate::problem::mistake_code::MistakeCode;
use crate::problem::order::{Order, order};
use crate::problem::resolve::{Stage, Value};

/// Definitions, elements of sequences and links one below the other at the most: what reads them needs stack for each.
pub(super) const DEEPEST: u32 = 10_000;

/// The numbers of a sequence's elements: 1 to `last`, by the name of the index.
#[derive(Debug, Clone)]
pub(super) struct Numbered {
    pub index: String,
    pub last: u32,
}

/// An order in which sequences that need one another, which go forward side by side, count as one: their leader. Also who leads each.
pub(super) fn together(nodes: usize, is_sequence: impl Fn(u32) -> bool, needs: impl Fn(u32) -> Vec<u32>) -> (Order, Vec<u32>) {
    let mut leaders: Vec<u32> = (0..nodes as u32).collect();
    let sequences: Vec<u32> = (0..nodes as u32).filter(|&node| is_sequence(node)).collect();
    loop {
        let joined = |node: u32| {
            if !is_sequence(node) {
                return needs(node).into_iter().map(|needed| leaders[needed as usize]).collect();
            }
            if leaders[node as usize] != node {
                return vec![leaders[node as usize]];
            }
            let members = sequences.iter().filter(|&&member| leaders[member as usize] == node);
            let needed = members.flat_map(|&member| needs(member)).map(|needed| leaders[needed as usize]);
            needed.filter(|&needed| needed != node).collect()
        };
        let found = order(nodes, joined);
        let before = leaders.clone();
        for circle in found.circles.iter().filter(|circle| circle.iter().all(|&node| is_sequence(node))) {
            let Some(&first) = circle.iter().min() else { continue };
            for leader in leaders.iter_mut().filter(|leader| circle.contains(leader)) {
                *leader = first;
            }
        }
        if leaders == before {
            return (found, leaders);
        }
    }
}

impl Assembly<'_> {
    /// The numbers of each definition that is a sequence.
    pub(super) fn sequence_ranges(&mut self, definitions: &[(Name, DefinitionEntry)]) -> Vec<Option<Numbered>> {
        let mut elements = 0;
        let mut ranges = Vec::with_capacity(definitions.len());
        for (_, entry) in definitions {
            let range = match entry {
                DefinitionEntry::One(_) => None,
                DefinitionEntry::Sequence(entry) => Some(self.sequence_range(entry, &mut elements)),
            };
            ranges.push(range);
        }
        ranges
    }

    /// The numbers of one; none after a mistake.
    fn sequence_range(&mut self, entry: &SequenceEntry, elements: &mut u32) -> Numbered {
        let none = Numbered { index: String::new(), last: 0 };
        let Some((index, ends)) = self.parsed(&entry.range, parse_range) else { return none };
        let span = Span { start: 0, end: entry.range.text.len() };
        let range = self.resolved(&entry.range, None, Stage::Constants, |resolver| resolver.range(&ends, span));
        let Some((first, last)) = range.map(|range| (*range.start(), *range.end())) else { return none };
        if first != 1 || last < 1 {
            let message = format!("a sequence from {first} to {last}");
            let help = "its first element has the number 1: `first` gives it";
            self.findings.mistake(MistakeCode::NumberRange, entry.range.place, message, help);
            return none;
        }
        let room = DEEPEST / 2 - *elements;
        if last > i64::from(room) {
            let message = format!("a sequence of {last} elements");
            let help = format!("{room} more are possible: each is a chain of all before it");
            self.findings.mistake(MistakeCode::NumberRange, entry.range.place, message, help);
            return none;
        }
        *elements += last as u32;
        Numbered { index, last: last as u32 }
    }

    /// Sequences that need one another, element by element, in the file's order.
    pub(super) fn sequences(
        &mut self,
        members: &[usize],
        definitions: &[(Name, DefinitionEntry)],
        (ranges, trees): (&[Option<Numbered>], &[Vec<Option<Ast>>]),
    ) {
        for &member in members {
            self.definitions[member] = Some(Value::Array(Vec::new()));
        }
        let ranges: Vec<&Numbered> = members.iter().filter_map(|&member| ranges[member].as_ref()).collect();
        let last = ranges.iter().map(|range| range.last).max().unwrap_or(0);
        for number in 1..=last {
            for (&member, range) in members.iter().zip(&ranges).filter(|(_, range)| number <= range.last) {
                let Some(formula) = self.element(&definitions[member], range, number, &trees[member]) else {
                    members.iter().for_each(|&member| self.definitions[member] = None);
                    return;
                };
                let name = format!("{}[{number}]", definitions[member].0.text);
                let formula = self.defined(name, formula);
                if let Some(Some(Value::Array(list))) = self.definitions.get_mut(member) {
                    list.push(formula);
                }
            }
        }
        if last == 0 {
            members.iter().for_each(|&member| self.definitions[member] = None);
        }
    }

    /// One element: of those given first, or by its formula.
    fn element(
        &mut self,
        (name, entry): &(Name, DefinitionEntry),
        range: &Numbered,
        number: u32,
        trees: &[Option<Ast>],
    ) -> Option<Formula> {
        let DefinitionEntry::Sequence(entry) = entry else { return None };
        let formula = match entry.first.get(number as usize - 1) {
            Some(Scalar::Number(value, _)) => Some(Formula::Constant(*value)),
            Some(Scalar::Expression(written)) => self.scalar(written, None),
            None => {
                let tree = trees.last()?.as_ref()?;
                self.index = Some((range.index.clone(), f64::from(number)));
                let formula = self.resolved(&entry.value, None, Stage::All, |resolver| resolver.scalar(tree));
                self.index = None;
                formula
            }
        }?;
        self.cells_filled(&formula, None, &format!("definition `{}`", name.text)).then_some(formula)
    }
}
