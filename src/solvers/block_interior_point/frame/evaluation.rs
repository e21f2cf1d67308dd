//! Values and derivatives of a component, scaled.

use super::super::arena::Header;
use super::{Frame, outward};

impl<'m> Frame<'m> {
    pub(super) fn place(&mut self, w: &[f64]) {
        for (((x, slope), w), &d) in self.x.iter_mut().zip(&mut self.slopes).zip(w).zip(&self.d) {
            *x = outward(d, *w);
            *slope = if d == 0.0 { *x } else { d };
        }
    }

    /// Scaled rows from `natural_rows`.
    pub(super) fn scale_rows(&mut self, row_scale: &[f64]) {
        let natural = self.natural_rows.iter().zip(&self.logarithmic_rows);
        for ((row, scale), (value, &logarithmic)) in self.rows.iter_mut().zip(row_scale).zip(natural) {
            *row = scale * if logarithmic { value.ln() } else { *value };
        }
    }

    /// Scaled f and rows at w. `false`: some are no numbers.
    pub fn values(&mut self, w: &[f64], header: &mut Header, row_scale: &[f64]) -> bool {
        self.place(w);
        header.evaluations += 1;
        let natural = self.local.values(&self.x, &mut self.natural_rows);
        self.objective = header.scaled(natural).0;
        self.scale_rows(row_scale);
        self.objective.is_finite() && self.rows.iter().all(|row| row.is_finite())
    }

    /// Values and first derivatives at w, scaled. `false`: some are no numbers.
    pub fn first_order(&mut self, w: &[f64], header: &mut Header, row_scale: &[f64]) -> bool {
        self.place(w);
        header.evaluations += 1;
        header.objective = self.local.first_order(&self.x, &mut self.natural_rows, &mut self.gradient, &mut self.jacobian);
        let (objective, weight) = header.scaled(header.objective);
        self.objective = objective;
        self.scale_rows(row_scale);
        for (gradient, slope) in self.gradient.iter_mut().zip(&self.slopes) {
            *gradient *= slope * weight;
        }
        for (i, jacobian) in self.jacobian.chunks_exact_mut(self.n.max(1)).enumerate() {
            let scale = if self.logarithmic_rows[i] { row_scale[i] / self.natural_rows[i] } else { row_scale[i] };
            jacobian.iter_mut().zip(&self.slopes).for_each(|(entry, slope)| *entry *= slope * scale);
        }
        let finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        self.objective.is_finite() && finite(&self.rows) && finite(&self.gradient) && finite(&self.jacobian)
    }

    /// The Lagrangian's Hessian at w, scaled, first derivatives there being known. `false`: some entries are no numbers.
    pub fn second_order(&mut self, y: &[f64], header: &Header, row_scale: &[f64]) -> bool {
        let n = self.n;
        for (i, weight) in self.weights.iter_mut().enumerate() {
            let scale = y[i] * row_scale[i];
            *weight = if self.logarithmic_rows[i] { scale / self.natural_rows[i] } else { scale };
        }
        self.local.hessian(&self.x, header.scaled(header.objective).1, &self.weights, &mut self.hessian);
        for (i, row) in self.hessian.chunks_exact_mut(n.max(1)).enumerate() {
            row.iter_mut().zip(&self.slopes[..=i]).for_each(|(entry, slope)| *entry *= self.slopes[i] * slope);
        }
        self.add_bends(y, header, row_scale);
        (0..n).all(|i| self.hessian[i * n..=i * n + i].iter().all(|entry| entry.is_finite()))
    }

    /// What the logarithms bend by themselves: diag(∂L/∂w) where x = exp(w), −∇ĉ∇ĉᵀ of logarithmic rows and objective.
    pub(super) fn add_bends(&mut self, y: &[f64], header: &Header, row_scale: &[f64]) {
        let n = self.n;
        for j in (0..n).filter(|&j| self.d[j] == 0.0) {
            let pull: f64 = y.iter().enumerate().map(|(i, y)| y * self.jacobian[i * n + j]).sum();
            self.hessian[j * n + j] += self.gradient[j] + pull;
        }
        let rows = self.jacobian.chunks_exact(n.max(1)).enumerate().filter(|&(i, _)| self.logarithmic_rows[i] && y[i] != 0.0);
        for (i, row) in rows {
            subtract_square(&mut self.hessian, y[i] / row_scale[i], row);
        }
        if header.logarithmic {
            subtract_square(&mut self.hessian, 1.0 / header.objective_scale, &self.gradient);
        }
    }
}

/// Subtracts weight·vvᵀ from a lower triangle.
pub(super) fn subtract_square(matrix: &mut [f64], weight: f64, v: &[f64]) {
    let n = v.len();
    for (j, &own) in v.iter().enumerate().filter(|(_, own)| **own != 0.0) {
        let factor = weight * own;
        for (entry, other) in matrix[j * n..=j * n + j].iter_mut().zip(v) {
            *entry -= factor * other;
        }
    }
}
