//! A model that counts, guards and stops: the only way backends see a model.

use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::time::Instant;

use super::{Components, Evaluation, EvaluationError, Meta, Model, Stop};

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

    /// The name of variable j, for messages.
    pub fn variable_name(&self, j: usize) -> String {
        self.meta().names.variable(j)
    }

    /// The name of row i, for messages.
    pub fn row_name(&self, i: usize) -> String {
        self.meta().names.row(i)
    }

    fn count_one(&self) -> Result<(), EvaluationError> {
        self.may_go_on()?;
        self.evaluations.fetch_add(1, Relaxed);
        Ok(())
    }
}

impl Model for Evaluator<'_> {
    fn meta(&self) -> &Meta {
        self.model.meta()
    }

    fn may_go_on(&self) -> Result<(), EvaluationError> {
        self.budget.check(self.evaluations()).map_err(EvaluationError::Stopped)
    }

    fn at<'m>(&'m self, x: &[f64]) -> Result<Box<dyn Evaluation + 'm>, EvaluationError> {
        self.may_go_on()?;
        Ok(Box::new(Guarded { guard: self, inner: self.model.at(x)? }))
    }

    fn components(&self) -> Option<Box<dyn Components + '_>> {
        self.model.components()
    }
}

/// One point behind the guard.
struct Guarded<'m> {
    guard: &'m Evaluator<'m>,
    inner: Box<dyn Evaluation + 'm>,
}

impl Evaluation for Guarded<'_> {
    fn objective(&mut self) -> Result<f64, EvaluationError> {
        self.guard.count_one()?;
        let value = self.inner.objective()?;
        guard(|_| "objective".into(), &[value])?;
        Ok(value)
    }

    fn gradient(&mut self, gradient: &mut [f64]) -> Result<f64, EvaluationError> {
        self.guard.count_one()?;
        let value = self.inner.gradient(gradient)?;
        guard(|_| "objective".into(), &[value])?;
        let names = &self.guard.meta().names;
        guard(|j| format!("derivative of the objective in {}", names.variable(j)), gradient)?;
        Ok(value)
    }

    fn constraints(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.guard.may_go_on()?;
        self.inner.constraints(values)?;
        guard(|i| format!("row {}", self.guard.meta().names.row(i)), values)
    }

    fn jacobian(&mut self, values: &mut [f64]) -> Result<(), EvaluationError> {
        self.guard.may_go_on()?;
        self.inner.jacobian(values)?;
        let meta = self.guard.meta();
        let row_of = |at: usize| meta.jacobian.offsets.partition_point(|&offset| offset <= at) - 1;
        guard(|at| format!("derivative of row {}", meta.names.row(row_of(at))), values)
    }

    fn hessian(&mut self, weight: f64, y: &[f64], values: &mut [f64]) -> Result<(), EvaluationError> {
        self.guard.may_go_on()?;
        self.inner.hessian(weight, y, values)?;
        guard(|_| "second derivatives".into(), values)
    }

    fn hessian_product(&mut self, weight: f64, y: &[f64], direction: &[f64], product: &mut [f64]) -> Result<(), EvaluationError> {
        self.guard.may_go_on()?;
        self.inner.hessian_product(weight, y, direction, product)?;
        guard(|_| "second derivatives".into(), product)
    }
}

/// Refuses what is no number.
fn guard(what: impl Fn(usize) -> String, values: &[f64]) -> Result<(), EvaluationError> {
    match values.iter().position(|value| !value.is_finite()) {
        None => Ok(()),
        Some(at) => Err(EvaluationError::Invalid { term: what(at), cause: format!("the value is {}", values[at]) }),
    }
}
