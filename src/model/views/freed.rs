//! A model with one limit released, minimising how far that limit has to move.

use crate::model::{Evaluation, EvaluationError, Meta, Model};

/// One side of a row or of a variable's bounds.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Limit {
    /// Row, and whether its upper side is meant.
    Row(usize, bool),
    /// Variable, likewise.
    Bound(usize, bool),
}

impl Limit {
    /// Whether the upper side is meant.
    pub fn is_upper(self) -> bool {
        match self {
            Limit::Row(_, upper) | Limit::Bound(_, upper) => upper,
        }
    }

    /// `bending`, `a.h.upper`; a row with two different limits says which.
    pub fn label(self, model: &dyn Model) -> String {
        let side = if self.is_upper() { "upper" } else { "lower" };
        match self {
            Limit::Bound(j, _) => format!("{}.{side}", model.variable_name(j)),
            Limit::Row(i, _) => {
                let (lower, upper) = (model.meta().row_lower[i], model.meta().row_upper[i]);
                let name = model.row_name(i);
                if lower != upper && lower.is_finite() && upper.is_finite() { format!("{name} ({side})") } else { name }
            }
        }
    }

    /// The limit's value.
    pub fn value(self, meta: &Meta) -> f64 {
        match self {
            Limit::Row(i, true) => meta.row_upper[i],
            Limit::Row(i, false) => meta.row_lower[i],
            Limit::Bound(j, true) => meta.upper[j],
            Limit::Bound(j, false) => meta.lower[j],
        }
    }
}

/// Minimise c_i(x) (or x_j) where its upper limit is released, −c_i(x) (or −x_j) where its lower one is, subject to all others.
/// Where an equality is released on one side, the other stays.
pub struct Freed<'a> {
    model: &'a dyn Model,
    meta: Meta,
    limit: Limit,
    sign: f64,
}

impl<'a> Freed<'a> {
    /// `model` without this limit.
    pub fn new(model: &'a dyn Model, limit: Limit) -> Self {
        let mut meta = model.meta().clone();
        match limit {
            Limit::Row(i, true) => meta.row_upper[i] = f64::INFINITY,
            Limit::Row(i, false) => meta.row_lower[i] = f64::NEG_INFINITY,
            Limit::Bound(j, true) => meta.upper[j] = f64::INFINITY,
            Limit::Bound(j, false) => meta.lower[j] = f64::NEG_INFINITY,
        }
        meta.objective_is_linear = match limit {
            Limit::Row(i, _) => meta.is_row_linear(i),
            Limit::Bound(..) => true,
        };
        Freed { model, meta, limit, sign: if limit.is_upper() { 1.0 } else { -1.0 } }
    }

    /// Where the limit has to be for `x` to meet it.
    ///
    /// # Errors
    /// The model has no value at `x`.
    pub fn needed(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        match self.limit {
            Limit::Bound(j, _) => Ok(x[j]),
            Limit::Row(i, _) => {
                let mut rows = vec![0.0; self.meta.rows()];
                self.model.constraints(x, &mut rows)?;
                Ok(rows[i])
            }
        }
    }
}

impl Model for Freed<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(FreedAt { view: self, x: x.to_vec(), inner: self.model.at(x)? }))
    }
}

/// One point with the limit released.
struct FreedAt<'m> {
    view: &'m Freed<'m>,
    x: Vec<f64>,
    inner: Box<dyn Evaluation + 'm>,
}

impl FreedAt<'_> {
    /// The multipliers of the model's rows that make its Lagrangian this one's.
    fn multipliers(&self, weight: f64, y: &[f64]) -> Vec<f64> {
        let mut all = y.to_vec();
        if let Limit::Row(i, _) = self.view.limit {
            all[i] += weight * self.view.sign;
        }
        all
    }
}

impl Evaluation for FreedAt<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        let needed = match self.view.limit {
            Limit::Bound(j, _) => self.x[j],
            Limit::Row(i, _) => {
                let mut rows = vec![0.0; self.view.meta.rows()];
                self.inner.constraints(&mut rows)?;
                rows[i]
            }
        };
        Ok(self.view.sign * needed)
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let Freed { meta, limit, sign, .. } = self.view;
        gradient.fill(0.0);
        match *limit {
            Limit::Bound(j, _) => gradient[j] = *sign,
            Limit::Row(i, _) => {
                let mut values = vec![0.0; meta.jacobian.len()];
                self.inner.jacobian(&mut values)?;
                for at in meta.jacobian.range(i) {
                    gradient[meta.jacobian.columns[at] as usize] += sign * values[at];
                }
            }
        }
        self.objective()
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.constraints(values)
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.jacobian(values)
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let all = self.multipliers(weight, y);
        self.inner.hessian(0.0, &all, values)
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let all = self.multipliers(weight, y);
        self.inner.hessian_product(0.0, &all, direction, product)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::sample::Sample;

    #[test]
    fn the_row_let_go_is_the_objective() {
        let model = Sample::new(&[1.0, 2.0], |x| x[0]).row(3.0, 4.0, |x| x[0] * x[1] * x[1]).row(0.0, 1.0, |x| x[0]);
        let freed = Freed::new(&model, Limit::Row(0, false));
        assert_eq!((freed.meta().row_lower[0], freed.meta().row_upper[0]), (f64::NEG_INFINITY, 4.0));
        let (x, mut gradient) = ([1.5, 2.0], [0.0; 2]);
        assert_eq!(freed.gradient(&x, &mut gradient).unwrap(), -6.0);
        assert_eq!(gradient, [-4.0, -6.0]);
        let (mut own, mut rows) = (vec![0.0; 3], vec![0.0; 3]);
        freed.hessian(&x, 2.0, &[1.0, 0.0], &mut own).unwrap();
        model.hessian(&x, 0.0, &[-1.0, 0.0], &mut rows).unwrap();
        assert_eq!(own, rows);
    }

    #[test]
    fn a_bound_let_go_is_the_objective() {
        let model = Sample::new(&[1.0, 2.0], |x| x[0]).bound(1, 0.0, 2.0).row(3.0, 4.0, |x| x[0] * x[1]);
        let freed = Freed::new(&model, Limit::Bound(1, true));
        let mut gradient = [9.0; 2];
        assert_eq!((freed.meta().upper[1], freed.gradient(&[1.0, 2.5], &mut gradient).unwrap()), (f64::INFINITY, 2.5));
        assert_eq!(gradient, [0.0, 1.0]);
    }
}
