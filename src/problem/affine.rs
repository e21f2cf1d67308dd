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

    /// A dimension or property of section `s`.
    pub fn of_property(problem: &Problem, s: u32, name: &str) -> Option<Affine> {
        Reading::of(problem).property(s, name)
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
struct Reading<'a> {
    problem: &'a Problem,
    definitions: HashMap<u32, Option<Affine>>,
    /// Linked dimensions, by section and formula.
    links: HashMap<(u32, u32), Option<Affine>>,
}

impl<'a> Reading<'a> {
    fn of(problem: &'a Problem) -> Self {
        Reading { problem, definitions: HashMap::new(), links: HashMap::new() }
    }

    fn formula(&mut self, formula: &Formula, item: Item) -> Option<Affine> {
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

    fn property(&mut self, s: u32, name: &str) -> Option<Affine> {
        if let Some(dimension) = self.problem.given_dimension(s, name) {
            return self.dimension(s, dimension);
        }
        let (problem, mut graph) = (self.problem, Graph::new());
        let number = *problem.sections.form.get(s as usize)?;
        let dimensions = problem.dimensions(s as usize);
        let inputs: Vec<NodeId> = (0..dimensions.len() as u32).map(|at| graph.input(at)).collect();
        let given = Given { form: sections::form(number), dimensions: &inputs, outline: &[] };
        let node = sections::kind_of(number).property(&mut graph, &given, name)?;
        let values: Vec<Affine> = dimensions.iter().map(|&dimension| self.dimension(s, dimension)).collect::<Option<_>>()?;
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
