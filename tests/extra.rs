//! Problems of the kinds of the benchmark collection that are not in it: does ribopt solve the class?
//!
//! Each file says in comments where it comes from and what is right (see `support::Promise`); `benches/optima.py` computes the
//! optima again with Ipopt.

mod support;

use std::path::Path;

use ribopt::crosscheck::{Outcome, Status};
use ribopt::problem::Settings;
use ribopt::run::choice::choose;
use support::{Promise, diagnosis, name, problem_files, read, solve, two_at_a_time};

/// Problems that do not end as they should, and why. A problem that does must leave the table.
const KNOWN_FAILURES: &[(&str, &str)] = &[];

/// Of the objective, relative to max(1, |optimum|).
const ACCURACY: f64 = 1e-6;

/// The same where no multipliers exist: what feasibility tolerates enters the objective by a root, the third at the worst.
const ACCURACY_WITHOUT_MULTIPLIERS: f64 = 5e-3;

#[test]
fn every_problem_gets_its_right_verdict() {
    let results = two_at_a_time(&problem_files("tests/extra"), |path| (name(path), verdict(path)));
    let known = |file: &str| KNOWN_FAILURES.iter().any(|(known, _)| file.ends_with(known));
    let mut complaints = Vec::new();
    for (file, result) in results {
        match result {
            Err(why) if !known(&file) => complaints.push(format!("{file}: {why}")),
            Ok(()) if known(&file) => complaints.push(format!("{file}: no longer fails, take it from the table")),
            _ => {}
        }
    }
    assert!(complaints.is_empty(), "{}", complaints.join("\n"));
}

fn verdict(path: &Path) -> Result<(), String> {
    let (promise, subject) = (Promise::read(path), read(path));
    let settings = Settings { max_seconds: 20.0, ..subject.settings.clone() };
    let choices = choose(&[], None, &settings).map_err(|error| error.to_string())?;
    let outcome = solve(&subject, &choices, &settings);
    let objective = outcome.objective.map(|objective| subject.sign() * objective);
    let right = match promise.optimum {
        None => outcome.status == promise.status,
        Some(best) => is_answered(&promise, &outcome, objective.unwrap_or(f64::NAN), best),
    };
    if right { Ok(()) } else { Err(format!("{objective:?} for {promise:?}\n{}", diagnosis(&outcome))) }
}

fn is_answered(promise: &Promise, outcome: &Outcome, objective: f64, best: f64) -> bool {
    let near = |value: f64, accuracy: f64| (objective - value).abs() <= accuracy * value.abs().max(1.0);
    if promise.without_multipliers {
        return near(best, ACCURACY_WITHOUT_MULTIPLIERS) && matches!(outcome.status, Status::Certified | Status::Uncertified);
    }
    let known = std::iter::once(best).chain(promise.local.iter().copied()).any(|value| near(value, ACCURACY));
    outcome.exit_code() == 0 && known
}
