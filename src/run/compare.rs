//! `compare`: every backend and algorithm alone on the problem, one after the other.

use std::sync::atomic::{AtomicBool, Ordering};
use std::time::Instant;

use super::Subject;
use super::choice::{self, Choice};
use super::present::present;
use super::unobserved::unobserved;
use crate::crosscheck::Task;
use crate::problem::Settings;
use crate::report::comparison::{Trial, mark_solved};

/// Runs all solvers on one problem. Its time limit is shared out evenly: what one leaves over, the others get.
pub fn compare(subject: &Subject, interrupt: Option<&AtomicBool>) -> Vec<Trial> {
    let begun = Instant::now();
    let choices = choice::all();
    let mut trials = Vec::with_capacity(choices.len());
    for (done, choice) in choices.iter().enumerate() {
        if interrupt.is_some_and(|flag| flag.load(Ordering::Relaxed)) {
            break;
        }
        let left = (subject.settings.max_seconds - begun.elapsed().as_secs_f64()).max(0.0);
        let max_seconds = left / (choices.len() - done) as f64;
        let model = subject.task(&subject.model().meta().start, None).model_for(choice.backend);
        trials.push(match choice.backend.refusal(&choice.algorithm, model) {
            Some(reason) => refused(subject, choice, reason),
            None => run(subject, choice, max_seconds, interrupt),
        });
    }
    mark_solved(&mut trials, subject.sign());
    trials
}

fn solver(choice: &Choice) -> String {
    format!("{} {}", choice.backend.name(), choice.algorithm)
}

fn refused(subject: &Subject, choice: &Choice, message: String) -> Trial {
    Trial {
        file: subject.about.file.clone(),
        solver: solver(choice),
        status: "refused",
        solved: false,
        objective: None,
        iterations: None,
        evaluations: 0,
        seconds: 0.0,
        message,
    }
}

fn run(subject: &Subject, choice: &Choice, max_seconds: f64, interrupt: Option<&AtomicBool>) -> Trial {
    let settings = Settings { max_seconds, ..subject.settings.clone() };
    let task = Task { settings: &settings, ..subject.task(&subject.model().meta().start, interrupt) };
    let outcome = present(subject, unobserved(&task, std::slice::from_ref(choice)));
    let solution = outcome.answers.first().map(|answer| &answer.solution);
    Trial {
        file: subject.about.file.clone(),
        solver: solver(choice),
        status: outcome.status.as_str(),
        solved: false,
        objective: outcome.objective.map(|value| subject.sign() * value),
        iterations: solution.and_then(|solution| solution.iterations),
        evaluations: solution.map_or(0, |solution| solution.evaluations),
        seconds: solution.map_or(0.0, |solution| solution.seconds),
        message: solution.map_or(outcome.message.clone(), |solution| solution.message.clone()),
    }
}
