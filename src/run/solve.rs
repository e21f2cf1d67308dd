//! `solve`: the folder, the logs, the cross-checked run, the files it leaves.

use std::path::{Path, PathBuf};
use std::sync::atomic::AtomicBool;

use super::bounded::bound_below;
use super::choice::{Choice, choose, refuse_if_none_accepts};
use super::courses::courses;
use super::folder::{Folder, default_folder};
use super::further::Further;
use super::observe::Records;
use super::refinement;
use super::remaining::Remaining;
use super::results::{Ending, Results};
use super::unobserved::unobserved;
use super::{MOST_LISTED, RunError, Subject, Watcher, lists, pictures, sizes, stand_in, strongest, structure_files, utilisation};
use crate::crosscheck::{Outcome, Status, Task};
use crate::files::Inputs;
use crate::files::whole::Content;
use crate::problem::Settings;
use crate::report::answer::EarlierAnswer;
use crate::report::{About, Findings, Volumes, result, tables};

/// What is asked of a run, besides the problem.
pub struct Request<'a> {
    /// Backends and algorithms.
    pub choices: Vec<Choice>,
    /// Output folder; the default where there is none.
    pub out: Option<&'a Path>,
    /// An earlier answer to start from.
    pub start: Option<&'a EarlierAnswer>,
    /// Everything that was read: no output takes its place.
    pub inputs: &'a Inputs,
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
    /// Mass of all ribs there, where each has a density.
    pub mass: Option<f64>,
    /// How far every limit is used, where all have values.
    pub utilisation: Option<utilisation::Table>,
    /// Why files could not be written: the answer is to be shown first.
    pub unwritten: Option<RunError>,
    /// The problem that the point was judged in, where that is not the user's: without vanished bars, or with coinciding modes.
    judged: Option<Subject>,
    place: PathBuf,
    _locked: Option<Folder>,
}

impl Solved {
    /// What reports speak of.
    pub fn findings<'a>(&'a self, subject: &'a Subject) -> Findings<'a> {
        let subject = self.judged(subject);
        Findings {
            about: &self.about,
            model: subject.shown(),
            class: subject.class(),
            outcome: &self.outcome,
            volumes: self.volumes,
            mass: self.mass,
            utilisation: self.utilisation.as_ref(),
        }
    }

    /// The problem that the point is of: the user's, or the one it was judged in.
    pub fn judged<'a>(&'a self, subject: &'a Subject) -> &'a Subject {
        self.judged.as_ref().unwrap_or(subject)
    }

    /// Where the files are; empty where none were left.
    pub fn folder(&self) -> &Path {
        &self.place
    }
}

/// Solves and leaves logs, tables and `result.json`. The watcher sees every iteration.
///
/// # Errors
/// Before anything is solved: a folder that cannot be used, no backend that takes the problem. Files that cannot be written
/// afterwards are told by [`Solved::unwritten`].
pub fn solve(subject: &Subject, request: &Request<'_>, watcher: &mut dyn Watcher) -> Result<Solved, RunError> {
    let default = default_folder(Path::new(&subject.about.file));
    let backends: Vec<&str> = request.choices.iter().map(|choice| choice.backend.name()).collect();
    run(subject, request, watcher, || Ok(Some(Results::open(request.out.unwrap_or(&default), &backends, request.inputs)?)))
}

/// The same without any file: [`Request::out`], [`Request::inputs`] and [`Request::plot`] count for nothing.
///
/// # Errors
/// No backend takes the problem.
pub fn solve_in_memory(subject: &Subject, request: &Request<'_>, watcher: &mut dyn Watcher) -> Result<Solved, RunError> {
    run(subject, request, watcher, || Ok(None))
}

fn run(
    subject: &Subject,
    request: &Request<'_>,
    watcher: &mut dyn Watcher,
    results: impl FnOnce() -> Result<Option<Results>, RunError>,
) -> Result<Solved, RunError> {
    let remaining = Remaining::new();
    subject.refuse_mechanism()?;
    refuse_if_none_accepts(&request.choices, &subject.task(&subject.model().meta().start, None))?;
    let mut about = subject.about.clone();
    let (start, start_multipliers) = starting_point(subject, request.start, &mut about.warnings);
    let results = results()?;
    about.warnings.extend(results.as_ref().and_then(|results| results.belongs_to_another(&about.file, &about.sha256)));
    let records = Records::open(subject, &request.choices, results.as_ref())?;
    let task = Task {
        start_multipliers: start_multipliers.as_deref(),
        starts: request.starts,
        ..subject.task(&start, request.interrupt)
    };
    let further =
        Further { choices: &request.choices, settings: &subject.settings, remaining: &remaining, interrupt: request.interrupt };
    let (mut outcome, judged) = further.judged(subject, &task, |task| records.watch(task, &request.choices, watcher));
    let judged = followed_up(subject, (&mut outcome, judged), &mut about, &further);
    about.warnings.extend(refinement::remarks(subject, &outcome.x));
    about.warnings.extend(stand_in::remark(judged.as_ref().unwrap_or(subject), &outcome));
    let subject = judged.as_ref().unwrap_or(subject);
    records.close(&mut outcome);
    about.warnings.extend(outcome.moved_start.iter().map(|moved| moved.remark.clone()));
    about.warnings.extend(records.failures());
    let few_rows = subject.shown().meta().rows() <= MOST_LISTED;
    let utilisation = few_rows.then(|| utilisation::table(subject, &outcome.x).ok()).flatten();
    let (volumes, mass) = (subject.volumes(&outcome.x), sizes::mass(subject.problem(), &outcome.x));
    let mut solved = Solved {
        outcome,
        volumes,
        mass,
        utilisation,
        unwritten: None,
        judged: None,
        place: PathBuf::new(),
        _locked: None,
        about,
    };
    if let Some(results) = results {
        leave(subject, &mut solved, results, records, (&start, request.plot));
    }
    Ok(Solved { judged, ..solved })
}

/// Leaves the files of a run that began at this start, pictures too where these are asked for.
fn leave(subject: &Subject, solved: &mut Solved, results: Results, records: Records<'_>, (start, plot): (&[f64], bool)) {
    let Solved { outcome, volumes, mass, utilisation, about, .. } = &*solved;
    let courses = courses(subject, &outcome.x).ok().flatten();
    let (model, class, mass, volumes) = (subject.shown(), subject.class(), *mass, *volumes);
    let findings = Findings { about, model, class, outcome, volumes, mass, utilisation: utilisation.as_ref() };
    let ending =
        Ending { sha256: &about.sha256, cut_short: matches!(outcome.status, Status::Interrupted | Status::LimitReached) };
    let (locked, place, written) = results.leave(ending, |files| {
        files.files(numbers(&findings, subject))?;
        if let Some(courses) = &courses {
            structure_files::tables(courses, &mut structure_files::into(files))?;
        }
        if plot {
            let start = outcome.moved_start.as_ref().map_or(start, |moved| &moved.x);
            let start = &start[..start.len().min(subject.shown().meta().variables())];
            pictures::leave(&records.traces(outcome), start, subject, &findings, files)?;
            if let Some(courses) = &courses {
                structure_files::pictures(courses, utilisation.as_ref(), about, &mut structure_files::into(files))?;
            }
        }
        Ok(())
    });
    (solved.unwritten, solved.place, solved._locked) = (written.err(), place, Some(locked));
}

/// The result and its tables.
fn numbers<'f>(findings: &'f Findings<'f>, subject: &'f Subject) -> Vec<(&'static str, Content<'f>)> {
    let mut files: Vec<(&'static str, Content<'f>)> = vec![
        ("result.json", Box::new(move |out| result::write(findings, out))),
        ("variables.csv", Box::new(move |out| tables::variables(findings, out))),
        ("constraints.csv", Box::new(move |out| tables::constraints(findings, out))),
    ];
    if let Some(table) = findings.utilisation {
        files.push(("limits.csv", Box::new(move |out| table.write_limits(out))));
        if !table.ribs.is_empty() {
            files.push(("utilisation.csv", Box::new(move |out| table.write_ribs(out))));
        }
    }
    files.extend(sizes::tables(subject, &findings.outcome.x));
    files
}

/// What a run without files is given besides the problem.
pub struct Quiet<'a> {
    /// Backends and algorithms.
    pub choices: &'a [Choice],
    /// Tolerances and limits.
    pub settings: &'a Settings,
    /// Where to begin, in the user's variables: the file's start where there is none.
    pub start: Option<Vec<f64>>,
    /// Row multipliers there, of the minimised form.
    pub start_multipliers: Option<&'a [f64]>,
    /// Starting points; 0 or 1: one.
    pub starts: usize,
    /// Set by Ctrl-C.
    pub interrupt: Option<&'a AtomicBool>,
}

/// What a run without files found.
pub struct Found {
    /// The verdict.
    pub outcome: Outcome,
    /// Sections and the rows of catalogues that were chosen for them, bars that vanished, and what else happened on the way.
    pub about: About,
    /// The problem that the point was judged in, where that is not the user's.
    pub judged: Option<Subject>,
}

/// Solves without leaving files: every backend of the settings, or all that are built in.
///
/// # Errors
/// No backend takes the problem.
pub fn outcome(subject: &Subject) -> Result<Outcome, RunError> {
    outcome_by(subject, &choose(&[], None, &subject.settings)?, &subject.settings)
}

/// The same by these backends and algorithms, with other tolerances and limits.
///
/// # Errors
/// None of them takes the problem.
pub fn outcome_by(subject: &Subject, choices: &[Choice], settings: &Settings) -> Result<Outcome, RunError> {
    let quiet = Quiet { choices, settings, start: None, start_multipliers: None, starts: 1, interrupt: None };
    quietly(subject, &quiet).map(|found| found.outcome)
}

/// Solves without leaving files.
///
/// # Errors
/// A mechanism; no backend takes the problem.
pub fn quietly(subject: &Subject, quiet: &Quiet<'_>) -> Result<Found, RunError> {
    let &Quiet { choices, settings, start_multipliers, starts, interrupt, .. } = quiet;
    let remaining = Remaining::new();
    subject.refuse_mechanism()?;
    let start = quiet.start.clone().map_or_else(|| subject.model().meta().start.clone(), |x| subject.completed(x));
    let task = Task { settings, start_multipliers, starts, ..subject.task(&start, interrupt) };
    refuse_if_none_accepts(choices, &task)?;
    let further = Further { choices, settings, remaining: &remaining, interrupt };
    let (mut outcome, judged) = further.judged(subject, &task, |task| unobserved(task, choices));
    let mut about = subject.about.clone();
    let judged = followed_up(subject, (&mut outcome, judged), &mut about, &further);
    Ok(Found { outcome, about, judged })
}

/// What follows an outcome and the problem it is of: sizes chosen from lists, bounds; the problem it is of then.
fn followed_up(
    subject: &Subject,
    (outcome, judged): (&mut Outcome, Option<Subject>),
    about: &mut About,
    further: &Further<'_>,
) -> Option<Subject> {
    let again = |rest: &Subject, x: &[f64]| further.nearby(rest, x);
    if let Some(chosen) = lists::choose(subject, further.settings, outcome, again, further.remaining, further.interrupt) {
        *outcome = chosen.outcome;
        about.chosen = chosen.rows;
        return chosen.subject;
    }
    bound_below(subject, outcome, further.remaining, further.interrupt);
    strongest::explain(subject, outcome, further.remaining);
    judged
}

fn starting_point(subject: &Subject, answer: Option<&EarlierAnswer>, warnings: &mut Vec<String>) -> (Vec<f64>, Option<Vec<f64>>) {
    let Some(answer) = answer else { return (subject.model().meta().start.clone(), None) };
    let (start, remarks) = answer.start(subject.shown());
    warnings.extend(remarks);
    (subject.completed(start), answer.multipliers(subject.model(), subject.sign()))
}
