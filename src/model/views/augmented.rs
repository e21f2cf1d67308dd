//! The augmented Lagrangian of a model: a model with bounds only.
//!
//! With the slack of each row minimised out (Powell, Hestenes, Rockafellar; Nocedal & Wright §17.4), t = c(x) + y/ρ and
//! s = t cut to [c_l, c_u], it is φ(x) = f(x) + ρ/2·Σ(t_i − s_i)². Equalities, one-sided and two-sided rows all follow
//! that formula; ρ·(t − s) is the next estimate of the multipliers, and ∇φ is ∇L at that estimate.

use crate::math::within;
use crate::model::evaluation::product_by_entries;
use crate::model::{Evaluation, EvaluationError, Meta, Model, Pattern};

/// φ for given multipliers and penalty; see the module's page.
pub struct Augmented<M> {
    model: M,
    meta: Meta,
    places: Places,
    multipliers: Vec<f64>,
    penalty: f64,
}

/// Where the Lagrangian's Hessian and each row's outer product ∇c·∇cᵀ stand in φ's Hessian.
struct Places {
    hessian: Vec<u32>,
    products: Vec<u32>,
}

/// Positions of outer products that are held at the most; each row of k entries takes k(k+1)/2.
pub const MOST_PRODUCTS: usize = 20_000_000;

/// The number of positions of outer products that rows need.
pub fn needed_products(meta: &Meta) -> usize {
    (0..meta.rows()).map(|row| meta.jacobian.range(row).len()).fold(0, |sum, k| sum.saturating_add(k * (k + 1) / 2))
}

impl<M: Model> Augmented<M> {
    /// φ with zero multipliers and penalty 1. `None` where rows are so dense that their outer products do not fit.
    pub fn new(model: M) -> Option<Self> {
        let inner = model.meta();
        if needed_products(inner) > MOST_PRODUCTS {
            return None;
        }
        let mut positions: Vec<(u32, u32)> = inner.hessian.iter().map(|(row, column)| (row as u32, column as u32)).collect();
        for row in 0..inner.rows() {
            positions.extend(products(inner.jacobian.row(row)));
        }
        let hessian = Pattern::from_positions(inner.variables(), &mut positions);
        let places = Places::find(inner, &hessian);
        let meta = Meta {
            lower: inner.lower.clone(),
            upper: inner.upper.clone(),
            start: inner.start.clone(),
            typical: inner.typical.clone(),
            hessian,
            curvature: inner.curvature,
            extra_work: inner.extra_work,
            names: inner.names.clone(),
            ..Meta::default()
        };
        Some(Augmented { multipliers: vec![0.0; inner.rows()], penalty: 1.0, model, meta, places })
    }

    /// The model itself.
    pub fn model(&self) -> &M {
        &self.model
    }

    /// Sets y (length m) and ρ > 0.
    pub fn set(&mut self, multipliers: &[f64], penalty: f64) {
        self.multipliers.copy_from_slice(multipliers);
        self.penalty = penalty;
    }

    /// ρ·(t − s) from c(x): the next estimate of the multipliers.
    pub fn next_multipliers(&self, rows: &[f64]) -> Vec<f64> {
        let meta = self.model.meta();
        let estimate = |(i, &value): (usize, &f64)| {
            let shifted = value + self.multipliers[i] / self.penalty;
            self.penalty * (shifted - within(shifted, meta.row_lower[i], meta.row_upper[i]))
        };
        rows.iter().enumerate().map(estimate).collect()
    }

    fn penalised(&self, objective: f64, estimate: &[f64]) -> f64 {
        objective + estimate.iter().map(|y| y * y).sum::<f64>() / (2.0 * self.penalty)
    }
}

/// The lower triangle of k·kᵀ for the ascending columns of a row.
fn products(columns: &[u32]) -> impl Iterator<Item = (u32, u32)> + '_ {
    columns.iter().enumerate().flat_map(move |(at, &row)| columns[..=at].iter().map(move |&column| (row, column)))
}

impl Places {
    fn find(inner: &Meta, union: &Pattern) -> Self {
        // Every position asked for was put into the union.
        let place = |(row, column): (u32, u32)| union.position(row as usize, column).unwrap_or_default() as u32;
        let hessian = inner.hessian.iter().map(|(row, column)| place((row as u32, column as u32))).collect();
        let products = (0..inner.rows()).flat_map(|row| products(inner.jacobian.row(row)).map(place)).collect();
        Places { hessian, products }
    }
}

impl<M: Model> Model for Augmented<M> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        Ok(Box::new(AugmentedAt { view: self, inner: self.model.at(x)?, estimate: None }))
    }
}

/// φ at one point.
struct AugmentedAt<'m, M> {
    view: &'m Augmented<M>,
    inner: Box<dyn Evaluation + 'm>,
    /// The next estimate of the multipliers, from the rows.
    estimate: Option<Vec<f64>>,
}

impl<M: Model> AugmentedAt<'_, M> {
    fn estimate(&mut self) -> Result<Vec<f64>, EvaluationError> {
        if let Some(known) = &self.estimate {
            return Ok(known.clone());
        }
        let mut rows = vec![0.0; self.view.model.meta().rows()];
        if !rows.is_empty() {
            self.inner.constraints(&mut rows)?;
        }
        let estimate = self.view.next_multipliers(&rows);
        self.estimate = Some(estimate.clone());
        Ok(estimate)
    }
}

impl<M: Model> Evaluation for AugmentedAt<'_, M> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        let estimate = self.estimate()?;
        Ok(self.view.penalised(self.inner.objective()?, &estimate))
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let pattern = &self.view.model.meta().jacobian;
        let estimate = self.estimate()?;
        let value = self.view.penalised(self.inner.gradient(gradient)?, &estimate);
        let mut jacobian = vec![0.0; pattern.len()];
        self.inner.jacobian(&mut jacobian)?;
        pattern.add_transposed(&jacobian, &estimate, gradient);
        Ok(value)
    }

    fn constraints(&mut self, _values: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn jacobian(&mut self, _values: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn hessian(&mut self, weight: f64, _y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let Augmented { model, places, penalty, .. } = self.view;
        let meta = model.meta();
        let estimate: Vec<f64> = self.estimate()?.into_iter().map(|y| weight * y).collect();
        let mut own = vec![0.0; meta.hessian.len()];
        self.inner.hessian(weight, &estimate, &mut own)?;
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        self.inner.jacobian(&mut jacobian)?;
        values.fill(0.0);
        for (&place, value) in places.hessian.iter().zip(&own) {
            values[place as usize] += value;
        }
        let mut places = places.products.iter();
        for (row, &y) in estimate.iter().enumerate() {
            let entries = &jacobian[meta.jacobian.range(row)];
            let places = places.by_ref().take(entries.len() * (entries.len() + 1) / 2);
            let curvature = if y == 0.0 { 0.0 } else { weight * penalty };
            let pairs =
                entries.iter().enumerate().flat_map(|(at, first)| entries[..=at].iter().map(move |second| first * second));
            places.zip(pairs).for_each(|(&place, product)| values[place as usize] += curvature * product);
        }
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let view = self.view;
        product_by_entries(self, &view.meta.hessian, (weight, y), direction, product)
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::sample::Sample;

    /// An equality, both sides of a range, and a row that is not active.
    fn model() -> Sample {
        Sample::new(&[1.0; 3], |x| x[0].powi(2) * x[1] + x[2].sin())
            .bounds(&[-9.0; 3], &[9.0; 3])
            .row(1.0, 1.0, |x| x[0] * x[1])
            .row(f64::NEG_INFINITY, 2.0, |x| x[1].exp() + x[2])
            .row(0.5, 3.0, |x| x[0] - x[2] * x[2])
            .row(f64::NEG_INFINITY, 50.0, |x| x[2] * x[0])
    }

    #[test]
    fn derivatives_agree_with_differences() {
        let mut augmented = Augmented::new(model()).unwrap();
        augmented.set(&[0.3, 1.2, -0.8, 0.0], 7.0);
        let (x, step) = ([0.7, 1.1, 0.9], 1e-6);
        let gradient = |x: &[f64]| {
            let mut gradient = vec![0.0; 3];
            augmented.gradient(x, &mut gradient).unwrap();
            gradient
        };
        let mut hessian = vec![0.0; augmented.meta().hessian.len()];
        augmented.hessian(&x, 2.0, &[], &mut hessian).unwrap();
        for j in 0..3 {
            let (mut ahead, mut behind) = (x, x);
            ahead[j] += step;
            behind[j] -= step;
            let slope = (augmented.objective(&ahead).unwrap() - augmented.objective(&behind).unwrap()) / (2.0 * step);
            assert!((slope - gradient(&x)[j]).abs() < 1e-7 * slope.abs().max(1.0));
            for i in j..3 {
                let curvature = (gradient(&ahead)[i] - gradient(&behind)[i]) / (2.0 * step);
                let exact = hessian[augmented.meta().hessian.position(i, j as u32).unwrap()];
                assert!((2.0 * curvature - exact).abs() < 1e-6 * exact.abs().max(1.0), "{i} {j}");
            }
        }
    }

    #[test]
    fn multipliers_take_the_sign_of_the_side() {
        let mut augmented = Augmented::new(model()).unwrap();
        augmented.set(&[0.0; 4], 10.0);
        assert_eq!(augmented.next_multipliers(&[0.5, 3.0, 0.25, 7.0]), [-5.0, 10.0, -2.5, 0.0]);
    }
}
