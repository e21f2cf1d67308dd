//! The values of the KKT matrix, slacks eliminated, and products with it.

use std::sync::Arc;

use super::super::slack_form::SlackForm;
use crate::model::Pattern;

/// [ W + diag(primal), Aᵀ; A, −diag(dual) ]
pub(super) struct System {
    /// Lower triangle of W.
    pub hessian: Arc<Pattern>,
    pub jacobian: Arc<Pattern>,
    pub hessian_values: Vec<f64>,
    pub jacobian_values: Vec<f64>,
    /// Σ_x + δ_w
    pub primal: Vec<f64>,
    /// 1/D + δ_c
    pub dual: Vec<f64>,
}

impl System {
    /// Room for the values of this form's matrix.
    pub fn new(form: &SlackForm<'_>) -> Self {
        System {
            hessian: Arc::clone(&form.hessian),
            jacobian: Arc::clone(&form.jacobian),
            hessian_values: vec![0.0; form.hessian.len()],
            jacobian_values: vec![0.0; form.jacobian.len()],
            primal: vec![0.0; form.variables()],
            dual: vec![0.0; form.rows.len()],
        }
    }

    /// Number of variables and rows: the order of the matrix.
    pub fn order(&self) -> usize {
        self.primal.len() + self.dual.len()
    }

    /// residual = right − K·x; variables first, then rows.
    pub fn residual(&self, right: &[f64], x: &[f64], residual: &mut [f64]) {
        let n = self.primal.len();
        let (variables, rows) = x.split_at(n);
        let (of_variables, of_rows) = residual.split_at_mut(n);
        for (j, residual) in of_variables.iter_mut().enumerate() {
            *residual = right[j] - self.primal[j] * variables[j];
        }
        for row in 0..n {
            let mut sum = 0.0;
            for at in self.hessian.range(row) {
                let (column, value) = (self.hessian.columns[at] as usize, self.hessian_values[at]);
                sum += value * variables[column];
                if column != row {
                    of_variables[column] -= value * variables[row];
                }
            }
            of_variables[row] -= sum;
        }
        for (i, residual) in of_rows.iter_mut().enumerate() {
            let mut sum = 0.0;
            for at in self.jacobian.range(i) {
                let (column, value) = (self.jacobian.columns[at] as usize, self.jacobian_values[at]);
                sum += value * variables[column];
                of_variables[column] -= value * rows[i];
            }
            *residual = right[n + i] - sum + self.dual[i] * rows[i];
        }
    }
}
