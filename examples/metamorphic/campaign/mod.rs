//! Metamorphic tests: a problem file is rewritten such that the verdict must stay, solved, and judged.
//!
//! file → [`draft::Draft`] (`reading`) → transformed (`kinds`: `variables`, `rows`) → file → solved (`solving`) → judged (`judge`).

pub mod draft;
pub mod judge;
pub mod kinds;
mod random;
mod reading;
pub mod report;
mod rows;
mod solving;
#[path = "../../../tests/support/mod.rs"]
mod support;
mod variables;
mod words;

use std::fs;
use std::panic::resume_unwind;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread;
use std::time::Instant;

use ribopt::crosscheck::Status;
use ribopt::problem::Sense;
use ribopt::run::Subject;

use draft::Draft;
use judge::{Fault, Grade, Truth, is_late, judge};
use kinds::{Done, transform};
use random::Random;
use solving::Run;

/// Runs of a campaign between two words on how far it is.
const RUNS_PER_WORD: usize = 100;

/// What to run.
pub struct Plan {
    pub folders: Vec<PathBuf>,
    pub seed: u64,
    /// The first run's number, and how many there are.
    pub first: usize,
    pub count: usize,
    /// One kind of transformation.
    pub only: Option<String>,
    pub jobs: usize,
    /// Per run.
    pub seconds: f64,
    /// Where transformed files and their runs lie; those that are not kept are removed.
    pub folder: PathBuf,
    /// Files to leave out, by parts of their names.
    pub without: Vec<String>,
    pub quiet: bool,
}

/// One fault found.
pub struct Finding {
    pub run: usize,
    pub problem: String,
    pub done: Done,
    pub fault: Fault,
    pub verdict: String,
    pub kept: PathBuf,
}

/// What a campaign found.
#[derive(Default)]
pub struct Found {
    /// Gravest first.
    pub findings: Vec<Finding>,
    pub runs: usize,
    /// Seconds, file and kind of runs that ended long after their limit, the longest first.
    pub late: Vec<(f64, String, String)>,
    /// Problems whose untransformed file is left out, and why.
    pub left_out: Vec<String>,
    pub seconds: f64,
}

impl Found {
    pub fn count(&self, grade: Grade) -> usize {
        self.findings.iter().filter(|finding| finding.fault.0 == grade).count()
    }
}

struct Problem {
    path: PathBuf,
    name: String,
    draft: Draft,
    truth: Truth,
    /// As the file is.
    run: Run,
}

/// Runs a plan.
///
/// # Errors
/// Folders that cannot be read or written.
pub fn run(plan: &Plan) -> Result<Found, String> {
    let begin = Instant::now();
    fs::create_dir_all(&plan.folder).map_err(|cause| format!("{}: {cause}", plan.folder.display()))?;
    let mut files: Vec<PathBuf> =
        plan.folders.iter().flat_map(|folder| support::problem_files(&folder.to_string_lossy())).collect();
    files.retain(|file| !plan.without.iter().any(|part| file.to_string_lossy().contains(part)) && is_transformable(file));
    // No more of them than runs: a sample needs no more. A file that is new takes the place of one, and leaves the others theirs.
    let place = |file: &PathBuf| Random::of_run(plan.seed, &name(file), usize::MAX).between(0.0, 1.0);
    files.sort_by(|one, other| place(one).total_cmp(&place(other)));
    files.truncate(plan.first + plan.count);
    let read = side_by_side(plan.jobs, files.len(), &|at| problem(&files[at], plan));
    let mut found = Found::default();
    let mut problems = Vec::new();
    for (path, result) in files.iter().zip(read) {
        match result {
            Ok(problem) => problems.push(problem),
            Err(why) => found.left_out.push(format!("{}: {why}", path.display())),
        }
    }
    if problems.is_empty() {
        return Err(format!("no problem to transform\n{}", found.left_out.join("\n")));
    }
    let as_they_are = problems.iter().filter_map(|problem| untransformed(problem, plan));
    found.findings.extend(as_they_are);
    let count = AtomicUsize::new(0);
    let runs = side_by_side(plan.jobs, plan.count, &|at| {
        let number = plan.first + at;
        one(number, number / problems.len(), &problems[number % problems.len()], plan, &count)
    });
    for (finding, late) in runs.into_iter().flatten() {
        found.runs += 1;
        found.findings.extend(finding);
        found.late.extend(late);
    }
    found.late.sort_by(|one, other| other.0.total_cmp(&one.0));
    found.findings.sort_by_key(|finding| (finding.fault.0, finding.problem.clone(), finding.run));
    found.seconds = begin.elapsed().as_secs_f64();
    Ok(found)
}

/// Whether transformations leave the problem what it is: a logarithm of a length is none, and other variables have other lists.
fn is_transformable(file: &Path) -> bool {
    let other = |input: ribopt::input::Input| input.dimensions.quantities || !input.problem.listed.is_empty();
    !ribopt::input::read(file).is_ok_and(other)
}

/// Results 0 … n − 1 by so many threads. Not by rayon: a solve waiting for its own parts there would take up another run meanwhile,
/// and count its time.
fn side_by_side<T: Send>(threads: usize, n: usize, result: &(dyn Fn(usize) -> T + Sync)) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let work = || {
        let mut own = Vec::new();
        loop {
            let at = next.fetch_add(1, Ordering::Relaxed);
            if at >= n {
                return own;
            }
            own.push((at, result(at)));
        }
    };
    let mut results: Vec<(usize, T)> = thread::scope(|scope| {
        let workers: Vec<_> = (0..threads.max(1)).map(|_| scope.spawn(work)).collect();
        workers.into_iter().flat_map(|worker| worker.join().unwrap_or_else(|panic| resume_unwind(panic))).collect()
    });
    results.sort_by_key(|(at, _)| *at);
    results.into_iter().map(|(_, result)| result).collect()
}

fn problem(path: &Path, plan: &Plan) -> Result<Problem, String> {
    let mut draft = reading::read(path)?;
    let name = name(path);
    let folder = plan.folder.join(format!("as-it-is-{name}"));
    let run = solving::run(path, &draft.untransformed(), path, &folder, plan.seconds);
    let _ = fs::remove_dir_all(&folder);
    let run = run?;
    for origin in &mut draft.origins {
        let size = run.sizes.get(&origin.in_file).copied().filter(|_| run.status == Status::Certified).unwrap_or(0.0);
        origin.size = if size > 0.0 && size < variables::NO_SIZE { size } else { 1.0 };
    }
    let undecided = [Status::LimitReached, Status::Interrupted, Status::InvalidValue];
    let truth = match promised(path, &run)? {
        Some(truth) => truth,
        None if undecided.contains(&run.status) => {
            return Err(format!("{}, and no comment says what is right", run.status.as_str()));
        }
        None => Truth {
            status: run.status,
            minima: run.objective.into_iter().collect(),
            without_multipliers: false,
            settles: run.objective.filter(|_| run.status == Status::NotAttained),
            class: run.class,
            scope: run.scope,
        },
    };
    Ok(Problem { path: path.into(), name, draft, truth, run })
}

/// Folder and stem of a file.
fn name(path: &Path) -> String {
    let words = [path.parent().and_then(Path::file_name), path.file_stem()];
    let words: Vec<_> = words.into_iter().flatten().map(|word| word.to_string_lossy()).collect();
    words.join("-")
}

/// What the comments of a file promise, where they do.
fn promised(path: &Path, run: &Run) -> Result<Option<Truth>, String> {
    let text = fs::read_to_string(path).map_err(|cause| cause.to_string())?;
    if !text.lines().any(|line| line.starts_with("# optimum:") || line.starts_with("# expect:")) {
        return Ok(None);
    }
    let promise = support::Promise::read(path);
    let sense = Subject::read(path, &[]).map_err(|error| error.to_string())?.about.sense;
    let sign = if sense == Sense::Maximize { -1.0 } else { 1.0 };
    Ok(Some(Truth {
        status: promise.status,
        minima: promise.optimum.into_iter().chain(promise.local).map(|value| sign * value).collect(),
        without_multipliers: promise.without_multipliers,
        settles: run.objective.filter(|_| run.status == Status::NotAttained),
        class: run.class,
        scope: run.scope,
    }))
}

/// The fault of the file as it is: its own comments say so.
fn untransformed(problem: &Problem, plan: &Plan) -> Option<Finding> {
    let done = Done { names: vec!["as it is"], keeps_class: true, moves_start: false };
    let fault = judge(&problem.truth, &done, &problem.run)?;
    let verdict = report::verdict(&problem.run, plan.seconds);
    Some(Finding { run: 0, problem: problem.name.clone(), done, fault, verdict, kept: problem.path.clone() })
}

/// A run's fault and its lateness, where it has them.
type Ended = (Option<Finding>, Option<(f64, String, String)>);

/// One run, of this round of the problem's. `None` where no transformation applies.
fn one(number: usize, round: usize, problem: &Problem, plan: &Plan, count: &AtomicUsize) -> Option<Ended> {
    let mut draft = problem.draft.clone();
    let mut random = Random::of_run(plan.seed, &problem.name, round);
    let done = transform(&mut draft, problem.truth.class, plan.only.as_deref(), &mut random)?;
    let name = format!("{number:06}-{}-{}", problem.name, done.name());
    let (kept, folder) = (plan.folder.join(format!("{name}.toml")), plan.folder.join(&name));
    let origin =
        format!("# {} transformed: {}; seed {}, run {number}, round {round}", problem.path.display(), done.name(), plan.seed);
    // A crash leaves the file that caused it.
    let written = fs::write(&kept, format!("{origin}\n{}", draft.text())).map_err(|cause| cause.to_string());
    let result = written.and_then(|()| solving::run(&kept, &draft, &problem.path, &folder, plan.seconds));
    let _ = fs::remove_dir_all(&folder);
    let (fault, verdict) = match &result {
        Err(why) => (Some((Grade::Different, format!("no verdict: {why}"))), String::new()),
        Ok(run) => (judge(&problem.truth, &done, run), report::verdict(run, plan.seconds)),
    };
    // Where the file as it is fails alike, that is said once.
    let fails_alike = judge(&problem.truth, &Done::default(), &problem.run).is_some()
        && result.as_ref().is_ok_and(|run| run.status == problem.run.status);
    let fault = fault.filter(|_| !fails_alike);
    if !plan.quiet {
        report::progress(1 + count.fetch_add(1, Ordering::Relaxed), RUNS_PER_WORD);
    }
    let late = result.as_ref().ok().filter(|run| is_late(run, plan.seconds));
    let late = late.map(|run| (run.seconds, problem.name.clone(), done.name()));
    if fault.is_none() && late.is_none() {
        let _ = fs::remove_file(&kept);
    }
    let finding = fault.map(|fault| {
        let comments = format!("{origin}\n# {}: {}\n# {verdict}\n", fault.0.words(), fault.1.replace('\n', "\n# "));
        let _ = fs::write(&kept, format!("{comments}{}", draft.text()));
        Finding { run: number, problem: problem.name.clone(), done, fault, verdict, kept }
    });
    Some((finding, late))
}
