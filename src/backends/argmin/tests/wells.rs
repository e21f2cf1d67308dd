//! Many coupled double wells: large, and bent the wrong way at the start, where unguarded steps would lead to a maximum.

use super::solve;
use crate::backends::Termination;
use crate::model::{EvaluationError, Meta, Model, Pattern};

/// min Σ (x_i² − 1)² + 0.05·x_i·x_{i+1} + 0.01·x_i, −2 ≤ x ≤ 2.
struct Wells {
    meta: Meta,
}

impl Wells {
    fn new(n: usize, start: f64) -> Self {
        let mut lower = (0..n as u32).flat_map(|i| (i.saturating_sub(1)..=i).map(move |j| (i, j))).collect();
        let hessian = Pattern::from_positions(n, &mut lower);
        let meta = Meta { lower: vec![-2.0; n], upper: vec![2.0; n], start: vec![start; n], hessian, ..Meta::default() };
        Wells { meta }
    }
}

impl Model for Wells {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        let own: f64 = x.iter().map(|x| (x * x - 1.0).powi(2) + 0.01 * x).sum();
        Ok(own + 0.05 * x.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>())
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        for (i, gradient) in gradient.iter_mut().enumerate() {
            let before = if i > 0 { x[i - 1] } else { 0.0 };
            let neighbours = before + x.get(i + 1).copied().unwrap_or(0.0);
            *gradient = 4.0 * x[i] * (x[i] * x[i] - 1.0) + 0.01 + 0.05 * neighbours;
        }
        self.objective(x)
    }

    fn constraints(&self, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn jacobian(&self, _: &[f64], _: &mut [f64]) -> Result<(), EvaluationError> {
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, _: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (value, (i, j)) in values.iter_mut().zip(self.meta.hessian.iter()) {
            *value = weight * if i == j { 12.0 * x[i] * x[i] - 4.0 } else { 0.05 };
        }
        Ok(())
    }
}

#[test]
fn every_variable_ends_in_a_well() {
    // Convex there, bent downwards there, and almost at the maximum.
    for start in [1.4, 0.3, 1e-3] {
        let model = Wells::new(1500, start);
        let solution = solve(&model);
        assert_eq!(solution.termination, Termination::Converged, "{start}: {}", solution.message);
        let mut gradient = vec![0.0; 1500];
        model.gradient(&solution.x, &mut gradient).unwrap();
        assert!(gradient.iter().all(|slope| slope.abs() < 1e-6), "{start}");
        assert!(solution.x.iter().all(|x| (x.abs() - 1.0).abs() < 0.05), "{start}: some variable is in no well");
    }
}
