//! The trust region's subproblem: minimise gᵀp + ½pᵀHp within ‖p‖ ≤ Δ by conjugate gradients (Steihaug; Nocedal & Wright,
//! algorithm 7.2). argmin's own version sorts step lengths that rounding can make NaN, which panics.

use argmin::core::{Error, KV, Problem, Solver, State, TerminationReason, TrustRegionRadius};
use argmin_math::ArgminDot;

use super::face::FaceHessian;
use super::subproblem::FaceState;

/// Residual, relative to the gradient, at which the conjugate gradients end.
const RESIDUAL: f64 = 1e-12;

/// Conjugate gradients inside a ball.
#[derive(Clone)]
pub(super) struct Steihaug {
    radius: f64,
}

impl Steihaug {
    /// With no radius yet: the trust region sets it.
    pub fn new() -> Self {
        Steihaug { radius: 1.0 }
    }

    fn step(&self, gradient: &[f64], hessian: &FaceHessian) -> Vec<f64> {
        let mut p = vec![0.0; gradient.len()];
        let mut residual = gradient.to_vec();
        let mut direction: Vec<f64> = gradient.iter().map(|g| -g).collect();
        let mut square = dot(&residual, &residual);
        let goal = RESIDUAL * RESIDUAL * square;
        for _ in 0..2 * gradient.len() + 20 {
            let image = hessian.dot(&direction);
            let curvature = dot(&direction, &image);
            let length = square / curvature;
            let next = along(&p, length, &direction);
            if curvature.is_nan() || curvature <= 0.0 || dot(&next, &next) >= self.radius * self.radius {
                return along(&p, self.to_boundary(&p, &direction), &direction);
            }
            p = next;
            residual = along(&residual, length, &image);
            let next_square = dot(&residual, &residual);
            if next_square.is_nan() || next_square <= goal {
                break;
            }
            let share = next_square / square;
            direction = residual.iter().zip(&direction).map(|(r, d)| share * d - r).collect();
            square = next_square;
        }
        p
    }

    /// The positive τ with ‖p + τd‖ = Δ; 0 where there is none.
    fn to_boundary(&self, p: &[f64], d: &[f64]) -> f64 {
        let (a, b, c) = (dot(d, d), dot(p, d), dot(p, p) - self.radius * self.radius);
        let root = (b * b - a * c).max(0.0).sqrt();
        let tau = if b > 0.0 { -c / (b + root) } else { (root - b) / a };
        if tau.is_finite() { tau.max(0.0) } else { 0.0 }
    }
}

fn dot(x: &[f64], y: &[f64]) -> f64 {
    x.iter().zip(y).map(|(x, y)| x * y).sum()
}

fn along(x: &[f64], length: f64, direction: &[f64]) -> Vec<f64> {
    x.iter().zip(direction).map(|(x, d)| x + length * d).collect()
}

impl TrustRegionRadius<f64> for Steihaug {
    fn set_radius(&mut self, radius: f64) {
        self.radius = radius;
    }
}

impl<O> Solver<O, FaceState> for Steihaug {
    fn name(&self) -> &str {
        "Steihaug"
    }

    fn next_iter(&mut self, _problem: &mut Problem<O>, state: FaceState) -> Result<(FaceState, Option<KV>), Error> {
        let step = match (state.get_gradient(), state.get_hessian()) {
            (Some(gradient), Some(hessian)) => self.step(gradient, hessian),
            _ => return Err(Error::msg("the trust region gave no derivatives")),
        };
        Ok((state.param(step).terminate_with(TerminationReason::SolverConverged), None))
    }
}
