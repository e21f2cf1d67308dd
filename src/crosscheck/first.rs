//! Every backend's first answer. None holds up the others: one that takes long gives way, and goes on afterwards.

use std::time::Instant;

use super::attempt::{Contestant, Referee};
use super::restart;
use super::{Answer, ObserverFactory};
use crate::backends::Termination;
use crate::model::Budget;

/// Seconds after which a backend gives way to the next.
const PATIENCE: f64 = 5.0;
/// What one that gave way has left where another's answer is certified: so many times the seconds that took, or PATIENCE.
const GRACE: f64 = 2.0;

/// One answer per backend, in the order given.
pub(super) fn answers(referee: &Referee<'_>, contestants: &[Contestant<'_>], observers: &mut ObserverFactory<'_>) -> Vec<Answer> {
    let (mut answers, mut gave_way) = (Vec::<Answer>::new(), Vec::new());
    for (k, &contestant) in contestants.iter().enumerate() {
        let mut observer = observers(k, contestant.algorithm);
        let is_last = k + 1 == contestants.len();
        let most = grace(&answers).unwrap_or(if is_last { f64::INFINITY } else { PATIENCE });
        // A tenth of what is left is kept for judging and second tries.
        let budget = referee.clock.share(0.9 / (contestants.len() - k) as f64, most);
        let answer = referee.attempt(contestant, referee.task.start, referee.task.start_multipliers, budget, &mut observer);
        if ran_out(referee, &answer, &budget) {
            gave_way.push(k);
        }
        answers.push(answer);
    }
    // Where nobody has met the rows, the elastic phase may know why: it comes first.
    let worth_going_on = answers.len() == gave_way.len() || answers.iter().any(|answer| referee.is_feasible(answer));
    for (left, &k) in (1..=gave_way.len()).rev().zip(&gave_way).filter(|_| worth_going_on) {
        let budget = referee.clock.share(0.9 / left as f64, grace(&answers).unwrap_or(f64::INFINITY));
        let start = answers[k].solution.x.clone();
        let mut observer = observers(k, contestants[k].algorithm);
        restart::again(referee, contestants[k], &mut answers[k], (&start, budget), &mut observer, "went on after the others");
        if grace(&answers).is_some() && ran_out(referee, &answers[k], &budget) {
            let message = &mut answers[k].solution.message;
            *message = format!("given up, for another backend's answer was certified long before; {message}");
        }
    }
    answers
}

/// Whether its own share of the time ended a run, and nothing else did.
fn ran_out(referee: &Referee<'_>, answer: &Answer, budget: &Budget<'_>) -> bool {
    answer.solution.termination == Termination::LimitReached
        && !answer.is_certified()
        && !referee.clock.is_over()
        && budget.deadline.is_some_and(|deadline| Instant::now() >= deadline)
}

/// Seconds granted once an answer is certified.
fn grace(answers: &[Answer]) -> Option<f64> {
    let seconds = answers.iter().filter(|answer| answer.is_certified()).map(|answer| GRACE * answer.solution.seconds);
    seconds.reduce(f64::min).map(|seconds| seconds.max(PATIENCE))
}
