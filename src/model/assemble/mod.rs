//! From a checked problem to a model: every sum falls into small elements, every element shares its kernel with its like.
//!
//! | step | file | what happens |
//! |---|---|---|
//! | 1 | `dependence` | asked once of every definition and section: does it hold variables, does it reach over items? |
//! | 2 | `walk` | a formula is followed to its terms: sums over items fall into summands, each with its weight |
//! | 3 | `template_key` | which variables and numbers of an item a summand needs, and in which slots |
//! | 4 | `template_arguments` | these variables and numbers of one item; items of the same shape share a template |
//! | 5 | `expression_graph`, `profile` | the summand becomes a graph of operations over its slots |
//! | 6 | `template` | the graph compiled: constant, affine terms, terms with a kernel |
//! | 7 | `kernel_groups` | equal kernels once, their elements side by side |
//! | 8 | `accumulate` | the summands added to the objective or to a row |
//! | 9 | `mod` | patterns of all derivatives, and where each element's go in them |
//!
//! A walk hands its summands to a `Sink`, and there are two: `accumulate` adds them up; `structure_of_rows` asks what their shape
//! proves, from which `classify` tells the class of the problem. `volumes` sums the ribs' volumes alone.

mod accumulate;
mod classify;
mod dependence;
mod expression_graph;
mod fixed_terms;
mod kernel_groups;
mod member;
mod profile;
mod structure_of_rows;
mod template;
mod template_arguments;
mod template_key;
mod volumes;
mod walk;

use std::sync::{Arc, OnceLock};

use thiserror::Error;

use super::affine::Affine;
use super::assembled::{ProblemNames, RibModel, RowOrigin};
use super::element_model::ElementModel;
use super::{Meta, Model, NameTable, Pattern};
use crate::expression::tape::TapeError;
use crate::problem::{Formula, Limit, Problem, Scope, Sense};
use accumulate::{Summation, Templates};
pub use classify::{Classification, classify, convex_constraints};
use dependence::Dependence;
use expression_graph::{Context, Item};
use fixed_terms::FixedTerms;
use kernel_groups::{Groups, Kernels};
pub use volumes::volumes;
use walk::Walk;

/// Assembles objective and rows with their derivatives and sparsity patterns.
///
/// ```
/// use ribopt::model::{assemble, Model};
/// use ribopt::problem::Problem;
///
/// let empty = assemble(&Problem::default().into())?;
/// assert_eq!((empty.meta().variables(), empty.meta().rows()), (0, 0));
/// # Ok::<(), ribopt::model::AssemblyError>(())
/// ```
///
/// # Errors
/// Where one term couples so many variables that its second derivatives do not fit.
pub fn assemble(problem: &Arc<Problem>) -> Result<RibModel, AssemblyError> {
    assemble_with(problem, problem.constraints.iter().map(|constraint| (&constraint.left, &constraint.right)))
}

/// The same with the rows restated: one left side and limit per constraint, in order.
fn assemble_rows(problem: &Arc<Problem>, rows: &[(Formula, Limit)]) -> Result<RibModel, AssemblyError> {
    assemble_with(problem, rows.iter().map(|(left, right)| (left, right)))
}

fn assemble_with<'a>(
    problem: &'a Arc<Problem>,
    sides: impl Iterator<Item = (&'a Formula, &'a Limit)>,
) -> Result<RibModel, AssemblyError> {
    let (facts, mut kernels) = (Dependence::of(problem), Kernels::default());
    let (objective, objective_groups) = objective(problem, &facts, &mut kernels)?;
    let rows = Rows::of(problem, sides, &facts, &mut kernels)?;
    let mut model = connect(problem, objective, objective_groups.into_list(), rows);
    let mut start = std::mem::take(&mut model.inner.meta.start);
    model.complete(&mut start);
    model.inner.meta.start = start;
    Ok(model)
}

fn objective(problem: &Problem, facts: &Dependence, kernels: &mut Kernels) -> Result<(Affine, Groups), AssemblyError> {
    let sign = match problem.sense {
        Sense::Minimize => 1.0,
        Sense::Maximize => -1.0,
    };
    let (mut groups, mut templates) = (Groups::default(), Templates::default());
    let mut summation = Summation {
        problem,
        kernels,
        templates: &mut templates,
        groups: &mut groups,
        affine: Affine::default(),
        row: None,
        elements: 0,
    };
    let walked = Walk::new(problem, facts).visit(&problem.objective, sign, Context::GLOBAL, &mut summation);
    walked.map_err(|cause| AssemblyError { place: "the objective".into(), cause })?;
    let mut affine = summation.affine;
    affine.merge();
    Ok((affine, groups))
}

/// Why no model could be assembled.
#[derive(Debug, Clone, PartialEq, Eq, Error)]
#[error("{place}: {cause}")]
pub struct AssemblyError {
    /// The declaration: `problem.toml:12 (constraint sag)`.
    pub place: String,
    /// What is too large.
    pub cause: TapeError,
}

/// All rows while they are collected.
#[derive(Default)]
struct Rows {
    affine: Vec<Affine>,
    /// Their terms that no variable can move: the affine parts' constants, and what fixed variables make of others.
    fixed_terms: Vec<f64>,
    lower: Vec<f64>,
    upper: Vec<f64>,
    nonlinear: Vec<bool>,
    origin: Vec<RowOrigin>,
    groups: Groups,
}

impl Rows {
    fn of<'a>(
        problem: &Problem,
        sides: impl Iterator<Item = (&'a Formula, &'a Limit)>,
        facts: &Dependence,
        kernels: &mut Kernels,
    ) -> Result<Rows, AssemblyError> {
        let (mut rows, fixed) = (Rows::default(), FixedTerms::of(problem));
        for ((index, constraint), sides) in problem.constraints.iter().enumerate().zip(sides) {
            let (mut walk, mut templates) = (Walk::new(problem, facts), Templates::default());
            for item in 0..constraint.scope.rows() {
                let origin = RowOrigin { constraint: index as u32, item: item as u32 };
                let context = context(&constraint.scope, item);
                let added = rows.add(sides, context, origin, &mut walk, kernels, &mut templates);
                let constant = added.map_err(|cause| AssemblyError {
                    place: format!("{} (constraint {})", constraint.place, constraint.name),
                    cause,
                })?;
                rows.fixed_terms.push(fixed.as_ref().map_or(constant, |fixed| fixed.term(sides.0, context)));
            }
        }
        Ok(rows)
    }

    /// Adds a row; its constant term.
    fn add<'a>(
        &mut self,
        (left, right): (&'a Formula, &Limit),
        context: Context,
        origin: RowOrigin,
        walk: &mut Walk<'a>,
        kernels: &mut Kernels,
        templates: &mut Templates<'a>,
    ) -> Result<f64, TapeError> {
        let row = Some(self.affine.len() as u32);
        let (problem, groups) = (walk.problem, &mut self.groups);
        let mut summation = Summation { problem, kernels, templates, groups, affine: Affine::default(), row, elements: 0 };
        walk.visit(left, 1.0, context, &mut summation)?;
        let Summation { mut affine, elements, .. } = summation;
        affine.merge();
        let constant = affine.constant;
        self.affine.push(affine);
        self.nonlinear.push(elements > 0);
        let (lower, upper) = limits(right, |formula| walk.constant(formula, context));
        self.lower.push(lower);
        self.upper.push(upper);
        self.origin.push(origin);
        Ok(constant)
    }
}

/// c_l and c_u of a row.
fn limits(limit: &Limit, mut constant: impl FnMut(&Formula) -> f64) -> (f64, f64) {
    match limit {
        Limit::AtMost(value) => (f64::NEG_INFINITY, constant(value)),
        Limit::AtLeast(value) => (constant(value), f64::INFINITY),
        Limit::Equal(value) => {
            let value = constant(value);
            (value, value)
        }
        Limit::Between(lower, upper) => (constant(lower), constant(upper)),
    }
}

/// Whose names the item-th row of a scope speaks of.
fn context(scope: &Scope, item: usize) -> Context<'_> {
    match scope {
        Scope::Once => Context::GLOBAL,
        Scope::Sections(items) => Context { item: Item::Section(items[item]), group: &[] },
        Scope::Ribs(items) => Context { item: Item::Rib(items[item]), group: &[] },
        Scope::Nodes(items) => Context { item: Item::Node(items[item]), group: &[] },
        // Plain data are the same throughout the group (the reader saw to that): the first member's serve.
        Scope::RibGroups(groups) => {
            Context { item: groups[item].1.first().map_or(Item::None, |&rib| Item::Rib(rib)), group: &groups[item].1 }
        }
        Scope::SectionGroups(groups) => {
            Context { item: groups[item].1.first().map_or(Item::None, |&section| Item::Section(section)), group: &groups[item].1 }
        }
        Scope::NodeGroups(groups) => {
            Context { item: groups[item].1.first().map_or(Item::None, |&node| Item::Node(node)), group: &groups[item].1 }
        }
    }
}

/// The coefficients of affine rows at their places in the Jacobian's pattern; zero elsewhere.
fn scattered(rows: &[Affine], jacobian: &Pattern) -> Vec<f64> {
    let mut values = vec![0.0; jacobian.len()];
    for (row, affine) in rows.iter().enumerate() {
        for &(j, coefficient) in &affine.coefficients {
            if let Some(at) = jacobian.position(row, j) {
                values[at] = coefficient;
            }
        }
    }
    values
}

/// Magnitudes given, 0 for what follows them.
fn padded(typical: &[f64], n: usize) -> Vec<f64> {
    typical.iter().copied().chain(std::iter::repeat(0.0)).take(n).collect()
}

/// Fixes the patterns and tells every element where its derivatives go.
fn connect(
    problem: &Arc<Problem>,
    objective: Affine,
    mut objective_groups: Vec<super::elements::KernelGroup>,
    rows: Rows,
) -> RibModel {
    let (n, m) = (problem.variables.lower.len(), rows.affine.len());
    let mut row_groups = rows.groups.into_list();
    let mut positions: Vec<(u32, u32)> = Vec::new();
    for (row, affine) in rows.affine.iter().enumerate() {
        positions.extend(affine.coefficients.iter().map(|&(j, _)| (row as u32, j)));
    }
    row_groups.iter().for_each(|group| group.jacobian_positions(&mut positions));
    let jacobian = Pattern::from_positions(m, &mut positions);
    objective_groups.iter().chain(&row_groups).for_each(|group| group.hessian_positions(&mut positions));
    let hessian = Pattern::from_positions(n, &mut positions);
    for group in objective_groups.iter_mut().chain(&mut row_groups) {
        group.connect(&jacobian, &hessian);
    }
    let linear_jacobian = scattered(&rows.affine, &jacobian);
    let row_origin: Arc<[RowOrigin]> = rows.origin.into();
    let meta = Meta {
        lower: problem.variables.lower.clone(),
        upper: problem.variables.upper.clone(),
        start: problem.variables.start.clone(),
        typical: padded(&problem.variables.typical, n),
        row_lower: rows.lower,
        row_upper: rows.upper,
        row_constants: rows.fixed_terms,
        row_is_linear: rows.nonlinear.iter().map(|nonlinear| !nonlinear).collect(),
        objective_is_linear: objective_groups.is_empty(),
        states: None,
        jacobian,
        hessian,
        names: NameTable::new(ProblemNames { problem: Arc::clone(problem), row_origin: Arc::clone(&row_origin) }),
        ..Meta::default()
    };
    let row_constants = rows.affine.iter().map(|affine| affine.constant).collect();
    let inner =
        ElementModel { meta, objective, linear_jacobian, row_constants, objective_groups, row_groups, ..ElementModel::default() };
    RibModel { problem: Arc::clone(problem), inner, row_origin, members: OnceLock::new() }
}
