//! An outcome in the user's own variables and rows: what follows them is auxiliary.

use super::{Subject, open_end};
use crate::certificate::Certificate;
use crate::crosscheck::Outcome;
use crate::model::{Model, Own};

/// The outcome as reports show it: without auxiliaries, the objective and the rows as the user's expressions at the point.
pub fn present(subject: &Subject, mut outcome: Outcome) -> Outcome {
    open_end::judge(subject, &mut outcome);
    let (model, shown) = (subject.model(), subject.shown());
    let own = model.own();
    if own.variables == model.meta().variables() {
        return outcome;
    }
    outcome.x.truncate(own.variables);
    outcome.objective = valued(shown, &outcome.x, outcome.objective);
    outcome.certificate = outcome.certificate.map(|certificate| reduced(shown, certificate, &outcome.x, own));
    for answer in &mut outcome.answers {
        answer.solution.x.truncate(own.variables);
        answer.solution.multipliers = None;
        answer.objective = valued(shown, &answer.solution.x, answer.objective);
        let certificate = answer.certificate.take();
        answer.certificate = certificate.map(|certificate| reduced(shown, certificate, &answer.solution.x, own));
    }
    for minimum in &mut outcome.minima {
        minimum.x.truncate(own.variables);
    }
    if let Some(direction) = &mut outcome.direction {
        direction.truncate(own.variables);
    }
    outcome.runaway.retain(|&j| j < own.variables);
    if let Some(moved) = &mut outcome.moved_start {
        moved.x.truncate(own.variables);
    }
    outcome
}

/// The user's objective at x, where it has a value.
fn valued(shown: &dyn Model, x: &[f64], otherwise: Option<f64>) -> Option<f64> {
    otherwise.map(|value| shown.objective(x).unwrap_or(value))
}

fn reduced(shown: &dyn Model, mut certificate: Certificate, x: &[f64], own: Own) -> Certificate {
    certificate.objective = shown.objective(x).unwrap_or(certificate.objective);
    certificate.row_values.truncate(own.rows);
    let mut values = vec![0.0; own.rows];
    if shown.constraints(x, &mut values).is_ok() {
        certificate.row_values = values;
    }
    certificate.row_multipliers.truncate(own.rows);
    certificate.row_sides.truncate(own.rows);
    certificate.bound_multipliers.truncate(own.variables);
    certificate.bound_sides.truncate(own.variables);
    certificate.variable_scales.truncate(own.variables);
    certificate.runaway.retain(|&j| j < own.variables);
    if let Some(escape) = &mut certificate.escape {
        escape.truncate(own.variables);
    }
    certificate
}
