//! Small models for tests: closures, differentiated exactly by hyper-dual numbers, with dense patterns.

use num_dual::HyperDual64;

use super::{EvaluationError, Meta, Model, Pattern};

/// The number the closures compute with.
pub(crate) type Value = HyperDual64;

type Function = Box<dyn Fn(&[Value]) -> Value + Send + Sync>;

/// A model put together by hand.
pub(crate) struct Sample {
    /// What is known of it.
    pub meta: Meta,
    objective: Function,
    rows: Vec<Function>,
}

impl Sample {
    /// Minimise `objective` from `start`, without bounds or rows.
    pub fn new(start: &[f64], objective: impl Fn(&[Value]) -> Value + Send + Sync + 'static) -> Sample {
        let n = start.len();
        let mut triangle = (0..n as u32).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
        let meta = Meta {
            lower: vec![f64::NEG_INFINITY; n],
            upper: vec![f64::INFINITY; n],
            start: start.to_vec(),
            typical: start.iter().map(|start| start.abs()).collect(),
            hessian: Pattern::from_positions(n, &mut triangle),
            ..Meta::default()
        };
        Sample { meta, objective: Box::new(objective), rows: Vec::new() }
    }

    /// Bounds of variable j.
    pub fn bound(mut self, j: usize, lower: f64, upper: f64) -> Sample {
        (self.meta.lower[j], self.meta.upper[j]) = (lower, upper);
        self
    }

    /// Bounds of every variable.
    pub fn bounds(mut self, lower: &[f64], upper: &[f64]) -> Sample {
        (self.meta.lower, self.meta.upper) = (lower.to_vec(), upper.to_vec());
        self
    }

    /// Says of all rows that they are linear.
    pub fn linear(mut self) -> Sample {
        self.meta.row_is_linear.fill(true);
        self
    }

    /// One more row: lower ≤ row ≤ upper.
    pub fn row(mut self, lower: f64, upper: f64, row: impl Fn(&[Value]) -> Value + Send + Sync + 'static) -> Sample {
        self.rows.push(Box::new(row));
        self.meta.row_lower.push(lower);
        self.meta.row_upper.push(upper);
        self.meta.row_is_linear.push(false);
        let (m, n) = (self.rows.len() as u32, self.meta.variables() as u32);
        let mut full = (0..m).flat_map(|i| (0..n).map(move |j| (i, j))).collect();
        self.meta.jacobian = Pattern::from_positions(self.rows.len(), &mut full);
        self
    }
}

/// The point with the infinitesimals ε₁ on x_i and ε₂ on x_j.
fn seeded(x: &[f64], i: usize, j: usize) -> Vec<Value> {
    let unit = |on: bool| f64::from(u8::from(on));
    x.iter().enumerate().map(|(k, &x)| Value::new(x, unit(k == i), unit(k == j), 0.0)).collect()
}

fn finite(value: f64, term: &str) -> Result<f64, EvaluationError> {
    let invalid = || EvaluationError::Invalid { term: term.into(), cause: format!("the value is {value}") };
    if value.is_finite() { Ok(value) } else { Err(invalid()) }
}

impl Model for Sample {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        finite((self.objective)(&seeded(x, 0, 0)).re, "objective")
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        for (j, gradient) in gradient.iter_mut().enumerate() {
            *gradient = finite((self.objective)(&seeded(x, j, j)).eps1, "objective")?;
        }
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, row) in values.iter_mut().zip(&self.rows) {
            *value = finite(row(&seeded(x, 0, 0)).re, "row")?;
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, (i, j)) in values.iter_mut().zip(self.meta.jacobian.iter()) {
            *value = finite(self.rows[i](&seeded(x, j, j)).eps1, "row")?;
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, (i, j)) in values.iter_mut().zip(self.meta.hessian.iter()) {
            let x = seeded(x, i, j);
            let rows = self.rows.iter().zip(y).map(|(row, y)| if *y == 0.0 { 0.0 } else { y * row(&x).eps1eps2 });
            let objective = if weight == 0.0 { 0.0 } else { weight * (self.objective)(&x).eps1eps2 };
            *value = finite(objective + rows.sum::<f64>(), "second derivatives")?;
        }
        Ok(())
    }
}
