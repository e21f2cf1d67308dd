//! What follows a command's first run: further runs, and by what and within what time they are made.

use std::sync::atomic::AtomicBool;

use super::present::present;
use super::remaining::Remaining;
use super::unobserved::{by_interior_point, unobserved};
use super::{Choice, Subject, coinciding, vanished};
use crate::crosscheck::{Outcome, Task};
use crate::problem::Settings;

/// What further runs of a command go by.
pub(super) struct Further<'a> {
    pub choices: &'a [Choice],
    pub settings: &'a Settings,
    pub remaining: &'a Remaining,
    pub interrupt: Option<&'a AtomicBool>,
}

impl Further<'_> {
    /// The task's outcome by `run`, judged anew where modes coincide or bars have vanished; and the problem it is then an outcome of.
    pub fn judged(
        &self,
        subject: &Subject,
        task: &Task<'_>,
        run: impl FnMut(&Task<'_>) -> Outcome,
    ) -> (Outcome, Option<Subject>) {
        let (outcome, other) = self.found(subject, task, run);
        (coinciding::unless_undecided(other.as_ref().unwrap_or(subject), outcome), other)
    }

    fn found(&self, subject: &Subject, task: &Task<'_>, mut run: impl FnMut(&Task<'_>) -> Outcome) -> (Outcome, Option<Subject>) {
        let quiet = self.of_rounds();
        // The run that is logged has half of the time, whatever comes before it.
        let half = |settings: &Settings| Settings { max_seconds: settings.max_seconds / 2.0, ..settings.clone() };
        let near =
            |rest: &Subject, settings: &Settings, x: &[f64]| self.from(rest, &half(settings), x, (self.choices, task.starts));
        let rounds = |rest: &Subject, settings: &Settings, x: &[f64]| self.from(rest, settings, x, (&quiet, 1));
        let foreseen = coinciding::foresee(subject, self.settings, task.start, &near, &rounds);
        let left = self.remaining.settings(task.settings);
        let none = Settings { max_seconds: 0.0, ..task.settings.clone() };
        let task = &Task { settings: left.as_ref().unwrap_or(&none), ..*task };
        if let Some(foreseen) = foreseen {
            let start = foreseen.subject.completed(foreseen.outcome.x.clone());
            let own = foreseen.subject.task(&start, self.interrupt);
            let all = left.is_some().then(|| run(&Task { settings: task.settings, starts: task.starts, ..own }));
            let all = all.map(|all| present(&foreseen.subject, all));
            if let Some(settled) = foreseen.compared(subject, all) {
                return (settled.outcome, Some(settled.subject));
            }
        }
        let outcome = present(subject, run(task));
        let again = |rest: &Subject, x: &[f64]| self.nearby(rest, x);
        let coinciding = coinciding::exchange(subject, self.settings, &outcome, &rounds).and_then(|found| {
            let all = again(&found.subject, &found.outcome.x);
            found.compared(subject, all)
        });
        match coinciding.or_else(|| vanished::settle(subject, &outcome, again)) {
            Some(settled) => (settled.outcome, Some(settled.subject)),
            None => (outcome, None),
        }
    }

    /// One start of every backend from a point of the user's variables; `None` where no time is left for it.
    pub fn nearby(&self, subject: &Subject, x: &[f64]) -> Option<Outcome> {
        self.from(subject, self.settings, x, (self.choices, 1))
    }

    /// Rounds that nobody sees are the interior point's, where it is asked for.
    fn of_rounds(&self) -> Vec<Choice> {
        let interior_point = by_interior_point();
        let is_asked = self.choices.iter().any(|choice| choice.backend.name() == interior_point.backend.name());
        if is_asked { vec![interior_point] } else { self.choices.to_vec() }
    }

    fn from(&self, subject: &Subject, settings: &Settings, x: &[f64], (choices, starts): (&[Choice], usize)) -> Option<Outcome> {
        let settings = self.remaining.settings(settings)?;
        let start = subject.completed(x.to_vec());
        let task = Task { settings: &settings, starts, ..subject.task(&start, self.interrupt) };
        Some(present(subject, unobserved(&task, choices)))
    }
}
