//! Small models for tests, differentiated by hyper-dual numbers.

use num_dual::HyperDual64;

use crate::model::{EvaluationError, Meta, Model, Pattern};

/// A function of x for hyper-dual numbers.
pub(crate) type Function = Box<dyn Fn(&[HyperDual64]) -> HyperDual64 + Sync>;

/// A dense little model made of closures.
pub(crate) struct ClosureModel {
    meta: Meta,
    objective: Function,
    rows: Vec<Function>,
}

impl ClosureModel {
    /// min objective from `start`, without bounds and rows.
    pub fn new(start: &[f64], objective: impl Fn(&[HyperDual64]) -> HyperDual64 + Sync + 'static) -> Self {
        let n = start.len();
        let mut all = (0..n as u32).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
        let meta = Meta {
            lower: vec![f64::NEG_INFINITY; n],
            upper: vec![f64::INFINITY; n],
            start: start.to_vec(),
            hessian: Pattern::from_positions(n, &mut all),
            ..Meta::default()
        };
        ClosureModel { meta, objective: Box::new(objective), rows: Vec::new() }
    }

    /// With bounds of every variable.
    pub fn bounds(mut self, lower: &[f64], upper: &[f64]) -> Self {
        (self.meta.lower, self.meta.upper) = (lower.to_vec(), upper.to_vec());
        self
    }

    /// With lower ≤ row ≤ upper.
    pub fn row(mut self, lower: f64, upper: f64, row: impl Fn(&[HyperDual64]) -> HyperDual64 + Sync + 'static) -> Self {
        self.meta.row_lower.push(lower);
        self.meta.row_upper.push(upper);
        self.meta.row_is_linear.push(false);
        self.rows.push(Box::new(row));
        let (n, m) = (self.meta.variables() as u32, self.rows.len());
        let mut all = (0..m as u32).flat_map(|i| (0..n).map(move |j| (i, j))).collect();
        self.meta.jacobian = Pattern::from_positions(m, &mut all);
        self
    }
}

/// x with unit derivatives in i and j.
fn seeded(x: &[f64], i: usize, j: usize) -> Vec<HyperDual64> {
    let unit = |on: bool| f64::from(u8::from(on));
    x.iter().enumerate().map(|(k, &x)| HyperDual64::new(x, unit(k == i), unit(k == j), 0.0)).collect()
}

fn finite(value: f64) -> Result<f64, EvaluationError> {
    let invalid = || EvaluationError::Invalid { term: "term".into(), cause: format!("the value is {value}") };
    if value.is_finite() { Ok(value) } else { Err(invalid()) }
}

impl Model for ClosureModel {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        finite((self.objective)(&seeded(x, 0, 0)).re)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        for (j, gradient) in gradient.iter_mut().enumerate() {
            *gradient = finite((self.objective)(&seeded(x, j, j)).eps1)?;
        }
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, row) in values.iter_mut().zip(&self.rows) {
            *value = finite(row(&seeded(x, 0, 0)).re)?;
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (at, (i, j)) in self.meta.jacobian.iter().enumerate() {
            values[at] = finite(self.rows[i](&seeded(x, j, j)).eps1)?;
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (at, (i, j)) in self.meta.hessian.iter().enumerate() {
            let x = seeded(x, i, j);
            let rows = self.rows.iter().zip(y).map(|(row, y)| if *y == 0.0 { 0.0 } else { y * row(&x).eps1eps2 });
            let objective = if weight == 0.0 { 0.0 } else { weight * (self.objective)(&x).eps1eps2 };
            values[at] = finite(objective + rows.sum::<f64>())?;
        }
        Ok(())
    }
}
