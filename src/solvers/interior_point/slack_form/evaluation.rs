//! The model's values and derivatives at w, scaled.

use super::SlackForm;
use crate::model::EvaluationError;

impl SlackForm<'_> {
    /// Scaled f and the scaled values of the kept rows, slacks left out of account.
    pub fn values(&mut self, w: &[f64], rows: &mut [f64]) -> Result<f64, EvaluationError> {
        self.x(w);
        let objective = self.model.objective(&self.x)?;
        self.rows_at_x(rows)?;
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
        let objective = self.model.gradient(&self.x, &mut self.gradient_values)?;
        for ((gradient, &j), scale) in gradient.iter_mut().zip(&self.free).zip(&self.variable_scale) {
            *gradient = self.gradient_values[j] * scale * self.objective_scale;
        }
        self.rows_at_x(rows)?;
        if !self.rows.is_empty() {
            self.model.jacobian(&self.x, &mut self.jacobian_values)?;
        }
        for (value, entry) in jacobian.iter_mut().zip(&self.jacobian_entries) {
            *value = self.jacobian_values[entry.source] * entry.factor;
        }
        Ok(self.objective_scale * objective)
    }

    fn rows_at_x(&mut self, rows: &mut [f64]) -> Result<(), EvaluationError> {
        if self.rows.is_empty() {
            return Ok(());
        }
        self.model.constraints(&self.x, &mut self.row_values)?;
        for ((value, &i), scale) in rows.iter_mut().zip(&self.rows).zip(&self.row_scale) {
            *value = self.row_values[i] * scale;
        }
        Ok(())
    }

    /// The scaled Hessian of the Lagrangian (objective weight 1) at w for scaled multipliers.
    pub fn hessian(&mut self, w: &[f64], y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.x(w);
        for ((&i, scale), y) in self.rows.iter().zip(&self.row_scale).zip(y) {
            self.multipliers[i] = y * scale;
        }
        self.model.hessian(&self.x, self.objective_scale, &self.multipliers, &mut self.hessian_values)?;
        for (value, entry) in values.iter_mut().zip(&self.hessian_entries) {
            *value = self.hessian_values[entry.source] * entry.factor;
        }
        Ok(())
    }
}
