//! Every backend's first answer. None holds up the others: one that takes long gives way, and goes on afterwards.

use super::ledger::Ledger;
use super::restarts;
use super::{Answer, work};

/// One answer per backend, in the order given; they run in the ledger's order.
pub(super) fn answers(ledger: &mut Ledger<'_, '_>) -> Vec<Answer> {
    let order = ledger.order();
    let mut found: Vec<Option<Answer>> = vec![None; order.len()];
    for (place, &k) in order.iter().enumerate() {
        let beside = share(ledger, found.iter().enumerate().filter_map(|(k, answer)| Some((k, answer.as_ref()?))));
        let proved = beside.is_some();
        let share = beside.unwrap_or_else(|| turn(ledger, place, order.len(), k));
        let answer = match proved && share / ledger.session.cost(ledger.solvers[k]) < work::FEWEST_EVALUATIONS {
            true => ledger.not_run(k, "not run: a minimum is certified, and its share of the work is a few evaluations".into()),
            false => ledger.run(k, ledger.session.task.start, share),
        };
        found[k] = Some(answer);
    }
    found.into_iter().flatten().collect()
}

/// A backend's share while nothing is certified.
fn turn(ledger: &Ledger<'_, '_>, place: usize, count: usize, k: usize) -> f64 {
    match (place, count) {
        (_, 1) => f64::INFINITY,
        // Those before it may have been refused: then it is the first.
        _ if place == 0 || ledger.least_first_work() == 0.0 => work::first_turn(ledger.session.cost(ledger.solvers[k])),
        _ => work::later_turn(ledger.least_first_work()),
    }
}

/// Those who gave way go on, with what is left of their share beside a certified answer. Where nobody has met the rows, the elastic
/// phase may know why: it comes first.
pub(super) fn go_on(ledger: &mut Ledger<'_, '_>, answers: &mut [Answer]) {
    let gave_way: Vec<usize> =
        ledger.order().into_iter().filter(|&k| answers[k].gave_way && !answers[k].is_certified()).collect();
    let worth_it = answers.len() == gave_way.len() || answers.iter().any(|answer| answer.feasible);
    for k in gave_way.into_iter().filter(|_| worth_it) {
        let mut share = share(ledger, answers.iter().enumerate()).unwrap_or(f64::INFINITY);
        if ledger.session.clock.is_over() {
            return;
        }
        let cost = ledger.session.cost(ledger.solvers[k]);
        share -= work::of(&answers[k], cost);
        if share < work::FEWEST_EVALUATIONS * cost {
            continue;
        }
        let start = answers[k].solution.x.clone();
        let next = ledger.run(k, &start, share);
        restarts::keep_better(ledger, &mut answers[k], next, "went on after the others");
    }
}

/// What is left to the others beside a certified answer.
fn share<'a>(ledger: &Ledger<'_, '_>, answers: impl Iterator<Item = (usize, &'a Answer)>) -> Option<f64> {
    let certified = answers.filter(|(_, answer)| answer.is_certified());
    let costs = certified.map(|(k, answer)| work::of(answer, ledger.session.cost(ledger.solvers[k])));
    let proof = costs.reduce(f64::min)?;
    Some(if ledger.session.task.class.is_global() { work::cross_check(proof) } else { work::after_certified(proof) })
}
