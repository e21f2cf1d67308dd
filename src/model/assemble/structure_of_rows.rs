//! What the structure of a formula proves: its summands, one of each shape, analysed over the hull of all items' ranges.

use std::collections::HashMap;

use super::expression_graph::{Context, Lowering};
use super::walk::{Sink, Summand, Walk, Work};
use crate::expression::display::display;
use crate::expression::graph::{Graph, NodeId};
use crate::expression::structure::{Curvature, Interval, Structure, Wanted, analyse, blame};
use crate::expression::tape::TapeError;
use crate::problem::{Formula, Problem};

/// Summands of one shape, and everything their inputs, data and weights range over.
struct Shape {
    graph: Graph,
    root: NodeId,
    inputs: Vec<Interval>,
    data: Vec<Interval>,
    weight: Interval,
    /// Variables of the first item, for words.
    variables: Vec<u32>,
    numbers: Vec<f64>,
}

/// Collects the shapes of one formula over all items it is repeated for.
pub(super) struct RowStructure<'a> {
    problem: &'a Problem,
    shapes: Vec<Shape>,
    known: HashMap<(Work<'a>, Vec<u32>), usize>,
    /// Summands of the row being collected, and the most of any row.
    summands: usize,
    most_summands: usize,
}

/// The verdict on a sum of summands.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) struct Bend {
    /// Of the sum in the variables.
    pub curvature: Curvature,
    /// Of the sum's logarithm in the logarithms of the variables: monomials are affine.
    pub log_curvature: Curvature,
}

impl<'a> RowStructure<'a> {
    pub fn new(problem: &'a Problem) -> Self {
        RowStructure { problem, shapes: Vec::new(), known: HashMap::new(), summands: 0, most_summands: 0 }
    }

    /// Adds one row's formula.
    pub fn add(&mut self, formula: &'a Formula, walk: &mut Walk<'a>, context: Context) -> Result<(), TapeError> {
        self.summands = 0;
        let done = walk.visit(formula, 1.0, context, self);
        self.most_summands = self.most_summands.max(self.summands);
        done
    }

    /// What holds for every row added.
    pub fn bend(&self) -> Bend {
        let mut bend = Bend { curvature: Curvature::Constant, log_curvature: Curvature::Constant };
        for shape in &self.shapes {
            let structure = shape.structures()[shape.root as usize];
            bend.curvature = bend.curvature.plus(shape.weighted(structure.curvature));
            let log = if shape.weight.lower > 0.0 { structure.log_curvature } else { Curvature::Unknown };
            bend.log_curvature = joined(bend.log_curvature, log);
        }
        // A sum of several monomials is a posynomial.
        if self.most_summands > 1 {
            bend.log_curvature = match bend.log_curvature {
                log if log.is_convex() => Curvature::Convex,
                _ => Curvature::Unknown,
            };
        }
        bend
    }

    /// Whether no term of any row added can be negative, proved over the variables' bounds.
    pub fn is_non_negative(&self) -> bool {
        self.shapes.iter().all(|shape| shape.weight.is_non_negative() && shape.range().is_non_negative())
    }

    /// Whether every term of every row added is positive, proved likewise.
    pub fn is_positive(&self) -> bool {
        self.shapes.iter().all(|shape| shape.weight.lower > 0.0 && shape.range().lower > 0.0)
    }

    /// A variable's name; of an auxiliary what it stands for.
    fn named(&self, variable: u32) -> String {
        let own = self.problem.variables.lower.len() - self.problem.auxiliaries.len();
        let Some(auxiliary) = (variable as usize).checked_sub(own).and_then(|at| self.problem.auxiliaries.get(at)) else {
            return self.problem.variable_name(variable as usize);
        };
        let mut lowering = Lowering::new(self.problem);
        let root = lowering.formula(&auxiliary.formula, Context::GLOBAL);
        let inner = |slot: u32| self.problem.variable_name(lowering.variables[slot as usize] as usize);
        display(&lowering.graph, root, &inner, &|slot| lowering.numbers[slot as usize].to_string())
    }

    /// The term that stands in the way of a property, in words.
    pub fn blame(&self, wanted: Wanted) -> Option<String> {
        self.shapes.iter().find_map(|shape| {
            let structures = shape.structures();
            let node = blame(&shape.graph, &structures, shape.root, wanted)?;
            let variable = |slot: u32| shape.variables.get(slot as usize).map_or("?".into(), |&variable| self.named(variable));
            let number = |slot: u32| shape.numbers.get(slot as usize).map_or("?".into(), |number| number.to_string());
            Some(display(&shape.graph, node, &variable, &number))
        })
    }
}

impl Shape {
    fn range(&self) -> Interval {
        self.structures()[self.root as usize].interval
    }

    fn structures(&self) -> Vec<Structure> {
        analyse(&self.graph, &self.inputs, &self.data)
    }

    fn weighted(&self, curvature: Curvature) -> Curvature {
        match curvature {
            _ if self.weight.is_non_negative() => curvature,
            _ if self.weight.is_non_positive() => curvature.negated(),
            flat if flat.is_affine() => flat,
            _ => Curvature::Unknown,
        }
    }

    fn widen(&mut self, inputs: &[Interval], data: &[f64], weight: f64) {
        self.inputs.iter_mut().zip(inputs).for_each(|(hull, &one)| *hull = hull.union(one));
        self.data.iter_mut().zip(data).for_each(|(hull, &one)| *hull = hull.union(Interval::point(one)));
        self.weight = self.weight.union(Interval::point(weight));
    }
}

/// What holds of either of two: rows of different shape in one constraint.
fn joined(a: Curvature, b: Curvature) -> Curvature {
    match (a, b) {
        (Curvature::Constant, same) | (same, Curvature::Constant) => same,
        (Curvature::Affine, same) | (same, Curvature::Affine) => same,
        (a, b) if a == b => a,
        _ => Curvature::Unknown,
    }
}

impl<'a> Sink<'a> for RowStructure<'a> {
    fn summand(&mut self, summand: &Summand<'a, '_>) -> Result<(), TapeError> {
        self.summands += 1;
        let bounds = &self.problem.variables;
        let range = |&j: &u32| Interval::new(bounds.lower[j as usize], bounds.upper[j as usize]);
        if let Some(work) = summand.work {
            let key = (work, summand.gathered.shape.clone());
            if let Some(&at) = self.known.get(&key) {
                let inputs: Vec<Interval> = summand.gathered.variables.iter().map(range).collect();
                self.shapes[at].widen(&inputs, &summand.gathered.numbers, summand.weight);
                return Ok(());
            }
            self.known.insert(key, self.shapes.len());
        }
        let mut lowering = Lowering::new(self.problem);
        let root = summand.lower(&mut lowering);
        self.shapes.push(Shape {
            inputs: lowering.variables.iter().map(range).collect(),
            data: lowering.numbers.iter().map(|&number| Interval::point(number)).collect(),
            weight: Interval::point(summand.weight),
            graph: lowering.graph,
            root,
            variables: lowering.variables,
            numbers: lowering.numbers,
        });
        Ok(())
    }
}
