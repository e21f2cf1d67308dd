//! Several backends, one verdict.
//!
//! [`run`] solves with each in turn, judges every point by the certificate, gives second tries where a point does not pass, and
//! says in the end what the problem is worth: a minimum, infeasible, unbounded, not attained, or undecided. A backend's own
//! status never decides anything.

mod clock;
mod diverging;
mod feasibility_polish;
mod first_round;
mod infeasible;
mod ledger;
mod merit;
mod messages;
mod multistart;
mod pool;
mod restarts;
#[cfg(test)]
mod scripted;
mod seeds;
mod session;
mod start;
#[cfg(test)]
mod tests;
mod types;
mod verdict;
mod work;

use crate::backends::{Backend, Termination};
use crate::certificate::impossible_row;
use crate::recession::{Fall, Ray};
use infeasible::{Elasticity, Proof};
use ledger::Ledger;
use session::{BESIDE, LAST_DIGITS, Session, Solver};
pub use start::MovedStart;
pub use types::{Agreement, Answer, Conflict, LimitMove, Minimum, ObserverFactory, Outcome, Status, Task};

/// Runs every backend with its algorithm and judges what they bring.
pub fn run(task: &Task<'_>, backends: &[(&dyn Backend, &str)], observers: &mut ObserverFactory<'_>) -> Outcome {
    let moved_start = start::in_domain(task);
    let begin = moved_start.as_ref().map_or(task.start, |moved| moved.x.as_slice());
    let task = &Task { start: begin, ..*task };
    let session = Session::new(task);
    let solvers: Vec<_> = backends.iter().map(|&(backend, algorithm)| Solver { backend, algorithm }).collect();
    let mut ledger = Ledger::new(&session, &solvers, observers);
    let mut outcome = match contradictory_rows(&mut ledger) {
        Some(outcome) => outcome,
        None => solved(&mut ledger),
    };
    if session.clock.is_interrupted() && outcome.status == Status::Certified {
        outcome.status = Status::Interrupted;
        messages::interrupted(&mut outcome);
    }
    outcome.moved_start = moved_start.clone();
    outcome
}

fn solved(ledger: &mut Ledger<'_, '_>) -> Outcome {
    let task = ledger.session.task;
    let mut answers = first_round::answers(ledger);
    let (mut minima, mut starts_run) = (Vec::new(), 1);
    if task.starts > 1 && !ledger.session.clock.is_over() {
        (minima, starts_run) = many_starts(ledger, &mut answers);
    }
    further_runs(ledger, &mut answers);
    let mut outcome = conclude(ledger, answers);
    if task.starts > 1 {
        messages::more_starts_than(&mut outcome, starts_run);
    }
    if starts_run < task.starts {
        messages::starts_left_out(&mut outcome, starts_run, task.starts);
    }
    outcome.minima = minima;
    outcome
}

/// Linear rows that contradict one another within the bounds: no solver is needed to tell, and none is asked.
fn contradictory_rows(ledger: &mut Ledger<'_, '_>) -> Option<Outcome> {
    let session = ledger.session;
    let tolerance = session.tolerances.constraint;
    impossible_row(session.task.model, tolerance)?;
    let why = "not run: the linear rows contradict one another within the bounds";
    let answers = (0..ledger.solvers.len()).map(|k| ledger.not_run(k, why.into())).collect();
    let (x, conflict) = match infeasible::explain(ledger, session.task.start) {
        Some(Elasticity::Infeasible { x, conflict, .. }) => (x, conflict),
        Some(Elasticity::Unproved(x) | Elasticity::Feasible(x)) => (x, Conflict::default()),
        None => (session.task.start.to_vec(), Conflict::default()),
    };
    Some(verdict::infeasible(session, answers, x, (conflict, true)))
}

/// The multi-start; its best point replaces the answer of the backend that found it, where it is better. The distinct minima, and
/// how many starts were run in all.
fn many_starts(ledger: &mut Ledger<'_, '_>, answers: &mut [Answer]) -> (Vec<Minimum>, usize) {
    let session = ledger.session;
    let found = multistart::run(session, ledger.solvers, &ledger.order(), session.task.starts - 1);
    let starts_run = found.len() + 1;
    let minima = multistart::minima(answers.iter().chain(found.iter().map(|found| &found.answer)));
    for found in found {
        if answers.iter().all(|own| session.is_better(&found.answer, own)) {
            let k = found.solver;
            answers[k] = observed(ledger, found);
            answers[k].remarks.push("found by the multi-start".into());
        }
    }
    (minima, starts_run)
}

/// The run of a start that won once more, for the log: it is the same run.
fn observed(ledger: &mut Ledger<'_, '_>, found: multistart::Found) -> Answer {
    let again = ledger.run(found.solver, &found.start, f64::INFINITY);
    if ledger.session.is_better(&found.answer, &again) { found.answer } else { again }
}

fn further_runs(ledger: &mut Ledger<'_, '_>, answers: &mut [Answer]) {
    let session = ledger.session;
    let is_proved = |answers: &[Answer]| session.task.class.is_global() && answers.iter().any(|answer| answer.is_certified());
    let improve = |ledger: &mut Ledger<'_, '_>, answers: &mut [Answer]| {
        for k in ledger.order() {
            if !is_proved(answers) {
                restarts::improve(ledger, k, &mut answers[k]);
            }
        }
    };
    improve(ledger, answers);
    if answers.iter().any(|answer| answer.gave_way && !answer.is_certified()) {
        first_round::go_on(ledger, answers);
        improve(ledger, answers);
    }
    restarts::probe(ledger, answers);
    let Some(best) = verdict::best(session, answers).map(|best| answers[best].clone()) else { return };
    for k in ledger.order() {
        if best.is_certified() && !is_proved(answers) {
            restarts::cross_start(ledger, k, &mut answers[k], &best);
        }
    }
}

fn conclude(ledger: &mut Ledger<'_, '_>, answers: Vec<Answer>) -> Outcome {
    let session = ledger.session;
    let mut answers = match from_certified(ledger, answers) {
        Ok(outcome) => return outcome,
        Err(answers) => answers,
    };
    if !session.clock.is_over() {
        answers.iter_mut().for_each(|answer| feasibility_polish::polish(session, answer));
    }
    // A point that was moved is judged again, and may pass now.
    answers = match from_certified(ledger, answers) {
        Ok(outcome) => return outcome,
        Err(answers) => answers,
    };
    if session.clock.is_over() {
        return verdict::undecided(session, answers);
    }
    if answers.iter().any(|answer| answer.feasible) {
        return from_feasible(ledger, answers);
    }
    if answers.iter().all(|answer| answer.solution.termination == Termination::Refused) {
        return verdict::undecided(session, answers);
    }
    from_infeasible(ledger, answers)
}

/// The outcome where an answer passed and nothing speaks against it; else the answers, as far as they still stand.
fn from_certified(ledger: &mut Ledger<'_, '_>, mut answers: Vec<Answer>) -> Result<Outcome, Vec<Answer>> {
    let session = ledger.session;
    verdict::withdraw_far(session, &mut answers);
    let certified = |answers: &[Answer]| verdict::best(session, answers).filter(|&best| answers[best].is_certified());
    let Some(best) = certified(&answers) else { return Err(answers) };
    if let Some((x, conflict)) = contradicted(ledger, &answers[best]) {
        return Ok(verdict::infeasible(session, answers, x, (conflict, true)));
    }
    if let Some(ray) = diverging::overruled(session, &answers, &answers[best]) {
        return Ok(verdict::diverging(session, answers, ray));
    }
    restarts::to_better_points(ledger, &mut answers);
    if certified(&answers).is_none() { Err(answers) } else { Ok(verdict::certified(session, answers)) }
}

/// No backend met the rows: can they be met at all?
fn from_infeasible(ledger: &mut Ledger<'_, '_>, mut answers: Vec<Answer>) -> Outcome {
    let session = ledger.session;
    let near = verdict::best(session, &answers).filter(|&best| answers[best].certificate.is_some());
    let near = near.map(|best| answers[best].solution.x.clone()).filter(|x| !diverging::is_too_far(session, x));
    let near = near.unwrap_or_else(|| session.task.start.to_vec());
    match infeasible::examine(ledger, &near) {
        Some(Elasticity::Feasible(start)) => {
            for k in ledger.order() {
                let remark = "started again from the feasible point of the elastic phase";
                restarts::retry(ledger, k, &mut answers[k], &start, remark);
                restarts::improve(ledger, k, &mut answers[k]);
            }
            match from_certified(ledger, answers) {
                Ok(outcome) => outcome,
                Err(answers) => from_feasible(ledger, answers),
            }
        }
        Some(Elasticity::Infeasible { x, conflict, proof }) => {
            verdict::infeasible(session, answers, x, (conflict, proof.is_global()))
        }
        Some(Elasticity::Unproved(x)) => verdict::no_feasible_point(session, answers, x),
        None => verdict::undecided(session, answers),
    }
}

/// Where the variables of feasible points are so far from the start that rounding may hide a contradiction of the rows, or where dependent
/// rows are met, but not to the last digit: the elastic phase tells from the start, and its proof stands against the point.
fn contradicted(ledger: &mut Ledger<'_, '_>, best: &Answer) -> Option<(Vec<f64>, Conflict)> {
    let session = ledger.session;
    let certificate = best.certificate.as_ref()?;
    let x = &best.solution.x;
    let is_inexact =
        || certificate.primal_infeasibility > LAST_DIGITS && session.judge.met_beside(x, BESIDE, LAST_DIGITS).is_none();
    let is_suspect = || diverging::is_too_far(session, x) || is_inexact();
    if !(certificate.multipliers_not_unique && is_suspect()) {
        return None;
    }
    proved_infeasible(ledger)
}

/// The elastic phase from the start, as far as it ends in a proof that stands against points that seem to meet the rows.
fn proved_infeasible(ledger: &mut Ledger<'_, '_>) -> Option<(Vec<f64>, Conflict)> {
    match infeasible::examine(ledger, ledger.session.task.start)? {
        Elasticity::Infeasible { x, conflict, proof: Proof::Contradiction } => Some((x, conflict)),
        _ => None,
    }
}

fn from_feasible(ledger: &mut Ledger<'_, '_>, mut answers: Vec<Answer>) -> Outcome {
    let session = ledger.session;
    // So far from the start rows that contradict one another seem to be met.
    let feasible = || answers.iter().filter(|answer| answer.feasible);
    if feasible().all(|answer| diverging::is_too_far(session, &answer.solution.x))
        && let Some((x, conflict)) = proved_infeasible(ledger)
    {
        return verdict::infeasible(session, answers, x, (conflict, true));
    }
    let ray = diverging::examine(session, ledger.solvers, &answers);
    if let Some(ray) = &ray
        && diverging::is_too_far(session, &ray.from)
        && let Some((x, conflict)) = proved_infeasible(ledger)
    {
        return verdict::infeasible(session, answers, x, (conflict, true));
    }
    if let Some(settled) = settling(session, &answers, ray.as_ref())
        && let Some(found) = multistart::attained(ledger, settled)
    {
        let k = found.solver;
        answers[k] = observed(ledger, found);
        answers[k].remarks.push("found from another start, as from the one given the variables run off".into());
        return verdict::certified(session, answers);
    }
    match ray {
        Some(ray) => verdict::diverging(session, answers, ray),
        None => verdict::undecided(session, answers),
    }
}

/// The value the objective settles at as variables run off, and where, if that is what was found; convex problems have no other minima.
fn settling<'a>(session: &Session<'_>, answers: &'a [Answer], ray: Option<&Ray>) -> Option<(f64, &'a [f64])> {
    if session.task.class.is_global() || ray.is_some_and(|ray| ray.fall == Fall::Endless) {
        return None;
    }
    let runs_off = |answer: &&Answer| answer.certificate.as_ref().is_some_and(|own| ray.is_some() || !own.runaway.is_empty());
    let feasible = answers.iter().filter(|answer| answer.feasible).filter(runs_off);
    let places = feasible.filter_map(|answer| Some((answer.objective?, answer.solution.x.as_slice())));
    places.min_by(|a, b| a.0.total_cmp(&b.0))
}
