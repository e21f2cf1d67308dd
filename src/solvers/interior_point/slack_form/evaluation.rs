//! The model's values and derivatives at w, scaled.

use super::{SlackForm, Source};
use crate::model::{Evaluation, EvaluationError};

/// The model at the point evaluated last.
pub(super) struct Kept<'a> {
    x: Vec<f64>,
    at: Box<dyn Evaluation + 'a>,
}

impl SlackForm<'_> {
    /// Scaled f and the scaled values of the kept rows, slacks left out of account.
    pub fn values(&mut self, w: &[f64], rows: &mut [f64]) -> Result<f64, EvaluationError> {
        self.x(w);
        let mut at = self.model.at(&self.x)?;
        let objective = at.objective()?;
        if !self.rows.is_empty() {
            at.constraints(&mut self.row_values)?;
        }
        drop(at);
        self.scale_rows(rows);
        Ok(self.objective_scale * objective)
    }

    /// Scaled row values, scaled gradient (length [`SlackForm::variables`]), Jacobian values. Returns scaled f.
    pub fn first_order(
        &mut self,
        w: &[f64],
        rows: &mut [f64],
        gradient: &mut [f64],
        jacobian: &mut [f64],
    ) -> Result<f64, EvaluationError> {
        self.x(w);
        let objective = self.derivatives_at_x()?;
        for ((gradient, &j), scale) in gradient.iter_mut().zip(&self.free).zip(&self.variable_scale) {
            *gradient = self.gradient_values[j] * scale * self.objective_scale;
        }
        self.scale_rows(rows);
        for (value, entry) in jacobian.iter_mut().zip(&self.jacobian_entries) {
            *value = self.jacobian_values[entry.source] * entry.factor;
        }
        Ok(self.objective_scale * objective)
    }

    /// The model's own first derivatives at x. The point of a model given is kept: its second derivatives are asked for next.
    fn derivatives_at_x(&mut self) -> Result<f64, EvaluationError> {
        let has_rows = !self.rows.is_empty();
        let Self { model, x, kept, gradient_values, row_values, jacobian_values, .. } = self;
        let mut read = |at: &mut dyn Evaluation| {
            let objective = at.gradient(gradient_values)?;
            if has_rows {
                at.constraints(row_values)?;
                at.jacobian(jacobian_values)?;
            }
            Ok(objective)
        };
        match model {
            Source::Given(model) => read(kept.insert(Kept { x: x.clone(), at: model.at(x)? }).at.as_mut()),
            Source::Own(model) => read(model.at(x)?.as_mut()),
        }
    }

    fn scale_rows(&self, rows: &mut [f64]) {
        for ((value, &i), scale) in rows.iter_mut().zip(&self.rows).zip(&self.row_scale) {
            *value = self.row_values[i] * scale;
        }
    }

    /// The scaled Hessian of the Lagrangian (objective weight 1) at w for scaled multipliers.
    pub fn hessian(&mut self, w: &[f64], y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.x(w);
        for ((&i, scale), y) in self.rows.iter().zip(&self.row_scale).zip(y) {
            self.multipliers[i] = y * scale;
        }
        match self.kept.as_mut().filter(|kept| kept.x == self.x) {
            Some(kept) => kept.at.hessian(self.objective_scale, &self.multipliers, &mut self.hessian_values)?,
            None => self.model.hessian(&self.x, self.objective_scale, &self.multipliers, &mut self.hessian_values)?,
        }
        for (value, entry) in values.iter_mut().zip(&self.hessian_entries) {
            *value = self.hessian_values[entry.source] * entry.factor;
        }
        Ok(())
    }
}
