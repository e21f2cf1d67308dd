//! The answer by names.

use crate::crosscheck::{Outcome, Status};
use crate::model::{Meta, NameTable};
use crate::run::Subject;

/// What a problem's solution is worth, and its values by name.
pub struct Answer {
    outcome: Outcome,
    names: NameTable,
    sign: f64,
    variables: usize,
    volume: Option<f64>,
}

impl Answer {
    pub(super) fn new(subject: &Subject, outcome: Outcome) -> Answer {
        let Meta { names, .. } = subject.shown().meta();
        let volume = subject.volumes(&outcome.x).map(|volumes| volumes.total);
        Answer { names: names.clone(), sign: subject.sign(), variables: subject.shown().meta().variables(), volume, outcome }
    }

    /// The verdict: certified, infeasible, unbounded, …
    pub fn status(&self) -> Status {
        self.outcome.status
    }

    /// Whether the point is proved to be a minimum (a maximum, where that is asked for).
    pub fn is_certified(&self) -> bool {
        self.outcome.status == Status::Certified
    }

    /// The verdict in plain sentences.
    pub fn message(&self) -> &str {
        &self.outcome.message
    }

    /// The objective's value, where it has one.
    pub fn objective(&self) -> Option<f64> {
        self.outcome.objective.map(|value| self.sign * value)
    }

    /// The volume of all ribs, where there are any.
    pub fn volume(&self) -> Option<f64> {
        self.volume
    }

    /// The value of a variable: `depth`, `x[2]`, `support.b`; `None` for a name that is no variable.
    pub fn value(&self, name: &str) -> Option<f64> {
        self.values().find(|(own, _)| own == name).map(|(_, value)| value)
    }

    /// All variables with their values.
    pub fn values(&self) -> impl Iterator<Item = (String, f64)> + '_ {
        self.outcome.x.iter().take(self.variables).enumerate().map(|(j, &value)| (self.names.variable(j), value))
    }

    /// The multiplier of a row: by how much the objective changes per unit of its limit, up to sign; `None` for a name that is no row,
    /// or where no certificate was made.
    pub fn multiplier(&self, row: &str) -> Option<f64> {
        let certificate = self.outcome.certificate.as_ref()?;
        let at = (0..certificate.row_multipliers.len()).find(|&i| self.names.row(i) == row)?;
        Some(self.sign * certificate.row_multipliers[at])
    }

    /// Everything that was found: certificate, every backend's answer, conflicts.
    pub fn outcome(&self) -> &Outcome {
        &self.outcome
    }
}
