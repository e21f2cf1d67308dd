//! Solvers behind one trait. A backend's own word is text to show, never a verdict: points are judged elsewhere.

pub mod argmin;
#[cfg(feature = "nlopt")]
pub mod nlopt;

use crate::model::{Budget, Model};

/// One solver family.
pub trait Backend: Sync {
    /// Whether it takes states and their equations beside the design, rather than the design alone.
    fn takes_states(&self) -> bool {
        false
    }

    /// `nlopt`, `argmin`.
    fn name(&self) -> &'static str;

    /// Names accepted by `--algorithm`, besides `auto`.
    fn algorithms(&self) -> &'static [&'static str];

    /// Why this algorithm cannot take this model, with those that can; `None` where it can (or the name is `auto`).
    fn refusal(&self, algorithm: &str, model: &dyn Model) -> Option<String>;

    /// What one evaluation costs this backend, its own algebra included, in entries of values and derivatives touched. An
    /// estimate that orders backends and bounds their shares, the same on every machine.
    fn work_per_evaluation(&self, model: &dyn Model) -> f64 {
        entries(model)
    }

    /// Minimises the model. Never panics; failures are solutions with a termination that says so.
    fn solve(&self, model: &dyn Model, job: &mut Job<'_>) -> Solution;
}

/// Values, gradient, Jacobian and Hessian: entries touched by one look at a model.
pub fn entries(model: &dyn Model) -> f64 {
    model.meta().work()
}

/// Says whether a point passes the certificate.
pub type StopTest<'a> = &'a (dyn Fn(&[f64]) -> bool + Sync);

/// Says whether a point of a part of the model ([`crate::model::components`]) passes the certificate by itself.
pub type PartTest<'a> = &'a (dyn Fn(&dyn Model, &[f64]) -> bool + Sync);

/// What a backend is asked to do.
pub struct Job<'a> {
    /// `auto` or one of [`Backend::algorithms`].
    pub algorithm: &'a str,
    /// Starting point (the model's own, or a warm start).
    pub start: &'a [f64],
    /// Row multipliers known from an earlier answer, as a first guess.
    pub start_multipliers: Option<&'a [f64]>,
    /// Tolerances asked for; solvers aim far below them and stop where rounding ends their progress.
    pub optimality_tolerance: f64,
    /// Relative step below which a run has stopped moving.
    pub step_tolerance: f64,
    /// Relative constraint violation accepted.
    pub constraint_tolerance: f64,
    /// Iterations at the most.
    pub max_iterations: u64,
    /// Evaluations, deadline, Ctrl-C.
    pub budget: Budget<'a>,
    /// True once a point passes the certificate: foreign solvers may stop there.
    pub stop_test: Option<StopTest<'a>>,
    /// The same of any model that the answer is made of: a part, or the model itself, with little to spare.
    pub part_test: Option<PartTest<'a>>,
    /// Called with every iteration (or, where a solver shows none, every improving evaluation).
    pub observer: &'a mut dyn FnMut(&Iteration<'_>),
}

/// One line of the log.
#[derive(Debug, Clone, Copy)]
pub struct Iteration<'a> {
    /// Iteration number from 0.
    pub iteration: u64,
    /// Objective evaluations so far.
    pub evaluations: u64,
    /// f(x)
    pub objective: f64,
    /// Largest absolute violation of rows and bounds (fmincon's Feasibility).
    pub feasibility: f64,
    /// First-order optimality measure; NaN where the solver has none.
    pub optimality: f64,
    /// Norm of the last step.
    pub step_norm: f64,
    /// The point; empty where a solver of many independent parts puts it together only in the end.
    pub x: &'a [f64],
}

/// Why a run stopped. What the point is, the certificate says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Termination {
    /// The solver saw no further progress.
    Converged,
    /// Iterations, evaluations or time ran out.
    LimitReached,
    /// Ctrl-C.
    Interrupted,
    /// The solver gave up, or the model gave a value that is no number.
    Failed,
    /// The algorithm cannot take this problem; nothing was run.
    Refused,
}

/// What a backend brings back.
#[derive(Debug, Clone)]
pub struct Solution {
    /// The algorithm that ran (`auto` resolved).
    pub algorithm: String,
    /// Why it stopped.
    pub termination: Termination,
    /// The same in one plain sentence, with the solver's own words and the term that failed.
    pub message: String,
    /// The best point; the start where nothing was run.
    pub x: Vec<f64>,
    /// The solver's row multipliers at x (L = f + yᵀc + zᵀx), where it has them: a first guess for the certificate.
    pub multipliers: Option<Vec<f64>>,
    /// Iterations; `None` where the solver shows none.
    pub iterations: Option<u64>,
    /// Objective evaluations.
    pub evaluations: u64,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// The evaluation error that ended the run, if one did.
    pub invalid: Option<String>,
}

impl Solution {
    /// The start, where nothing was run or nothing came of it.
    pub fn at_start(job: &Job<'_>, termination: Termination, message: impl Into<String>) -> Self {
        Solution {
            algorithm: job.algorithm.to_owned(),
            termination,
            message: message.into(),
            x: job.start.to_vec(),
            multipliers: None,
            iterations: None,
            evaluations: 0,
            seconds: 0.0,
            invalid: None,
        }
    }
}
