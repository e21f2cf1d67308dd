//! Models written by hand, for tests: formulas over any number type, differentiated exactly by hyper-dual numbers.

use num_dual::{DualNum, HyperDual64};

use super::{EvaluationError, Meta, Model, Pattern};

/// Objective and rows of a test problem.
pub trait Formulas: Sync {
    /// f(x)
    fn objective<D: DualNum<f64> + Copy>(&self, x: &[D]) -> D;

    /// c(x)
    fn rows<D: DualNum<f64> + Copy>(&self, _x: &[D]) -> Vec<D> {
        Vec::new()
    }
}

/// A dense model from formulas.
pub struct Handmade<F> {
    formulas: F,
    meta: Meta,
}

impl<F: Formulas> Handmade<F> {
    /// Variables as (lower, start, upper), rows as (lower, upper).
    pub fn new(formulas: F, variables: &[(f64, f64, f64)], rows: &[(f64, f64)]) -> Self {
        let (n, m) = (variables.len() as u32, rows.len() as u32);
        let mut full = (0..m).flat_map(|i| (0..n).map(move |j| (i, j))).collect();
        let mut triangle = (0..n).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
        let meta = Meta {
            lower: variables.iter().map(|variable| variable.0).collect(),
            start: variables.iter().map(|variable| variable.1).collect(),
            upper: variables.iter().map(|variable| variable.2).collect(),
            row_lower: rows.iter().map(|row| row.0).collect(),
            row_upper: rows.iter().map(|row| row.1).collect(),
            row_is_linear: vec![false; rows.len()],
            objective_is_linear: false,
            jacobian: Pattern::from_positions(rows.len(), &mut full),
            hessian: Pattern::from_positions(variables.len(), &mut triangle),
        };
        Handmade { formulas, meta }
    }

    /// The point with the infinitesimals ε₁ on x_i and ε₂ on x_j.
    fn dual(x: &[f64], i: usize, j: usize) -> Vec<HyperDual64> {
        let unit = |at: usize, k: usize| f64::from(u8::from(at == k));
        x.iter().enumerate().map(|(k, &value)| HyperDual64::new(value, unit(i, k), unit(j, k), 0.0)).collect()
    }
}

fn checked(value: f64, term: &str) -> Result<f64, EvaluationError> {
    let invalid = || EvaluationError::Invalid { term: term.into(), cause: format!("the value is {value}") };
    if value.is_finite() { Ok(value) } else { Err(invalid()) }
}

impl<F: Formulas> Model for Handmade<F> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        checked(self.formulas.objective(x), "objective")
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        for (j, entry) in gradient.iter_mut().enumerate() {
            *entry = checked(self.formulas.objective(&Self::dual(x, j, j)).eps1, "objective")?;
        }
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, row) in values.iter_mut().zip(self.formulas.rows(x)) {
            *value = checked(row, "row")?;
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for j in 0..x.len() {
            for (i, row) in self.formulas.rows(&Self::dual(x, j, j)).into_iter().enumerate() {
                values[i * x.len() + j] = checked(row.eps1, "row")?;
            }
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, (i, j)) in values.iter_mut().zip(self.meta.hessian.iter()) {
            let dual = Self::dual(x, i, j);
            let rows = self.formulas.rows(&dual).into_iter().zip(y).map(|(row, y)| y * row.eps1eps2).sum::<f64>();
            *value = checked(weight * self.formulas.objective(&dual).eps1eps2 + rows, "second derivatives")?;
        }
        Ok(())
    }
}
