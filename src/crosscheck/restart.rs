//! Second tries: away from saddles, from a backend's own best point, from beside another's answer.

use super::Answer;
use super::attempt::{Contestant, Referee};
use super::seeds::Seeds;
use crate::backends::{Iteration, Termination};
use crate::model::Budget;

const ESCAPES: usize = 5;

/// Improves an answer that did not pass, while that helps.
pub(super) fn improve(referee: &Referee<'_>, contestant: Contestant<'_>, answer: &mut Answer) {
    leave_saddles(referee, contestant, answer);
    go_to_bounds(referee, answer);
    if is_worth_another_try(referee, answer) {
        let start = answer.solution.x.clone();
        retry(referee, contestant, answer, &start, "started again at its own best point");
    }
    if is_worth_another_try(referee, answer) {
        let start = beside(referee, &answer.solution.x, 1e-2);
        retry(referee, contestant, answer, &start, "started again beside its own best point");
    }
}

/// Starts a backend whose answer did not pass beside another's certified point.
pub(super) fn cross_start(referee: &Referee<'_>, contestant: Contestant<'_>, answer: &mut Answer, other: &Answer) {
    if is_worth_another_try(referee, answer) {
        let start = beside(referee, &other.solution.x, 1e-3);
        retry(referee, contestant, answer, &start, &format!("started again beside the answer of {}", other.backend));
    }
}

/// Starts a backend from a point another one holds.
pub(super) fn retry(referee: &Referee<'_>, contestant: Contestant<'_>, answer: &mut Answer, start: &[f64], remark: &str) {
    let budget = referee.clock.share(0.5, f64::INFINITY);
    again(referee, contestant, answer, (start, budget), &mut |_| {}, remark);
}

/// Starts a backend again from a point, with a budget; the better answer stays.
pub(super) fn again(
    referee: &Referee<'_>,
    contestant: Contestant<'_>,
    answer: &mut Answer,
    (start, budget): (&[f64], Budget<'_>),
    observer: &mut dyn FnMut(&Iteration<'_>),
    remark: &str,
) {
    let mut next = referee.attempt(contestant, start, None, budget, observer);
    if referee.is_better(&next, answer) {
        add_effort(&mut next, answer);
        next.remarks = std::mem::take(&mut answer.remarks);
        next.remarks.push(remark.to_string());
        *answer = next;
    } else {
        add_effort(answer, &next);
    }
}

fn add_effort(to: &mut Answer, from: &Answer) {
    to.solution.evaluations += from.solution.evaluations;
    to.solution.seconds += from.solution.seconds;
    to.solution.iterations = to.solution.iterations.map(|count| count + from.solution.iterations.unwrap_or(0));
}

fn is_worth_another_try(referee: &Referee<'_>, answer: &Answer) -> bool {
    let ended = matches!(answer.solution.termination, Termination::Converged | Termination::Failed);
    let runs_away = answer.certificate.as_ref().is_some_and(|certificate| !certificate.runaway.is_empty());
    let passes = answer.is_certified();
    ended && !passes && !runs_away && !referee.clock.is_over()
}

/// Where the objective falls towards bounds so far away that a backend gave up on the way: the point on these bounds, if it passes.
fn go_to_bounds(referee: &Referee<'_>, answer: &mut Answer) {
    let meta = referee.task.model.meta();
    let mut gradient = vec![0.0; meta.variables()];
    let is_open = answer.certificate.as_ref().is_some_and(|own| !own.certified && own.runaway.is_empty());
    if !is_open || referee.task.model.gradient(&answer.solution.x, &mut gradient).is_err() {
        return;
    }
    let falls_to = |j: usize| if gradient[j] > 0.0 { meta.lower[j] } else { meta.upper[j] };
    let place = |(j, &x): (usize, &f64)| if gradient[j] != 0.0 && falls_to(j).is_finite() { falls_to(j) } else { x };
    let x: Vec<f64> = answer.solution.x.iter().enumerate().map(place).collect();
    if let Some(certificate) = referee.judge.certify(&x, None).ok().filter(|certificate| certificate.certified) {
        answer.objective = Some(certificate.objective);
        answer.certificate = Some(certificate);
        (answer.solution.x, answer.solution.multipliers) = (x, None);
        answer.remarks.push("moved on to the bounds towards which the objective falls".into());
    }
}

/// From a stationary point that is no minimum, a step along the direction in which the objective bends down.
fn leave_saddles(referee: &Referee<'_>, contestant: Contestant<'_>, answer: &mut Answer) {
    for _ in 0..ESCAPES {
        let direction = answer.certificate.as_ref().and_then(|certificate| certificate.escape.clone());
        let Some(direction) = direction else { return };
        if referee.clock.is_over() {
            return;
        }
        let before = answer.solution.x.clone();
        for start in escapes(referee, &before, &direction) {
            retry(referee, contestant, answer, &start, "left a stationary point that is no minimum");
            if answer.solution.x != before {
                break;
            }
        }
        if answer.solution.x == before {
            return;
        }
    }
}

/// Points a little along ±direction, the lower objective first.
fn escapes(referee: &Referee<'_>, x: &[f64], direction: &[f64]) -> Vec<Vec<f64>> {
    let step = |size: f64| inside(referee, x.iter().zip(direction).map(|(x, v)| x + size * v).collect());
    let mut points: Vec<_> = [0.1, -0.1, 1e-2, -1e-2].map(step).into_iter().filter(|point| point != x).collect();
    let value = |point: &Vec<f64>| referee.task.model.objective(point).unwrap_or(f64::INFINITY);
    points.sort_by(|a, b| value(a).total_cmp(&value(b)));
    points
}

/// A fixed perturbation of this relative size.
fn beside(referee: &Referee<'_>, x: &[f64], size: f64) -> Vec<f64> {
    let mut seeds = Seeds::new(1);
    let start = &referee.task.model.meta().start;
    let moved = x.iter().zip(start).map(|(x, start)| {
        let scale = x.abs().max(start.abs());
        x + size * (2.0 * seeds.uniform() - 1.0) * if scale > 0.0 { scale } else { 1.0 }
    });
    inside(referee, moved.collect())
}

fn inside(referee: &Referee<'_>, mut x: Vec<f64>) -> Vec<f64> {
    referee.task.model.meta().clamp(&mut x);
    x
}
