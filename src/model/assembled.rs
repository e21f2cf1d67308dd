//! The model assembled from a problem: what its elements add up to, and where each row comes from.

use std::sync::{Arc, OnceLock};

use super::around::{Around, around};
use super::auxiliaries;
use super::components::{ComponentView, Components, Members};
use super::element_model::ElementModel;
use super::elements::KernelGroup;
use super::{Evaluation, EvaluationError, Meta, Model, Names, Own};
use crate::problem::Problem;

/// Objective and rows of a [`Problem`] with exact sparse derivatives.
///
/// A maximisation is turned: the model always minimises, [`crate::problem::Sense`] tells what reports show.
pub struct RibModel {
    pub(super) problem: Arc<Problem>,
    /// What it is made of.
    pub(super) inner: ElementModel,
    /// Which declaration and which item each row comes from.
    pub(super) row_origin: Arc<[RowOrigin]>,
    /// The components, once somebody asked.
    pub(super) members: OnceLock<Option<Members>>,
}

/// Where a row comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RowOrigin {
    /// Index into [`Problem::constraints`].
    pub constraint: u32,
    /// Which of its items, counted as its scope lists them.
    pub item: u32,
}

/// A problem's variables, and rows by the constraint and the item each comes from.
pub(super) struct ProblemNames {
    pub problem: Arc<Problem>,
    pub row_origin: Arc<[RowOrigin]>,
}

impl Names for ProblemNames {
    fn variable(&self, j: usize) -> String {
        self.problem.variable_name(j)
    }

    fn row(&self, i: usize) -> String {
        let RowOrigin { constraint, item } = self.row_origin[i];
        self.problem.row_name(constraint as usize, item as usize)
    }

    fn objective(&self) -> String {
        format!("objective {}", self.problem.objective_text)
    }

    fn rib_volume(&self, rib: usize) -> String {
        format!("volume of rib {}", &self.problem.ribs.names[rib])
    }

    fn row_place(&self, i: usize) -> Option<String> {
        let constraint = self.row_origin.get(i)?.constraint as usize;
        self.problem.constraints.get(constraint).map(|constraint| constraint.place.clone())
    }
}

impl RibModel {
    /// The declaration it was assembled from.
    pub fn problem(&self) -> &Arc<Problem> {
        &self.problem
    }

    /// Where row i comes from.
    pub fn row_origin(&self, i: usize) -> RowOrigin {
        self.row_origin[i]
    }

    /// Number of rows that constraints before this one make.
    pub fn rows_before(&self, constraint: usize) -> usize {
        self.row_origin.partition_point(|origin| (origin.constraint as usize) < constraint)
    }

    /// Number of elements (objective, rows) and of kernels they share.
    pub fn elements(&self) -> (usize, usize, usize) {
        let count = |groups: &[KernelGroup]| groups.iter().map(KernelGroup::len).sum();
        let (objective, rows) = (&self.inner.objective_groups, &self.inner.row_groups);
        (count(objective), count(rows), objective.len() + rows.len())
    }
}

impl Model for RibModel {
    fn meta(&self) -> &Meta {
        &self.inner.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        self.inner.at(x)
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.inner.objective(x)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.inner.gradient(x, gradient)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.constraints(x, values)
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.jacobian(x, values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.hessian(x, weight, y, values)
    }

    fn own(&self) -> Own {
        let auxiliaries = &self.problem.auxiliaries;
        let rows = match auxiliaries.first() {
            Some(first) => self.rows_before(first.constraints.start),
            None => self.meta().rows(),
        };
        Own { variables: self.meta().variables() - auxiliaries.len(), rows }
    }

    fn complete(&self, x: &mut [f64]) {
        let first = self.problem.auxiliaries.first().map_or(0, |first| self.rows_before(first.constraints.start));
        // In the inner problem of a structure inputs stand behind the auxiliaries.
        let end = if self.problem.inputs_are_forces { self.problem.first_input as usize } else { x.len() };
        auxiliaries::complete(self, &self.problem.auxiliaries, first, end, x);
    }

    fn around(&self, variables: &[u32]) -> Option<Around<'_>> {
        Some(around(&self.inner, variables))
    }

    fn components(&self) -> Option<Box<dyn Components + '_>> {
        let members = self.members.get_or_init(|| Members::of(&self.inner)).as_ref()?;
        Some(Box::new(ComponentView { model: &self.inner, members }))
    }
}
