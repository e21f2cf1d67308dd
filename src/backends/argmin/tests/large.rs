//! A chain of many variables, each coupled to its neighbour only: time and memory must grow with n, not n².

use super::{solve, violation};
use crate::backends::Termination;
use crate::model::{EvaluationError, Meta, Model, Pattern};

/// min Σ a_i/x_i + x_i + 0.1·x_i·x_{i+1}, 0.1 ≤ x ≤ 10, x_i²·x_{i+1} ≥ 1.
struct Chain {
    meta: Meta,
}

impl Chain {
    fn new(n: usize) -> Self {
        let (mut rows, mut lower) = (Vec::new(), Vec::new());
        for i in 0..n as u32 {
            lower.push((i, i));
            if i > 0 {
                lower.push((i, i - 1));
                rows.extend([(i - 1, i - 1), (i - 1, i)]);
            }
        }
        Chain {
            meta: Meta {
                lower: vec![0.1; n],
                upper: vec![10.0; n],
                start: vec![3.0; n],
                typical: vec![3.0; n],
                row_lower: vec![1.0; n - 1],
                row_upper: vec![f64::INFINITY; n - 1],
                row_is_linear: vec![false; n - 1],
                objective_is_linear: false,
                jacobian: Pattern::from_positions(n - 1, &mut rows),
                hessian: Pattern::from_positions(n, &mut lower),
                ..Meta::default()
            },
        }
    }

    fn coefficient(i: usize) -> f64 {
        0.3 + (i % 7) as f64
    }
}

impl Model for Chain {
    fn meta(&self) -> &Meta {
        &self.meta
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        let own: f64 = x.iter().enumerate().map(|(i, x)| Self::coefficient(i) / x + x).sum();
        Ok(own + 0.1 * x.windows(2).map(|pair| pair[0] * pair[1]).sum::<f64>())
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        for (i, gradient) in gradient.iter_mut().enumerate() {
            let neighbours = if i > 0 { x[i - 1] } else { 0.0 } + x.get(i + 1).copied().unwrap_or(0.0);
            *gradient = 1.0 - Self::coefficient(i) / (x[i] * x[i]) + 0.1 * neighbours;
        }
        self.objective(x)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        values.iter_mut().zip(x.windows(2)).for_each(|(value, pair)| *value = pair[0] * pair[0] * pair[1]);
        Ok(())
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for (values, pair) in values.chunks_exact_mut(2).zip(x.windows(2)) {
            values.copy_from_slice(&[2.0 * pair[0] * pair[1], pair[0] * pair[0]]);
        }
        Ok(())
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        for i in 0..x.len() {
            let diagonal = self.meta.hessian.offsets[i + 1] - 1;
            values[diagonal] = weight * 2.0 * Self::coefficient(i) / x[i].powi(3);
            if let (Some(y), Some(next)) = (y.get(i), x.get(i + 1)) {
                values[diagonal] += y * 2.0 * next;
            }
            if i > 0 {
                values[diagonal - 1] = 0.1 * weight + y[i - 1] * 2.0 * x[i - 1];
            }
        }
        Ok(())
    }
}

/// From 1000 variables on steps are taken without a line search first: another way to the same answer.
#[test]
fn one_variable_more_that_makes_a_problem_large_changes_nothing() {
    let [small, large] = [999, 1000].map(|size| solve(&Chain::new(size)));
    assert_eq!((small.termination, large.termination), (Termination::Converged, Termination::Converged));
    // What happens at the chain's end is felt a few links on, and no further.
    let apart = small.x.iter().zip(&large.x).take(900).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(apart < 1e-7, "{apart}");
}

#[test]
fn ten_thousand_variables() {
    let size = std::env::var("RIBOPT_CHAIN").ok().and_then(|size| size.parse().ok()).unwrap_or(10_000);
    let model = Chain::new(size);
    let solution = solve(&model);
    assert_eq!(solution.termination, Termination::Converged, "{}", solution.message);
    assert!(solution.iterations.is_some_and(|iterations| iterations < 60), "{:?}", solution.iterations);
    assert!(violation(&model, &solution.x) < 1e-10);
    println!("{:?} iterations, {:.2} s, {}", solution.iterations, solution.seconds, solution.message);
}
