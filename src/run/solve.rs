//! `solve`: the folder, the logs, the cross-checked run, the files it leaves.

use std::cell::RefCell;
use std::io::Write;
use std::path::Path;
use std::sync::atomic::AtomicBool;

use super::choice::{Choice, refuse_if_none_accepts};
use super::folder::{Folder, FolderError, default_folder};
use super::pictures;
use super::present::present;
use super::{RunError, Subject, Watcher};
use crate::backends::Iteration;
use crate::crosscheck::{self, Outcome, Task};
use crate::log::IterationLog;
use crate::report::answer::EarlierAnswer;
use crate::report::pictures::Trace;
use crate::report::{About, Findings, Volumes, result, tables, whole_file};

/// What is asked of a run, besides the problem.
pub struct Request<'a> {
    /// Backends and algorithms.
    pub choices: Vec<Choice>,
    /// Output folder; the default where there is none.
    pub out: Option<&'a Path>,
    /// An earlier answer to start from.
    pub start: Option<&'a Path>,
    /// Starting points; 0 or 1: one.
    pub starts: usize,
    /// Leave pictures too.
    pub plot: bool,
    /// Set by Ctrl-C.
    pub interrupt: Option<&'a AtomicBool>,
}

/// What a run found.
pub struct Solved {
    /// The subject's words, with what happened on the way among the warnings.
    pub about: About,
    /// The verdict.
    pub outcome: Outcome,
    /// Volumes at the reported point.
    pub volumes: Option<Volumes>,
    folder: Folder,
}

impl Solved {
    /// What reports speak of.
    pub fn findings<'a>(&'a self, subject: &'a Subject) -> Findings<'a> {
        Findings {
            about: &self.about,
            model: subject.shown(),
            class: subject.class,
            outcome: &self.outcome,
            volumes: self.volumes,
        }
    }

    /// Where the files are.
    pub fn folder(&self) -> &Path {
        self.folder.path()
    }
}

/// Solves and leaves logs, tables and `result.json`. The watcher sees every iteration.
///
/// # Errors
/// Before anything is solved: a folder that cannot be used, an answer that cannot be read, no backend that takes the
/// problem. Afterwards: files that cannot be written.
pub fn solve(subject: &Subject, request: &Request<'_>, watcher: &mut dyn Watcher) -> Result<Solved, RunError> {
    refuse_if_none_accepts(&request.choices, subject.model())?;
    let mut about = subject.about.clone();
    let (start, start_multipliers) = starting_point(subject, request.start, &mut about.warnings)?;
    let default = default_folder(Path::new(&about.file));
    let folder = Folder::open(request.out.unwrap_or(&default))?;
    folder.remove_old_logs()?;
    let logs = open_logs(subject, &request.choices, &folder)?;
    let task = Task {
        model: subject.model(),
        substitution: subject.substitution(),
        class: subject.class,
        settings: &subject.settings,
        start: &start,
        start_multipliers: start_multipliers.as_deref(),
        starts: request.starts,
        interrupt: request.interrupt,
    };
    let traces: Vec<_> = request.choices.iter().map(|choice| RefCell::new(Trace::new(choice.backend.name()))).collect();
    let outcome = present(subject, observed(&task, &request.choices, &logs, &traces, watcher, subject));
    about.warnings.extend(outcome.moved_start.iter().map(|moved| moved.remark.clone()));
    about.warnings.extend(logs.iter().filter_map(|log| log.borrow().failure()));
    let volumes = subject.volumes(&outcome.x);
    let solved = Solved { about, outcome, volumes, folder };
    leave_files(&solved.findings(subject), &solved.folder)?;
    if request.plot {
        let traces: Vec<Trace> = traces.into_iter().map(RefCell::into_inner).collect();
        let start = solved.outcome.moved_start.as_ref().map_or(&start, |moved| &moved.x);
        let start = &start[..start.len().min(subject.shown().meta().variables())];
        pictures::leave(&traces, start, subject, &solved)?;
    }
    Ok(solved)
}

fn starting_point(
    subject: &Subject,
    answer: Option<&Path>,
    warnings: &mut Vec<String>,
) -> Result<(Vec<f64>, Option<Vec<f64>>), RunError> {
    let Some(path) = answer else {
        return Ok((subject.model().meta().start.clone(), None));
    };
    let answer = EarlierAnswer::read(path)?;
    let (start, remarks) = answer.start(subject.shown());
    warnings.extend(remarks);
    Ok((subject.completed(start), answer.multipliers(subject.model(), subject.sign())))
}

/// Logs are opened before anything is solved: a disk that cannot be written to is told at once.
fn open_logs(subject: &Subject, choices: &[Choice], folder: &Folder) -> Result<Vec<RefCell<IterationLog>>, RunError> {
    let model = subject.shown();
    let open = |choice: &Choice| {
        let path = folder.file(&format!("log-{}.csv", choice.backend.name()));
        let log = IterationLog::create(&path, model.meta().variables(), |j| model.variable_name(j));
        log.map(RefCell::new).map_err(|cause| RunError::from(FolderError::Unwritable { path, cause }))
    };
    choices.iter().map(open).collect()
}

/// The cross-checked run, every iteration logged and shown.
fn observed(
    task: &Task<'_>,
    choices: &[Choice],
    logs: &[RefCell<IterationLog>],
    traces: &[RefCell<Trace>],
    watcher: &mut dyn Watcher,
    subject: &Subject,
) -> Outcome {
    let backends: Vec<_> = choices.iter().map(|choice| (choice.backend, choice.algorithm.as_str())).collect();
    let watcher = RefCell::new(watcher);
    let mut begun = vec![false; choices.len()];
    let mut observe = |at: usize, algorithm: &str| -> Box<dyn FnMut(&Iteration<'_>) + '_> {
        let (log, trace) = (logs.get(at), traces.get(at));
        if let (Some(log), Some(begun @ false)) = (log, begun.get_mut(at)) {
            log.borrow_mut().begin();
            *begun = true;
        }
        watcher.borrow_mut().begin(choices.get(at).map_or("", |choice| choice.backend.name()), algorithm);
        let watcher = &watcher;
        Box::new(move |iteration: &Iteration<'_>| {
            let in_users_sense = in_users_terms(subject, iteration);
            if let Some(log) = log {
                log.borrow_mut().add(&in_users_sense);
            }
            if let Some(trace) = trace {
                trace.borrow_mut().add([in_users_sense.objective, iteration.feasibility, iteration.optimality]);
            }
            watcher.borrow_mut().iteration(&in_users_sense);
        })
    };
    let outcome = crosscheck::run(task, &backends, &mut observe);
    watcher.borrow_mut().end();
    outcome
}

/// An iteration in the user's sense and variables. A restated objective is shown as the user's expression is at that point.
fn in_users_terms<'i>(subject: &Subject, iteration: &Iteration<'i>) -> Iteration<'i> {
    let (shown, all) = (subject.shown(), iteration.x);
    let x = all.get(..shown.meta().variables()).unwrap_or(all);
    let objective = match x.len() < all.len() {
        true => shown.objective(x).unwrap_or(iteration.objective),
        false => iteration.objective,
    };
    Iteration { objective: subject.sign() * objective, x, ..*iteration }
}

fn leave_files(findings: &Findings<'_>, folder: &Folder) -> Result<(), RunError> {
    let write = |name: &str, content: &dyn Fn(&mut dyn Write) -> std::io::Result<()>| {
        let path = folder.file(name);
        whole_file::write(&path, |out| content(out)).map_err(|cause| FolderError::Unwritable { path, cause })
    };
    write("variables.csv", &|out| tables::variables(findings, out))?;
    write("constraints.csv", &|out| tables::constraints(findings, out))?;
    write("result.json", &|out| result::write(findings, out))?;
    Ok(())
}
