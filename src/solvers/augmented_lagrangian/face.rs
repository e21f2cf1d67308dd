//! A bounds-only model seen from the face of its box on which some variables rest: what the trust region minimises.

use crate::math::within;
use crate::model::{EvaluationError, Model, Pattern};

/// The model over its free variables. Points outside the box count as their projection, so that bounds hold in every
/// evaluation; a projected variable has no derivative.
pub(super) struct Face<'a> {
    model: &'a dyn Model,
    free: Vec<usize>,
    base: Vec<f64>,
}

impl<'a> Face<'a> {
    /// The face through x on which the variables rest that are at a bound and pushed against it by the gradient.
    pub fn through(model: &'a dyn Model, x: &[f64], gradient: &[f64]) -> Self {
        let free = (0..x.len()).filter(|&j| projected(model, x, gradient, j) != 0.0 || is_inside(model, x, j));
        Face { free: free.collect(), base: x.to_vec(), model }
    }

    /// The free variables of the point the face was made through.
    pub fn origin(&self) -> Vec<f64> {
        self.free.iter().map(|&j| self.base[j]).collect()
    }

    /// All variables, inside the box.
    pub fn complete(&self, w: &[f64]) -> Vec<f64> {
        let meta = self.model.meta();
        let mut x = self.base.clone();
        for (&j, &value) in self.free.iter().zip(w) {
            x[j] = within(value, meta.lower[j], meta.upper[j]);
        }
        x
    }

    /// Whether any free variable has left the box.
    pub fn is_left(&self, w: &[f64]) -> bool {
        let meta = self.model.meta();
        self.free.iter().zip(w).any(|(&j, &value)| value < meta.lower[j] || value > meta.upper[j])
    }

    fn is_outside(&self, at: usize, w: &[f64]) -> bool {
        let (meta, j) = (self.model.meta(), self.free[at]);
        w[at] < meta.lower[j] || w[at] > meta.upper[j]
    }

    /// φ; +∞ where it has no value, which makes the trust region shorten this trial step. Never an answer.
    pub fn value(&self, w: &[f64]) -> Result<f64, EvaluationError> {
        match self.model.objective(&self.complete(w)) {
            Err(EvaluationError::Invalid { .. }) => Ok(f64::INFINITY),
            other => other,
        }
    }

    /// ∇φ over the free variables.
    pub fn gradient(&self, w: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        let mut all = vec![0.0; self.base.len()];
        self.model.gradient(&self.complete(w), &mut all)?;
        Ok(self.free.iter().enumerate().map(|(at, &j)| if self.is_outside(at, w) { 0.0 } else { all[j] }).collect())
    }

    /// ∇²φ over the free variables.
    pub fn hessian(&self, w: &[f64]) -> Result<FaceHessian, EvaluationError> {
        let pattern = &self.model.meta().hessian;
        let mut values = vec![0.0; pattern.len()];
        self.model.hessian(&self.complete(w), 1.0, &[], &mut values)?;
        let mut position = vec![u32::MAX; self.base.len()];
        for (at, &j) in self.free.iter().enumerate() {
            if !self.is_outside(at, w) {
                position[j] = at as u32;
            }
        }
        Ok(FaceHessian::new(pattern, &values, &position))
    }
}

fn is_inside(model: &dyn Model, x: &[f64], j: usize) -> bool {
    x[j] > model.meta().lower[j] && x[j] < model.meta().upper[j]
}

/// The gradient's entry, or 0 where it only pushes x_j against a bound it rests on.
fn projected(model: &dyn Model, x: &[f64], gradient: &[f64], j: usize) -> f64 {
    let meta = model.meta();
    let held = (x[j] <= meta.lower[j] && gradient[j] > 0.0) || (x[j] >= meta.upper[j] && gradient[j] < 0.0);
    if held { 0.0 } else { gradient[j] }
}

/// ‖projected gradient‖∞
pub(super) fn stationarity(model: &dyn Model, x: &[f64], gradient: &[f64]) -> f64 {
    (0..x.len()).fold(0.0, |largest, j| largest.max(projected(model, x, gradient, j).abs()))
}

/// ∇²φ on a face: its lower triangle by entries (row, column, value).
pub(super) struct FaceHessian(Vec<(u32, u32, f64)>);

impl FaceHessian {
    fn new(pattern: &Pattern, values: &[f64], position: &[u32]) -> Self {
        let entries = pattern.iter().zip(values).map(|((row, column), &value)| (position[row], position[column], value));
        FaceHessian(entries.filter(|&(row, column, value)| row != u32::MAX && column != u32::MAX && value != 0.0).collect())
    }

    /// ∇²φ·direction
    pub fn times(&self, direction: &[f64]) -> Vec<f64> {
        let mut product = vec![0.0; direction.len()];
        for &(row, column, value) in &self.0 {
            let (row, column) = (row as usize, column as usize);
            product[row] += value * direction[column];
            if row != column {
                product[column] += value * direction[row];
            }
        }
        product
    }
}
