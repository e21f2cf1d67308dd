//! The line search along a Newton step.

use super::arena::ComponentIterate;
use super::barrier::{self, distances, force};
use super::frame::Frame;
use super::newton::Newton;
use super::parameters::PARAMETERS;
use crate::solvers::barrier::longest_multiplier_step;

/// A thread's room.
#[derive(Default)]
pub(super) struct Search {
    trial: Vec<f64>,
}

/// f − μ·Σ ln(distances) + ν·Σ|c − s|.
#[derive(Clone, Copy)]
struct Merit {
    mu: f64,
    penalty: f64,
}

impl Merit {
    /// At w, with objective and rows as evaluated last.
    fn at(self, frame: &Frame<'_>, w: &[f64]) -> f64 {
        let open = |at: &usize| frame.lower[*at] < frame.upper[*at];
        let barrier = |at: usize| barrier::value(self.mu, distances(w[at], frame.lower[at], frame.upper[at]));
        frame.objective + (0..w.len()).filter(open).map(barrier).sum::<f64>() + self.penalty * violation(frame, w)
    }
}

/// Σ|c − s|
fn violation(frame: &Frame<'_>, w: &[f64]) -> f64 {
    frame.rows.iter().zip(&w[frame.n..]).map(|(row, slack)| (row - slack).abs()).sum()
}

fn largest(values: &[f64]) -> f64 {
    values.iter().fold(0.0, |most: f64, v| most.max(v.abs()))
}

impl Search {
    /// Backtracks until the merit function falls; moves there, first derivatives being evaluated. `false`: it does not fall.
    pub fn descend(&mut self, frame: &mut Frame<'_>, newton: &Newton, iterate: &mut ComponentIterate<'_>) -> bool {
        let violation = violation(frame, iterate.w);
        let slope: f64 = newton.slope.iter().zip(&newton.w).map(|(slope, step)| slope * step).sum();
        let needed = if violation > 0.0 { slope / (0.9 * violation) } else { 0.0 };
        // One wild step must not weigh down all that follow.
        iterate.header.penalty = (PARAMETERS.penalty_kept * iterate.header.penalty).max(1.5 * largest(&newton.y)).max(needed);
        let merit = Merit { mu: iterate.header.mu, penalty: iterate.header.penalty };
        let tau = PARAMETERS.barrier.tau(merit.mu);
        let (begin, fall) = (merit.at(frame, iterate.w), slope - merit.penalty * violation);
        let longest = longest(frame, newton, iterate, tau);
        let room = 10.0 * f64::EPSILON * begin.abs().max(1.0);
        let mut length = longest;
        loop {
            self.trial.clear();
            self.trial.extend(iterate.w.iter().zip(&newton.w).map(|(w, step)| w + length * step));
            // The first trial is nearly always taken, and then its derivatives are wanted.
            let is_first = length == longest;
            let valid = if is_first {
                frame.first_order(&self.trial, iterate.header, iterate.row_scale)
            } else {
                frame.values(&self.trial, iterate.header, iterate.row_scale)
            };
            self.settle_slacks(frame, merit);
            if valid && merit.at(frame, &self.trial) <= begin + PARAMETERS.eta * length * fall + room {
                if !is_first && !frame.first_order(&self.trial, iterate.header, iterate.row_scale) {
                    return false;
                }
                break;
            }
            length *= 0.5;
            if length < PARAMETERS.shortest {
                return false;
            }
        }
        self.accept(frame, newton, iterate, length, tau);
        true
    }

    /// Moves slacks to where the merit function is least for the rows as they are: onto the row, unless the barrier there
    /// pulls harder than the penalty. Curved rows cost no short steps that way.
    fn settle_slacks(&mut self, frame: &Frame<'_>, merit: Merit) {
        let n = frame.n;
        for (i, &row) in frame.rows.iter().enumerate() {
            let (slack, lower, upper) = (&mut self.trial[n + i], frame.lower[n + i], frame.upper[n + i]);
            let (below, above) = distances(*slack, lower, upper);
            let kept = |distance: f64| (merit.mu / merit.penalty).min(distance).max(PARAMETERS.distance_kept * distance);
            let (low, high) = (lower + kept(below), upper - kept(above));
            let settled = match (lower.is_finite(), upper.is_finite()) {
                (true, true) if low <= high => row.max(low).min(high),
                (true, false) => row.max(low),
                (false, true) => row.min(high),
                _ => *slack,
            };
            if settled.is_finite() {
                *slack = settled;
            }
        }
    }

    /// Moves to the trial point, multipliers by their own longest steps.
    fn accept(&mut self, frame: &Frame<'_>, newton: &Newton, iterate: &mut ComponentIterate<'_>, length: f64, tau: f64) {
        let (mu, n) = (iterate.header.mu, frame.n);
        let dual = longest_multiplier_step(iterate.z_lower, &newton.z_lower, tau).min(longest_multiplier_step(
            iterate.z_upper,
            &newton.z_upper,
            tau,
        ));
        iterate.header.step = iterate.w[..n].iter().zip(&self.trial).map(|(w, trial)| (trial - w).powi(2)).sum();
        iterate.w.copy_from_slice(&self.trial);
        for (y, new) in iterate.y.iter_mut().zip(&newton.y) {
            *y += length * (new - *y);
        }
        for at in 0..iterate.w.len() {
            let (below, above) = distances(iterate.w[at], frame.lower[at], frame.upper[at]);
            let central = |z: f64, distance: f64| {
                let middle = force(mu, distance);
                z.clamp(middle / PARAMETERS.barrier.kappa_sigma, middle * PARAMETERS.barrier.kappa_sigma)
            };
            if frame.lower[at] < frame.upper[at] {
                iterate.z_lower[at] = central(iterate.z_lower[at] + dual * newton.z_lower[at], below);
                iterate.z_upper[at] = central(iterate.z_upper[at] + dual * newton.z_upper[at], above);
            }
        }
    }
}

/// The fraction-to-the-boundary rule for w.
fn longest(frame: &Frame<'_>, newton: &Newton, iterate: &ComponentIterate<'_>, tau: f64) -> f64 {
    let mut length: f64 = 1.0;
    for (at, &step) in newton.w.iter().enumerate() {
        let (below, above) = distances(iterate.w[at], frame.lower[at], frame.upper[at]);
        if step < 0.0 {
            length = length.min(-tau * below / step);
        } else if step > 0.0 {
            length = length.min(tau * above / step);
        }
    }
    length
}
