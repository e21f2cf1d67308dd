//! Further runs: one table of which, when and how much. A backend does one run; everything that begins again is here.

use super::ledger::Ledger;
use super::merit;
use super::seeds::{self, Seeds};
use super::session::Session;
use super::{Answer, verdict, work};
use crate::backends::Termination;

/// A way to begin again.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Restart {
    /// From a stationary point that is no minimum, a step along the direction of negative curvature.
    EscapeSaddle,
    /// No run: the point on the bounds towards which the objective falls, where it passes.
    BoundsAhead,
    /// From its own best point, where scales fit better than at the start.
    AtOwnBest,
    /// From its own best point moved by this share of the variables.
    Beside(f64),
    /// From another's certified point moved by this share.
    CrossStart(f64),
}

/// What is tried for an answer that did not pass, in this order until it does, and how often at the most.
pub(super) const POLICY: &[(Restart, usize)] =
    &[(Restart::EscapeSaddle, 5), (Restart::BoundsAhead, 1), (Restart::AtOwnBest, 1), (Restart::Beside(1e-2), 1)];

/// For answers that still do not pass beside one that does.
pub(super) const BESIDE_CERTIFIED: Restart = Restart::CrossStart(1e-3);

/// Steps away from a saddle, in units of the direction.
const ESCAPES: [f64; 4] = [0.1, -0.1, 1e-2, -1e-2];
/// A further run that ends this close to where the one before did, relative, has ended at the same point.
const SAME: f64 = 1e-9;
/// Variables and rows up to which other starts are probed.
const SMALL: usize = 50;
/// Seeds of the probe's starts, besides the middle of the bounds.
const SEEDS: [u64; 2] = [1, 2];
/// Rounds in which worse answers are brought to a better point.
const ROUNDS: usize = 3;

/// Improves an answer that did not pass, while that helps.
pub(super) fn improve(ledger: &mut Ledger<'_, '_>, k: usize, answer: &mut Answer) {
    for &(restart, times) in POLICY {
        for _ in 0..times {
            if !apply(ledger, k, answer, restart, None) {
                break;
            }
        }
    }
}

/// Starts a backend whose answer did not pass beside another's certified point.
pub(super) fn cross_start(ledger: &mut Ledger<'_, '_>, k: usize, answer: &mut Answer, other: &Answer) {
    apply(ledger, k, answer, BESIDE_CERTIFIED, Some(other));
}

/// One line of the table. Whether the answer became better.
fn apply(ledger: &mut Ledger<'_, '_>, k: usize, answer: &mut Answer, restart: Restart, other: Option<&Answer>) -> bool {
    let session = ledger.session;
    if answer.is_certified() || session.clock.is_over() {
        return false;
    }
    match restart {
        Restart::EscapeSaddle => escape_saddle(ledger, k, answer),
        Restart::BoundsAhead => go_to_bounds(session, answer),
        _ if !is_worth_another_run(ledger, k, answer) => false,
        Restart::AtOwnBest => {
            let start = answer.solution.x.clone();
            retry(ledger, k, answer, &start, "started again at its own best point")
        }
        Restart::Beside(share) => {
            let start = beside(session, &answer.solution.x, share);
            retry(ledger, k, answer, &start, "started again beside its own best point")
        }
        Restart::CrossStart(share) => {
            let Some(other) = other else { return false };
            let start = beside(session, &other.solution.x, share);
            retry(ledger, k, answer, &start, &format!("started again beside the answer of {}", other.backend))
        }
    }
}

/// Starts backend k from a point, with a further run's work; the better answer stays. Whether it is the new one.
pub(super) fn retry(ledger: &mut Ledger<'_, '_>, k: usize, answer: &mut Answer, start: &[f64], remark: &str) -> bool {
    let next = ledger.run(k, start, work::further_run(ledger.first_work(k)));
    if is_same_point(&next.solution.x, &answer.solution.x) && is_same_point(start, &answer.solution.x) && !next.is_certified() {
        ledger.settle(k);
    }
    keep_better(ledger, answer, next, remark)
}

/// The better of an answer and a later one, with the effort of both. Whether it is the later one.
pub(super) fn keep_better(ledger: &Ledger<'_, '_>, answer: &mut Answer, mut next: Answer, remark: &str) -> bool {
    if !ledger.session.is_better(&next, answer) {
        add_effort(answer, &next);
        return false;
    }
    add_effort(&mut next, answer);
    next.remarks = std::mem::take(&mut answer.remarks);
    next.remarks.push(remark.to_string());
    *answer = next;
    true
}

fn add_effort(to: &mut Answer, from: &Answer) {
    to.solution.evaluations += from.solution.evaluations;
    to.solution.seconds += from.solution.seconds;
    to.solution.iterations = to.solution.iterations.map(|count| count + from.solution.iterations.unwrap_or(0));
}

fn is_same_point(a: &[f64], b: &[f64]) -> bool {
    a.iter().zip(b).all(|(a, b)| (a - b).abs() <= SAME * a.abs().max(b.abs()))
}

/// Runs that were cut short, that ran away, or that keep ending where they are get no further one.
fn is_worth_another_run(ledger: &Ledger<'_, '_>, k: usize, answer: &Answer) -> bool {
    let ended = matches!(answer.solution.termination, Termination::Converged | Termination::Failed);
    let runs_away = answer.certificate.as_ref().is_some_and(|certificate| !certificate.runaway.is_empty());
    ended && !runs_away && !ledger.is_settled(k)
}

/// Where the objective falls towards bounds so far away that a backend gave up on the way: the point on these bounds, if it passes.
fn go_to_bounds(session: &Session<'_>, answer: &mut Answer) -> bool {
    let meta = session.task.model.meta();
    let mut gradient = vec![0.0; meta.variables()];
    let is_open = answer.certificate.as_ref().is_some_and(|own| own.runaway.is_empty());
    if !is_open || session.task.model.gradient(&answer.solution.x, &mut gradient).is_err() {
        return false;
    }
    let falls_to = |j: usize| if gradient[j] > 0.0 { meta.lower[j] } else { meta.upper[j] };
    let place = |(j, &x): (usize, &f64)| if gradient[j] != 0.0 && falls_to(j).is_finite() { falls_to(j) } else { x };
    let x: Vec<f64> = answer.solution.x.iter().enumerate().map(place).collect();
    let mut moved = answer.clone();
    (moved.solution.x, moved.solution.multipliers) = (x, None);
    session.judge_again(&mut moved);
    if moved.is_certified() {
        moved.remarks.push("moved on to the bounds towards which the objective falls".into());
        *answer = moved;
    }
    answer.is_certified()
}

/// From a stationary point that is no minimum, a step along the direction of negative curvature.
fn escape_saddle(ledger: &mut Ledger<'_, '_>, k: usize, answer: &mut Answer) -> bool {
    let direction = answer.certificate.as_ref().and_then(|certificate| certificate.escape.clone());
    let Some(direction) = direction else { return false };
    let before = answer.solution.x.clone();
    for start in escapes(ledger.session, &before, &direction) {
        if ledger.session.clock.is_over() {
            return false;
        }
        if retry(ledger, k, answer, &start, "left a stationary point that is no minimum") {
            return true;
        }
    }
    false
}

/// Points a little along ±direction, the lower objective first.
fn escapes(session: &Session<'_>, x: &[f64], direction: &[f64]) -> Vec<Vec<f64>> {
    let step = |size: f64| inside(session, x.iter().zip(direction).map(|(x, v)| x + size * v).collect());
    let mut points: Vec<_> = ESCAPES.map(step).into_iter().filter(|point| point != x).collect();
    let value = |point: &Vec<f64>| session.task.model.objective(point).unwrap_or(f64::INFINITY);
    points.sort_by(|a, b| value(a).total_cmp(&value(b)));
    points
}

/// A fixed perturbation of this relative size.
fn beside(session: &Session<'_>, x: &[f64], size: f64) -> Vec<f64> {
    let mut seeds = Seeds::new(1);
    let start = &session.task.model.meta().start;
    let moved = x.iter().zip(start).map(|(x, start)| {
        let scale = x.abs().max(start.abs());
        x + size * (2.0 * seeds.uniform() - 1.0) * if scale > 0.0 { scale } else { 1.0 }
    });
    inside(session, moved.collect())
}

fn inside(session: &Session<'_>, mut x: Vec<f64>) -> Vec<f64> {
    session.task.model.meta().clamp(&mut x);
    x
}

/// Looks from a few other starts for a better minimum than the certified one, where the problem is small and its minima may be
/// local. One backend looks; what it finds is offered to the others.
pub(super) fn probe(ledger: &mut Ledger<'_, '_>, answers: &mut [Answer]) {
    let (session, meta) = (ledger.session, ledger.session.task.model.meta());
    if session.task.class.is_global() || meta.variables().max(meta.rows()) > SMALL {
        return;
    }
    let is_free = |&k: &usize| ledger.solvers[k].algorithm == "auto" && answers[k].solution.termination != Termination::Refused;
    let Some(k) = ledger.order().into_iter().find(is_free) else { return };
    let starts: Vec<_> = std::iter::once(seeds::middle(meta)).chain(SEEDS.map(|seed| Seeds::new(seed).point(meta))).collect();
    for start in starts {
        let Some(best) = verdict::best(session, answers).filter(|&best| answers[best].is_certified()) else { return };
        if session.clock.is_over() {
            return;
        }
        let allowed = work::probe(ledger.first_work(k));
        let next = ledger.run(k, &start, allowed);
        if next.is_certified() && merit::is_lower(session, &next, &answers[best]) {
            answers[k].certificate = None;
            answers[k].feasible = false;
            keep_better(ledger, &mut answers[k], next, "found from another start");
        } else {
            // The iterations shown are those that led to the answer.
            answers[k].solution.evaluations += next.solution.evaluations;
            answers[k].solution.seconds += next.solution.seconds;
        }
    }
}

/// Brings every answer that is worse than a feasible point another backend holds to that point, or below it: a backend whose
/// runs end above it takes the point over. Afterwards no certified answer stands above a feasible one.
pub(super) fn to_better_points(ledger: &mut Ledger<'_, '_>, answers: &mut [Answer]) {
    let session = ledger.session;
    for _ in 0..ROUNDS {
        let Some(best) = verdict::best(session, answers).filter(|&best| answers[best].is_certified()) else { return };
        let Some(lower) = verdict::better_elsewhere(session, answers, &answers[best]) else { return };
        let better = answers[lower].clone();
        for (k, answer) in answers.iter_mut().enumerate() {
            if k != lower && answer.is_certified() && merit::is_lower(session, &better, answer) {
                bring(ledger, k, answer, &better);
            }
        }
    }
}

fn bring(ledger: &mut Ledger<'_, '_>, k: usize, answer: &mut Answer, better: &Answer) {
    let next = match ledger.session.clock.is_over() {
        true => None,
        false => Some(ledger.run(k, &better.solution.x, work::further_run(ledger.first_work(k)))),
    };
    let mut next = next.unwrap_or_else(|| answer.clone());
    let stays_above = !next.feasible || next.objective > better.objective;
    if stays_above && (!next.is_certified() || merit::is_lower(ledger.session, better, &next)) {
        (next.solution.x, next.solution.multipliers) = (better.solution.x.clone(), None);
        ledger.session.judge_again(&mut next);
    }
    add_effort(&mut next, answer);
    next.remarks = std::mem::take(&mut answer.remarks);
    next.remarks
        .push(format!("had a local minimum above a feasible point of {}, and was started again from there", better.backend));
    *answer = next;
}
