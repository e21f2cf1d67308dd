//! Findings as lines.

use std::fmt::Write;

use super::judge::{Grade, is_late};
use super::solving::Run;
use super::{Finding, Found};

/// Lines on runs that ended after their limit.
const LATE_SHOWN: usize = 20;

/// What a run says, in a few words.
pub fn verdict(run: &Run, limit: f64) -> String {
    let scope = format!("{:?}", run.scope).to_lowercase();
    let value = run.objective.map_or("no value".into(), |value| format!("{value:?}"));
    let late = if is_late(run, limit) { format!(", after {:.1} s", run.seconds) } else { String::new() };
    let first = run.message.split_inclusive(['.', '\n']).next().unwrap_or_default().trim();
    format!("{} ({scope}, {}), {value}{late}: {first}", run.status.as_str(), run.class)
}

/// One line per finding, gravest first, and a summary.
pub fn text(found: &Found) -> String {
    let mut out = String::new();
    for Finding { run, problem, done, fault, verdict, kept } in &found.findings {
        let (grade, why) = fault;
        let why = why.lines().next().unwrap_or_default();
        let _ = writeln!(out, "{}  {problem}  {}  run {run}: {why}; {verdict}  {}", grade.words(), done.name(), kept.display());
    }
    for left_out in &found.left_out {
        let _ = writeln!(out, "left out  {left_out}");
    }
    let counts: Vec<String> = Grade::ALL.iter().map(|&grade| format!("{} {}", found.count(grade), grade.words())).collect();
    for (seconds, problem, done) in found.late.iter().take(LATE_SHOWN) {
        let _ = writeln!(out, "late  {problem}  {done}: ended after {seconds:.1} s");
    }
    let late = format!("{} ended after their limit", found.late.len());
    let _ = writeln!(out, "{} runs in {:.0} s: {}; {late}", found.runs, found.seconds, counts.join(", "));
    out
}

/// A word on standard error every now and then.
pub fn progress(count: usize, every: usize) {
    if count.is_multiple_of(every) {
        eprintln!("{count} runs");
    }
}
