//! Iterations of the small interior point: a primal–dual barrier method with an ℓ₁ merit function on dense matrices.
//!
//! It is the method of the sparse interior point cut down to what a handful of variables and inequalities need. It has
//! no restoration, takes no equalities and leaves no saddles: such components go to the sparse interior point.

use super::arena::{ComponentIterate, Phase};
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
    pub fn advance(&mut self, iterate: &mut ComponentIterate<'_>, steps: u32) {
        iterate.header.evaluations = 0;
        let mut go = if iterate.header.phase == Phase::New { self.begin(iterate) } else { self.resume(iterate) };
        for _ in 0..steps {
            if go != Go::On {
                break;
            }
            iterate.header.iterations += 1;
            go = self.iterate(iterate);
        }
        iterate.header.phase = match go {
            Go::On if iterate.header.iterations < PARAMETERS.patience => Phase::Running,
            Go::Solved => Phase::Solved,
            _ => Phase::Hard,
        };
    }

    fn evaluate(&mut self, iterate: &mut ComponentIterate<'_>) -> Go {
        if self.frame.first_order(iterate.w, iterate.header, iterate.row_scale) { Go::On } else { Go::Hard }
    }

    /// Back at a component that is under way.
    fn resume(&mut self, iterate: &mut ComponentIterate<'_>) -> Go {
        self.frame.select(iterate);
        self.evaluate(iterate)
    }

    /// The first iterate.
    fn begin(&mut self, iterate: &mut ComponentIterate<'_>) -> Go {
        iterate.row_scale.fill(1.0);
        self.frame.select(iterate);
        self.push_start(iterate);
        if self.evaluate(iterate) == Go::Hard {
            return Go::Hard;
        }
        iterate.header.logarithmic = self.frame.has_logarithm();
        self.frame.choose_scales(iterate);
        if self.is_answer(iterate) {
            return Go::Solved;
        }
        self.push_start(iterate);
        if self.evaluate(iterate) == Go::Hard {
            return Go::Hard;
        }
        let frame = &self.frame;
        for at in frame.n..frame.n + frame.m {
            iterate.w[at] = pushed(frame.rows[at - frame.n], frame.lower[at], frame.upper[at], PARAMETERS.kappa_1);
        }
        iterate.header.mu = PARAMETERS.barrier.mu_0;
        for (at, &w) in iterate.w.iter().enumerate() {
            let (below, above) = distances(w, frame.lower[at], frame.upper[at]);
            let fixed = frame.lower[at] == frame.upper[at];
            iterate.z_lower[at] = if fixed { 0.0 } else { force(PARAMETERS.barrier.mu_0, below) };
            iterate.z_upper[at] = if fixed { 0.0 } else { force(PARAMETERS.barrier.mu_0, above) };
        }
        for (i, y) in iterate.y.iter_mut().enumerate() {
            *y = iterate.z_upper[frame.n + i] - iterate.z_lower[frame.n + i];
        }
        self.note(iterate);
        Go::On
    }

    fn push_start(&self, iterate: &mut ComponentIterate<'_>) {
        let frame = &self.frame;
        for (at, start) in frame.start(iterate.component).enumerate() {
            iterate.w[at] = pushed(start, frame.lower[at], frame.upper[at], PARAMETERS.kappa_1);
        }
    }

    /// Whether the start with its multipliers is a minimum, or leads to one in a few steps of Newton's.
    fn is_answer(&mut self, iterate: &mut ComponentIterate<'_>) -> bool {
        let Some(multipliers) = self.multipliers else { return false };
        self.frame.take_start(iterate, multipliers);
        let found = self.crossover.attempt(&mut self.frame, iterate);
        if found {
            self.note_crossover(iterate);
        }
        found
    }

    fn note(&mut self, iterate: &mut ComponentIterate<'_>) {
        (iterate.header.violation, iterate.header.relative_violation) = self.frame.violation(iterate.component);
        iterate.header.error = self.error(iterate, 0.0);
    }

    /// One iteration; the frame holds first derivatives at the iterate before and after.
    fn iterate(&mut self, iterate: &mut ComponentIterate<'_>) -> Go {
        let close = iterate.header.error <= PARAMETERS.epsilon_tol;
        while iterate.header.mu > PARAMETERS.barrier.mu_last
            && PARAMETERS.barrier.is_solved(self.error(iterate, iterate.header.mu), iterate.header.mu)
        {
            iterate.header.mu = PARAMETERS.barrier.next(iterate.header.mu);
            iterate.header.penalty = 0.0;
        }
        if close || (iterate.header.mu <= PARAMETERS.crossover && iterate.header.mu < iterate.header.tried) {
            iterate.header.tried = iterate.header.mu;
            if self.crossover.attempt(&mut self.frame, iterate) {
                self.note_crossover(iterate);
                return Go::Solved;
            }
            // The attempt left other derivatives behind.
            if self.evaluate(iterate) == Go::Hard {
                return Go::Hard;
            }
        }
        if !self.frame.second_order(iterate.y, iterate.header, iterate.row_scale) || !self.newton.compute(&self.frame, iterate) {
            return Go::Hard;
        }
        if close && iterate.header.mu <= PARAMETERS.barrier.mu_last {
            return Go::Solved;
        }
        if !self.search.descend(&mut self.frame, &self.newton, iterate) {
            return Go::Hard;
        }
        self.note(iterate);
        Go::On
    }

    fn note_crossover(&mut self, iterate: &mut ComponentIterate<'_>) {
        (iterate.header.violation, iterate.header.relative_violation) = self.frame.violation(iterate.component);
        iterate.header.error = self.crossover.error;
    }

    /// The optimality error for a barrier parameter (Wächter & Biegler 2006, equation (5)).
    fn error(&self, iterate: &ComponentIterate<'_>, mu: f64) -> f64 {
        let frame = &self.frame;
        let (n, size) = (frame.n, iterate.w.len());
        let (mut dual, mut complementarity, mut total) = (0.0_f64, 0.0_f64, 0.0);
        for at in 0..size {
            if frame.lower[at] == frame.upper[at] {
                continue;
            }
            let own = if at < n {
                let pull: f64 = iterate.y.iter().enumerate().map(|(i, y)| y * frame.jacobian[i * n + at]).sum();
                frame.gradient[at] + pull
            } else {
                -iterate.y[at - n]
            };
            let (lower, upper) = (iterate.z_lower[at], iterate.z_upper[at]);
            let (below, above) = distances(iterate.w[at], frame.lower[at], frame.upper[at]);
            dual = dual.max((own - lower + upper).abs());
            total += lower + upper;
            for (z, distance) in [(lower, below), (upper, above)] {
                if distance.is_finite() {
                    complementarity = complementarity.max((z * distance - mu).abs());
                }
            }
        }
        let primal = (0..frame.m).map(|i| (frame.rows[i] - iterate.w[n + i]).abs()).fold(0.0, f64::max);
        let scale = (total / size.max(1) as f64 / 100.0).max(1.0);
        (dual / scale).max(primal).max(complementarity / scale)
    }
}
