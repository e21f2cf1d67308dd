//! A model in other units: variables x = D·w, objective f/σ, rows c_i/s_i.
//!
//! Every scale is a power of two, so that scaling and unscaling are exact: a bound stays that very bound, and a point
//! goes there and back bit for bit.

use crate::model::domain::valid_near;
use crate::model::{Evaluation, EvaluationError, Meta, Model};

/// The factors of a [`Scaled`] model, all positive and finite.
#[derive(Debug, Clone, PartialEq)]
pub struct Scales {
    /// D: x_j = d_j·w_j. Length n.
    pub variables: Vec<f64>,
    /// σ: the scaled objective is f/σ.
    pub objective: f64,
    /// s: the scaled rows are c_i/s_i. Length m.
    pub rows: Vec<f64>,
}

impl Scales {
    /// All ones.
    pub fn unit(meta: &Meta) -> Self {
        Scales { variables: vec![1.0; meta.variables()], objective: 1.0, rows: vec![1.0; meta.rows()] }
    }

    /// The scales of the certificate (docs/certificate.md) at x: d as given, σ = ‖D∇f(x)‖∞, s_i = max(|limit_i|, ‖D∇c_i(x)‖∞); 1 where that is 0.
    ///
    /// # Errors
    /// Those of the model at x.
    pub fn at(model: &dyn Model, x: &[f64], variables: Vec<f64>) -> Result<Self, EvaluationError> {
        let meta = model.meta();
        let variables: Vec<f64> = variables.into_iter().map(power_of_two).collect();
        let mut gradient = vec![0.0; meta.variables()];
        model.gradient(x, &mut gradient)?;
        let objective = gradient.iter().zip(&variables).fold(0.0, |largest: f64, (g, d)| largest.max((g * d).abs()));
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        model.jacobian(x, &mut jacobian)?;
        let rows = (0..meta.rows()).map(|row| power_of_two(row_scale(meta, row, &jacobian, &variables))).collect();
        Ok(Scales { variables, objective: power_of_two(objective), rows })
    }
}

/// `x` inside its bounds, moved into the domain where the model has no value or derivative at it, and the scales there for the units
/// that `variables` gives.
///
/// # Errors
/// The error at `x`, where no point was found.
pub fn valid_start(
    model: &dyn Model,
    x: &[f64],
    variables: impl Fn(&[f64]) -> Vec<f64>,
) -> Result<(Vec<f64>, Scales), EvaluationError> {
    let mut x = x.to_vec();
    model.meta().clamp(&mut x);
    match Scales::at(model, &x, variables(&x)) {
        Err(EvaluationError::Invalid { .. }) => {
            let x = valid_near(model, &x)?;
            let scales = Scales::at(model, &x, variables(&x))?;
            Ok((x, scales))
        }
        at_once => at_once.map(|scales| (x, scales)),
    }
}

fn row_scale(meta: &Meta, row: usize, jacobian: &[f64], variables: &[f64]) -> f64 {
    let limits = [meta.row_lower[row], meta.row_upper[row]];
    let limit = limits.into_iter().filter(|limit| limit.is_finite()).fold(0.0, |largest: f64, limit| largest.max(limit.abs()));
    meta.jacobian.range(row).fold(limit, |largest, at| {
        let column = meta.jacobian.columns[at] as usize;
        largest.max((jacobian[at] * variables[column]).abs())
    })
}

/// The power of two next to a magnitude; 1 for zero and for what is no finite number.
pub fn power_of_two(magnitude: f64) -> f64 {
    let magnitude = magnitude.abs();
    if magnitude > 0.0 && magnitude.is_finite() { magnitude.log2().round().clamp(-1000.0, 1000.0).exp2() } else { 1.0 }
}

/// The scaled model; see the module's page.
pub struct Scaled<'a> {
    model: &'a dyn Model,
    scales: Scales,
    meta: Meta,
}

impl<'a> Scaled<'a> {
    /// `model` in the units of `scales` (made for this model: lengths n and m).
    pub fn new(model: &'a dyn Model, scales: Scales) -> Self {
        let mut meta = model.meta().clone();
        for values in [&mut meta.lower, &mut meta.upper, &mut meta.start, &mut meta.typical] {
            divide(values, &scales.variables);
        }
        for limits in [&mut meta.row_lower, &mut meta.row_upper, &mut meta.row_constants] {
            divide(limits, &scales.rows);
        }
        Scaled { model, scales, meta }
    }

    /// The factors.
    pub fn scales(&self) -> &Scales {
        &self.scales
    }

    /// x = D·w
    pub fn unscaled_point(&self, w: &[f64]) -> Vec<f64> {
        w.iter().zip(&self.scales.variables).map(|(w, d)| w * d).collect()
    }

    /// w = x/D
    pub fn scaled_point(&self, x: &[f64]) -> Vec<f64> {
        x.iter().zip(&self.scales.variables).map(|(x, d)| x / d).collect()
    }

    /// Row multipliers of the model, from those of the scaled one: y_i = σ·y'_i/s_i.
    pub fn unscaled_multipliers(&self, y: &[f64]) -> Vec<f64> {
        y.iter().zip(&self.scales.rows).map(|(y, s)| self.scales.objective * y / s).collect()
    }

    /// Row multipliers of the scaled model, from the model's own.
    pub fn scaled_multipliers(&self, y: &[f64]) -> Vec<f64> {
        y.iter().zip(&self.scales.rows).map(|(y, s)| y * s / self.scales.objective).collect()
    }
}

fn divide(values: &mut [f64], divisors: &[f64]) {
    for (value, divisor) in values.iter_mut().zip(divisors) {
        *value /= divisor;
    }
}

impl Model for Scaled<'_> {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn at<'m>(&'m self, w: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        let inner = self.model.at(&self.unscaled_point(w))?;
        Ok(Box::new(ScaledAt { scales: &self.scales, meta: &self.meta, inner }))
    }
}

/// One point in other units.
struct ScaledAt<'m> {
    scales: &'m Scales,
    meta: &'m Meta,
    inner: Box<dyn Evaluation + 'm>,
}

impl Evaluation for ScaledAt<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        Ok(self.inner.objective()? / self.scales.objective)
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        let value = self.inner.gradient(gradient)?;
        for (g, d) in gradient.iter_mut().zip(&self.scales.variables) {
            *g *= d / self.scales.objective;
        }
        Ok(value / self.scales.objective)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.constraints(values)?;
        divide(values, &self.scales.rows);
        Ok(())
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.inner.jacobian(values)?;
        for (value, (row, column)) in values.iter_mut().zip(self.meta.jacobian.iter()) {
            *value *= self.scales.variables[column] / self.scales.rows[row];
        }
        Ok(())
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        let mut y = y.to_vec();
        divide(&mut y, &self.scales.rows);
        self.inner.hessian(weight / self.scales.objective, &y, values)?;
        for (value, (row, column)) in values.iter_mut().zip(self.meta.hessian.iter()) {
            *value *= self.scales.variables[row] * self.scales.variables[column];
        }
        Ok(())
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        let mut y = y.to_vec();
        divide(&mut y, &self.scales.rows);
        let inner: Vec<f64> = direction.iter().zip(&self.scales.variables).map(|(v, d)| v * d).collect();
        self.inner.hessian_product(weight / self.scales.objective, &y, &inner, product)?;
        product.iter_mut().zip(&self.scales.variables).for_each(|(value, d)| *value *= d);
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::sample::Sample;

    fn model() -> Sample {
        Sample::new(&[1e3, 1e-3], |x| x[0].powi(3) * x[1] + x[1].exp())
            .bounds(&[0.0, -1.0], &[1e4, 2.0])
            .row(f64::NEG_INFINITY, 1e-4, |x| x[0] * x[1].powi(2))
            .row(3.0, 80.0, |x| x[0].sqrt())
    }

    fn scaled(model: &Sample) -> Scaled<'_> {
        let start = model.meta().start.clone();
        Scaled::new(model, Scales::at(model, &start, start.clone()).unwrap())
    }

    #[test]
    fn points_go_there_and_back_bit_for_bit() {
        let model = model();
        let scaled = scaled(&model);
        let x = [17.3, 0.1];
        assert_eq!(scaled.unscaled_point(&scaled.scaled_point(&x)), x);
        assert_eq!(scaled.unscaled_point(&scaled.meta().upper), model.meta().upper);
        let y = [0.3, -7.0];
        assert_eq!(scaled.unscaled_multipliers(&scaled.scaled_multipliers(&y)), y);
    }

    #[test]
    fn the_largest_derivatives_at_the_start_are_near_one() {
        let model = model();
        let scaled = scaled(&model);
        let mut gradient = [0.0; 2];
        scaled.gradient(&scaled.meta().start.clone(), &mut gradient).unwrap();
        let largest = gradient[0].abs().max(gradient[1].abs());
        assert!((0.3..3.0).contains(&largest), "{largest}");
    }

    /// Each derivative against central differences of the one before it.
    #[test]
    fn derivatives_agree_with_differences() {
        let model = model();
        let scaled = scaled(&model);
        let (w, y, step) = ([0.9, 1.2], [0.7, -0.4], 1e-6);
        let lagrangian_gradient = |w: &[f64]| {
            let (mut gradient, mut jacobian) = (vec![0.0; 2], vec![0.0; 4]);
            scaled.gradient(w, &mut gradient).unwrap();
            scaled.jacobian(w, &mut jacobian).unwrap();
            scaled.meta().jacobian.add_transposed(&jacobian, &y, &mut gradient);
            gradient
        };
        let lagrangian = |w: &[f64]| {
            let mut rows = [0.0; 2];
            scaled.constraints(w, &mut rows).unwrap();
            scaled.objective(w).unwrap() + y[0] * rows[0] + y[1] * rows[1]
        };
        let mut hessian = [0.0; 3];
        scaled.hessian(&w, 1.0, &y, &mut hessian).unwrap();
        for j in 0..2 {
            let (mut ahead, mut behind) = (w, w);
            ahead[j] += step;
            behind[j] -= step;
            let difference = (lagrangian(&ahead) - lagrangian(&behind)) / (2.0 * step);
            assert!((difference - lagrangian_gradient(&w)[j]).abs() < 1e-6);
            let second = (lagrangian_gradient(&ahead)[1] - lagrangian_gradient(&behind)[1]) / (2.0 * step);
            assert!((second - hessian[1 + j]).abs() < 1e-6);
        }
    }

    #[test]
    fn nothing_scales_zero() {
        assert_eq!(power_of_two(0.0), 1.0);
        assert_eq!(power_of_two(f64::INFINITY), 1.0);
        assert_eq!(power_of_two(-1000.0), 1024.0);
    }
}
