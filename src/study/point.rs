//! One point of a study: the problem read with its values, solved, and what came of it as a row.

use std::sync::atomic::AtomicBool;
use std::time::Instant;

use super::row::finite;
use super::{OnFailure, Point, Row, Study, StudyError, sensitivity};
use crate::crosscheck::{Outcome, Status};
use crate::report::Findings;
use crate::report::governing::Governing;
use crate::run::solve::{Found, Quiet, quietly};
use crate::run::{RunError, Subject, analyse, choice};

/// Limits that a row names.
const NAMED: usize = 3;

/// Objectives this near to one another, relatively, are one: of two starts the warm one is kept then.
const TIE: f64 = 1e-9;

/// An answer to go on from.
pub(super) struct Warm {
    names: Vec<String>,
    x: Vec<f64>,
    multipliers: Option<Vec<f64>>,
}

/// A run of a point, and where it began.
struct Ran {
    found: Found,
    start: &'static str,
}

/// Solves a point; from `warm` where its variables are the same. Every few points (`also_cold`) a nonlinear problem starts cold as well.
/// `None` where it was interrupted.
///
/// # Errors
/// The problem has changed since the study began.
pub(super) fn solve(
    study: &Study,
    point: &Point,
    (warm, also_cold): (Option<&Warm>, bool),
    interrupt: Option<&AtomicBool>,
) -> Result<Option<(Row, Option<Warm>)>, StudyError> {
    let begun = Instant::now();
    let wrong = |error: RunError| {
        let message = error.mistakes().into_iter().next().map_or_else(|| error.to_string(), |mistake| mistake.message);
        Ok(Some((Row::without_numbers(point, "mistake", Some(2), message), None)))
    };
    let subject = match Subject::read_with(&study.problem, &study.additions(point), &|_| {}) {
        Ok(subject) => subject,
        Err(error) => return wrong(error),
    };
    if subject.about.sha256 != study.problem_sha256 {
        return Err(StudyError::Changed(study.problem.clone()));
    }
    let names: Vec<String> = (0..subject.shown().meta().variables()).map(|j| subject.shown().variable_name(j)).collect();
    let warm = warm.filter(|warm| warm.names == names);
    let ran = match best_start(study, &subject, (warm, also_cold), interrupt) {
        Ok(ran) => ran,
        Err(error) => return wrong(error),
    };
    if ran.found.outcome.status == Status::Interrupted {
        return Ok(None);
    }
    let row = row(study, point, &subject, &ran);
    let outcome = &ran.found.outcome;
    let next =
        (ran.found.judged.is_none() && outcome.objective.is_some() && outcome.status != Status::Infeasible).then(|| Warm {
            names,
            x: outcome.x.clone(),
            multipliers: outcome.certificate.as_ref().map(|certificate| certificate.row_multipliers.clone()),
        });
    Ok(Some((Row { seconds: begun.elapsed().as_secs_f64(), ..row }, next)))
}

/// The better of a warm and a cold run, where both are due.
fn best_start(
    study: &Study,
    subject: &Subject,
    (warm, also_cold): (Option<&Warm>, bool),
    interrupt: Option<&AtomicBool>,
) -> Result<Ran, RunError> {
    let Some(warm) = warm else { return run(study, subject, None, interrupt) };
    let first = run(study, subject, Some(warm), interrupt)?;
    let nonlinear = also_cold && !subject.class().is_global();
    let failed = study.options.on_failure == OnFailure::RetryCold && !is_settled(&first.found.outcome);
    if first.found.outcome.status == Status::Interrupted || !(nonlinear || failed) {
        return Ok(first);
    }
    let second = run(study, subject, None, interrupt)?;
    let interrupted = second.found.outcome.status == Status::Interrupted;
    Ok(if interrupted || is_better(&second.found.outcome, &first.found.outcome) { second } else { first })
}

fn is_settled(outcome: &Outcome) -> bool {
    matches!(outcome.exit_code(), 0 | 3 | 4)
}

/// Whether an outcome is worth more than another: settled before open, then the lower objective (of the minimised form).
fn is_better(one: &Outcome, other: &Outcome) -> bool {
    let rank = |outcome: &Outcome| match (outcome.exit_code(), outcome.objective) {
        (0, Some(_)) => 0,
        (3 | 4, _) => 1,
        (_, Some(_)) => 2,
        _ => 3,
    };
    match (rank(one), rank(other), one.objective, other.objective) {
        (a, b, ..) if a != b => a < b,
        (_, _, Some(a), Some(b)) => a < b - TIE * b.abs(),
        _ => false,
    }
}

fn run(study: &Study, subject: &Subject, warm: Option<&Warm>, interrupt: Option<&AtomicBool>) -> Result<Ran, RunError> {
    let mut settings = subject.settings.clone();
    if let Some(seconds) = study.options.max_seconds {
        settings.max_seconds = seconds;
    }
    let choices = choice::choose(&[], None, &settings)?;
    let rows = subject.model().meta().rows();
    let start = warm.map(|warm| {
        let mut x = warm.x.clone();
        subject.shown().meta().clamp(&mut x);
        x
    });
    let multipliers = warm.and_then(|warm| warm.multipliers.as_deref()).filter(|multipliers| multipliers.len() == rows);
    let starts = if warm.is_some() { 1 } else { subject.usual_starts() };
    let quiet = Quiet { choices: &choices, settings: &settings, start, start_multipliers: multipliers, starts, interrupt };
    let found = quietly(subject, &quiet)?;
    Ok(Ran { found, start: if warm.is_some() { "warm" } else { "cold" } })
}

/// What is told of a run.
fn row(study: &Study, point: &Point, subject: &Subject, ran: &Ran) -> Row {
    let outcome = &ran.found.outcome;
    let judged = ran.found.judged.as_ref().unwrap_or(subject);
    let volumes = subject.volumes(&outcome.x);
    let findings = Findings {
        about: &ran.found.about,
        model: judged.shown(),
        class: judged.class(),
        outcome,
        volumes,
        mass: None,
        utilisation: None,
    };
    let mut row = Row::without_numbers(point, outcome.status.as_str(), Some(outcome.exit_code()), outcome.message.clone());
    row.start = ran.start.to_owned();
    row.iterations = outcome.best.and_then(|best| outcome.answers[best].solution.iterations);
    row.lower_bound = finite(findings.lower_bound());
    // What is infeasible or has no end is no design: its numbers would be taken for one.
    if matches!(outcome.exit_code(), 3 | 4 | 6) || outcome.certificate.is_none() {
        return row;
    }
    row.scope = Some(outcome.scope.as_str().to_owned());
    row.objective = finite(findings.objective());
    row.volume = finite(volumes.map(|volumes| volumes.total));
    row.variables = outcome.x.iter().take(study.variables.len()).map(|&value| finite(Some(value))).collect();
    row.quantities = quantities(study, subject, &outcome.x);
    row.governs = Governing::of(&findings, NAMED).costliest.iter().map(|limit| limit.name.clone()).collect();
    if ran.found.judged.is_none() && ran.found.about.chosen.is_empty() && outcome.exit_code() == 0 {
        row.sensitivities = sensitivity::all(study, point, subject, &findings);
    }
    row
}

/// The study's quantities at a design.
fn quantities(study: &Study, subject: &Subject, x: &[f64]) -> Vec<Option<f64>> {
    if study.quantities.is_empty() {
        return Vec::new();
    }
    let known = analyse::definitions(subject, x).unwrap_or_default();
    let value = |name: &str| known.iter().find(|(known, _)| known == name).and_then(|(_, value)| finite(Some(*value)));
    study.quantities.iter().map(|quantity| value(&quantity.name)).collect()
}
