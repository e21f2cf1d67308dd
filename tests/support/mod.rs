//! What the comments of a problem file promise, and one solve of it.
#![allow(dead_code, reason = "each test binary uses a part")]

pub mod workbook;

use std::fs;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicUsize, Ordering};

use ribopt::crosscheck::{Outcome, Status};
use ribopt::problem::Settings;
use ribopt::run::solve::outcome_by;
use ribopt::run::{Choice, Subject};

/// What a problem file says of its answer, in comments: `# optimum: 1.5`, further `# local: 2.5` lines for minima that are
/// no worse an answer than the start deserves, or `# expect: infeasible`.
#[derive(Debug)]
pub struct Promise {
    /// `certified` unless the file expects otherwise.
    pub status: Status,
    pub optimum: Option<f64>,
    pub local: Vec<f64>,
    /// The minimum has no multipliers: it need not be certified.
    pub without_multipliers: bool,
}

impl Promise {
    pub fn read(path: &Path) -> Promise {
        let text = fs::read_to_string(path).expect("a readable file");
        let values = |key: &str| -> Vec<String> {
            text.lines().filter_map(|line| line.strip_prefix("# ")?.strip_prefix(key)).map(|word| word.trim().into()).collect()
        };
        let numbers = |key: &str| -> Vec<f64> {
            let number = |word: String| word.parse().unwrap_or_else(|_| panic!("{}: {key} {word}", path.display()));
            values(key).into_iter().map(number).collect()
        };
        let expect = values("expect:").pop().unwrap_or_default();
        let promise = Promise {
            status: match expect.as_str() {
                "infeasible" => Status::Infeasible,
                "unbounded" => Status::Unbounded,
                "not-attained" => Status::NotAttained,
                "" | "no-multipliers" => Status::Certified,
                other => panic!("{}: nothing to expect is called {other}", path.display()),
            },
            optimum: numbers("optimum:").pop(),
            local: numbers("local:"),
            without_multipliers: expect == "no-multipliers",
        };
        let consistent = (promise.status == Status::Certified) == promise.optimum.is_some();
        assert!(consistent, "{} promises neither an optimum nor a verdict, or both", path.display());
        promise
    }
}

/// All problem files of a folder and its sub-folders, in a fixed order.
pub fn problem_files(folder: &str) -> Vec<PathBuf> {
    fn gather(folder: &Path, files: &mut Vec<PathBuf>) {
        for entry in fs::read_dir(folder).expect("a readable folder") {
            let path = entry.expect("a readable folder").path();
            if path.is_dir() {
                gather(&path, files);
            } else if path.extension().is_some_and(|extension| extension == "toml") {
                files.push(path);
            }
        }
    }
    let mut files = Vec::new();
    gather(Path::new(folder), &mut files);
    files.sort();
    files
}

/// What `look` says of every file, two files at a time. Not by rayon: a solve waiting for its own parts there would take up another file
/// meanwhile, count its time, and pile file upon file on one stack.
pub fn two_at_a_time<T: Send>(files: &[PathBuf], look: impl Fn(&Path) -> T + Sync) -> Vec<T> {
    let next = AtomicUsize::new(0);
    let work =
        || std::iter::from_fn(|| files.get(next.fetch_add(1, Ordering::Relaxed))).map(|path| look(path)).collect::<Vec<T>>();
    std::thread::scope(|scope| {
        let workers = [scope.spawn(work), scope.spawn(work)];
        workers.into_iter().flat_map(|worker| worker.join().expect("no panic")).collect()
    })
}

/// The path as tables name it: below its folder, without the extension.
pub fn name(path: &Path) -> String {
    path.components().skip(1).collect::<PathBuf>().with_extension("").display().to_string()
}

pub fn read(path: &Path) -> Subject {
    Subject::read(path, &[]).unwrap_or_else(|mistakes| panic!("{mistakes}"))
}

/// One run from the file's start, as the command makes it.
pub fn solve(subject: &Subject, choices: &[Choice], settings: &Settings) -> Outcome {
    outcome_by(subject, choices, settings).unwrap_or_else(|refused| panic!("{refused}"))
}

/// The answers one by one: how each run stopped and what its point measures.
pub fn diagnosis(outcome: &Outcome) -> String {
    let mut lines = vec![format!("    {}: {}", outcome.status.as_str(), outcome.message)];
    for answer in &outcome.answers {
        let solution = &answer.solution;
        let measures = answer.certificate.as_ref().map_or("no value there".into(), |certificate| {
            format!(
                "primal {:.1e} dual {:.1e} complementarity {:.1e} negative curvature {} runaway {:?}",
                certificate.primal_infeasibility,
                certificate.dual_infeasibility,
                certificate.complementarity,
                certificate.negative_curvature,
                certificate.runaway,
            )
        });
        lines.push(format!(
            "    {} {}: {:?} after {} evaluations, f {:?}, {measures}; {}",
            answer.backend, solution.algorithm, solution.termination, solution.evaluations, answer.objective, solution.message
        ));
    }
    lines.join("\n")
}
