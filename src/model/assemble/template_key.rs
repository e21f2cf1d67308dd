//! What a formula takes from its item, so that items of one shape can share one compiled template.

use std::collections::HashSet;
use std::sync::Arc;

use super::expression_graph::{Item, OwnNumber, end_section};
use crate::problem::formula::{End, Energy, Formula, Subject, What};
use crate::problem::{Dimension, Problem};

/// The names a formula uses, in a fixed order.
#[derive(Debug, Default)]
pub(super) struct TemplateKey {
    /// Uses the item's own section (section scope).
    own: bool,
    from: bool,
    to: bool,
    pub(super) numbers: Vec<OwnNumber>,
    /// Cases and combinations in which it asks for what the item does as a member of the structure.
    pub(super) sets: Vec<u32>,
    /// Pieces of the member whose ends' displacements in a mode it asks for.
    pub(super) pieces: Vec<u32>,
    /// Variables it names globally.
    pub(super) globals: Vec<u32>,
    /// False where a name reaches beyond the item: each item is then compiled by itself.
    pub(super) shareable: bool,
    /// Definitions and links already read: they may share one another many times over.
    read: HashSet<Named>,
}

/// A formula with a name of its own.
#[derive(Debug, PartialEq, Eq, Hash)]
enum Named {
    Definition(u32),
    /// A linked dimension, by section and formula.
    Link(u32, u32),
}

/// An item whose formula names more global variables than this is compiled by itself.
const MANY_GLOBALS: usize = 64;

impl TemplateKey {
    /// Reads a formula (seeing through definitions).
    pub fn of(problem: &Problem, formula: &Formula) -> TemplateKey {
        let mut plan = TemplateKey { shareable: true, ..TemplateKey::default() };
        plan.visit(problem, formula);
        plan.shareable &= plan.globals.len() <= MANY_GLOBALS;
        plan
    }

    /// The plan of a rib's volume.
    pub fn volume() -> TemplateKey {
        TemplateKey { from: true, to: true, numbers: vec![OwnNumber::Length], shareable: true, ..TemplateKey::default() }
    }

    fn visit(&mut self, problem: &Problem, formula: &Formula) {
        match formula {
            Formula::Constant(_) => {}
            Formula::Variable(variable) => self.global(*variable),
            Formula::Definition(definition) => {
                if self.read.insert(Named::Definition(*definition)) {
                    self.visit(problem, &problem.definitions[*definition as usize].1);
                }
            }
            Formula::Unary(..) | Formula::Binary(..) | Formula::Fold(..) => {
                formula.children().for_each(|one| self.visit(problem, one));
            }
            Formula::SectionProperty(section, property) => self.named(problem, *section, &property.0),
            Formula::OwnProperty(_) => self.own = true,
            Formula::AtProperty(..) => (self.from, self.to) = (true, true),
            Formula::EndProperty(End::From, _) => self.from = true,
            Formula::EndProperty(End::To, _) => self.to = true,
            Formula::OwnLength => self.number(OwnNumber::Length),
            Formula::OwnData(column) => self.number(OwnNumber::Data(*column)),
            Formula::OwnMaterial(name) => self.number(OwnNumber::Material(Arc::clone(name))),
            Formula::EndData(end, column) => self.number(OwnNumber::EndData(*end, *column)),
            Formula::OwnVolume => {
                (self.from, self.to) = (true, true);
                self.number(OwnNumber::Length);
            }
            Formula::Response(response) => match response.subject {
                Subject::Own if matches!(response.what, What::Mass | What::Length) => {
                    (self.from, self.to) = (true, true);
                    self.number(OwnNumber::Material("density".into()));
                    self.number(OwnNumber::Length);
                }
                Subject::Own if !matches!(response.what, What::Displacement(_) | What::Reaction(_) | What::Sag(..)) => {
                    (self.from, self.to) = (true, true);
                    if let What::Modal(energy, piece) = response.what {
                        self.pieces.push(piece);
                        if energy == Energy::Inertia {
                            self.number(OwnNumber::Material("density".into()));
                        }
                    }
                    if !self.sets.contains(&response.set) {
                        self.sets.push(response.set);
                    }
                }
                _ => self.shareable = false,
            },
            // A profile's weights and even its variables differ from item to item.
            Formula::RibVolume(_) | Formula::Volume(_) | Formula::Over { .. } | Formula::Profile(..) => self.shareable = false,
        }
    }

    /// What a property of a section takes: one dimension where it is one, all of them otherwise.
    fn named(&mut self, problem: &Problem, section: u32, property: &str) {
        match problem.given_dimension(section, property) {
            Some(dimension) => self.dimension(problem, section, dimension),
            None => {
                for &dimension in problem.dimensions(section as usize) {
                    self.dimension(problem, section, dimension);
                }
            }
        }
    }

    fn dimension(&mut self, problem: &Problem, section: u32, dimension: Dimension) {
        match dimension {
            Dimension::Constant(_) => {}
            Dimension::Variable(variable) => self.global(variable),
            Dimension::Formula(formula) => {
                if self.read.insert(Named::Link(section, formula)) {
                    self.link(problem, section, &problem.dimension_formulas[formula as usize]);
                }
            }
        }
    }

    /// A linked dimension: what is its own there belongs to its section, not to the item.
    fn link(&mut self, problem: &Problem, section: u32, formula: &Formula) {
        match formula {
            Formula::OwnProperty(property) => self.named(problem, section, &property.0),
            Formula::OwnData(_) => {}
            Formula::Unary(..) | Formula::Binary(..) | Formula::Fold(..) => {
                formula.children().for_each(|one| self.link(problem, section, one));
            }
            other => self.visit(problem, other),
        }
    }

    fn global(&mut self, variable: u32) {
        self.globals.push(variable);
    }

    fn number(&mut self, number: OwnNumber) {
        if !self.numbers.contains(&number) {
            self.numbers.push(number);
        }
    }

    /// Sections of the item in the order their slots are given out.
    pub(super) fn sections(&self, problem: &Problem, item: Item) -> [Option<u32>; 2] {
        match item {
            Item::Section(section) if self.own => [Some(section), None],
            Item::Rib(rib) => {
                let (from, to) = (end_section(problem, rib, End::From), end_section(problem, rib, End::To));
                let from = self.from.then_some(from);
                [from, (self.to && from != Some(to)).then_some(to)]
            }
            _ => [None, None],
        }
    }

    /// Gives out the slots in the order [`TemplateArguments`](super::template_arguments::TemplateArguments) fills them.
    pub fn reserve(&self, lowering: &mut super::expression_graph::Lowering, item: Item) {
        for section in self.sections(lowering.problem, item).into_iter().flatten() {
            lowering.own_section(section);
        }
        for number in &self.numbers {
            lowering.own_number(item, number.clone());
        }
        if let Item::Rib(rib) = item {
            self.sets.iter().for_each(|&set| lowering.own_member(rib, set));
            self.pieces.iter().for_each(|&piece| lowering.own_piece(rib, piece));
        }
        lowering.close();
        for &variable in &self.globals {
            lowering.variable(variable);
        }
    }
}
