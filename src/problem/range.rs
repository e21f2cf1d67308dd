//! The values a formula takes between the variables' bounds, by interval arithmetic.

use std::collections::HashMap;

use super::affine::property_graph;
use super::evaluate::{Evaluation, Item};
use super::formula::{End, Members};
use super::{Dimension, Formula, Problem};
use crate::expression::operators::{Binary, Fold, Unary};
use crate::expression::structure::{Interval, analyse};

/// Ranges of formulas; what definitions and links take is computed once.
#[derive(Debug, Default)]
pub struct Ranges {
    definitions: HashMap<u32, Interval>,
    links: HashMap<(u32, u32), Interval>,
}

impl Ranges {
    /// The range of a formula in the scope of `item`. The range of a minimum, maximum or absolute value is widened towards zero
    /// by half, so that a variable bounded by it never rests on that bound where it takes the value itself.
    pub fn of(&mut self, problem: &Problem, formula: &Formula, item: Item) -> Interval {
        match formula {
            Formula::Constant(value) => Interval::point(*value),
            Formula::Variable(j) => variable(problem, *j),
            Formula::Definition(d) => self.definition(problem, *d),
            Formula::SectionProperty(s, property) => self.property(problem, *s, &property.0),
            Formula::OwnProperty(property) => match item {
                Item::Section(s) => self.property(problem, s, &property.0),
                _ => Interval::WHOLE,
            },
            Formula::EndProperty(end, property) => match end_section(problem, *end, item) {
                Some(section) => self.property(problem, section, &property.0),
                None => Interval::WHOLE,
            },
            Formula::Unary(op, inner) => {
                let range = self.of(problem, inner, item).unary(*op);
                if *op == Unary::Abs { towards_zero(range) } else { range }
            }
            Formula::Binary(op, left, right) => self.binary(problem, *op, (left, right), item),
            Formula::Fold(fold, list) => self.joined(problem, *fold, list.iter().map(|one| (one, item))),
            Formula::Over { fold, collection, members, body } => {
                let list: Vec<Item> = match members {
                    Members::All => (0..problem.count(*collection)).map(|index| Item::of(*collection, index)).collect(),
                    Members::Listed(list) => list.iter().map(|&index| Item::of(*collection, index)).collect(),
                    Members::Group(_) => return Interval::WHOLE,
                };
                self.joined(problem, *fold, list.into_iter().map(|item| (&**body, item)))
            }
            // Eigenvalues are those above zero.
            Formula::Response(response) if response.eigenvalue().is_some() => {
                Interval { lower: f64::MIN_POSITIVE, upper: f64::INFINITY }
            }
            Formula::RibVolume(_) | Formula::Volume(_) | Formula::OwnVolume | Formula::Profile(..) => Interval::WHOLE,
            number => Evaluation::constants(problem).value(number, item).map_or(Interval::WHOLE, Interval::point),
        }
    }

    fn binary(&mut self, problem: &Problem, op: Binary, (left, right): (&Formula, &Formula), item: Item) -> Interval {
        let (l, r) = (self.of(problem, left, item), self.of(problem, right, item));
        match op {
            Binary::Multiply if left == right => l.power(2.0),
            Binary::Min | Binary::Max => towards_zero(l.binary(op, r)),
            _ => l.binary(op, r),
        }
    }

    fn joined<'f>(&mut self, problem: &Problem, fold: Fold, list: impl Iterator<Item = (&'f Formula, Item)>) -> Interval {
        let op = match fold {
            Fold::Sum => Binary::Add,
            Fold::Min => Binary::Min,
            Fold::Max => Binary::Max,
        };
        let joined = list.map(|(one, item)| self.of(problem, one, item)).reduce(|all, one| all.binary(op, one));
        match (fold, joined) {
            (Fold::Sum, None) => Interval::point(0.0),
            (_, None) => Interval::WHOLE,
            (Fold::Sum, Some(sum)) => sum,
            (_, Some(range)) => towards_zero(range),
        }
    }

    fn definition(&mut self, problem: &Problem, d: u32) -> Interval {
        if let Some(&known) = self.definitions.get(&d) {
            return known;
        }
        let Some((_, formula)) = problem.definitions.get(d as usize) else { return Interval::WHOLE };
        let range = self.of(problem, formula, Item::None);
        self.definitions.insert(d, range);
        range
    }

    fn property(&mut self, problem: &Problem, s: u32, name: &str) -> Interval {
        if let Some(dimension) = problem.given_dimension(s, name) {
            return self.dimension(problem, s, dimension);
        }
        let Some(&form) = problem.sections.form.get(s as usize) else { return Interval::WHOLE };
        let Some((graph, node)) = property_graph(form, name).filter(|_| problem.outline(s).is_empty()) else {
            return Interval::WHOLE;
        };
        let dimensions = problem.dimensions(s as usize).to_vec();
        let inputs: Vec<Interval> = dimensions.into_iter().map(|dimension| self.dimension(problem, s, dimension)).collect();
        analyse(&graph, &inputs, &[])[node as usize].interval
    }

    fn dimension(&mut self, problem: &Problem, s: u32, dimension: Dimension) -> Interval {
        let f = match dimension {
            Dimension::Constant(value) => return Interval::point(value),
            Dimension::Variable(j) => return variable(problem, j),
            Dimension::Formula(f) => f,
        };
        if let Some(&known) = self.links.get(&(s, f)) {
            return known;
        }
        let Some(formula) = problem.dimension_formulas.get(f as usize) else { return Interval::WHOLE };
        let range = self.of(problem, formula, Item::Section(s));
        self.links.insert((s, f), range);
        range
    }
}

fn variable(problem: &Problem, j: u32) -> Interval {
    let bounds = &problem.variables;
    match (bounds.lower.get(j as usize), bounds.upper.get(j as usize)) {
        (Some(&lower), Some(&upper)) => Interval::new(lower, upper),
        _ => Interval::WHOLE,
    }
}

/// The section at an end of the item, where the item is a rib.
pub(super) fn end_section(problem: &Problem, end: End, item: Item) -> Option<u32> {
    let Item::Rib(r) = item else { return None };
    let ends = if end == End::From { &problem.ribs.from } else { &problem.ribs.to };
    ends.get(r as usize).copied()
}

/// What is above zero reaches down to half of its least, what is below zero up to half of its greatest value.
fn towards_zero(range: Interval) -> Interval {
    let lower = if range.lower > 0.0 { 0.5 * range.lower } else { range.lower };
    let upper = if range.upper < 0.0 { 0.5 * range.upper } else { range.upper };
    Interval::new(lower, upper)
}
