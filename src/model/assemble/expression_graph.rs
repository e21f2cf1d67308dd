//! From resolved formulas to expression graphs over local slots.

mod names;
mod response;
mod volumes;

use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use super::member::MemberNodes;
use crate::expression::ast::Collection;
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::{Binary, Fold};
use crate::problem::evaluate::Evaluation;
pub(super) use crate::problem::evaluate::Item;
use crate::problem::formula::{End, Formula, Members, Total};
use crate::problem::{Cells, Column, Problem};
use crate::ribs::law::VolumeLaw;
pub(super) use names::end_section;

/// Whose own names a formula speaks of, and which items its group has.
#[derive(Debug, Clone, Copy)]
pub(super) struct Context<'a> {
    pub item: Item,
    /// Members of the row's group, for folds over [`Members::Group`].
    pub group: &'a [u32],
}

impl Context<'_> {
    pub const GLOBAL: Context<'static> = Context { item: Item::None, group: &[] };

    pub fn of(self, item: Item) -> Self {
        Context { item, ..self }
    }
}

/// The number in a data column; NaN where there is none (the reader refuses to use such a cell).
pub(super) fn cell(columns: &[Column], column: u32, row: u32) -> f64 {
    match columns.get(column as usize).map(|column| &column.cells) {
        Some(Cells::Numbers(numbers)) => numbers[row as usize],
        _ => f64::NAN,
    }
}

/// The items a fold runs over.
pub(super) fn members<'a>(problem: &Problem, collection: Collection, members: &'a Members, context: Context<'a>) -> Vec<u32> {
    match members {
        Members::Listed(list) => list.to_vec(),
        Members::All => (0..problem.count(collection)).collect(),
        Members::Group(None) => context.group.to_vec(),
        Members::Group(Some(list)) => context.group.iter().copied().filter(|item| list.binary_search(item).is_ok()).collect(),
    }
}

/// The law a rib of this declaration follows under a total.
pub(super) fn law_of(problem: &Problem, rib: u32, total: Total) -> VolumeLaw {
    match (total, problem.ribs.law[rib as usize]) {
        (Total::Frustum, _) | (Total::Own, VolumeLaw::Frustum) => VolumeLaw::Frustum,
        _ => VolumeLaw::Prismatoid,
    }
}

/// Builds graphs whose inputs and data are local slots, so that items of one shape share what is compiled.
pub(super) struct Lowering<'a> {
    pub problem: &'a Problem,
    pub graph: Graph,
    /// Variable of each input slot.
    pub variables: Vec<u32>,
    slots: HashMap<u32, u32>,
    /// Number of each data slot.
    pub numbers: Vec<f64>,
    /// Dimension nodes of sections named in the item's scope (own, from, to): their numbers are data.
    own_sections: HashMap<u32, Rc<[NodeId]>>,
    /// Dimension nodes of sections named globally: their numbers are literals.
    sections: HashMap<u32, Rc<[NodeId]>>,
    own_numbers: HashMap<(Item, OwnNumber), NodeId>,
    definitions: HashMap<u32, NodeId>,
    /// Linked dimensions, by section and formula.
    links: HashMap<(u32, u32), NodeId>,
    /// Members of the structure, by number and case or combination.
    members: HashMap<(u32, u32), MemberNodes>,
    /// Slots for numbers are given out: further numbers belong to other items and are literals.
    closed: bool,
}

/// A number of the item itself.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum OwnNumber {
    Length,
    Data(u32),
    EndData(End, u32),
    Material(Arc<str>),
}

impl OwnNumber {
    /// Its value for an item.
    pub fn of(&self, problem: &Problem, item: Item) -> f64 {
        match (self.clone(), item) {
            (OwnNumber::Length, Item::Rib(rib)) => problem.ribs.length[rib as usize],
            (OwnNumber::Data(column), Item::Rib(rib)) => cell(&problem.ribs.data, column, rib),
            (OwnNumber::Data(column), Item::Section(section)) => cell(&problem.sections.data, column, section),
            (OwnNumber::Data(column), Item::Node(node)) => cell(problem.columns(Collection::Nodes), column, node),
            (OwnNumber::EndData(end, column), Item::Rib(rib)) => {
                cell(&problem.sections.data, column, end_section(problem, rib, end))
            }
            (OwnNumber::Material(name), Item::Rib(_)) => {
                Evaluation::constants(problem).value(&Formula::OwnMaterial(name), item).unwrap_or(f64::NAN)
            }
            // The reader resolves own names only inside their scope.
            _ => f64::NAN,
        }
    }
}

impl<'a> Lowering<'a> {
    pub fn new(problem: &'a Problem) -> Self {
        Lowering {
            problem,
            graph: Graph::new(),
            variables: Vec::new(),
            slots: HashMap::new(),
            numbers: Vec::new(),
            own_sections: HashMap::new(),
            sections: HashMap::new(),
            own_numbers: HashMap::new(),
            definitions: HashMap::new(),
            links: HashMap::new(),
            members: HashMap::new(),
            closed: false,
        }
    }

    /// The input slot of a variable, given out in order of first use.
    pub fn variable(&mut self, variable: u32) -> NodeId {
        let variables = &mut self.variables;
        let slot = *self.slots.entry(variable).or_insert_with(|| {
            variables.push(variable);
            variables.len() as u32 - 1
        });
        self.graph.input(slot)
    }

    /// Ends the giving out of slots for numbers.
    pub fn close(&mut self) {
        self.closed = true;
    }

    fn number(&mut self, number: f64) -> NodeId {
        if self.closed {
            return self.graph.constant(number);
        }
        self.numbers.push(number);
        self.graph.data(self.numbers.len() as u32 - 1)
    }

    fn link(&mut self, section: u32, formula: u32) -> NodeId {
        if let Some(&node) = self.links.get(&(section, formula)) {
            return node;
        }
        let (problem, context) = (self.problem, Context::GLOBAL.of(Item::Section(section)));
        let node = self.formula(&problem.dimension_formulas[formula as usize], context);
        self.links.insert((section, formula), node);
        node
    }

    /// The graph of a formula.
    pub fn formula(&mut self, formula: &Formula, context: Context) -> NodeId {
        match formula {
            Formula::Constant(value) => self.graph.constant(*value),
            Formula::Variable(variable) => self.variable(*variable),
            Formula::Definition(definition) => self.definition(*definition),
            Formula::Unary(op, inner) => {
                let inner = self.formula(inner, context);
                self.graph.unary(*op, inner)
            }
            Formula::Binary(op, left, right) => {
                let (left, right) = (self.formula(left, context), self.formula(right, context));
                self.graph.binary(*op, left, right)
            }
            Formula::Fold(fold, list) => {
                let nodes: Vec<NodeId> = list.iter().map(|one| self.formula(one, context)).collect();
                self.fold(*fold, &nodes)
            }
            Formula::Over { fold, collection, members: which, body } => {
                let nodes: Vec<NodeId> = members(self.problem, *collection, which, context)
                    .into_iter()
                    .map(|index| self.formula(body, context.of(Item::of(*collection, index))))
                    .collect();
                self.fold(*fold, &nodes)
            }
            Formula::SectionProperty(section, property) => match self.problem.given_dimension(*section, &property.0) {
                // Alone: another dimension of the section may be linked to this one.
                Some(dimension) => self.dimension(*section, dimension),
                None => {
                    let dimensions = self.named_section(*section);
                    self.property(*section, &dimensions, property)
                }
            },
            Formula::Response(response) => self.response(response, context),
            Formula::Profile(profile, at) => self.profile(*profile, at, context),
            Formula::RibVolume(rib) => self.rib_volume(*rib, law_of(self.problem, *rib, Total::Own)),
            Formula::Volume(total) => self.volume(*total),
            own => self.own(own, context),
        }
    }

    fn definition(&mut self, definition: u32) -> NodeId {
        if let Some(&node) = self.definitions.get(&definition) {
            return node;
        }
        let problem = self.problem;
        let node = self.formula(&problem.definitions[definition as usize].1, Context::GLOBAL);
        self.definitions.insert(definition, node);
        node
    }

    fn volume(&mut self, total: Total) -> NodeId {
        let nodes: Vec<NodeId> =
            (0..self.problem.count(Collection::Ribs)).map(|rib| self.rib_volume(rib, law_of(self.problem, rib, total))).collect();
        self.graph.sum(&nodes)
    }

    fn fold(&mut self, fold: Fold, nodes: &[NodeId]) -> NodeId {
        let op = match fold {
            Fold::Sum => return self.graph.sum(nodes),
            Fold::Min => Binary::Min,
            Fold::Max => Binary::Max,
        };
        let first = nodes.first().copied().unwrap_or_else(|| self.graph.constant(f64::NAN));
        nodes.iter().skip(1).fold(first, |folded, &node| self.graph.binary(op, folded, node))
    }
}
