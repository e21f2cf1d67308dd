//! Models of your own.

use crate::certificate::{self, Certificate, Tolerances};
use crate::crosscheck::{Outcome, Task};
use crate::model::{Class, EvaluationError, Model};
use crate::problem::Settings;
use crate::run::RunError;
use crate::run::choice::{choose, refuse_if_none_accepts};
use crate::run::unobserved::unobserved;

/// Solves a model from its start with every backend of the settings (all that are built in, by default), and judges what they find.
/// Nothing is known of its class, so a certified minimum is a local one.
///
/// # Errors
/// No backend takes it.
///
/// ```
/// use ribopt::model::closures::{Closures, Function};
///
/// // minimise (x − 3)² subject to x ≤ 2
/// let model = Closures::new(&["x"], &[0.5], &[], &[])
///     .minimise(Function::dense(1, |x| (x[0] - 3.0).powi(2), |x, g| g[0] = 2.0 * (x[0] - 3.0), |_, h| h[0] = 2.0))
///     .row("limit", f64::NEG_INFINITY, 2.0, Function::affine(0.0, &[(0, 1.0)]));
/// let outcome = ribopt::solve(&model, &Default::default())?;
/// assert!((outcome.x[0] - 2.0).abs() < 1e-8);
/// assert!(ribopt::certify(&model, &outcome.x)?.certified);
/// assert!(!ribopt::certify(&model, &[1.0])?.certified);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub fn solve(model: &dyn Model, settings: &Settings) -> Result<Outcome, RunError> {
    let choices = choose(&[], None, settings)?;
    let start = model.meta().start.clone();
    let task = Task {
        model,
        substitution: None,
        class: Class::Nonlinear,
        settings,
        start: &start,
        start_multipliers: None,
        starts: 1,
        interrupt: None,
    };
    refuse_if_none_accepts(&choices, &task)?;
    Ok(unobserved(&task, &choices))
}

/// Judges a point of any model, wherever it comes from, by the default tolerances. docs/certificate.md tells what is proved.
///
/// # Errors
/// The model has no value or derivative there.
pub fn certify(model: &dyn Model, x: &[f64]) -> Result<Certificate, EvaluationError> {
    certificate::certify(model, Class::Nonlinear, x, None, Tolerances::default())
}
