//! One Newton step of the barrier problem, slacks and rows eliminated: a matrix of the order of the variables.
//!
//! ```text
//! (W + Σ_x + δ + Aᵀ Σ_s A)·dx = −∇φ_x − Aᵀ(∇φ_s + Σ_s·(c − s))      ds = A·dx + (c − s)      y⁺ = Σ_s·ds + ∇φ_s
//! ```
//! The matrix is positive definite exactly where the whole KKT matrix has the inertia of a minimum: there are no equalities.

use super::arena::ComponentIterate;
use super::barrier::{distances, force};
use super::frame::Frame;
use super::parameters::PARAMETERS;
use crate::linear_algebra::cholesky;

/// Room for one step; one per thread.
#[derive(Default)]
pub(super) struct Newton {
    /// Step of w and of the bounds' multipliers.
    pub w: Vec<f64>,
    pub z_lower: Vec<f64>,
    pub z_upper: Vec<f64>,
    /// The rows' multipliers after a full step.
    pub y: Vec<f64>,
    /// ∇φ, for w.
    pub slope: Vec<f64>,
    sigma: Vec<f64>,
    matrix: Vec<f64>,
    factor: Vec<f64>,
}

impl Newton {
    /// Computes the step at the component's iterate, derivatives being in the frame. `false`: no regularisation helps.
    pub fn compute(&mut self, frame: &Frame<'_>, iterate: &mut ComponentIterate<'_>) -> bool {
        self.barrier_terms(frame, iterate);
        self.condense(frame);
        let last = iterate.header.regularisation;
        let mut delta = 0.0;
        // Where the matrix is all but singular the step is endless, and of no more use than where it is indefinite.
        while !(self.factorise(frame.n, delta) && self.solve(frame, iterate)) {
            delta = if delta == 0.0 { PARAMETERS.inertia.begin(last) } else { delta * PARAMETERS.inertia.growth(last) };
            if delta > PARAMETERS.inertia.largest {
                return false;
            }
            iterate.header.regularisation = delta;
        }
        self.multiplier_steps(frame, iterate);
        true
    }

    fn barrier_terms(&mut self, frame: &Frame<'_>, iterate: &ComponentIterate<'_>) {
        self.slope.clear();
        self.sigma.clear();
        for (at, &w) in iterate.w.iter().enumerate() {
            let (below, above) = distances(w, frame.lower[at], frame.upper[at]);
            let mu = iterate.header.mu;
            let own = frame.gradient.get(at).copied().unwrap_or(0.0);
            self.slope.push(own - force(mu, below) + force(mu, above));
            self.sigma.push(force(iterate.z_lower[at], below) + force(iterate.z_upper[at], above));
        }
    }

    fn condense(&mut self, frame: &Frame<'_>) {
        let n = frame.n;
        self.matrix.clear();
        self.matrix.extend_from_slice(&frame.hessian);
        for j in 0..n {
            self.matrix[j * n + j] += self.sigma[j];
        }
        for (row, &sigma) in frame.jacobian.chunks_exact(n.max(1)).zip(&self.sigma[n..]) {
            for (j, &slope) in row.iter().enumerate().filter(|(_, slope)| **slope != 0.0) {
                let factor = sigma * slope;
                for (entry, other) in self.matrix[j * n..=j * n + j].iter_mut().zip(row) {
                    *entry += factor * other;
                }
            }
        }
        for j in (0..n).filter(|&j| frame.lower[j] == frame.upper[j]) {
            self.hold(n, j);
        }
    }

    /// Takes a fixed variable out.
    fn hold(&mut self, n: usize, j: usize) {
        for k in 0..n {
            self.matrix[j.max(k) * n + j.min(k)] = 0.0;
        }
        self.matrix[j * n + j] = 1.0;
    }

    fn factorise(&mut self, n: usize, delta: f64) -> bool {
        self.factor.clear();
        self.factor.extend_from_slice(&self.matrix);
        for j in 0..n {
            self.factor[j * n + j] += delta;
        }
        cholesky::factor(&mut self.factor, n)
    }

    /// `false`: the step reaches too far.
    fn solve(&mut self, frame: &Frame<'_>, iterate: &ComponentIterate<'_>) -> bool {
        let n = frame.n;
        self.w.clear();
        self.w.extend(self.slope[..n].iter().map(|slope| -slope));
        let residual = |i: usize| frame.rows[i] - iterate.w[n + i];
        for (i, row) in frame.jacobian.chunks_exact(n.max(1)).enumerate() {
            let push = self.slope[n + i] + self.sigma[n + i] * residual(i);
            self.w.iter_mut().zip(row).for_each(|(right, slope)| *right -= slope * push);
        }
        for j in (0..n).filter(|&j| frame.lower[j] == frame.upper[j]) {
            self.w[j] = 0.0;
        }
        cholesky::solve(&self.factor, &mut self.w);
        if (0..n).any(|j| self.w[j].abs() > frame.reach(j, iterate.w[j])) {
            return false;
        }
        self.y.clear();
        for (i, row) in frame.jacobian.chunks_exact(n.max(1)).enumerate() {
            let step = row.iter().zip(&self.w).map(|(slope, dx)| slope * dx).sum::<f64>() + residual(i);
            self.y.push(self.sigma[n + i] * step + self.slope[n + i]);
            self.w.push(step);
        }
        true
    }

    fn multiplier_steps(&mut self, frame: &Frame<'_>, iterate: &ComponentIterate<'_>) {
        self.z_lower.clear();
        self.z_upper.clear();
        for (at, &step) in self.w.iter().enumerate() {
            let (below, above) = distances(iterate.w[at], frame.lower[at], frame.upper[at]);
            let mu = iterate.header.mu;
            let (lower, upper) = (iterate.z_lower[at], iterate.z_upper[at]);
            self.z_lower.push(force(mu - lower * step, below) - lower);
            self.z_upper.push(force(mu + upper * step, above) - upper);
        }
    }
}
