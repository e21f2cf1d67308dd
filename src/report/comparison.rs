//! `compare`: what every backend and algorithm made of every problem, side by side.

use std::io::{self, Write};

use serde::Serialize;

use super::number::{exact, significant};
use super::performance_profile::Profile;
use super::text::TextTable;
use crate::crosscheck::Status;

/// A certified objective counts as the best one within this, relative to max(1, |best|).
const SAME_OBJECTIVE: f64 = 1e-6;

/// Runs shorter than this are equally fast, in seconds.
const SHORTEST: f64 = 1e-4;

/// One solver on one problem.
#[derive(Debug, Clone, Serialize)]
pub struct Trial {
    /// The problem file.
    pub file: String,
    /// Backend and algorithm: `nlopt slsqp`.
    pub solver: String,
    /// The word for what the answer is; `refused` where nothing was run.
    pub status: &'static str,
    /// Certified, and no other solver certified a better objective.
    pub solved: bool,
    /// The objective in the user's sense.
    pub objective: Option<f64>,
    /// Iterations, where the solver shows them.
    pub iterations: Option<u64>,
    /// Objective evaluations.
    pub evaluations: u64,
    /// Wall-clock seconds.
    pub seconds: f64,
    /// Why it stopped, or why it was refused.
    pub message: String,
}

impl Trial {
    /// True where something was run.
    pub fn ran(&self) -> bool {
        self.status != "refused"
    }
}

/// Sets [`Trial::solved`] for the trials of one problem; `sign` is −1 where the user maximises.
pub fn mark_solved(trials: &mut [Trial], sign: f64) {
    let certified = |trial: &Trial| trial.objective.filter(|_| trial.status == Status::Certified.as_str());
    let best = trials.iter().filter_map(certified).map(|objective| sign * objective).min_by(f64::total_cmp);
    for trial in trials {
        let objective = certified(trial).map(|objective| sign * objective);
        let near = |(f, best): (f64, f64)| f - best <= SAME_OBJECTIVE * best.abs().max(1.0);
        trial.solved = objective.zip(best).is_some_and(near);
    }
}

/// The trials of one problem as a table, those that solved it first, by evaluations; refusals last.
pub fn table(trials: &[Trial]) -> TextTable {
    let mut sorted: Vec<&Trial> = trials.iter().collect();
    sorted.sort_by_key(|trial| (!trial.solved, !trial.ran(), trial.evaluations));
    let mut table = TextTable::new(3, &["solver", "point", "", "objective", "iterations", "evaluations", "seconds"]);
    for trial in sorted {
        let note = if trial.solved || trial.status != Status::Certified.as_str() { "" } else { "worse minimum" };
        let mut row = vec![trial.solver.clone(), trial.status.into(), note.into()];
        row.push(trial.objective.map_or("-".into(), |value| significant(value, 10)));
        row.push(trial.iterations.map_or("-".into(), |iterations| iterations.to_string()));
        row.push(if trial.ran() { trial.evaluations.to_string() } else { "-".into() });
        row.push(if trial.ran() { significant(trial.seconds, 3) } else { "-".into() });
        table.add(row);
    }
    table
}

/// Writes all trials: `file,solver,status,solved,objective,iterations,evaluations,seconds,message`.
///
/// # Errors
/// Whatever the writer says.
pub fn write_csv(trials: &[Trial], out: impl Write) -> io::Result<()> {
    let mut table = csv::Writer::from_writer(out);
    let columns = ["file", "solver", "status", "solved", "objective", "iterations", "evaluations", "seconds", "message"];
    table.write_record(columns)?;
    for trial in trials {
        let Trial { file, solver, status, solved, objective, iterations, evaluations, seconds, message } = trial;
        let objective = objective.map_or(String::new(), exact);
        let iterations = iterations.map_or(String::new(), |iterations| iterations.to_string());
        let (solved, evaluations, seconds) = (solved.to_string(), evaluations.to_string(), exact(*seconds));
        table.write_record([file.as_str(), solver, status, &solved, &objective, &iterations, &evaluations, &seconds, message])?;
    }
    table.flush()
}

/// Profiles by evaluations and by time, over the solvers that ran at least once, in the order met.
pub fn profiles(trials: &[Trial]) -> [Profile; 2] {
    let mut solvers: Vec<String> = Vec::new();
    let mut files: Vec<&str> = Vec::new();
    for trial in trials {
        if trial.ran() && !solvers.contains(&trial.solver) {
            solvers.push(trial.solver.clone());
        }
        if !files.contains(&trial.file.as_str()) {
            files.push(&trial.file);
        }
    }
    let profile = |measure: &str, cost: fn(&Trial) -> f64, smallest: f64| {
        let mut costs = vec![vec![None; files.len()]; solvers.len()];
        for trial in trials.iter().filter(|trial| trial.solved) {
            let place =
                (solvers.iter().position(|name| *name == trial.solver), files.iter().position(|name| *name == trial.file));
            if let (Some(solver), Some(file)) = place {
                costs[solver][file] = Some(cost(trial));
            }
        }
        Profile::new(measure, &solvers, &costs, smallest)
    };
    [profile("evaluations", |trial| trial.evaluations as f64, 1.0), profile("seconds", |trial| trial.seconds, SHORTEST)]
}

#[cfg(test)]
mod tests {
    use super::*;

    fn trial(file: &str, solver: &str, status: &'static str, objective: f64, evaluations: u64) -> Trial {
        let (file, solver) = (file.to_string(), solver.to_string());
        let objective = Some(objective);
        Trial { file, solver, status, solved: false, objective, iterations: None, evaluations, seconds: 0.5, message: "".into() }
    }

    #[test]
    fn only_the_best_certified_objective_counts_as_solved() {
        let mut trials = [
            trial("a", "s1", "certified", 1.0, 10),
            trial("a", "s2", "certified", 2.0, 5),
            trial("a", "s3", "uncertified", 0.5, 1),
        ];
        mark_solved(&mut trials, 1.0);
        assert_eq!(trials.each_ref().map(|trial| trial.solved), [true, false, false]);
        mark_solved(&mut trials, -1.0);
        assert_eq!(trials.each_ref().map(|trial| trial.solved), [false, true, false]);
    }

    #[test]
    fn profiles_count_every_problem() {
        let mut trials = vec![trial("a", "s1", "certified", 1.0, 10), trial("b", "s1", "uncertified", 1.0, 1)];
        mark_solved(&mut trials, 1.0);
        let [evaluations, seconds] = profiles(&trials);
        assert_eq!(evaluations.curves[0].share(1.0), 0.5);
        assert_eq!(seconds.curves[0].problems, 2);
    }
}
