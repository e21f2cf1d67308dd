//! An item's names: its data, its sections, its dimensions and properties.

use super::super::member::Framework;
use super::Item;
use super::{Context, Lowering, OwnNumber, law_of};
use crate::expression::graph::NodeId;
use crate::problem::formula::{End, Formula, Total};
use crate::problem::{Dimension, Problem, Property};
use crate::structure::Tapered;
use std::rc::Rc;
use std::sync::Arc;

impl<'a> Lowering<'a> {
    /// The data slot of a number of the item.
    pub fn own_number(&mut self, item: Item, which: OwnNumber) -> NodeId {
        let key = (item, which);
        if let Some(&node) = self.own_numbers.get(&key) {
            return node;
        }
        let node = self.number(key.1.of(self.problem, item));
        self.own_numbers.insert(key, node);
        node
    }

    /// The slots of the rib that is the item as a member of the structure.
    pub fn own_member(&mut self, rib: u32, set: u32) {
        if let Some(framework) = Framework::of(self.problem)
            && let Some(member) = framework.structure.member(rib)
        {
            self.member(framework, member, set);
        }
    }

    /// The slots of what moves the ends of the rib's piece in a mode.
    pub fn own_piece(&mut self, rib: u32, piece: u32) {
        if let Some(framework) = Framework::of(self.problem)
            && let Some(member) = framework.structure.member(rib)
        {
            framework.modal(member, piece).into_iter().for_each(|input| _ = self.variable(input));
        }
    }

    /// The dimensions of a section at the end of a member: those of the item where it is the item's.
    pub(super) fn item_section(&mut self, section: u32) -> Rc<[NodeId]> {
        match self.own_sections.get(&section) {
            Some(nodes) => Rc::clone(nodes),
            None => self.named_section(section),
        }
    }

    /// Gives out the slots of a section of the item, before anything else is lowered.
    pub fn own_section(&mut self, section: u32) -> Rc<[NodeId]> {
        if let Some(nodes) = self.own_sections.get(&section) {
            return Rc::clone(nodes);
        }
        let dimensions = self.problem.dimensions(section as usize);
        let nodes: Rc<[NodeId]> = dimensions
            .iter()
            .map(|&dimension| match dimension {
                Dimension::Constant(value) => self.number(value),
                other => self.dimension(section, other),
            })
            .collect();
        self.own_sections.insert(section, Rc::clone(&nodes));
        nodes
    }

    pub(super) fn named_section(&mut self, section: u32) -> Rc<[NodeId]> {
        if let Some(nodes) = self.sections.get(&section) {
            return Rc::clone(nodes);
        }
        let dimensions = self.problem.dimensions(section as usize);
        let nodes: Rc<[NodeId]> = dimensions.iter().map(|&dimension| self.dimension(section, dimension)).collect();
        self.sections.insert(section, Rc::clone(&nodes));
        nodes
    }

    pub(super) fn dimension(&mut self, section: u32, dimension: Dimension) -> NodeId {
        match dimension {
            Dimension::Constant(value) => self.graph.constant(value),
            Dimension::Variable(variable) => self.variable(variable),
            Dimension::Formula(formula) => self.link(section, formula),
        }
    }

    /// Names that speak of the item.
    pub(super) fn own(&mut self, formula: &Formula, context: Context) -> NodeId {
        let problem = self.problem;
        match (formula, context.item) {
            (Formula::OwnProperty(property), Item::Section(section)) => self.own_property(section, property),
            (Formula::OwnData(column), item) => self.own_number(item, OwnNumber::Data(*column)),
            (Formula::AtProperty(x, Property(name)), Item::Rib(rib)) => {
                let sections = [End::From, End::To].map(|end| end_section(problem, rib, end));
                let [start, end] = sections.map(|section| self.own_section(section));
                let form = crate::sections::form(problem.sections.form[sections[0] as usize]);
                let tapered = Tapered { form, outline: problem.outline(sections[0]), start: &start, end: &end };
                tapered.property(&mut self.graph, *x, name)
            }
            (Formula::OwnMaterial(name), item) => self.own_number(item, OwnNumber::Material(Arc::clone(name))),
            (Formula::OwnLength, Item::Rib(rib)) => self.rib_length(rib, true),
            (Formula::OwnLength, item) => self.own_number(item, OwnNumber::Length),
            (Formula::EndData(end, column), item) => self.own_number(item, OwnNumber::EndData(*end, *column)),
            (Formula::OwnVolume, Item::Rib(rib)) => self.own_volume(rib, law_of(problem, rib, Total::Own)),
            (Formula::EndProperty(end, property), Item::Rib(rib)) => {
                let section = end_section(problem, rib, *end);
                let dimensions = self.own_section(section);
                self.property(section, &dimensions, property)
            }
            // The reader resolves own names only inside their scope; anything else has no value.
            _ => self.graph.constant(f64::NAN),
        }
    }

    /// A property of the item's section; a given dimension alone where the others are not known yet, for they may be linked to it.
    pub(super) fn own_property(&mut self, section: u32, property: &Property) -> NodeId {
        let known = self.own_sections.contains_key(&section);
        match self.problem.given_dimension(section, &property.0) {
            Some(dimension) if !known => self.dimension(section, dimension),
            _ => {
                let dimensions = self.own_section(section);
                self.property(section, &dimensions, property)
            }
        }
    }
}

/// The section at one end of a rib.
pub(in super::super) fn end_section(problem: &Problem, rib: u32, end: End) -> u32 {
    match end {
        End::From => problem.ribs.from[rib as usize],
        End::To => problem.ribs.to[rib as usize],
    }
}
