//! Iterations of the small interior point: a primal–dual barrier method with an ℓ₁ merit function on dense matrices.
//!
//! It is the method of the sparse interior point cut down to what a handful of variables and inequalities need. It has
//! no restoration, takes no equalities and leaves no saddles: such components go to the sparse interior point.

use super::arena::{Phase, Piece};
use super::barrier::{distances, force};
use super::crossover::Crossover;
use super::frame::Frame;
use super::newton::Newton;
use super::parameters::PARAMETERS;
use super::search::Search;
use crate::solvers::barrier::pushed;

/// A thread's room.
pub(super) struct Stepper<'m> {
    pub frame: Frame<'m>,
    /// Of all rows, where the start is an earlier answer.
    multipliers: Option<&'m [f64]>,
    newton: Newton,
    crossover: Crossover,
    search: Search,
}

/// Whether the iterations go on.
#[derive(Clone, Copy, PartialEq)]
enum Go {
    On,
    Solved,
    Hard,
}

impl<'m> Stepper<'m> {
    pub fn new(frame: Frame<'m>, multipliers: Option<&'m [f64]>) -> Self {
        Stepper { frame, multipliers, newton: Newton::default(), crossover: Crossover::default(), search: Search::default() }
    }

    /// Takes one component `steps` iterations further, or to its end.
    pub fn advance(&mut self, piece: &mut Piece<'_>, steps: u32) {
        piece.header.evaluations = 0;
        let mut go = if piece.header.phase == Phase::New { self.begin(piece) } else { self.resume(piece) };
        for _ in 0..steps {
            if go != Go::On {
                break;
            }
            piece.header.iterations += 1;
            go = self.iterate(piece);
        }
        piece.header.phase = match go {
            Go::On if piece.header.iterations < PARAMETERS.patience => Phase::Running,
            Go::Solved => Phase::Solved,
            _ => Phase::Hard,
        };
    }

    fn evaluate(&mut self, piece: &mut Piece<'_>) -> Go {
        if self.frame.first_order(piece.w, piece.header, piece.row_scale) { Go::On } else { Go::Hard }
    }

    /// Back at a component that is under way.
    fn resume(&mut self, piece: &mut Piece<'_>) -> Go {
        self.frame.select(piece);
        self.evaluate(piece)
    }

    /// The first iterate.
    fn begin(&mut self, piece: &mut Piece<'_>) -> Go {
        piece.row_scale.fill(1.0);
        self.frame.select(piece);
        self.push_start(piece);
        if self.evaluate(piece) == Go::Hard {
            return Go::Hard;
        }
        piece.header.logarithmic = self.frame.has_logarithm();
        self.frame.choose_scales(piece);
        if self.is_answer(piece) {
            return Go::Solved;
        }
        self.push_start(piece);
        if self.evaluate(piece) == Go::Hard {
            return Go::Hard;
        }
        let frame = &self.frame;
        for at in frame.n..frame.n + frame.m {
            piece.w[at] = pushed(frame.rows[at - frame.n], frame.lower[at], frame.upper[at], PARAMETERS.kappa_1);
        }
        piece.header.mu = PARAMETERS.barrier.mu_0;
        for (at, &w) in piece.w.iter().enumerate() {
            let (below, above) = distances(w, frame.lower[at], frame.upper[at]);
            let fixed = frame.lower[at] == frame.upper[at];
            piece.z_lower[at] = if fixed { 0.0 } else { force(PARAMETERS.barrier.mu_0, below) };
            piece.z_upper[at] = if fixed { 0.0 } else { force(PARAMETERS.barrier.mu_0, above) };
        }
        for (i, y) in piece.y.iter_mut().enumerate() {
            *y = piece.z_upper[frame.n + i] - piece.z_lower[frame.n + i];
        }
        self.note(piece);
        Go::On
    }

    fn push_start(&self, piece: &mut Piece<'_>) {
        let frame = &self.frame;
        for (at, start) in frame.start(piece.component).enumerate() {
            piece.w[at] = pushed(start, frame.lower[at], frame.upper[at], PARAMETERS.kappa_1);
        }
    }

    /// Whether the start with its multipliers is a minimum, or leads to one in a few steps of Newton's.
    fn is_answer(&mut self, piece: &mut Piece<'_>) -> bool {
        let Some(multipliers) = self.multipliers else { return false };
        self.frame.take_start(piece, multipliers);
        let found = self.crossover.attempt(&mut self.frame, piece);
        if found {
            self.note_crossover(piece);
        }
        found
    }

    fn note(&mut self, piece: &mut Piece<'_>) {
        (piece.header.violation, piece.header.relative_violation) = self.frame.violation(piece.component);
        piece.header.error = self.error(piece, 0.0);
    }

    /// One iteration; the frame holds first derivatives at the iterate before and after.
    fn iterate(&mut self, piece: &mut Piece<'_>) -> Go {
        let close = piece.header.error <= PARAMETERS.epsilon_tol;
        while piece.header.mu > PARAMETERS.barrier.mu_last
            && PARAMETERS.barrier.is_solved(self.error(piece, piece.header.mu), piece.header.mu)
        {
            piece.header.mu = PARAMETERS.barrier.next(piece.header.mu);
            piece.header.penalty = 0.0;
        }
        if close || (piece.header.mu <= PARAMETERS.crossover && piece.header.mu < piece.header.tried) {
            piece.header.tried = piece.header.mu;
            if self.crossover.attempt(&mut self.frame, piece) {
                self.note_crossover(piece);
                return Go::Solved;
            }
            // The attempt left other derivatives behind.
            if self.evaluate(piece) == Go::Hard {
                return Go::Hard;
            }
        }
        if !self.frame.second_order(piece.y, piece.header, piece.row_scale) || !self.newton.compute(&self.frame, piece) {
            return Go::Hard;
        }
        if close && piece.header.mu <= PARAMETERS.barrier.mu_last {
            return Go::Solved;
        }
        if !self.search.descend(&mut self.frame, &self.newton, piece) {
            return Go::Hard;
        }
        self.note(piece);
        Go::On
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
}
