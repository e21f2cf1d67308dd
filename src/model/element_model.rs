//! A model of affine parts and sums of elements.

use std::sync::OnceLock;

use super::affine::Affine;
use super::chunked_evaluation::Chunks;
use super::elements::{KernelGroup, Label};
use super::{EvaluationError, Meta, Model, all_finite};

/// Objective and rows as affine functions and elements, with exact sparse derivatives.
#[derive(Default)]
pub(super) struct ElementModel {
    pub meta: Meta,
    /// The objective's affine part.
    pub objective: Affine,
    /// The rows' affine parts: values along the Jacobian's pattern, zero elsewhere.
    pub linear_jacobian: Vec<f64>,
    /// The rows' affine parts: their constants.
    pub row_constants: Vec<f64>,
    /// Elements of the objective, by kernel.
    pub objective_groups: Vec<KernelGroup>,
    /// Elements of the rows, by kernel.
    pub row_groups: Vec<KernelGroup>,
    /// How a large model is evaluated side by side, once somebody asked.
    pub chunks: OnceLock<Option<Chunks>>,
}

impl ElementModel {
    fn chunks(&self) -> Option<&Chunks> {
        let (n, m) = (self.meta.variables(), self.meta.rows());
        self.chunks.get_or_init(|| Chunks::of(n, m, &self.objective_groups, &self.row_groups)).as_ref()
    }

    fn invalid(&self, groups: &[KernelGroup], x: &[f64], fallback: &str) -> EvaluationError {
        if let Some(j) = x.iter().position(|value| !value.is_finite()) {
            return EvaluationError::Invalid {
                term: self.meta.names.variable(j),
                cause: format!("the variable itself is {}", x[j]),
            };
        }
        let (term, cause) = match groups.iter().find_map(|group| group.explain(x)) {
            Some((label, cause)) => (self.describe(label), cause),
            None => (fallback.to_string(), "the sum of its terms overflows".to_string()),
        };
        EvaluationError::Invalid { term, cause }
    }

    fn describe(&self, label: Label) -> String {
        match label {
            Label::Objective => self.meta.names.objective(),
            Label::RibVolume(rib) => self.meta.names.rib_volume(rib as usize),
            Label::Row(row) => format!("row {}", self.meta.names.row(row as usize)),
        }
    }
}

impl Model for ElementModel {
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
        let groups: Vec<&KernelGroup> = self.objective_groups.iter().chain(&self.row_groups).collect();
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
}
