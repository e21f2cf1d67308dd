//! The trust region's subproblem: minimise gᵀp + ½pᵀHp within ‖p‖ ≤ Δ by conjugate gradients (Steihaug; Nocedal & Wright,
//! algorithm 7.2).

use super::face::FaceHessian;
use crate::math::dot;

/// Residual, relative to the gradient, at which the conjugate gradients end.
const RESIDUAL: f64 = 1e-12;

/// The step within the radius.
pub(super) fn step(gradient: &[f64], hessian: &FaceHessian, radius: f64) -> Vec<f64> {
    let mut p = vec![0.0; gradient.len()];
    let mut residual = gradient.to_vec();
    let mut direction: Vec<f64> = gradient.iter().map(|g| -g).collect();
    let mut square = dot(&residual, &residual);
    let goal = RESIDUAL * RESIDUAL * square;
    for _ in 0..2 * gradient.len() + 20 {
        let image = hessian.times(&direction);
        let curvature = dot(&direction, &image);
        let length = square / curvature;
        let next = along(&p, length, &direction);
        if curvature.is_nan() || curvature <= 0.0 || dot(&next, &next) >= radius * radius {
            return along(&p, to_boundary(&p, &direction, radius), &direction);
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
fn to_boundary(p: &[f64], d: &[f64], radius: f64) -> f64 {
    let (a, b, c) = (dot(d, d), dot(p, d), dot(p, p) - radius * radius);
    let root = (b * b - a * c).max(0.0).sqrt();
    let tau = if b > 0.0 { -c / (b + root) } else { (root - b) / a };
    if tau.is_finite() { tau.max(0.0) } else { 0.0 }
}

fn along(x: &[f64], length: f64, direction: &[f64]) -> Vec<f64> {
    x.iter().zip(direction).map(|(x, d)| x + length * d).collect()
}
