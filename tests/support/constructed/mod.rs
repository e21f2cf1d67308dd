//! Problems whose nature is known by construction: x*, its active set (strict, weak, dependent limits), multipliers and the
//! reduced Hessian on the critical cone are chosen first, then the problem is written down around them.
//!
//! In coordinates t = T(x/s − u*), T random and well conditioned, the first limits are t_i ≥ 0. The Lagrangian is exactly
//! ½tᵀKt plus, for degenerate points, a power of one coordinate. K over the strictly active coordinates is arbitrary; over the
//! weak ones and the free ones its Schur complement M on the weak ones is chosen: strictly copositive or falling on one face.
#![allow(dead_code, reason = "each binary uses a part")]

mod degenerate;
pub mod polynomial;
mod random;
mod stationary;
mod without_minimum;

use ribopt::certificate::{Certifier, Tolerances};
use ribopt::model::Class;

pub use polynomial::Problem;
pub use random::Random;

/// What x* is.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Nature {
    StrictMinimum,
    /// Flat to second order along one direction, along which a higher power rises.
    DegenerateMinimum,
    /// The same, but it falls on one side or on both.
    DegenerateNoMinimum,
    /// The Lagrangian has negative curvature on the null space of the active limits.
    Saddle,
    /// It has negative curvature only where so many weakly active limits are left at once.
    FallsOnFace(usize),
    Maximum,
    /// No point is feasible: a Farkas combination is short by this power of ten.
    Infeasible(i32),
    Unbounded,
}

impl Nature {
    pub fn may_be_certified(self) -> bool {
        matches!(self, Nature::StrictMinimum | Nature::DegenerateMinimum)
    }
}

/// A problem with points to be judged, x* first where there is one.
pub struct Constructed {
    pub nature: Nature,
    pub seed: u64,
    pub problem: Problem,
    pub points: Vec<Vec<f64>>,
}

/// The problem of a seed, with `near` points beside x*.
pub fn construct(seed: u64, near: usize) -> Constructed {
    let mut random = Random::new(seed);
    let nature = match random.below(20) {
        0..=6 => Nature::StrictMinimum,
        7 => Nature::DegenerateMinimum,
        8..=9 => Nature::DegenerateNoMinimum,
        10..=11 => Nature::Saddle,
        12..=15 => Nature::FallsOnFace(1 + random.below(5)),
        16 => Nature::Maximum,
        17..=18 => Nature::Infeasible(-(random.below(8) as i32)),
        _ => Nature::Unbounded,
    };
    let (problem, points) = match nature {
        Nature::Infeasible(power) => without_minimum::infeasible(&mut random, 10f64.powi(power)),
        Nature::Unbounded => without_minimum::unbounded(&mut random),
        _ => stationary::around(&mut random, nature, near),
    };
    Constructed { nature, seed, problem, points }
}

/// What went wrong at a point.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Fault {
    WronglyCertified,
    MinimumNotCertified,
    TestsDisagree,
    Error,
}

/// How often the certificate was asked, by nature, and what it got wrong.
#[derive(Default)]
pub struct Tally {
    pub calls: usize,
    /// Strict minima, and how many of them were certified.
    pub minima: (usize, usize),
    /// Degenerate ones.
    pub degenerate: (usize, usize),
    /// Stationary points at which the three second-order tests were compared.
    pub compared: usize,
    pub faults: Vec<(Fault, u64, usize, Nature)>,
}

impl Tally {
    pub fn count(&self, fault: Fault) -> usize {
        self.faults.iter().filter(|found| found.0 == fault).count()
    }

    /// Judges all points of a problem.
    pub fn add(&mut self, constructed: &Constructed) {
        let Constructed { nature, seed, problem, points } = constructed;
        let certifier = Certifier::new(problem, Class::Nonlinear, Tolerances::default());
        for (at, x) in points.iter().enumerate() {
            self.calls += 1;
            let mut fault = |fault| self.faults.push((fault, *seed, at, *nature));
            let Ok(certificate) = certifier.certify(x, None) else {
                fault(Fault::Error);
                continue;
            };
            let is_certified = certificate.certified;
            match nature {
                _ if is_certified && !nature.may_be_certified() => fault(Fault::WronglyCertified),
                Nature::StrictMinimum if at == 0 && !is_certified => fault(Fault::MinimumNotCertified),
                _ => {}
            }
            match nature {
                Nature::StrictMinimum if at == 0 => add(&mut self.minima, is_certified),
                Nature::DegenerateMinimum if at == 0 => add(&mut self.degenerate, is_certified),
                _ => {}
            }
            if at == 0 && !matches!(nature, Nature::Infeasible(_) | Nature::Unbounded) {
                self.compared += 1;
                match certifier.second_order_by_every_test(x) {
                    Ok([dense, sparse, apart]) if dense == sparse && sparse == apart => {}
                    _ => self.faults.push((Fault::TestsDisagree, *seed, at, *nature)),
                }
            }
        }
    }
}

fn add((all, good): &mut (usize, usize), is_good: bool) {
    *all += 1;
    *good += usize::from(is_good);
}
