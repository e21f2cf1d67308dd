//! Every backend and every algorithm on every problem file of `problems/`.

mod support;

use ribopt::certificate::Extent;
use ribopt::crosscheck::Status;
use ribopt::problem::Settings;
use ribopt::run::choice::{all, built_in};
use ribopt::run::{Choice, Subject};
use support::{Promise, diagnosis, name, problem_files, read, solve, two_at_a_time};

/// Backend, problem, and why the one need not solve the other.
const EXCLUDED: &[(&str, &str, &str)] =
    &[("nlopt", "strongest-column", COINCIDING), ("nlopt", "ten-bar-frequencies", COINCIDING)];

/// NLopt finds these optima to eleven digits, but stops by the objective's change before the multipliers of coinciding modes settle.
const COINCIDING: &str = "modes coincide at the optimum: SLSQP's point is not stationary to the tolerance";

/// Relative distance to the known optimum.
const ACCURACY: f64 = 1e-7;

/// The same for single algorithms: whatever is certified.
const CERTIFIED_ACCURACY: f64 = 1e-6;

/// The interior point needs tens of iterations.
const ITERATIONS: u64 = 100;

/// Single algorithms may give up; the slow ones are made to.
const SECONDS_PER_ALGORITHM: f64 = 2.0;

fn optimum(promise: &Promise) -> f64 {
    promise.optimum.expect("a problem of `problems/` has an optimum")
}

#[test]
fn every_backend_certifies_the_known_optimum_of_every_problem() {
    let failures: Vec<String> = two_at_a_time(&problem_files("problems"), backends_on).concat();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn backends_on(path: &std::path::Path) -> Vec<String> {
    let (promise, subject, file) = (Promise::read(path), read(path), name(path));
    let best = optimum(&promise);
    let asked = built_in().iter().filter(|backend| {
        let excluded = |&(excluded, problem, _): &(&str, &str, &str)| excluded == backend.name() && problem == file;
        !EXCLUDED.iter().any(excluded)
    });
    let failure = |&backend: &&'static dyn ribopt::backends::Backend| {
        let outcome = solve(&subject, &[Choice { backend, algorithm: "auto".into() }], &subject.settings);
        let objective = outcome.objective.map_or(f64::NAN, |objective| subject.sign() * objective);
        let near = (objective - best).abs() <= ACCURACY * best.abs();
        let iterations = outcome.answers.first().and_then(|answer| answer.solution.iterations).unwrap_or(0);
        let good = outcome.status == Status::Certified && near && iterations < ITERATIONS;
        let name = backend.name();
        (!good).then(|| format!("{file}, {name}: {objective} for {best}, {iterations} iterations\n{}", diagnosis(&outcome)))
    };
    asked.filter_map(failure).collect()
}

#[test]
fn no_algorithm_is_certified_at_a_wrong_objective() {
    let failures: Vec<String> = two_at_a_time(&problem_files("problems"), algorithms_on).concat();
    assert!(failures.is_empty(), "{}", failures.join("\n"));
}

fn algorithms_on(path: &std::path::Path) -> Vec<String> {
    let (promise, subject) = (Promise::read(path), read(path));
    if !subject.problem().listed.is_empty() {
        return Vec::new(); // an algorithm has no say in what is chosen from lists
    }
    let best = subject.sign() * optimum(&promise);
    let settings = Settings { max_seconds: SECONDS_PER_ALGORITHM, ..subject.settings.clone() };
    let accepting = all().into_iter().filter(|choice| refusal(&subject, choice).is_none());
    let failure = |choice: Choice| {
        let outcome = solve(&subject, std::slice::from_ref(&choice), &settings);
        let excess = outcome.objective.unwrap_or(f64::NAN) - best;
        let near = excess.abs() <= CERTIFIED_ACCURACY * best.abs();
        // Another local minimum is worse, and not claimed to be global.
        let local = excess > 0.0 && outcome.scope == Extent::Local;
        let wrong = outcome.status == Status::Certified && !near && !local;
        wrong.then(|| format!("{}, {}: {excess:e} above {best}\n{}", name(path), choice.algorithm, diagnosis(&outcome)))
    };
    accepting.filter_map(failure).collect()
}

#[test]
fn whoever_refuses_a_problem_says_who_can_take_it() {
    for path in problem_files("problems") {
        let subject = read(&path);
        let (refusing, accepting): (Vec<Choice>, _) = all().into_iter().partition(|choice| refusal(&subject, choice).is_some());
        for choice in refusing {
            let reason = refusal(&subject, &choice).unwrap_or_default();
            let helpful = accepting.iter().any(|other| reason.contains(&other.algorithm));
            assert!(helpful, "{}, {}: {reason}", name(&path), choice.algorithm);
        }
    }
}

fn refusal(subject: &Subject, choice: &Choice) -> Option<String> {
    choice.backend.refusal(&choice.algorithm, subject.model())
}

#[test]
fn exclusions_name_what_there_is_and_give_a_reason() {
    let files: Vec<String> = problem_files("problems").iter().map(|path| name(path)).collect();
    for (backend, problem, reason) in EXCLUDED {
        assert!(built_in().iter().any(|known| known.name() == *backend), "there is no backend {backend}");
        assert!(files.iter().any(|file| file == problem), "there is no problem {problem}");
        assert!(!reason.is_empty());
    }
}
