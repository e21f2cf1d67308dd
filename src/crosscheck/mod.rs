//! Several backends, one verdict.
//!
//! [`run`] solves with each in turn, judges every point by the certificate, gives second tries where a point does not pass, and
//! says in the end what the problem is worth: a minimum, infeasible, unbounded, not attained, or undecided. A backend's own
//! status never decides anything.

mod attempt;
mod clock;
mod diverging;
mod first;
mod infeasible;
mod multistart;
mod restart;
mod seeds;
mod settle;
mod start;
#[cfg(test)]
mod tests;
mod types;
mod verdict;
mod words;

use crate::backends::{Backend, Termination};
use attempt::{Contestant, Referee};
use diverging::{Fall, Ray};
use infeasible::Elasticity;
pub use start::MovedStart;
pub use types::{Agreement, Answer, Conflict, Minimum, ObserverFactory, Outcome, Status, Task};

/// Runs every backend with its algorithm and judges what they bring.
pub fn run(task: &Task<'_>, backends: &[(&dyn Backend, &str)], observers: &mut ObserverFactory<'_>) -> Outcome {
    let moved_start = start::in_domain(task);
    let begin = moved_start.as_ref().map_or(task.start, |moved| moved.x.as_slice());
    let task = &Task { start: begin, ..*task };
    let referee = Referee::new(task);
    let contestants: Vec<_> = backends.iter().map(|&(backend, algorithm)| Contestant { backend, algorithm }).collect();
    let mut answers = first::answers(&referee, &contestants, observers);
    let (mut minima, mut starts_run) = (Vec::new(), 1);
    if task.starts > 1 && !referee.clock.is_over() {
        (minima, starts_run) = many_starts(&referee, &contestants, &mut answers);
    }
    second_tries(&referee, &contestants, &mut answers);
    let mut outcome = conclude(&referee, &contestants, answers);
    if starts_run < task.starts {
        words::starts_left_out(&mut outcome, starts_run, task.starts);
    }
    if referee.clock.is_interrupted() && outcome.status == Status::Certified {
        outcome.status = Status::Interrupted;
        words::interrupted(&mut outcome);
    }
    (outcome.minima, outcome.moved_start) = (minima, moved_start.clone());
    outcome
}

/// The multi-start; its best point replaces the answer of the backend that found it, where it is better. The distinct minima, and
/// how many starts were run in all.
fn many_starts(referee: &Referee<'_>, contestants: &[Contestant<'_>], answers: &mut [Answer]) -> (Vec<Minimum>, usize) {
    let found = multistart::run(referee, contestants, referee.task.starts - 1);
    let starts_run = found.len() + 1;
    let minima = multistart::minima(answers.iter().chain(found.iter().map(|(_, answer)| answer)));
    for (k, mut answer) in found {
        if answers.iter().all(|own| referee.is_better(&answer, own)) {
            answer.remarks.push("found by the multi-start".into());
            answers[k] = answer;
        }
    }
    (minima, starts_run)
}

fn second_tries(referee: &Referee<'_>, contestants: &[Contestant<'_>], answers: &mut [Answer]) {
    for (answer, &contestant) in answers.iter_mut().zip(contestants) {
        restart::improve(referee, contestant, answer);
    }
    let Some(best) = verdict::best(referee, answers).map(|best| answers[best].clone()) else { return };
    if !best.is_certified() {
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
    let passes = |answer: &Answer| answer.is_certified();
    if let Some(best) = verdict::best(referee, &answers).map(|best| &answers[best]).filter(|best| passes(best)) {
        if let Some((x, conflict)) = contradicted(referee, contestants, best) {
            return verdict::infeasible(referee, answers, x, conflict);
        }
        return match diverging::overruled(referee, &answers, best) {
            Some(ray) => verdict::diverging(referee, answers, ray),
            None => verdict::certified(referee, answers),
        };
    }
    answers.iter_mut().for_each(|answer| settle::settle(referee, answer));
    if referee.clock.is_over() {
        return verdict::undecided(referee, answers);
    }
    if answers.iter().any(|answer| referee.is_feasible(answer)) {
        return from_feasible(referee, contestants, answers);
    }
    if answers.iter().all(|answer| answer.solution.termination == Termination::Refused) {
        return verdict::undecided(referee, answers);
    }
    let near = verdict::best(referee, &answers).filter(|&best| answers[best].certificate.is_some());
    let near = near.map(|best| answers[best].solution.x.clone()).filter(|x| !diverging::is_far_out(referee, x));
    let near = near.unwrap_or_else(|| referee.task.start.to_vec());
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

/// Dependent rows that a certified point far out seems to meet only because rounding hides the contradiction: where one start is
/// enough to tell, the elastic phase does, from the start.
fn contradicted(referee: &Referee<'_>, contestants: &[Contestant<'_>], best: &Answer) -> Option<(Vec<f64>, Conflict)> {
    let is_dependent = best.certificate.as_ref().is_some_and(|certificate| certificate.multipliers_not_unique);
    if !(is_dependent && referee.task.class.is_global() && diverging::is_far_out(referee, &best.solution.x)) {
        return None;
    }
    match infeasible::examine(referee, contestants, referee.task.start)? {
        Elasticity::Infeasible { x, conflict } => Some((x, conflict)),
        _ => None,
    }
}

fn from_feasible(referee: &Referee<'_>, contestants: &[Contestant<'_>], mut answers: Vec<Answer>) -> Outcome {
    let ray = diverging::examine(referee, contestants, &answers);
    // So far out rows that contradict one another seem to be met.
    if let Some(ray) = &ray
        && diverging::is_far_out(referee, &ray.from)
        && let Some(Elasticity::Infeasible { x, conflict }) = infeasible::examine(referee, contestants, referee.task.start)
    {
        return verdict::infeasible(referee, answers, x, conflict);
    }
    if let Some(value) = settling(referee, &answers, ray.as_ref())
        && let Some((k, mut answer)) = multistart::attained(referee, contestants, value)
    {
        answer.remarks.push("found from another start, as from the one given the variables run off".into());
        answers[k] = answer;
        return verdict::certified(referee, answers);
    }
    match ray {
        Some(ray) => verdict::diverging(referee, answers, ray),
        None => verdict::undecided(referee, answers),
    }
}

/// The value the objective settles at as variables run off, where that is what was found; convex problems have no other minima.
fn settling(referee: &Referee<'_>, answers: &[Answer], ray: Option<&Ray>) -> Option<f64> {
    if referee.task.class.is_global() || ray.is_some_and(|ray| ray.fall == Fall::Endless) {
        return None;
    }
    let runs_off = |answer: &&Answer| answer.certificate.as_ref().is_some_and(|own| ray.is_some() || !own.runaway.is_empty());
    let feasible = answers.iter().filter(|answer| referee.is_feasible(answer)).filter(runs_off);
    feasible.filter_map(|answer| answer.objective).reduce(f64::min)
}
