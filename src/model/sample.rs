//! Small models for tests: closures over num-dual's hyper-dual numbers, dense patterns.

use nalgebra::{DVector, Dyn};
use num_dual::Dual2Vec64;

use super::{EvaluationError, Meta, Model, Pattern};

/// A number that carries gradient and Hessian.
pub type Value = Dual2Vec64<Dyn>;

type Function = Box<dyn Fn(&[Value]) -> Value + Sync>;

/// A model put together by hand.
pub struct Sample {
    meta: Meta,
    objective: Function,
    rows: Vec<Function>,
}

impl Sample {
    /// Minimise `objective` from `start`, without bounds or rows.
    pub fn new(start: &[f64], objective: impl Fn(&[Value]) -> Value + Sync + 'static) -> Sample {
        let n = start.len();
        let mut all = (0..n as u32).flat_map(|i| (0..=i).map(move |j| (i, j))).collect();
        let hessian = Pattern::from_positions(n, &mut all);
        let (lower, upper) = (vec![f64::NEG_INFINITY; n], vec![f64::INFINITY; n]);
        let meta = Meta { lower, upper, start: start.to_vec(), hessian, ..Meta::default() };
        Sample { meta, objective: Box::new(objective), rows: Vec::new() }
    }

    /// Bounds of variable j.
    pub fn bound(mut self, j: usize, lower: f64, upper: f64) -> Sample {
        (self.meta.lower[j], self.meta.upper[j]) = (lower, upper);
        self
    }

    /// One more row.
    pub fn row(mut self, lower: f64, upper: f64, function: impl Fn(&[Value]) -> Value + Sync + 'static) -> Sample {
        self.rows.push(Box::new(function));
        self.meta.row_lower.push(lower);
        self.meta.row_upper.push(upper);
        self.meta.row_is_linear.push(false);
        let (m, n) = (self.rows.len() as u32, self.meta.variables() as u32);
        self.meta.jacobian = Pattern::from_positions(m as usize, &mut (0..m).flat_map(|i| (0..n).map(move |j| (i, j))).collect());
        self
    }

    fn evaluate(&self, function: &Function, x: &[f64]) -> Result<Value, EvaluationError> {
        let n = x.len();
        let seed = |j: usize| {
            let mut value = Value::from_re(x[j]);
            value.v1 = num_dual::Derivative::derivative_generic(nalgebra::Const::<1>, Dyn(n), j);
            value
        };
        let value = function(&(0..n).map(seed).collect::<Vec<_>>());
        let cause = format!("the value is {}", value.re);
        if value.re.is_finite() { Ok(value) } else { Err(EvaluationError::Invalid { term: "sample".into(), cause }) }
    }

    fn gradient_of(value: &Value, n: usize) -> DVector<f64> {
        value.v1.clone().unwrap_generic(nalgebra::Const::<1>, Dyn(n)).transpose()
    }
}

impl Model for Sample {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        Ok(self.evaluate(&self.objective, x)?.re)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let value = self.evaluate(&self.objective, x)?;
        gradient.copy_from_slice(Self::gradient_of(&value, x.len()).as_slice());
        Ok(value.re)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (row, value) in self.rows.iter().zip(values) {
            *value = self.evaluate(row, x)?.re;
        }
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (row, values) in self.rows.iter().zip(values.chunks_mut(x.len())) {
            values.copy_from_slice(Self::gradient_of(&self.evaluate(row, x)?, x.len()).as_slice());
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.fill(0.0);
        let n = x.len();
        for (factor, function) in std::iter::once((weight, &self.objective)).chain(y.iter().copied().zip(&self.rows)) {
            let hessian = self.evaluate(function, x)?.v2.unwrap_generic(Dyn(n), Dyn(n));
            for (value, (i, j)) in values.iter_mut().zip(self.meta.hessian.iter()) {
                *value += factor * hessian[(i, j)];
            }
        }
        Ok(())
    }
}
