//! Unbounded, or not attained? Decided by ways followed in the user's model, never by a solver's word.

use super::Answer;
use super::session::{Session, Solver};
use super::work;
use crate::certificate::{Certificate, have_rows_grown, sizes_at_start, sizes_known_at};
use crate::model::{Class, Model, WithBounds};
use crate::recession::{Fall, Ray, Terrain, is_farther, size};

/// Half widths of the artificial boxes, in units of the variables' own sizes.
const BOXES: [f64; 2] = [1e3, 1e5];
/// Variable j diverges where |x_j − start_j| > DIVERGED·size_j.
const DIVERGED: f64 = 100.0;
/// Rounding may hide a violation at x where |x_j − start_j| > TOO_FAR·(what is known of its size where the model starts) for some j.
pub(super) const TOO_FAR: f64 = 1e4;
/// Objectives this close, in units of σ, are the same.
const AGREEMENT: f64 = 1e-6;
/// f' < f − SHARE·|f| is lower, |x'_j − start_j| < SHARE·|x_j − start_j| nearer.
const SHARE: f64 = 0.5;
/// A fall of more than ROUNDINGS·max(σ, |f|) is none of rounding's.
const ROUNDINGS: f64 = 1e3 * f64::EPSILON;
/// Shares of the way to a lower point at which the objective is looked at.
const SHARES: [f64; 8] = [1.0 / 128.0, 1.0 / 64.0, 1.0 / 32.0, 1.0 / 16.0, 0.125, 0.25, 0.5, 1.0];
/// Points within SAME·d_j of one another are one.
const SAME: f64 = 1e-6;
/// Places on a way are led back to the rows within this, relative to the variables there.
const BESIDE: f64 = 0.1;

/// Follows ways with the user's model.
fn with_terrain<T>(session: &Session<'_>, follow: impl FnOnce(&Terrain<'_>) -> T) -> T {
    let nearest = |x: &[f64]| if session.clock.is_over() { None } else { session.judge.nearest_feasible(x, BESIDE) };
    // A posynomial that is minimised stays positive.
    let is_positive = || session.task.model.objective(session.task.start).is_ok_and(|value| value >= 0.0);
    let is_bounded = session.task.class == Class::GeometricProgram && is_positive();
    follow(&Terrain { model: session.task.model, start: session.task.start, nearest: &nearest, is_bounded })
}

/// Looks for a ray from the feasible points among `answers`, and, where a variable is open, from minima inside artificial boxes.
pub(super) fn examine(session: &Session<'_>, solvers: &[Solver<'_>], answers: &[Answer]) -> Option<Ray> {
    let meta = session.task.model.meta();
    let feasible = answers.iter().filter(|answer| answer.feasible).map(|answer| answer.solution.x.as_slice());
    let points: Vec<&[f64]> = feasible.chain([session.task.start]).collect();
    let from_points = with_terrain(session, |terrain| {
        if let Some(ray) = points.iter().find_map(|x| terrain.towards_edge(x)) {
            return Some(ray);
        }
        if meta.lower.iter().chain(&meta.upper).all(|bound| bound.is_finite()) {
            return None;
        }
        let gradient = |x: &[f64]| {
            let mut gradient = vec![0.0; x.len()];
            session.task.model.gradient(x, &mut gradient).ok().map(|_| gradient.iter().map(|g| -g).collect::<Vec<_>>())
        };
        let along_way = points.iter().find_map(|x| terrain.straight(x, &difference(x, session.task.start)));
        along_way
            .or_else(|| points.iter().find_map(|x| terrain.straight(x, &gradient(x)?)))
            .or_else(|| points.iter().find_map(|x| terrain.axes(x)))
            .or_else(|| points.iter().find_map(|x| terrain.power_curve(x)))
    });
    let is_open = meta.lower.iter().chain(&meta.upper).any(|bound| bound.is_infinite());
    let valley = || points.iter().find_map(|x| if session.clock.is_over() { None } else { session.judge.way_beyond(x) });
    let found = from_points.or_else(|| if is_open { valley().or_else(|| boxed(session, solvers)) } else { None });
    // A way that settles is worth less than a point's own, which falls without end.
    match (&found, judged(answers)) {
        (Some(Ray { fall: Fall::Endless, .. }), _) | (_, None) => found,
        (Some(_), Some(own)) if own.fall == Fall::Settling => found,
        (_, own) => own,
    }
}

/// The way the certificate of an answer has found.
fn judged(answers: &[Answer]) -> Option<Ray> {
    let rays = || answers.iter().filter_map(tail);
    rays().find(|ray| ray.fall == Fall::Endless).or_else(|| rays().next())
}

/// The way outwards a feasible answer's certificate has followed.
fn tail(answer: &Answer) -> Option<Ray> {
    let own = answer.certificate.as_ref().filter(|own| answer.feasible && !own.runaway.is_empty())?;
    let fall = if own.falls_without_end { Fall::Endless } else { Fall::Settling };
    let mut direction = vec![0.0; answer.solution.x.len()];
    own.runaway.iter().for_each(|&j| direction[j] = answer.solution.x[j]);
    Some(Ray { fall, direction, from: answer.solution.x.clone() })
}

/// Whether what another backend found overrules certified points: it goes on falling below them, or, at the same value, certified
/// points have gone as far in the variables that diverge: on the way its certificate has followed they are in the same tail.
pub(super) fn overruled(session: &Session<'_>, answers: &[Answer], best: &Answer) -> Option<Ray> {
    let certificate = best.certificate.as_ref()?;
    let level = AGREEMENT * certificate.sigma.max(f64::EPSILON * certificate.objective.abs());
    let start = &session.task.model.meta().start;
    let is_far = |&j: &usize| is_farther(best.solution.x[j], start[j], DIVERGED);
    let overrules = |terrain: &Terrain<'_>, answer: &Answer| {
        let (x, own) = (&answer.solution.x, answer.certificate.as_ref()?);
        if !answer.feasible || own.certified || own.objective > certificate.objective + level {
            return None;
        }
        let is_lower = own.objective < certificate.objective - level;
        let is_in_it = is_on_the_way(start, own, x, &best.solution.x) || is_beside(certificate, &best.solution.x, x);
        if let Some(tail) =
            tail(answer).filter(|_| is_lower || is_in_it || falls_towards(session, (certificate, &best.solution.x), x))
        {
            return Some(tail);
        }
        let straight = || terrain.straight(x, &difference(x, start)).or_else(|| terrain.power_curve(x));
        // However little lower: a way from there that never stops falling is a proof. That from one feasible point to another is on the rows.
        if own.objective < certificate.objective {
            let onwards = || terrain.straight(x, &difference(x, &best.solution.x));
            return straight().or_else(onwards).or_else(|| if is_lower { terrain.towards_edge(x) } else { None });
        }
        own.runaway.iter().any(is_far).then(straight).flatten()
    };
    with_terrain(session, |terrain| answers.iter().find_map(|answer| overrules(terrain, answer)))
}

/// Whether the objective falls from a judged point straight to another one, from the very beginning and beyond rounding: then what the point
/// leaves of the fall is the slope that is accepted, and it is no minimum.
fn falls_towards(session: &Session<'_>, (own, from): (&Certificate, &[f64]), to: &[f64]) -> bool {
    let model = session.task.model;
    let rounding = ROUNDINGS * own.sigma.max(own.objective.abs());
    let mut last = own.objective;
    SHARES.into_iter().all(|share| {
        let x: Vec<f64> = from.iter().zip(to).map(|(from, to)| from + share * (to - from)).collect();
        let is_feasible = || session.judge.primal_infeasibility(&x).is_some_and(|worst| worst <= session.tolerances.constraint);
        let falls = |value: f64| value < std::mem::replace(&mut last, value) - rounding;
        model.objective(&x).is_ok_and(falls) && is_feasible()
    })
}

/// Whether a point has gone on the way on which the variables of a judged one run away: all of them as far, or one of them far from where
/// it comes from and farther (a slack beside it may have gone to and fro).
fn is_on_the_way(start: &[f64], own: &Certificate, x: &[f64], point: &[f64]) -> bool {
    let gone = |j: usize| (point[j] - start[j]) * (x[j] - start[j]).signum();
    let way = |j: usize| (x[j] - start[j]).abs();
    let far = |j: usize| DIVERGED * size(start[j]);
    let goes_on = |&j: &usize| way(j) != 0.0 && gone(j) >= way(j).min(far(j));
    let goes_far = |&j: &usize| way(j) != 0.0 && gone(j) >= way(j).max(far(j));
    !own.runaway.is_empty() && (own.runaway.iter().all(goes_on) || own.runaway.iter().any(goes_far))
}

/// Whether a feasible answer is lower than a judged one by a share of the objective itself, and nearer to where a variable comes from that has
/// gone far: what is small at the judged point is small only beside what its variables have grown to.
pub(super) fn is_lower_nearer(session: &Session<'_>, answer: &Answer, (own, far): (&Certificate, &[f64])) -> bool {
    let start = &session.task.model.meta().start;
    let nearer = |(&start, (&x, &far)): (&f64, (&f64, &f64))| {
        is_farther(far, start, TOO_FAR) && (x - start).abs() < SHARE * (far - start).abs()
    };
    let is_lower = answer.objective.is_some_and(|objective| own.objective - objective > SHARE * own.objective.abs());
    answer.feasible && is_lower && start.iter().zip(answer.solution.x.iter().zip(far)).any(nearer)
}

/// Whether a judged point is where variables have run off: beside `far`, or as far out in a variable that is far there.
pub(super) fn is_in_tail(session: &Session<'_>, x: &[f64], (own, far): (&Certificate, &[f64])) -> bool {
    let start = &session.task.model.meta().start;
    let has_run_off =
        |(&start, (&x, &far)): (&f64, (&f64, &f64))| is_farther(x, start, TOO_FAR) && is_farther(far, start, TOO_FAR);
    let runs = start.iter().zip(x.iter().zip(far)).any(has_run_off);
    runs || is_beside(own, x, far)
}

/// Whether two points are one but for what is accepted of slopes.
fn is_beside(own: &Certificate, x: &[f64], other: &[f64]) -> bool {
    x.iter().zip(other).zip(&own.variable_scales).all(|((x, other), d)| (x - other).abs() <= SAME * d)
}

/// Whether a point lies so far from the start that rounding may hide a violation of the rows. States follow from the design, and may start next to
/// nothing by chance; a bent row's slope at the start may tell of a variable what holds only there (of the displacement of a bar that becomes slender).
pub(super) fn is_too_far(session: &Session<'_>, x: &[f64]) -> bool {
    let meta = session.task.model.meta();
    let design = meta.states.map_or(x.len(), |states| states.first_variable);
    let sizes = sizes_at_start(session.task.model).unwrap_or_else(|| meta.start.iter().copied().map(size).collect());
    let way = |j: usize| (x[j] - meta.start[j]).abs();
    let far: Vec<usize> = (0..design).filter(|&j| way(j) > TOO_FAR * sizes[j]).collect();
    let at_x = if far.is_empty() { None } else { sizes_known_at(session.task.model, x) };
    let is_far = |&j: &usize| at_x.as_ref().is_none_or(|sizes| way(j) > TOO_FAR * sizes[j]);
    let far: Vec<usize> = far.into_iter().filter(is_far).collect();
    !far.is_empty() && have_rows_grown(session.task.model, x, &far, TOO_FAR)
}

/// Minima inside two artificial boxes: their difference shows where the problem runs off to.
fn boxed(session: &Session<'_>, solvers: &[Solver<'_>]) -> Option<Ray> {
    solvers.iter().find_map(|&solver| {
        let [near, far] = BOXES.map(|width| corner(session, solver, width));
        let (near, far) = (near?, far?);
        let direction = difference(&far, &near);
        with_terrain(session, |terrain| terrain.straight(&far, &direction).or_else(|| terrain.straight(&near, &direction)))
    })
}

fn corner(session: &Session<'_>, solver: Solver<'_>, width: f64) -> Option<Vec<f64>> {
    if session.clock.is_over() {
        return None;
    }
    let start = &session.task.model.meta().start;
    let model = WithBounds::about_start(session.task.model, |j| width * start[j].abs().max(1.0));
    let budget = session.budget(solver, &model, work::further_run(0.0));
    let solution = session.solve_aside(solver, &model, &model.meta().start, budget);
    let feasible = session.judge.primal_infeasibility(&solution.x).is_some_and(|worst| worst <= session.tolerances.constraint);
    feasible.then_some(solution.x)
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}
