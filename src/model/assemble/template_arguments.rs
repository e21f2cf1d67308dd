//! What one item brings to a template: its variables and numbers, and the shape that decides whose template it may use.

use super::expression_graph::{Item, OwnNumber, cell, end_section};
use super::member::Framework;
use super::template_key::TemplateKey;
use crate::problem::formula::{End, Formula};
use crate::problem::{Dimension, Problem};

/// One item's variables and numbers by slot, and the shape that decides whether two items may share a template.
#[derive(Debug, Default)]
pub(super) struct TemplateArguments {
    pub variables: Vec<u32>,
    pub numbers: Vec<f64>,
    pub shape: Vec<u32>,
    /// Data that computed dimensions have taken: section and column.
    taken: Vec<(u32, u32)>,
}

/// In a shape: a number, and a computed dimension.
const NUMBER: u32 = u32::MAX;
const COMPUTED: u32 = u32::MAX - 1;

impl TemplateArguments {
    /// Reads an item; false where it cannot share a template.
    pub fn read(&mut self, plan: &TemplateKey, problem: &Problem, item: Item) -> bool {
        self.variables.clear();
        self.numbers.clear();
        self.shape.clear();
        self.taken.clear();
        if !plan.shareable || item == Item::None {
            return false;
        }
        if let Item::Rib(rib) = item {
            if problem.structure.as_deref().is_some_and(|structure| structure.moves(rib)) {
                return false;
            }
            let (from, to) = (end_section(problem, rib, End::From), end_section(problem, rib, End::To));
            self.shape.extend([problem.ribs.law[rib as usize] as u32, u32::from(from == to)]);
        }
        if !plan.sections(problem, item).into_iter().flatten().all(|section| self.section(problem, section)) {
            return false;
        }
        for number in &plan.numbers {
            if !self.is_taken(item, number) {
                self.numbers.push(number.of(problem, item));
            }
        }
        if !self.member(plan, problem, item) {
            return false;
        }
        for &variable in &plan.globals {
            self.variable(variable);
        }
        true
    }

    /// The rib as a member of the structure.
    fn member(&mut self, plan: &TemplateKey, problem: &Problem, item: Item) -> bool {
        if plan.sets.is_empty() {
            return true;
        }
        let Some(framework) = Framework::of(problem) else { return false };
        let Item::Rib(rib) = item else { return false };
        let Some(member) = framework.structure.member(rib).filter(|&member| framework.is_plain(member)) else { return false };
        for &set in &plan.sets {
            let (numbers, loads) = framework.numbers(member, set);
            self.numbers.extend(numbers);
            framework.shape(member, &loads, &mut self.shape);
            framework.inputs(member, set).into_iter().flatten().for_each(|input| self.variable(input));
        }
        for &piece in &plan.pieces {
            let prepared = framework.member(member).1;
            let carried = prepared.of_piece(piece).iter().fold(0, |bits, &kept| 2 * bits + u32::from(kept));
            self.shape.extend([prepared.pieces, carried]);
            framework.modal(member, piece).into_iter().for_each(|input| self.variable(input));
        }
        true
    }

    fn section(&mut self, problem: &Problem, section: u32) -> bool {
        self.shape.push(problem.sections.form[section as usize].into());
        // Shapes drawn by points are compiled into the template.
        problem.outline(section).is_empty()
            && problem.dimensions(section as usize).iter().all(|&dimension| match dimension {
                Dimension::Constant(value) => {
                    self.numbers.push(value);
                    self.shape.push(NUMBER);
                    true
                }
                other => self.dimension(problem, section, other),
            })
    }

    fn dimension(&mut self, problem: &Problem, section: u32, dimension: Dimension) -> bool {
        match dimension {
            Dimension::Variable(variable) => self.variable(variable),
            Dimension::Formula(formula) => {
                self.shape.extend([COMPUTED, formula]);
                return self.link(problem, section, &problem.dimension_formulas[formula as usize]);
            }
            // A number met inside a formula is a literal there.
            Dimension::Constant(_) => return false,
        }
        true
    }

    /// A computed dimension of what is the section's own, in the order in which it is lowered; anything further is not shared.
    fn link(&mut self, problem: &Problem, section: u32, formula: &Formula) -> bool {
        match formula {
            Formula::Constant(_) => true,
            Formula::Variable(variable) => {
                self.variable(*variable);
                true
            }
            Formula::OwnProperty(property) => {
                problem.given_dimension(section, &property.0).is_some_and(|dimension| self.dimension(problem, section, dimension))
            }
            Formula::OwnData(column) => {
                if !self.taken.contains(&(section, *column)) {
                    self.taken.push((section, *column));
                    self.numbers.push(cell(&problem.sections.data, *column, section));
                }
                true
            }
            Formula::Unary(..) | Formula::Binary(..) | Formula::Fold(..) => {
                formula.children().all(|one| self.link(problem, section, one))
            }
            _ => false,
        }
    }

    /// Whether a number of the item has its slot already.
    fn is_taken(&self, item: Item, number: &OwnNumber) -> bool {
        match (item, number) {
            (Item::Section(section), OwnNumber::Data(column)) => self.taken.contains(&(section, *column)),
            _ => false,
        }
    }

    /// Takes a variable; its slot is part of the shape, so that variables shared between dimensions are seen.
    fn variable(&mut self, variable: u32) {
        let slot = match self.variables.iter().position(|&known| known == variable) {
            Some(slot) => slot,
            None => {
                self.variables.push(variable);
                self.variables.len() - 1
            }
        };
        self.shape.push(slot as u32);
    }
}
