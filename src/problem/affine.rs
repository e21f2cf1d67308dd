//! Formulas that are affine in the variables: constant + Σ coefficient·x_j.

use std::collections::HashMap;

use super::evaluate::{Evaluation, Item};
use super::formula::End;
use super::{Dimension, Formula, Problem, Variables};
use crate::expression::graph::{Graph, Node, NodeId};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::sections::{self, Given};

/// constant + Σ coefficient·x_j, terms by ascending j, none twice.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Affine {
    /// The value at x = 0.
    pub constant: f64,
    /// Variables and coefficients.
    pub terms: Vec<(u32, f64)>,
}

impl Affine {
    fn constant(constant: f64) -> Affine {
        Affine { constant, terms: Vec::new() }
    }

    /// The formula in the scope of `item`, if it is written affinely (no cancelling of curved terms is looked for).
    pub fn of(problem: &Problem, formula: &Formula, item: Item) -> Option<Affine> {
        Reading::of(problem).formula(formula, item)
    }

    /// `self + factor·other`
    pub fn plus(mut self, other: &Affine, factor: f64) -> Affine {
        self.constant += factor * other.constant;
        for &(j, coefficient) in &other.terms {
            match self.terms.binary_search_by_key(&j, |term| term.0) {
                Ok(at) => self.terms[at].1 += factor * coefficient,
                Err(at) => self.terms.insert(at, (j, factor * coefficient)),
            }
        }
        self
    }

    fn scaled(mut self, factor: f64) -> Affine {
        self.constant *= factor;
        self.terms.iter_mut().for_each(|term| term.1 *= factor);
        self
    }

    /// The smallest and largest value inside the variables' bounds.
    pub fn range(&self, variables: &Variables) -> (f64, f64) {
        let mut range = (self.constant, self.constant);
        for &(j, coefficient) in self.terms.iter().filter(|term| term.1 != 0.0) {
            let (lower, upper) = (coefficient * variables.lower[j as usize], coefficient * variables.upper[j as usize]);
            range = (range.0 + lower.min(upper), range.1 + lower.max(upper));
        }
        range
    }

    /// The coefficient of x_j.
    pub fn coefficient(&self, j: u32) -> f64 {
        self.terms.iter().find(|term| term.0 == j).map_or(0.0, |term| term.1)
    }
}

/// What was read so far: definitions and links may share one another many times over.
pub(super) struct Reading<'a> {
    problem: &'a Problem,
    definitions: HashMap<u32, Option<Affine>>,
    /// Linked dimensions, by section and formula.
    links: HashMap<(u32, u32), Option<Affine>>,
    /// Derived dimensions and properties by form and name, their terms counting the given dimensions. There are few.
    properties: Vec<(u16, Box<str>, Option<Affine>)>,
}

impl<'a> Reading<'a> {
    pub fn of(problem: &'a Problem) -> Self {
        Reading { problem, definitions: HashMap::new(), links: HashMap::new(), properties: Vec::new() }
    }

    /// The formula in the scope of `item`; see [`Affine::of`].
    pub fn formula(&mut self, formula: &Formula, item: Item) -> Option<Affine> {
        match formula {
            Formula::Variable(j) => Some(Affine { constant: 0.0, terms: vec![(*j, 1.0)] }),
            Formula::Definition(d) => self.definition(*d),
            Formula::SectionProperty(s, property) => self.property(*s, &property.0),
            Formula::OwnProperty(property) => match item {
                Item::Section(s) => self.property(s, &property.0),
                _ => None,
            },
            Formula::EndProperty(end, property) => {
                let Item::Rib(r) = item else { return None };
                let ends = if *end == End::From { &self.problem.ribs.from } else { &self.problem.ribs.to };
                self.property(*ends.get(r as usize)?, &property.0)
            }
            Formula::Profile(profile, at) => {
                let s = Evaluation::constants(self.problem).value(at, item)?;
                let terms = self.problem.profiles.get(*profile as usize)?.weights(s)?;
                Some(Affine { constant: 0.0, terms })
            }
            Formula::Unary(Unary::Negate, operand) => Some(self.formula(operand, item)?.scaled(-1.0)),
            Formula::Binary(op, left, right) => join(*op, self.formula(left, item)?, self.formula(right, item)?),
            Formula::Fold(Fold::Sum, list) => {
                list.iter().try_fold(Affine::default(), |sum, formula| Some(sum.plus(&self.formula(formula, item)?, 1.0)))
            }
            other => Evaluation::constants(self.problem).value(other, item).map(Affine::constant),
        }
    }

    fn definition(&mut self, d: u32) -> Option<Affine> {
        if let Some(known) = self.definitions.get(&d) {
            return known.clone();
        }
        let found = self.formula(&self.problem.definitions.get(d as usize)?.1, Item::None);
        self.definitions.insert(d, found.clone());
        found
    }

    /// A dimension or property of section `s`.
    pub fn property(&mut self, s: u32, name: &str) -> Option<Affine> {
        if let Some(dimension) = self.problem.given_dimension(s, name) {
            return self.dimension(s, dimension);
        }
        let number = *self.problem.sections.form.get(s as usize)?;
        let known = self.properties.iter().position(|(form, known, _)| *form == number && **known == *name);
        let at = known.unwrap_or_else(|| {
            self.properties.push((number, name.into(), of_form(number, name)));
            self.properties.len() - 1
        });
        let Some(shape) = self.properties[at].2.clone() else { return self.with_numbers(s, number, name) };
        let mut sum = Affine::constant(shape.constant);
        for (slot, coefficient) in shape.terms {
            let dimension = *self.problem.dimensions(s as usize).get(slot as usize)?;
            sum = sum.plus(&self.dimension(s, dimension)?, coefficient);
        }
        Some(sum)
    }

    /// A property that is affine only because some dimensions are numbers.
    fn with_numbers(&mut self, s: u32, number: u16, name: &str) -> Option<Affine> {
        let dimensions = self.problem.dimensions(s as usize);
        if dimensions.iter().all(|dimension| matches!(dimension, Dimension::Variable(_))) {
            return None;
        }
        let values: Vec<Affine> = dimensions.iter().map(|&dimension| self.dimension(s, dimension)).collect::<Option<_>>()?;
        let (graph, node) = property_graph(number, name)?;
        of_node(&graph, node, &values)
    }

    fn dimension(&mut self, s: u32, dimension: Dimension) -> Option<Affine> {
        let formula = match dimension {
            Dimension::Constant(value) => return Some(Affine::constant(value)),
            Dimension::Variable(j) => return Some(Affine { constant: 0.0, terms: vec![(j, 1.0)] }),
            Dimension::Formula(formula) => formula,
        };
        if let Some(known) = self.links.get(&(s, formula)) {
            return known.clone();
        }
        let found = self.formula(self.problem.dimension_formulas.get(formula as usize)?, Item::Section(s));
        self.links.insert((s, formula), found.clone());
        found
    }
}

fn join(op: Binary, left: Affine, right: Affine) -> Option<Affine> {
    match op {
        Binary::Add => Some(left.plus(&right, 1.0)),
        Binary::Subtract => Some(left.plus(&right, -1.0)),
        Binary::Multiply if right.terms.is_empty() => Some(left.scaled(right.constant)),
        Binary::Multiply if left.terms.is_empty() => Some(right.scaled(left.constant)),
        Binary::Divide if right.terms.is_empty() => Some(left.scaled(1.0 / right.constant)),
        op if left.terms.is_empty() && right.terms.is_empty() => {
            Some(Affine::constant(op.evaluate(left.constant, right.constant)))
        }
        _ => None,
    }
}

/// A property of a form, where it is affine in the given dimensions.
fn of_form(number: u16, name: &str) -> Option<Affine> {
    let (graph, node) = property_graph(number, name)?;
    let count = sections::form(number).dimensions.len() as u32;
    let slots: Vec<Affine> = (0..count).map(|slot| Affine { constant: 0.0, terms: vec![(slot, 1.0)] }).collect();
    of_node(&graph, node, &slots)
}

/// A property as a graph of its form's dimensions.
pub(super) fn property_graph(number: u16, name: &str) -> Option<(Graph, NodeId)> {
    let (form, mut graph) = (sections::form(number), Graph::new());
    let inputs: Vec<NodeId> = (0..form.dimensions.len() as u32).map(|at| graph.input(at)).collect();
    let node = sections::kind_of(number).property(&mut graph, &Given { form, dimensions: &inputs, outline: &[] }, name)?;
    Some((graph, node))
}

/// The few nodes of a property, each affine in the inputs.
fn of_node(graph: &Graph, node: NodeId, inputs: &[Affine]) -> Option<Affine> {
    match graph.node(node) {
        Node::Constant(value) => Some(Affine::constant(value)),
        Node::Input(slot) => inputs.get(slot as usize).cloned(),
        Node::Unary(Unary::Negate, operand) => Some(of_node(graph, operand, inputs)?.scaled(-1.0)),
        Node::Binary(op, left, right) => join(op, of_node(graph, left, inputs)?, of_node(graph, right, inputs)?),
        Node::Data(_) | Node::Unary(..) => None,
    }
}
