//! One iteration of the small interior point: a primal–dual barrier method with an ℓ₁ merit function on dense matrices.
//!
//! It is the method of the sparse interior point cut down to what a handful of variables and inequalities need. What it
//! cannot do it leaves to its big relative: no restoration, no equalities, no saddles.

use super::arena::{Phase, Piece};
use super::barrier::{self, distances, force};
use super::crossover::Crossover;
use super::frame::Frame;
use super::newton::Newton;
use crate::backends::argmin::interior_point::pushed;

/// First and last barrier parameter, and how it falls.
const FIRST_BARRIER: f64 = 0.1;
const LAST_BARRIER: f64 = 1e-11;
const LINEAR_DECREASE: f64 = 0.2;
const SUPERLINEAR_DECREASE: f64 = 1.5;
const BARRIER_TOLERANCE: f64 = 10.0;
/// Push of the start off its bounds.
const PUSH: f64 = 1e-2;
const LEAST_TAU: f64 = 0.99;
/// The scaled optimality error that ends the iterations.
const TOLERANCE: f64 = 1e-10;
/// From this barrier parameter on the active set is tried.
const CROSSOVER: f64 = 1e-3;
/// Iterations after which the big relative takes over.
const PATIENCE: u32 = 200;
const ARMIJO: f64 = 1e-4;
const SHORTEST: f64 = 1e-9;
/// Bound multipliers stay within this factor of the central ones.
const CENTRAL: f64 = 1e10;

/// A thread's room.
pub(super) struct Stepper<'m> {
    pub frame: Frame<'m>,
    newton: Newton,
    crossover: Crossover,
    trial: Vec<f64>,
}

/// Whether the iteration goes on.
enum Go {
    On,
    Solved,
    Hard,
}

impl<'m> Stepper<'m> {
    pub fn new(frame: Frame<'m>) -> Self {
        Stepper { frame, newton: Newton::default(), crossover: Crossover::default(), trial: Vec::new() }
    }

    /// One iteration of one component.
    pub fn step(&mut self, piece: &mut Piece<'_>) {
        self.frame.turn_to(piece);
        piece.header.evaluations = 0;
        if piece.header.phase == Phase::New {
            piece.header.phase = if self.begin(piece) { Phase::Running } else { Phase::Hard };
            return;
        }
        piece.header.iterations += 1;
        match self.iterate(piece) {
            Go::On if piece.header.iterations < PATIENCE => {}
            Go::Solved => piece.header.phase = Phase::Solved,
            _ => piece.header.phase = Phase::Hard,
        }
    }

    /// The first iterate. `false`: the model has no value there.
    fn begin(&mut self, piece: &mut Piece<'_>) -> bool {
        let frame = &mut self.frame;
        piece.row_scale.fill(1.0);
        frame.turn_to(piece);
        for (at, start) in frame.start(piece.component).enumerate() {
            piece.w[at] = pushed(start, frame.lower[at], frame.upper[at], PUSH);
        }
        if !frame.first_order(piece.w, piece.header, piece.row_scale) {
            return false;
        }
        frame.choose_scales(piece);
        if !frame.first_order(piece.w, piece.header, piece.row_scale) {
            return false;
        }
        for at in frame.n..frame.n + frame.m {
            piece.w[at] = pushed(frame.rows[at - frame.n], frame.lower[at], frame.upper[at], PUSH);
        }
        piece.header.mu = FIRST_BARRIER;
        for (at, &w) in piece.w.iter().enumerate() {
            let (below, above) = distances(w, frame.lower[at], frame.upper[at]);
            let fixed = frame.lower[at] == frame.upper[at];
            piece.z_lower[at] = if fixed { 0.0 } else { force(FIRST_BARRIER, below) };
            piece.z_upper[at] = if fixed { 0.0 } else { force(FIRST_BARRIER, above) };
        }
        for (i, y) in piece.y.iter_mut().enumerate() {
            *y = piece.z_upper[frame.n + i] - piece.z_lower[frame.n + i];
        }
        self.note(piece);
        true
    }

    fn note(&mut self, piece: &mut Piece<'_>) {
        (piece.header.violation, piece.header.relative_violation) = self.frame.violation(piece.component);
        piece.header.error = self.error(piece, 0.0);
    }

    fn iterate(&mut self, piece: &mut Piece<'_>) -> Go {
        if !self.frame.first_order(piece.w, piece.header, piece.row_scale) {
            return Go::Hard;
        }
        self.note(piece);
        let close = piece.header.error <= TOLERANCE;
        while piece.header.mu > LAST_BARRIER && self.error(piece, piece.header.mu) <= BARRIER_TOLERANCE * piece.header.mu {
            let mu = piece.header.mu;
            piece.header.mu = LAST_BARRIER.max((LINEAR_DECREASE * mu).min(mu.powf(SUPERLINEAR_DECREASE)));
            piece.header.penalty = 0.0;
        }
        if close || (piece.header.mu <= CROSSOVER && piece.header.mu < piece.header.tried) {
            piece.header.tried = piece.header.mu;
            if self.crossover.attempt(&mut self.frame, piece) {
                self.note_crossover(piece);
                return Go::Solved;
            }
            // The attempt left other derivatives behind.
            if !self.frame.first_order(piece.w, piece.header, piece.row_scale) {
                return Go::Hard;
            }
        }
        if !self.frame.second_order(piece.y, piece.header, piece.row_scale) || !self.newton.compute(&self.frame, piece) {
            return Go::Hard;
        }
        if close && piece.header.mu <= LAST_BARRIER {
            return Go::Solved;
        }
        if self.search(piece) { Go::On } else { Go::Hard }
    }

    fn note_crossover(&mut self, piece: &mut Piece<'_>) {
        (piece.header.violation, piece.header.relative_violation) = self.frame.violation(piece.component);
        piece.header.error = self.crossover.error;
    }

    /// The optimality error for a barrier parameter (Wächter & Biegler 2006, equation (5)).
    fn error(&self, piece: &Piece<'_>, mu: f64) -> f64 {
        let frame = &self.frame;
        let (n, size) = (frame.n, piece.w.len());
        let (mut dual, mut complementarity, mut total) = (0.0_f64, 0.0_f64, 0.0);
        for at in 0..size {
            if frame.lower[at] == frame.upper[at] {
                continue;
            }
            let own = if at < n {
                let pull: f64 = piece.y.iter().enumerate().map(|(i, y)| y * frame.jacobian[i * n + at]).sum();
                frame.gradient[at] + pull
            } else {
                -piece.y[at - n]
            };
            let (lower, upper) = (piece.z_lower[at], piece.z_upper[at]);
            let (below, above) = distances(piece.w[at], frame.lower[at], frame.upper[at]);
            dual = dual.max((own - lower + upper).abs());
            total += lower + upper;
            for (z, distance) in [(lower, below), (upper, above)] {
                if distance.is_finite() {
                    complementarity = complementarity.max((z * distance - mu).abs());
                }
            }
        }
        let primal = (0..frame.m).map(|i| (frame.rows[i] - piece.w[n + i]).abs()).fold(0.0, f64::max);
        let scale = (total / size.max(1) as f64 / 100.0).max(1.0);
        (dual / scale).max(primal).max(complementarity / scale)
    }

    /// Backtracks along the Newton step until the merit function falls; moves there. `false`: it does not fall.
    fn search(&mut self, piece: &mut Piece<'_>) -> bool {
        let (n, mu) = (self.frame.n, piece.header.mu);
        let tau = LEAST_TAU.max(1.0 - mu);
        let largest = |values: &[f64]| values.iter().fold(0.0, |most: f64, v| most.max(v.abs()));
        let violation: f64 = (0..self.frame.m).map(|i| (self.frame.rows[i] - piece.w[n + i]).abs()).sum();
        let slope: f64 = self.newton.slope.iter().zip(&self.newton.w).map(|(slope, step)| slope * step).sum();
        let needed = if violation > 0.0 { slope / (0.9 * violation) } else { 0.0 };
        piece.header.penalty = piece.header.penalty.max(1.5 * largest(&self.newton.y)).max(needed);
        let (penalty, fall) = (piece.header.penalty, slope - piece.header.penalty * violation);
        let begin = self.merit(piece.w, self.frame.objective, mu, penalty);
        let mut length = self.longest(piece, tau);
        let room = 10.0 * f64::EPSILON * begin.abs().max(1.0);
        loop {
            self.trial.clear();
            self.trial.extend(piece.w.iter().zip(&self.newton.w).map(|(w, step)| w + length * step));
            let objective = self.frame.values(&self.trial, piece.header, piece.row_scale);
            self.relax_slacks();
            if self.merit(&self.trial, objective, mu, penalty) <= begin + ARMIJO * length * fall + room {
                break;
            }
            length *= 0.5;
            if length < SHORTEST {
                return false;
            }
        }
        self.accept(piece, length, tau);
        true
    }

    /// Slacks that fall short of their rows in the direction away from an only limit catch up: infeasibility and barrier both
    /// gain.
    fn relax_slacks(&mut self) {
        let n = self.frame.n;
        for (i, &row) in self.frame.rows.iter().enumerate() {
            let slack = &mut self.trial[n + i];
            match (self.frame.lower[n + i].is_finite(), self.frame.upper[n + i].is_finite()) {
                (true, false) => *slack = slack.max(row),
                (false, true) => *slack = slack.min(row),
                _ => {}
            }
        }
    }

    fn merit(&self, w: &[f64], objective: f64, mu: f64, penalty: f64) -> f64 {
        let frame = &self.frame;
        let open = |at: &usize| frame.lower[*at] < frame.upper[*at];
        let barrier: f64 =
            (0..w.len()).filter(open).map(|at| barrier::value(mu, distances(w[at], frame.lower[at], frame.upper[at]))).sum();
        let violation: f64 = (0..frame.m).map(|i| (frame.rows[i] - w[frame.n + i]).abs()).sum();
        objective + barrier + penalty * violation
    }

    /// The fraction-to-the-boundary rule for w.
    fn longest(&self, piece: &Piece<'_>, tau: f64) -> f64 {
        let mut length: f64 = 1.0;
        for (at, &step) in self.newton.w.iter().enumerate() {
            let (below, above) = distances(piece.w[at], self.frame.lower[at], self.frame.upper[at]);
            if step < 0.0 {
                length = length.min(-tau * below / step);
            } else if step > 0.0 {
                length = length.min(tau * above / step);
            }
        }
        length
    }

    /// Moves to the trial point, multipliers by their own longest steps.
    fn accept(&mut self, piece: &mut Piece<'_>, length: f64, tau: f64) {
        let (mu, n) = (piece.header.mu, self.frame.n);
        let newton = &self.newton;
        let longest = |z: &[f64], steps: &[f64]| {
            z.iter().zip(steps).filter(|(_, step)| **step < 0.0).fold(1.0, |most: f64, (z, step)| most.min(-tau * z / step))
        };
        let dual = longest(piece.z_lower, &newton.z_lower).min(longest(piece.z_upper, &newton.z_upper));
        piece.header.step = piece.w[..n].iter().zip(&self.trial).map(|(w, trial)| (trial - w).powi(2)).sum();
        piece.w.copy_from_slice(&self.trial);
        for (y, new) in piece.y.iter_mut().zip(&newton.y) {
            *y += length * (new - *y);
        }
        for at in 0..piece.w.len() {
            let (below, above) = distances(piece.w[at], self.frame.lower[at], self.frame.upper[at]);
            let central = |z: f64, distance: f64| {
                let middle = force(mu, distance);
                z.clamp(middle / CENTRAL, middle * CENTRAL)
            };
            if self.frame.lower[at] < self.frame.upper[at] {
                piece.z_lower[at] = central(piece.z_lower[at] + dual * newton.z_lower[at], below);
                piece.z_upper[at] = central(piece.z_upper[at] + dual * newton.z_upper[at], above);
            }
        }
    }
}
