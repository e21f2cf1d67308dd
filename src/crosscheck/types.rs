//! What is asked and what is answered.

use std::sync::atomic::AtomicBool;

use super::start::MovedStart;
use crate::backends::{Backend, Iteration, Solution};
use crate::certificate::{Certificate, Extent};
use crate::model::{Class, Limit, Model, Own, Substitution};
use crate::problem::Settings;

/// What is to be solved.
#[derive(Clone, Copy)]
pub struct Task<'a> {
    /// The problem in the user's variables and units, minimised. Points are judged on it.
    pub model: &'a dyn Model,
    /// The same in other variables, where backends are to solve that.
    pub substitution: Option<&'a dyn Substitution>,
    /// What is proved about it.
    pub class: Class,
    /// Tolerances and limits.
    pub settings: &'a Settings,
    /// Starting point, length n, inside the bounds; moved into the domain where a term has no value there.
    pub start: &'a [f64],
    /// Row multipliers of an earlier answer.
    pub start_multipliers: Option<&'a [f64]>,
    /// Starting points of the multi-start; 0 or 1: the start alone.
    pub starts: usize,
    /// Set by Ctrl-C.
    pub interrupt: Option<&'a AtomicBool>,
}

impl<'a> Task<'a> {
    /// The other variables a backend solves in: states beside the design only where it takes them.
    pub(super) fn substitution_for(&self, backend: &dyn Backend) -> Option<&'a dyn Substitution> {
        let states = |model: &dyn Model| model.meta().states.is_some();
        let own = states(self.model);
        let takes =
            |other: &&'a dyn Substitution| states(other.model()) == own || states(other.model()) == backend.takes_states();
        self.substitution.filter(takes)
    }

    /// The model a backend works on: the substituted one, where there is one for it (there, geometric programs are convex).
    pub fn model_for(&self, backend: &dyn Backend) -> &'a dyn Model {
        self.substitution_for(backend).map_or(self.model, |other| other.model())
    }
}

/// Makes the observer of one run, given the backend's place in the list and its algorithm as asked for. Points arrive in the
/// user's variables.
pub type ObserverFactory<'a> = dyn FnMut(usize, &str) -> Box<dyn FnMut(&Iteration<'_>) + 'a> + 'a;

/// What a run is worth.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
#[allow(missing_docs)]
pub enum Status {
    Certified,
    #[default]
    Uncertified,
    Infeasible,
    Unbounded,
    NotAttained,
    LimitReached,
    Interrupted,
    InvalidValue,
}

impl Status {
    /// The word of the result file.
    pub fn as_str(self) -> &'static str {
        match self {
            Status::Certified => "certified",
            Status::Uncertified => "uncertified",
            Status::Infeasible => "infeasible",
            Status::Unbounded => "unbounded",
            Status::NotAttained => "not-attained",
            Status::LimitReached => "limit-reached",
            Status::Interrupted => "interrupted",
            Status::InvalidValue => "invalid-value",
        }
    }
}

/// One backend's answer, judged.
#[derive(Debug, Clone)]
pub struct Answer {
    /// Name of the backend.
    pub backend: &'static str,
    /// What it brought back; x in the user's variables.
    pub solution: Solution,
    /// f(x), where it has a value.
    pub objective: Option<f64>,
    /// What the point is; `None` where it could not be evaluated.
    pub certificate: Option<Certificate>,
    /// Whether the point meets rows and bounds; also known where the point has values but no derivatives.
    pub feasible: bool,
    /// Which of the backend's attempts gave this answer, counted from 1; 0 where nothing was run.
    pub attempt: usize,
    /// Its share of the work ended the run, and no limit the user set.
    pub gave_way: bool,
    /// What happened besides: restarts, cross-starts, why it is not certified.
    pub remarks: Vec<String>,
}

impl Answer {
    /// A backend's solution, not judged yet.
    pub(super) fn unjudged(backend: &'static str, solution: Solution) -> Answer {
        Answer {
            backend,
            solution,
            objective: None,
            certificate: None,
            feasible: false,
            attempt: 0,
            gave_way: false,
            remarks: Vec::new(),
        }
    }

    /// Whether its point passed the certificate.
    pub fn is_certified(&self) -> bool {
        self.certificate.as_ref().is_some_and(|certificate| certificate.certified)
    }
}

/// How far the backends' answers agree.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Agreement {
    /// All certified and objectives within 1e−6·σ.
    pub agree: bool,
    /// Largest difference of the objectives.
    pub objective_difference: f64,
    /// Largest |x_j − x'_j|/d_j.
    pub variable_difference: f64,
}

/// Rows and bounds that conflict.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Conflict {
    /// The rows violated at the least-violation point, with the signed amount a limit would have to move.
    pub violated_rows: Vec<(usize, f64)>,
    /// A small set of rows that already conflicts,
    pub rows: Vec<usize>,
    /// with these bounds (variable, upper side).
    pub bounds: Vec<(usize, bool)>,
    /// Moves each of which, on its own, makes the problem feasible; the least relative one first.
    pub alternatives: Vec<LimitMove>,
    /// No part of the set conflicts by itself (proved, for linear, geometric and convex problems).
    pub minimal: bool,
}

impl Conflict {
    /// Leaves out auxiliary rows and variables: what they say, the user's rows say.
    pub(super) fn keep_own(&mut self, own: Own) {
        self.violated_rows.retain(|&(row, _)| row < own.rows);
        self.rows.retain(|&row| row < own.rows);
        self.bounds.retain(|&(j, _)| j < own.variables);
        self.alternatives.retain(|alternative| match alternative.limit {
            Limit::Row(row, _) => row < own.rows,
            Limit::Bound(j, _) => j < own.variables,
        });
    }
}

/// A limit moved on its own, with a feasible point to show that it is enough.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LimitMove {
    /// The limit.
    pub limit: Limit,
    /// Where it is.
    pub from: f64,
    /// Where it is enough to have it.
    pub to: f64,
    /// Less would not be enough, but for rounding to six digits (proved: linear, geometric and convex problems).
    pub least: bool,
}

impl LimitMove {
    /// |to − from| over the limit's size; infinite where the limit is 0 and has none.
    pub fn relative(&self) -> f64 {
        (self.to - self.from).abs() / self.from.abs()
    }
}

/// A distinct minimum of the multi-start.
#[derive(Debug, Clone, PartialEq)]
pub struct Minimum {
    /// Its point.
    pub x: Vec<f64>,
    /// f(x)
    pub objective: f64,
    /// How many starts ended there.
    pub count: usize,
}

/// The verdict.
#[derive(Debug, Clone, Default)]
pub struct Outcome {
    /// What the run is worth.
    pub status: Status,
    /// How far it reaches.
    pub scope: Extent,
    /// Why, in plain sentences.
    pub message: String,
    /// What to do about it, where there is something to do.
    pub remedy: Option<String>,
    /// The best answer's point, or the least-violation point, or the start.
    pub x: Vec<f64>,
    /// f(x), where it has a value.
    pub objective: Option<f64>,
    /// What that point is.
    pub certificate: Option<Certificate>,
    /// Which of `answers` is the best.
    pub best: Option<usize>,
    /// One per backend, in the order given.
    pub answers: Vec<Answer>,
    /// Of two or more backends.
    pub agreement: Option<Agreement>,
    /// No feasible point is below this (convex classes).
    pub lower_bound: Option<f64>,
    /// Where the problem is infeasible.
    pub conflict: Option<Conflict>,
    /// Where it is unbounded: a direction, length n.
    pub direction: Option<Vec<f64>>,
    /// Variables that run off, where the minimum is not attained.
    pub runaway: Vec<usize>,
    /// Distinct minima of the multi-start, best first.
    pub minima: Vec<Minimum>,
    /// Two backends hold certified points of equal value, apart from one another.
    pub minimiser_is_not_unique: bool,
    /// Where the run began, if the start was outside the domain.
    pub moved_start: Option<MovedStart>,
    /// A backend holds a feasible point better than the certified best answer.
    pub better_point_elsewhere: bool,
}

impl Outcome {
    /// The exit code of `solve` (docs/verdict.md).
    pub fn exit_code(&self) -> u8 {
        match self.status {
            Status::Certified if !self.better_point_elsewhere => 0,
            Status::Certified | Status::Uncertified => 1,
            Status::Infeasible => 3,
            Status::Unbounded | Status::NotAttained => 4,
            Status::LimitReached | Status::Interrupted => 5,
            Status::InvalidValue => 6,
        }
    }
}
