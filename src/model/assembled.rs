//! The model assembled from a problem: affine parts and sums of elements.

use std::sync::{Arc, OnceLock};

use super::auxiliaries;
use super::chunked_evaluation::Chunks;
use super::components::{ComponentView, Components, Members};
use super::elements::{Group, Label};
use super::{EvaluationError, Meta, Model, Own};
use crate::problem::Problem;

/// An affine function: constant and coefficients, one per variable at the most.
#[derive(Debug, Clone, Default)]
pub(super) struct Affine {
    pub constant: f64,
    pub coefficients: Vec<(u32, f64)>,
}

impl Affine {
    fn value(&self, x: &[f64]) -> f64 {
        self.constant + self.coefficients.iter().map(|&(j, c)| c * x[j as usize]).sum::<f64>()
    }

    /// The derivatives by the variables from `first` on, overwritten.
    pub fn gradient(&self, first: usize, target: &mut [f64]) {
        target.fill(0.0);
        let begin = self.coefficients.partition_point(|&(j, _)| (j as usize) < first);
        for &(j, coefficient) in &self.coefficients[begin..] {
            let Some(derivative) = target.get_mut(j as usize - first) else { break };
            *derivative = coefficient;
        }
    }

    /// Adds up the coefficients of each variable, in ascending order of variables.
    pub fn merge(&mut self) {
        self.coefficients.sort_by_key(|&(j, _)| j);
        self.coefficients.dedup_by(|next, kept| {
            let same = next.0 == kept.0;
            if same {
                kept.1 += next.1;
            }
            same
        });
        self.coefficients.shrink_to_fit();
    }
}

/// Objective and rows of a [`Problem`] with exact sparse derivatives.
///
/// A maximisation is turned: the model always minimises, [`crate::problem::Sense`] tells what reports show.
pub struct RibModel {
    pub(super) problem: Arc<Problem>,
    pub(super) meta: Meta,
    /// The objective's affine part.
    pub(super) objective: Affine,
    /// The rows' constants.
    pub(super) row_constants: Vec<f64>,
    /// The rows' affine parts: values along the Jacobian's pattern, zero elsewhere.
    pub(super) linear_jacobian: Vec<f64>,
    /// Elements of the objective, by kernel.
    pub(super) objective_groups: Vec<Group>,
    /// Elements of the rows, by kernel.
    pub(super) row_groups: Vec<Group>,
    /// Which declaration and which item each row comes from.
    pub(super) row_origin: Vec<RowOrigin>,
    /// The components, once somebody asked.
    pub(super) members: OnceLock<Option<Members>>,
    /// How a large model is evaluated side by side, once somebody asked.
    pub(super) chunks: OnceLock<Option<Chunks>>,
}

/// Where a row comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct RowOrigin {
    /// Index into [`Problem::constraints`].
    pub constraint: u32,
    /// Which of its items, counted as its scope lists them.
    pub item: u32,
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
        let count = |groups: &[Group]| groups.iter().map(Group::len).sum();
        (count(&self.objective_groups), count(&self.row_groups), self.objective_groups.len() + self.row_groups.len())
    }

    fn chunks(&self) -> Option<&Chunks> {
        let (n, m) = (self.meta.variables(), self.meta.rows());
        self.chunks.get_or_init(|| Chunks::of(n, m, &self.objective_groups, &self.row_groups)).as_ref()
    }

    fn invalid(&self, groups: &[Group], x: &[f64], fallback: &str) -> EvaluationError {
        if let Some(j) = x.iter().position(|value| !value.is_finite()) {
            return EvaluationError::Invalid { term: self.variable_name(j), cause: format!("the variable itself is {}", x[j]) };
        }
        let (term, cause) = match groups.iter().find_map(|group| group.explain(x)) {
            Some((label, cause)) => (self.describe(label), cause),
            None => (fallback.to_string(), "the sum of its terms overflows".to_string()),
        };
        EvaluationError::Invalid { term, cause }
    }

    fn describe(&self, label: Label) -> String {
        match label {
            Label::Objective => format!("objective {}", self.problem.objective_text),
            Label::RibVolume(rib) => format!("volume of rib {}", &self.problem.ribs.names[rib as usize]),
            Label::Row(row) => format!("row {}", self.row_name(row as usize)),
        }
    }
}

/// Looked at in blocks without a way out, so that the compiler uses vector instructions.
pub(super) fn all_finite(values: &[f64]) -> bool {
    values.chunks(64).all(|block| block.iter().fold(true, |finite, value| finite & value.is_finite()))
}

impl Model for RibModel {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        let value = self.objective.value(x) + self.objective_groups.iter().map(|group| group.value(x)).sum::<f64>();
        if value.is_finite() { Ok(value) } else { Err(self.invalid(&self.objective_groups, x, "objective")) }
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let groups = &self.objective_groups;
        let sum = match self.chunks() {
            Some(chunks) => chunks.gradient(&self.objective, groups, x, gradient),
            None => {
                self.objective.gradient(0, gradient);
                let sum = groups.iter().map(|group| group.add_gradient(x, gradient)).sum();
                if all_finite(gradient) { sum } else { f64::NAN }
            }
        };
        let value = self.objective.value(x) + sum;
        if value.is_finite() { Ok(value) } else { Err(self.invalid(groups, x, "gradient of the objective")) }
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.meta.jacobian.multiply(&self.linear_jacobian, x, values);
        for (value, constant) in values.iter_mut().zip(&self.row_constants) {
            *value += constant;
        }
        let finite = match self.chunks() {
            Some(chunks) => chunks.add_rows(&self.row_groups, x, values),
            None => {
                self.row_groups.iter().for_each(|group| group.add_rows(group.range(), x, 0, values));
                all_finite(values)
            }
        };
        if finite { Ok(()) } else { Err(self.invalid(&self.row_groups, x, "rows")) }
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let finite = match self.chunks() {
            Some(chunks) => chunks.jacobian(&self.linear_jacobian, &self.row_groups, &self.meta.jacobian, x, values),
            None => {
                values.copy_from_slice(&self.linear_jacobian);
                self.row_groups.iter().for_each(|group| group.add_jacobian(group.range(), x, 0, values));
                all_finite(values)
            }
        };
        if finite { Ok(()) } else { Err(self.invalid(&self.row_groups, x, "first derivatives of the rows")) }
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let groups: Vec<&Group> = self.objective_groups.iter().chain(&self.row_groups).collect();
        let finite = match self.chunks() {
            Some(chunks) => chunks.hessian(&groups, &self.meta.hessian, x, (weight, y), values),
            None => {
                values.fill(0.0);
                groups.iter().for_each(|group| group.add_hessian(group.range(), x, weight, y, 0, values));
                all_finite(values)
            }
        };
        if finite {
            return Ok(());
        }
        let groups = if self.objective_groups.iter().any(|group| group.explain(x).is_some()) {
            &self.objective_groups
        } else {
            &self.row_groups
        };
        Err(self.invalid(groups, x, "second derivatives"))
    }

    fn own(&self) -> Own {
        let auxiliaries = &self.problem.auxiliaries;
        let rows = match auxiliaries.first() {
            Some(first) => self.rows_before(first.constraints.start),
            None => self.meta.rows(),
        };
        Own { variables: self.meta.variables() - auxiliaries.len(), rows }
    }

    fn complete(&self, x: &mut [f64]) {
        let first = self.problem.auxiliaries.first().map_or(0, |first| self.rows_before(first.constraints.start));
        // In the inner problem of a structure inputs stand behind the auxiliaries.
        let end = if self.problem.inputs_are_forces { self.problem.first_input as usize } else { x.len() };
        auxiliaries::complete(self, &self.problem.auxiliaries, first, end, x);
    }

    fn components(&self) -> Option<Box<dyn Components + '_>> {
        let members = self.members.get_or_init(|| Members::of(self)).as_ref()?;
        Some(Box::new(ComponentView { model: self, members }))
    }

    fn variable_name(&self, j: usize) -> String {
        self.problem.variable_name(j)
    }

    fn row_name(&self, i: usize) -> String {
        let RowOrigin { constraint, item } = self.row_origin[i];
        self.problem.row_name(constraint as usize, item as usize)
    }

    fn row_place(&self, i: usize) -> Option<String> {
        let constraint = self.row_origin.get(i)?.constraint as usize;
        self.problem.constraints.get(constraint).map(|constraint| constraint.place.clone())
    }
}
