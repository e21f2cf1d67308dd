//! One point in logarithms.

use super::Logarithmic;
use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError};

/// One point in logarithms, with the first derivatives in x once they were asked for: second ones need them.
pub(super) struct LogarithmicAt<'m> {
    pub(super) view: &'m Logarithmic,
    pub(super) y: Vec<f64>,
    pub(super) x: Vec<f64>,
    pub(super) inner: Box<dyn Evaluation + 'm>,
    /// f and ∇f in x.
    pub(super) gradient: Option<(f64, Vec<f64>)>,
    /// The Jacobian in x.
    pub(super) jacobian: Option<Vec<f64>>,
}

impl LogarithmicAt<'_> {
    pub(super) fn gradient_in_x(&mut self) -> Result<&(f64, Vec<f64>), EvaluationError> {
        let Self { inner, gradient, x, .. } = self;
        let known = match gradient {
            Some(known) => known,
            None => {
                let mut values = vec![0.0; x.len()];
                let value = inner.gradient(&mut values)?;
                gradient.insert((value, values))
            }
        };
        Ok(known)
    }

    pub(super) fn jacobian_in_x(&mut self) -> Result<&[f64], EvaluationError> {
        let Self { inner, jacobian, view, .. } = self;
        let known = match jacobian {
            Some(known) => known,
            None => {
                let mut values = vec![0.0; view.meta.jacobian.len()];
                inner.jacobian(&mut values)?;
                jacobian.insert(values)
            }
        };
        Ok(known)
    }

    /// weight·∇f + Jᵀ·multipliers in x.
    pub(super) fn lagrangian_gradient(&mut self, weight: f64, multipliers: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let view = self.view;
        let mut gradient = vec![0.0; self.x.len()];
        if weight != 0.0 {
            gradient.copy_from_slice(&self.gradient_in_x()?.1);
            gradient.iter_mut().for_each(|g| *g *= weight);
        }
        view.meta.jacobian.add_transposed(self.jacobian_in_x()?, multipliers, &mut gradient);
        Ok(gradient)
    }
}

impl Evaluation for LogarithmicAt<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.inner.objective()
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let (value, in_x) = self.gradient_in_x()?;
        gradient.copy_from_slice(in_x);
        let value = *value;
        gradient.iter_mut().zip(&self.x).for_each(|(g, x)| *g *= x);
        Ok(value)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.constraints(values)?;
        let view = self.view;
        let pattern = &view.meta.jacobian;
        for (row, value) in values.iter_mut().enumerate().filter(|(row, _)| view.monomial[*row]) {
            let sum: f64 = pattern.range(row).map(|at| view.exponents[at] * self.y[pattern.columns[at] as usize]).sum();
            *value = view.constants[row] + sum;
        }
        Ok(())
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        values.copy_from_slice(self.jacobian_in_x()?);
        let pattern = &view.meta.jacobian;
        for (row, &monomial) in view.monomial.iter().enumerate() {
            for at in pattern.range(row) {
                values[at] = if monomial { view.exponents[at] } else { values[at] * self.x[pattern.columns[at] as usize] };
            }
        }
        Ok(())
    }

    fn hessian(&mut self, weight: f64, multipliers: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        let pattern = &view.model.meta().hessian;
        let multipliers: Vec<f64> =
            multipliers.iter().zip(&view.monomial).map(|(&y, &monomial)| if monomial { 0.0 } else { y }).collect();
        let mut inner = vec![0.0; pattern.len()];
        self.inner.hessian(weight, &multipliers, &mut inner)?;
        values.fill(0.0);
        for (((i, j), &slot), value) in pattern.iter().zip(&view.slots).zip(inner) {
            values[slot as usize] = value * self.x[i] * self.x[j];
        }
        let gradient = self.lagrangian_gradient(weight, &multipliers)?;
        for (j, &slot) in view.diagonal.iter().enumerate() {
            values[slot as usize] += gradient[j] * self.x[j];
        }
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}
