//! From a point of the barrier's path to the minimum itself: Newton's method on the limits that seem active.
//!
//! Each step solves the KKT system [W Aᵀ; A −δI] over the free variables by P = W + AᵀA/ε, positive definite where (for small ε)
//! the minimum is strict, and the Schur complement A·P⁻¹·Aᵀ + δI. δ tames dependent limits without moving the fixed point.

use super::arena::ComponentIterate;
use super::barrier::distances;
use super::frame::Frame;
use super::parameters::PARAMETERS;
use crate::linear_algebra::cholesky;
use crate::math::within;
use crate::solvers::barrier::BoundState;

/// A thread's room.
#[derive(Default)]
pub(super) struct Crossover {
    /// The residual reached.
    pub error: f64,
    sides: Vec<BoundState>,
    free: Vec<usize>,
    held: Vec<usize>,
    w: Vec<f64>,
    y: Vec<f64>,
    residual: Vec<f64>,
    matrix: Vec<f64>,
    step: Vec<f64>,
    /// P⁻¹Aᵀ, a row per limit.
    spread: Vec<f64>,
    schur: Vec<f64>,
    moves: Vec<f64>,
}

impl Crossover {
    /// Tries the active set the component's multipliers suggest. `true`: the iterate is at a minimum now, to rounding.
    pub fn attempt(&mut self, frame: &mut Frame<'_>, iterate: &mut ComponentIterate<'_>) -> bool {
        self.guess(frame, iterate);
        if !self.converge(frame, iterate) || !self.is_inside(frame) || !self.has_right_signs(frame) {
            return false;
        }
        iterate.header.step = iterate.w.iter().zip(&self.w).take(frame.n).map(|(old, new)| (new - old).powi(2)).sum();
        iterate.w.copy_from_slice(&self.w);
        iterate.y.copy_from_slice(&self.y);
        true
    }

    fn guess(&mut self, frame: &Frame<'_>, iterate: &ComponentIterate<'_>) {
        let side = |at: usize| {
            let (lower, upper) = (frame.lower[at], frame.upper[at]);
            let (below, above) = distances(iterate.w[at], lower, upper);
            match (lower == upper || iterate.z_lower[at] > below, iterate.z_upper[at] > above) {
                (true, _) => BoundState::Lower,
                (_, true) => BoundState::Upper,
                _ => BoundState::Free,
            }
        };
        self.sides.clear();
        self.sides.extend((0..iterate.w.len()).map(side));
        self.free.clear();
        self.free.extend((0..frame.n).filter(|&j| self.sides[j] == BoundState::Free));
        self.held.clear();
        self.held.extend((0..frame.m).filter(|&i| self.sides[frame.n + i] != BoundState::Free));
        self.w.clear();
        self.w.extend((0..iterate.w.len()).map(|at| match self.sides[at] {
            BoundState::Free => iterate.w[at],
            BoundState::Lower => frame.lower[at],
            BoundState::Upper => frame.upper[at],
        }));
        self.y.clear();
        self.y.extend((0..frame.m).map(|i| if self.sides[frame.n + i] == BoundState::Free { 0.0 } else { iterate.y[i] }));
    }

    fn converge(&mut self, frame: &mut Frame<'_>, iterate: &mut ComponentIterate<'_>) -> bool {
        let mut last = f64::INFINITY;
        for _ in 0..PARAMETERS.crossover_steps {
            if !frame.first_order(&self.w, iterate.header, iterate.row_scale) {
                return false;
            }
            self.error = self.assess(frame);
            if self.error <= PARAMETERS.exact || (self.error <= PARAMETERS.accepted && self.error > 0.5 * last) {
                return self.free.is_empty() || last < f64::INFINITY || self.has_positive_curvature(frame, iterate);
            }
            if self.error.is_nan() || self.error >= last || !self.has_positive_curvature(frame, iterate) {
                return false;
            }
            last = self.error;
            if !self.advance(frame) {
                return false;
            }
        }
        false
    }

    /// Residuals ∇L over the free variables; returns the largest, rows included, relative to the multipliers.
    fn assess(&mut self, frame: &Frame<'_>) -> f64 {
        let n = frame.n;
        self.residual.clear();
        for &j in &self.free {
            let pull: f64 = self.held.iter().map(|&i| self.y[i] * frame.jacobian[i * n + j]).sum();
            self.residual.push(frame.gradient[j] + pull);
        }
        let rows = self.held.iter().map(|&i| frame.rows[i] - self.w[n + i]);
        let size = self.y.iter().fold(1.0, |most: f64, y| most.max(y.abs()));
        let dual = self.residual.iter().fold(0.0, |most: f64, r| most.max(r.abs())) / size;
        rows.fold(dual, |most, gap| most.max(gap.abs()))
    }

    /// Factorises W + AᵀA/ε over the free variables.
    fn has_positive_curvature(&mut self, frame: &mut Frame<'_>, iterate: &ComponentIterate<'_>) -> bool {
        if !frame.second_order(&self.y, iterate.header, iterate.row_scale) {
            return false;
        }
        let (n, size) = (frame.n, self.free.len());
        self.matrix.clear();
        self.matrix.resize(size * size, 0.0);
        for (a, &i) in self.free.iter().enumerate() {
            for (b, &j) in self.free[..=a].iter().enumerate() {
                let rows: f64 = self.held.iter().map(|&row| frame.jacobian[row * n + i] * frame.jacobian[row * n + j]).sum();
                self.matrix[a * size + b] = frame.hessian[i * n + j] + rows / PARAMETERS.augmentation;
            }
        }
        cholesky::factor(&mut self.matrix, size)
    }

    /// One Newton step. `false`: the limits are dependent beyond what δ tames.
    fn advance(&mut self, frame: &Frame<'_>) -> bool {
        let (n, free, held) = (frame.n, self.free.len(), self.held.len());
        self.spread.clear();
        for &i in &self.held {
            let first = self.spread.len();
            self.spread.extend(self.free.iter().map(|&j| frame.jacobian[i * n + j]));
            cholesky::solve(&self.matrix, &mut self.spread[first..]);
        }
        // P·dx + Aᵀ·dy = −∇L − Aᵀg/ε and A·dx − δ·dy = −g.
        self.step.clear();
        for (&j, residual) in self.free.iter().zip(&self.residual) {
            let push: f64 = self.held.iter().map(|&i| frame.jacobian[i * n + j] * (frame.rows[i] - self.w[n + i])).sum();
            self.step.push(-residual - push / PARAMETERS.augmentation);
        }
        cholesky::solve(&self.matrix, &mut self.step);
        self.schur.clear();
        self.schur.resize(held * held, 0.0);
        self.moves.clear();
        for (a, &i) in self.held.iter().enumerate() {
            let along = |v: &[f64]| self.free.iter().zip(v).map(|(&j, v)| frame.jacobian[i * n + j] * v).sum::<f64>();
            self.moves.push(along(&self.step) + frame.rows[i] - self.w[n + i]);
            for b in 0..=a {
                self.schur[a * held + b] = along(&self.spread[b * free..(b + 1) * free]);
            }
            self.schur[a * held + a] = self.schur[a * held + a] * (1.0 + PARAMETERS.proximal) + f64::MIN_POSITIVE;
        }
        if !cholesky::factor(&mut self.schur, held) {
            return false;
        }
        cholesky::solve(&self.schur, &mut self.moves);
        for ((&i, dy), spread) in self.held.iter().zip(&self.moves).zip(self.spread.chunks_exact(free.max(1))) {
            self.y[i] += dy;
            self.step.iter_mut().zip(spread).for_each(|(step, spread)| *step -= spread * dy);
        }
        for (&j, step) in self.free.iter().zip(&self.step) {
            self.w[j] += step;
        }
        true
    }

    /// Whether the limits left out hold, rows within rounding; slacks of free rows follow their rows.
    fn is_inside(&mut self, frame: &Frame<'_>) -> bool {
        for i in (0..frame.m).filter(|&i| self.sides[frame.n + i] == BoundState::Free) {
            let (row, lower, upper) = (frame.rows[i], frame.lower[frame.n + i], frame.upper[frame.n + i]);
            let inside = within(row, lower, upper);
            self.w[frame.n + i] = if (row - inside).abs() <= PARAMETERS.accepted * row.abs().max(1.0) { inside } else { row };
        }
        self.w.iter().zip(&frame.lower).zip(&frame.upper).all(|((w, lower), upper)| lower <= w && w <= upper)
    }

    /// Whether all multipliers push the right way.
    fn has_right_signs(&mut self, frame: &Frame<'_>) -> bool {
        let n = frame.n;
        let bound = |j: usize| {
            let pull: f64 = self.held.iter().map(|&i| self.y[i] * frame.jacobian[i * n + j]).sum();
            let slope = frame.gradient[j] + pull;
            match self.sides[j] {
                BoundState::Free => true,
                _ if frame.lower[j] == frame.upper[j] => true,
                BoundState::Lower => slope >= -PARAMETERS.no_multiplier,
                BoundState::Upper => slope <= PARAMETERS.no_multiplier,
            }
        };
        let row = |&i: &usize| match self.sides[n + i] {
            BoundState::Upper => self.y[i] >= -PARAMETERS.no_multiplier,
            _ => self.y[i] <= PARAMETERS.no_multiplier,
        };
        (0..n).all(bound) && self.held.iter().all(row)
    }
}
