//! A model that counts, guards and stops: the only way backends see a model.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::Instant;

use super::{Components, EvaluationError, Meta, Model, Stop};

/// When a run must end. Checked before every evaluation, so that it holds inside line searches and foreign solvers too.
#[derive(Debug, Clone, Copy)]
pub struct Budget<'a> {
    /// Points evaluated at the most.
    pub max_evaluations: u64,
    /// The moment to stop.
    pub deadline: Option<Instant>,
    /// Set by Ctrl-C.
    pub interrupt: Option<&'a AtomicBool>,
}

impl Default for Budget<'_> {
    fn default() -> Self {
        Budget { max_evaluations: u64::MAX, deadline: None, interrupt: None }
    }
}

impl Budget<'_> {
    /// Whether a run with this many evaluations behind it must stop.
    pub fn check(&self, evaluations: u64) -> Result<(), Stop> {
        if self.interrupt.is_some_and(|flag| flag.load(Relaxed)) {
            return Err(Stop::Interrupted);
        }
        if self.deadline.is_some_and(|deadline| Instant::now() >= deadline) {
            return Err(Stop::Time);
        }
        if evaluations >= self.max_evaluations {
            return Err(Stop::Evaluations);
        }
        Ok(())
    }
}

/// Wraps a model: counts objective evaluations, refuses what is no number, honours a [`Budget`].
pub struct Evaluator<'a> {
    model: &'a dyn Model,
    budget: Budget<'a>,
    evaluations: AtomicU64,
}

impl<'a> Evaluator<'a> {
    /// A guard around `model`.
    pub fn new(model: &'a dyn Model, budget: Budget<'a>) -> Self {
        Evaluator { model, budget, evaluations: AtomicU64::new(0) }
    }

    /// Objective evaluations so far (value alone or with gradient).
    pub fn evaluations(&self) -> u64 {
        self.evaluations.load(Relaxed)
    }

    /// The budget.
    pub fn budget(&self) -> &Budget<'a> {
        &self.budget
    }

    /// Counts points that were evaluated past this guard, component by component.
    pub fn count(&self, points: u64) {
        self.evaluations.fetch_add(points, Relaxed);
    }

    fn may_go_on(&self) -> Result<(), EvaluationError> {
        self.budget.check(self.evaluations()).map_err(EvaluationError::Stopped)
    }

    fn guard(&self, what: impl Fn(usize) -> String, values: &[f64]) -> Result<(), EvaluationError> {
        match values.iter().position(|value| !value.is_finite()) {
            None => Ok(()),
            Some(at) => Err(EvaluationError::Invalid { term: what(at), cause: format!("the value is {}", values[at]) }),
        }
    }
}

impl Model for Evaluator<'_> {
    fn meta(&self) -> &Meta {
        self.model.meta()
    }

    fn objective(&self, x: &[f64]) -> Result<f64, EvaluationError> {
        self.may_go_on()?;
        self.evaluations.fetch_add(1, Relaxed);
        let value = self.model.objective(x)?;
        self.guard(|_| "objective".into(), &[value])?;
        Ok(value)
    }

    fn gradient(&self, x: &[f64], gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.may_go_on()?;
        self.evaluations.fetch_add(1, Relaxed);
        let value = self.model.gradient(x, gradient)?;
        self.guard(|_| "objective".into(), &[value])?;
        self.guard(|j| format!("derivative of the objective in {}", self.variable_name(j)), gradient)?;
        Ok(value)
    }

    fn constraints(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.may_go_on()?;
        self.model.constraints(x, values)?;
        self.guard(|i| format!("row {}", self.row_name(i)), values)
    }

    fn jacobian(&self, x: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.may_go_on()?;
        self.model.jacobian(x, values)?;
        let row_of = |at: usize| self.meta().jacobian.offsets.partition_point(|&offset| offset <= at) - 1;
        self.guard(|at| format!("derivative of row {}", self.row_name(row_of(at))), values)
    }

    fn hessian(&self, x: &[f64], weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.may_go_on()?;
        self.model.hessian(x, weight, y, values)?;
        self.guard(|_| "second derivatives".into(), values)
    }

    fn components(&self) -> Option<Box<dyn Components + '_>> {
        self.model.components()
    }

    fn variable_name(&self, j: usize) -> String {
        self.model.variable_name(j)
    }

    fn row_name(&self, i: usize) -> String {
        self.model.row_name(i)
    }
}
