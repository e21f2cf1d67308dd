//! What is seen of the runs: the logs, and the rows pictures are drawn from.

use std::cell::RefCell;

use super::folder::FolderError;
use super::results::Results;
use super::{Choice, RunError, Subject, Watcher};
use crate::backends::Iteration;
use crate::crosscheck::{self, Outcome, Task};
use crate::log::IterationLog;
use crate::report::pictures::Trace;

/// Log and rows of each backend, in the order of the choices.
pub(super) struct Records<'s> {
    records: Vec<RefCell<Record>>,
    subject: &'s Subject,
}

struct Record {
    log: IterationLog,
    trace: Trace,
}

impl<'s> Records<'s> {
    /// Opens the logs, before anything is solved: a disk that cannot be written to is told at once. Without results nothing is written.
    ///
    /// # Errors
    /// A log that cannot be made.
    pub fn open(subject: &'s Subject, choices: &[Choice], results: Option<&Results>) -> Result<Records<'s>, RunError> {
        let model = subject.shown();
        let open = |choice: &Choice| {
            let backend = choice.backend.name();
            let log = match results.map(|results| results.log(backend)) {
                None => IterationLog::unwritten(),
                Some(path) => IterationLog::create(&path, model.meta().variables(), |j| model.variable_name(j))
                    .map_err(|cause| RunError::from(FolderError::Unwritable { path, cause }))?,
            };
            Ok(RefCell::new(Record { log, trace: Trace::new(backend) }))
        };
        Ok(Records { records: choices.iter().map(open).collect::<Result<_, RunError>>()?, subject })
    }

    /// The cross-checked run, every iteration logged and shown.
    pub fn watch(&self, task: &Task<'_>, choices: &[Choice], watcher: &mut dyn Watcher) -> Outcome {
        let backends: Vec<_> = choices.iter().map(|choice| (choice.backend, choice.algorithm.as_str())).collect();
        let watcher = RefCell::new(watcher);
        let mut observe = |at: usize, algorithm: &str| -> Box<dyn FnMut(&Iteration<'_>) + '_> {
            let record = self.records.get(at);
            if let Some(record) = record {
                record.borrow_mut().begin();
            }
            watcher.borrow_mut().begin(choices.get(at).map_or("", |choice| choice.backend.name()), algorithm);
            let watcher = &watcher;
            Box::new(move |iteration: &Iteration<'_>| {
                let in_users_sense = self.in_users_terms(iteration);
                if let Some(record) = record {
                    record.borrow_mut().add(&in_users_sense);
                }
                watcher.borrow_mut().iteration(&in_users_sense);
            })
        };
        let outcome = crosscheck::run(task, &backends, &mut observe);
        watcher.borrow_mut().end();
        outcome
    }

    /// An iteration in the user's sense and variables. A restated objective is shown as the user's expression is at that point.
    fn in_users_terms<'i>(&self, iteration: &Iteration<'i>) -> Iteration<'i> {
        let (shown, all) = (self.subject.shown(), iteration.x);
        let x = all.get(..shown.meta().variables()).unwrap_or(all);
        let objective = match self.subject.has_auxiliaries() {
            true => shown.objective(x).unwrap_or(iteration.objective),
            false => iteration.objective,
        };
        Iteration { objective: self.subject.sign() * objective, x, ..*iteration }
    }

    /// Numbers the answers' attempts as the logs do. A solver's last row need not be the point it brought back, as that was polished, or put onto bounds: then it is added.
    pub fn close(&self, outcome: &mut Outcome) {
        for (record, answer) in self.records.iter().zip(&mut outcome.answers) {
            answer.attempt = record.borrow().log.attempt(answer.attempt, &answer.solution.x);
            let Some(certificate) = &answer.certificate else { continue };
            let iteration = Iteration {
                iteration: answer.solution.iterations.unwrap_or(0),
                evaluations: answer.solution.evaluations,
                objective: self.subject.sign() * certificate.objective,
                feasibility: certificate.primal_infeasibility,
                optimality: certificate.dual_infeasibility,
                step_norm: f64::NAN,
                x: &answer.solution.x,
            };
            record.borrow_mut().close(answer.attempt, &iteration);
        }
    }

    /// Why logs end early, if one does.
    pub fn failures(&self) -> Vec<String> {
        self.records.iter().filter_map(|record| record.borrow().log.failure()).collect()
    }

    /// The rows of the runs that gave the answers.
    pub fn traces(self, outcome: &Outcome) -> Vec<Trace> {
        let records = self.records.into_iter().map(RefCell::into_inner).enumerate();
        let of = |(at, record): (usize, Record)| record.trace.of(outcome.answers.get(at).map_or(1, |answer| answer.attempt));
        records.map(of).collect()
    }
}

impl Record {
    fn begin(&mut self) {
        self.log.begin();
    }

    fn add(&mut self, iteration: &Iteration<'_>) {
        let attempt = self.log.add(iteration);
        self.trace.add(attempt, [iteration.objective, iteration.feasibility, iteration.optimality]);
    }

    fn close(&mut self, attempt: usize, iteration: &Iteration<'_>) {
        if self.log.close(attempt, iteration) {
            self.trace.add(attempt, [iteration.objective, iteration.feasibility, iteration.optimality]);
        }
    }
}
