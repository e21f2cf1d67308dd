//! The value of a formula where it has one without any variable, or at the starting point.

use std::cell::RefCell;
use std::collections::HashMap;

use super::formula::{End, Members};
use super::{Cells, Column, Dimension, Formula, Problem};
use crate::expression::ast::Collection;
use crate::expression::graph::{Graph, NodeId};
use crate::expression::operators::{Binary, Fold};
use crate::sections::{self, Given};

/// The item whose own names hold.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
#[allow(missing_docs)]
pub enum Item {
    None,
    Section(u32),
    Rib(u32),
}

impl Item {
    /// Number `index` of a collection.
    pub fn of(collection: Collection, index: u32) -> Item {
        match collection {
            Collection::Sections => Item::Section(index),
            Collection::Ribs => Item::Rib(index),
        }
    }
}

/// Evaluates without a model: constants only, or with the variables at a point.
pub struct Evaluation<'a> {
    /// The problem.
    pub problem: &'a Problem,
    /// Values of the variables; without them, what depends on a variable has no value.
    pub x: Option<&'a [f64]>,
    /// The members of the row's group.
    pub group: Option<&'a [u32]>,
    /// Definitions and links evaluated so far: they may share one another many times over.
    known: RefCell<HashMap<Named, Option<f64>>>,
}

/// A formula with a name of its own.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Named {
    Definition(u32),
    /// A linked dimension, by section and formula.
    Link(u32, u32),
}

impl<'a> Evaluation<'a> {
    /// Values of what depends on no variable.
    pub fn constants(problem: &'a Problem) -> Self {
        Evaluation { problem, x: None, group: None, known: RefCell::default() }
    }

    /// Values of what depends on no variable, in a row of this group.
    pub fn of_group(problem: &'a Problem, group: Option<&'a [u32]>) -> Self {
        Evaluation { group, ..Evaluation::constants(problem) }
    }

    /// Values at the starting point.
    pub fn at_start(problem: &'a Problem) -> Self {
        Evaluation::at(problem, &problem.variables.start)
    }

    /// Values at a point.
    pub fn at(problem: &'a Problem, x: &'a [f64]) -> Self {
        Evaluation { problem, x: Some(x), group: None, known: RefCell::default() }
    }

    /// The value; `None` where it depends on a variable, on a volume or on an empty cell.
    pub fn value(&self, formula: &Formula, item: Item) -> Option<f64> {
        match formula {
            Formula::Constant(value) => Some(*value),
            Formula::Variable(j) => self.variable(*j),
            Formula::Definition(d) => self.definition(*d),
            Formula::SectionProperty(s, property) => self.property(*s, &property.0),
            Formula::RibVolume(_) | Formula::Volume(_) | Formula::OwnVolume => None,
            Formula::OwnProperty(property) => match item {
                Item::Section(s) => self.property(s, &property.0),
                _ => None,
            },
            Formula::EndProperty(end, property) => self.property(self.end(*end, item)?, &property.0),
            Formula::OwnLength => match item {
                Item::Rib(r) => self.problem.ribs.length.get(r as usize).copied(),
                _ => None,
            },
            Formula::OwnData(column) => match item {
                Item::Section(s) => number(self.problem.sections.data.get(*column as usize)?, s),
                Item::Rib(r) => number(self.problem.ribs.data.get(*column as usize)?, r),
                Item::None => None,
            },
            Formula::EndData(end, column) => number(self.problem.sections.data.get(*column as usize)?, self.end(*end, item)?),
            Formula::Profile(profile, at) => {
                let (s, profile) = (self.value(at, item)?, self.problem.profiles.get(*profile as usize)?);
                profile.weights(s)?.into_iter().map(|(j, weight)| Some(weight * self.variable(j)?)).sum()
            }
            Formula::Unary(op, operand) => Some(op.evaluate(self.value(operand, item)?)),
            Formula::Binary(op, left, right) => Some(op.evaluate(self.value(left, item)?, self.value(right, item)?)),
            Formula::Fold(fold, list) => join(*fold, list.iter().map(|part| self.value(part, item))),
            Formula::Over { fold, collection, members, body } => self.over(*fold, *collection, members, body),
        }
    }

    fn over(&self, fold: Fold, collection: Collection, members: &Members, body: &Formula) -> Option<f64> {
        let value = |index: u32| self.value(body, Item::of(collection, index));
        match members {
            Members::All => join(fold, (0..self.problem.count(collection)).map(value)),
            Members::Listed(list) => join(fold, list.iter().map(|&index| value(index))),
            Members::Group(thinned) => {
                let chosen = |index: &&u32| thinned.as_ref().is_none_or(|list| list.binary_search(index).is_ok());
                join(fold, self.group?.iter().filter(chosen).map(|&index| value(index)))
            }
        }
    }

    fn variable(&self, j: u32) -> Option<f64> {
        self.x?.get(j as usize).copied()
    }

    fn definition(&self, d: u32) -> Option<f64> {
        // Constant definitions were folded where they are used.
        if self.x.is_some() {
            self.named(Named::Definition(d), &self.problem.definitions.get(d as usize)?.1, Item::None)
        } else {
            None
        }
    }

    fn named(&self, name: Named, formula: &Formula, item: Item) -> Option<f64> {
        if let Some(known) = self.known.borrow().get(&name) {
            return *known;
        }
        let value = self.value(formula, item);
        self.known.borrow_mut().insert(name, value);
        value
    }

    fn end(&self, end: End, item: Item) -> Option<u32> {
        let Item::Rib(r) = item else { return None };
        let ends = if end == End::From { &self.problem.ribs.from } else { &self.problem.ribs.to };
        ends.get(r as usize).copied()
    }

    /// A dimension or property of section `s`.
    pub fn property(&self, s: u32, name: &str) -> Option<f64> {
        let form_number = *self.problem.sections.form.get(s as usize)?;
        if let Some(dimension) = self.problem.given_dimension(s, name) {
            return self.dimension(s, dimension);
        }
        let (form, dimensions) = (sections::form(form_number), self.problem.dimensions(s as usize));
        let values: Option<Vec<f64>> = dimensions.iter().map(|&dimension| self.dimension(s, dimension)).collect();
        let (mut graph, values) = (Graph::new(), values?);
        let nodes: Vec<NodeId> = values.into_iter().map(|value| graph.constant(value)).collect();
        let given = Given { form, dimensions: &nodes, outline: self.problem.outline(s) };
        let node = sections::kind_of(form_number).property(&mut graph, &given, name)?;
        graph.as_constant(node)
    }

    /// A given dimension of section `s`.
    pub fn dimension(&self, s: u32, dimension: Dimension) -> Option<f64> {
        match dimension {
            Dimension::Constant(value) => Some(value),
            Dimension::Variable(j) => self.variable(j),
            // Constant links were folded where they are declared.
            Dimension::Formula(_) if self.x.is_none() => None,
            Dimension::Formula(f) => {
                self.named(Named::Link(s, f), self.problem.dimension_formulas.get(f as usize)?, Item::Section(s))
            }
        }
    }
}

/// The values joined; `None` as soon as one is missing, or where there is none to take the smallest of.
fn join(fold: Fold, mut values: impl Iterator<Item = Option<f64>>) -> Option<f64> {
    let op = match fold {
        Fold::Sum => return values.try_fold(0.0, |sum, value| Some(sum + value?)),
        Fold::Min => Binary::Min,
        Fold::Max => Binary::Max,
    };
    let first = values.next()??;
    values.try_fold(first, |best, value| Some(op.evaluate(best, value?)))
}

/// The number in a cell; `None` where it is empty or text.
pub fn number(column: &Column, row: u32) -> Option<f64> {
    match &column.cells {
        Cells::Numbers(numbers) => numbers.get(row as usize).copied().filter(|value| !value.is_nan()),
        Cells::Labels { .. } => None,
    }
}
