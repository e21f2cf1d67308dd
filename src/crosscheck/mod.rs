//! Several backends, one verdict.
//!
//! [`run`] solves with each in turn, judges every point by the certificate, gives second tries where a point does not pass, and
//! says in the end what the problem is worth: a minimum, infeasible, unbounded, not attained, or undecided. A backend's own
//! status never decides anything.

mod attempt;
mod clock;
mod diverging;
mod infeasible;
mod multistart;
mod restart;
mod seeds;
mod settle;
#[cfg(test)]
mod tests;
mod types;
mod verdict;
mod words;

use crate::backends::{Backend, Termination};
use attempt::{Contestant, Referee};
use infeasible::Elasticity;
pub use types::{Agreement, Answer, Conflict, Minimum, ObserverFactory, Outcome, Status, Task};

/// Runs every backend with its algorithm and judges what they bring.
pub fn run(task: &Task<'_>, backends: &[(&dyn Backend, &str)], observers: &mut ObserverFactory<'_>) -> Outcome {
    let referee = Referee::new(task);
    let contestants: Vec<_> = backends.iter().map(|&(backend, algorithm)| Contestant { backend, algorithm }).collect();
    let mut answers = first_answers(&referee, &contestants, observers);
    let mut minima = Vec::new();
    if task.starts > 1 && !referee.clock.is_over() {
        minima = many_starts(&referee, &contestants, &mut answers);
    }
    second_tries(&referee, &contestants, &mut answers);
    let mut outcome = conclude(&referee, &contestants, answers);
    outcome.minima = minima;
    outcome
}

fn first_answers(referee: &Referee<'_>, contestants: &[Contestant<'_>], observers: &mut ObserverFactory<'_>) -> Vec<Answer> {
    let mut answers = Vec::new();
    for (k, &contestant) in contestants.iter().enumerate() {
        let mut observer = observers(k, contestant.algorithm);
        // A tenth of what is left is kept for judging and second tries.
        let budget = referee.clock.share(0.9 / (contestants.len() - k) as f64, f64::INFINITY);
        answers.push(referee.attempt(contestant, referee.task.start, referee.task.start_multipliers, budget, &mut observer));
    }
    answers
}

/// The multi-start; its best point replaces the answer of the backend that found it, where it is better.
fn many_starts(referee: &Referee<'_>, contestants: &[Contestant<'_>], answers: &mut [Answer]) -> Vec<Minimum> {
    let found = multistart::run(referee, contestants, referee.task.starts - 1);
    let minima = multistart::minima(answers.iter().chain(found.iter().map(|(_, answer)| answer)));
    for (k, mut answer) in found {
        if answers.iter().all(|own| referee.is_better(&answer, own)) {
            answer.remarks.push("found by the multi-start".into());
            answers[k] = answer;
        }
    }
    minima
}

fn second_tries(referee: &Referee<'_>, contestants: &[Contestant<'_>], answers: &mut [Answer]) {
    for (answer, &contestant) in answers.iter_mut().zip(contestants) {
        restart::improve(referee, contestant, answer);
    }
    let Some(best) = verdict::best(referee, answers).map(|best| answers[best].clone()) else { return };
    if !best.certificate.as_ref().is_some_and(|certificate| certificate.certified) {
        return;
    }
    for (k, &contestant) in contestants.iter().enumerate() {
        restart::cross_start(referee, contestant, &mut answers[k], &best);
    }
    if let Some(k) = verdict::better_elsewhere(referee, answers, &best) {
        let start = answers[k].solution.x.clone();
        for (answer, &contestant) in answers.iter_mut().zip(contestants) {
            restart::retry(
                referee,
                contestant,
                answer,
                &start,
                "started again from a better feasible point another backend held",
            );
        }
    }
}

fn conclude(referee: &Referee<'_>, contestants: &[Contestant<'_>], mut answers: Vec<Answer>) -> Outcome {
    let passes = |answer: &Answer| answer.certificate.as_ref().is_some_and(|certificate| certificate.certified);
    if answers.iter().any(passes) {
        return verdict::certified(referee, answers);
    }
    answers.iter_mut().for_each(|answer| settle::settle(referee, answer));
    if referee.clock.is_over() {
        return verdict::undecided(referee, answers);
    }
    if answers.iter().any(|answer| referee.is_feasible(answer)) {
        return match diverging::examine(referee, contestants, &answers) {
            Some(ray) => verdict::diverging(referee, answers, ray),
            None => verdict::undecided(referee, answers),
        };
    }
    if answers.iter().all(|answer| answer.solution.termination == Termination::Refused) {
        return verdict::undecided(referee, answers);
    }
    let near = verdict::best(referee, &answers).filter(|&best| answers[best].certificate.is_some());
    let near = near.map_or_else(|| referee.task.start.to_vec(), |best| answers[best].solution.x.clone());
    match infeasible::examine(referee, contestants, &near) {
        Some(Elasticity::Feasible(start)) => {
            for (answer, &contestant) in answers.iter_mut().zip(contestants) {
                restart::retry(referee, contestant, answer, &start, "started again from the feasible point of the elastic phase");
                restart::improve(referee, contestant, answer);
            }
            if answers.iter().any(passes) {
                verdict::certified(referee, answers)
            } else {
                from_feasible(referee, contestants, answers)
            }
        }
        Some(Elasticity::Infeasible { x, conflict }) => verdict::infeasible(referee, answers, x, conflict),
        Some(Elasticity::Unproved(x)) => verdict::no_feasible_point(referee, answers, x),
        None => verdict::undecided(referee, answers),
    }
}

fn from_feasible(referee: &Referee<'_>, contestants: &[Contestant<'_>], answers: Vec<Answer>) -> Outcome {
    match diverging::examine(referee, contestants, &answers) {
        Some(ray) => verdict::diverging(referee, answers, ray),
        None => verdict::undecided(referee, answers),
    }
}
