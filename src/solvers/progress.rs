//! What an iteration leaves behind, and how a run ends.

use crate::model::{EvaluationError, Stop};

/// A point with what decides its rank, and what is shown of it.
#[derive(Debug, Clone)]
pub struct RankedPoint {
    /// The model's x.
    pub x: Vec<f64>,
    /// f(x)
    pub objective: f64,
    /// Largest violation relative to the rows' scales: what decides the rank.
    pub relative_violation: f64,
    /// Largest absolute violation: what is shown.
    pub feasibility: f64,
    /// First-order optimality measure.
    pub optimality: f64,
    /// Row multipliers in the model's units.
    pub multipliers: Option<Vec<f64>>,
}

impl RankedPoint {
    /// Feasible (to `tolerance`) before cheap: whether this point ranks above another.
    pub fn ranks_above(&self, other: &RankedPoint, tolerance: f64) -> bool {
        match (self.relative_violation <= tolerance, other.relative_violation <= tolerance) {
            (true, true) => self.objective < other.objective,
            (feasible, also) if feasible != also => feasible,
            _ => self.relative_violation < other.relative_violation,
        }
    }
}

/// Why a run ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Why {
    /// No further progress is to be expected.
    Converged,
    /// Iterations, evaluations or time ran out.
    LimitReached,
    /// Ctrl-C.
    Interrupted,
    /// The solver gave up, or the model gave a value that is no number.
    Failed,
}

/// How a run ended.
#[derive(Debug, Clone)]
pub struct Conclusion {
    /// Why.
    pub why: Why,
    /// The same in one sentence.
    pub message: String,
    /// The evaluation error that ended the run.
    pub invalid: Option<String>,
}

impl Conclusion {
    /// A run that ended by itself.
    pub fn new(why: Why, message: String) -> Self {
        Conclusion { why, message, invalid: None }
    }

    /// What an evaluation error means for a run.
    pub fn of(error: &EvaluationError) -> Self {
        let (why, invalid) = match error {
            EvaluationError::Stopped(Stop::Interrupted) => (Why::Interrupted, None),
            EvaluationError::Stopped(_) => (Why::LimitReached, None),
            EvaluationError::Invalid { .. } => (Why::Failed, Some(error.to_string())),
        };
        Conclusion { why, message: error.to_string(), invalid }
    }
}

/// An iterate and the way to it.
#[derive(Debug)]
pub struct Reached {
    /// The iterate.
    pub point: RankedPoint,
    /// Norm of the step there.
    pub step_norm: f64,
    /// Objective evaluations so far.
    pub evaluations: u64,
}

/// What one iteration came to.
#[derive(Debug)]
pub struct Progress {
    /// The new iterate; `None` where the last one stands.
    pub at: Option<Reached>,
    /// Set when the run is over: how, and the answer where it is not the best iterate by rank.
    pub ending: Option<(Conclusion, Option<RankedPoint>)>,
}

impl Progress {
    /// A new iterate.
    pub fn at(point: RankedPoint, step_norm: f64, evaluations: u64) -> Self {
        Progress { at: Some(Reached { point, step_norm, evaluations }), ending: None }
    }

    /// A run that an evaluation error ended.
    pub fn failed(error: &EvaluationError) -> Self {
        Progress { at: None, ending: Some((Conclusion::of(error), None)) }
    }

    /// The same with an ending.
    pub fn concluded(self, conclusion: Conclusion, answer: Option<RankedPoint>) -> Self {
        Progress { ending: Some((conclusion, answer)), ..self }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_feasible_point_ranks_above_a_cheaper_infeasible_one() {
        let point = |objective: f64, violation: f64| RankedPoint {
            x: vec![objective],
            objective,
            relative_violation: violation,
            feasibility: violation,
            optimality: 1.0,
            multipliers: None,
        };
        let mut best = point(5.0, 1.0);
        for (objective, violation, expected) in [(9.0, 0.5, 9.0), (7.0, 0.0, 7.0), (1.0, 0.1, 7.0), (6.0, 1e-9, 6.0)] {
            let next = point(objective, violation);
            if next.ranks_above(&best, 1e-8) {
                best = next;
            }
            assert_eq!(best.objective, expected);
        }
    }
}
