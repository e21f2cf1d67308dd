//! Unbounded, or not attained? Decided by following rays with the model itself, never by a solver's word.

mod paths;

use super::Answer;
use super::session::{Session, Solver};
use crate::model::{Meta, Model, WithBounds};

/// How the objective behaves along a feasible way.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Fall {
    /// Every tenfold distance brings at least as much again: −∞.
    Endless,
    /// Every tenfold distance brings less: it settles.
    Settling,
}

/// A feasible way along which the objective never stops falling.
pub(super) struct Ray {
    pub(super) fall: Fall,
    /// Length n, in the user's variables; of a bent way, where it leads in the end.
    pub(super) direction: Vec<f64>,
    /// Where it begins.
    pub(super) from: Vec<f64>,
}

/// Decades a ray is followed.
const DECADES: i32 = 9;
/// Half widths of the artificial boxes, in units of the variables' own sizes.
const BOXES: [f64; 2] = [1e3, 1e5];
/// Variable j diverges where |x_j − start_j| > DIVERGED·size_j.
const DIVERGED: f64 = 100.0;
/// Rounding may hide a violation at x where |x_j − start_j| > TOO_FAR·size_j for some j.
const TOO_FAR: f64 = 1e4;
/// Objectives this close, in units of σ, are the same.
const AGREEMENT: f64 = 1e-6;
/// Variables tried one by one at the most.
const TRIED: usize = 200;
/// Components of a direction below this, relative, are noise.
const NOISE: f64 = 1e-6;

/// Looks for a ray from the feasible points among `answers`, and, where a variable is open, from minima inside artificial boxes.
pub(super) fn examine(session: &Session<'_>, solvers: &[Solver<'_>], answers: &[Answer]) -> Option<Ray> {
    let meta = session.task.model.meta();
    let answers = answers.iter().filter(|answer| answer.feasible).map(|answer| answer.solution.x.as_slice());
    let points: Vec<&[f64]> = answers.chain([session.task.start]).collect();
    if let Some(ray) = points.iter().find_map(|x| paths::towards_edge(session, x)) {
        return Some(ray);
    }
    if meta.lower.iter().chain(&meta.upper).all(|bound| bound.is_finite()) {
        return None;
    }
    let along_way = points.iter().find_map(|x| follow(session, x, &difference(x, &meta.start)));
    let gradient = |x: &[f64]| {
        let mut gradient = vec![0.0; x.len()];
        session.task.model.gradient(x, &mut gradient).ok().map(|_| gradient.iter().map(|g| -g).collect::<Vec<_>>())
    };
    along_way
        .or_else(|| points.iter().find_map(|x| follow(session, x, &gradient(x)?)))
        .or_else(|| points.iter().find_map(|x| axes(meta).find_map(|axis| follow(session, x, &axis))))
        .or_else(|| points.iter().find_map(|x| paths::power_curve(session, x)))
        .or_else(|| boxed(session, solvers))
}

/// Whether what another backend found overrules certified points: it goes on falling below them, or, at the same value, certified
/// points have gone as far in the variables that diverge.
pub(super) fn overruled(session: &Session<'_>, answers: &[Answer], best: &Answer) -> Option<Ray> {
    let certificate = best.certificate.as_ref()?;
    let level = AGREEMENT * certificate.sigma.max(f64::EPSILON * certificate.objective.abs());
    let start = &session.task.model.meta().start;
    let is_far = |&j: &usize| (best.solution.x[j] - start[j]).abs() > DIVERGED * size(start[j]);
    let overrules = |answer: &Answer| {
        let (x, own) = (&answer.solution.x, answer.certificate.as_ref()?);
        if !answer.feasible || own.certified || own.objective > certificate.objective + level {
            return None;
        }
        let straight = || follow(session, x, &difference(x, start)).or_else(|| paths::power_curve(session, x));
        if own.objective < certificate.objective - level {
            return straight().or_else(|| paths::towards_edge(session, x));
        }
        own.runaway.iter().any(is_far).then(straight).flatten()
    };
    answers.iter().find_map(overrules)
}

/// Whether a point lies so far from the start that rounding may hide a violation of the rows. States follow from the design, and may start next to
/// nothing by chance.
pub(super) fn is_too_far(session: &Session<'_>, x: &[f64]) -> bool {
    let meta = session.task.model.meta();
    let design = meta.states.map_or(x.len(), |states| states.first_variable);
    x.iter().zip(&meta.start).take(design).any(|(x, &start)| (x - start).abs() > TOO_FAR * size(start))
}

/// The size of a variable that starts here.
fn size(start: f64) -> f64 {
    if start == 0.0 { 1.0 } else { start.abs() }
}

/// ±e_j for the variables open on that side.
fn axes(meta: &Meta) -> impl Iterator<Item = Vec<f64>> + '_ {
    let axis = |j: usize, sign: f64| {
        let mut direction = vec![0.0; meta.variables()];
        direction[j] = sign * meta.start[j].abs().max(1.0);
        direction
    };
    let up = move |j: usize| (meta.upper[j] == f64::INFINITY).then(|| axis(j, 1.0));
    let down = move |j: usize| (meta.lower[j] == f64::NEG_INFINITY).then(|| axis(j, -1.0));
    (0..meta.variables().min(TRIED)).flat_map(move |j| [up(j), down(j)]).flatten()
}

/// Minima inside two artificial boxes: their difference is the direction in which the problem diverges.
fn boxed(session: &Session<'_>, solvers: &[Solver<'_>]) -> Option<Ray> {
    solvers.iter().find_map(|&solver| {
        let [near, far] = BOXES.map(|width| corner(session, solver, width));
        let (near, far) = (near?, far?);
        let direction = difference(&far, &near);
        follow(session, &far, &direction).or_else(|| follow(session, &near, &direction))
    })
}

fn corner(session: &Session<'_>, solver: Solver<'_>, width: f64) -> Option<Vec<f64>> {
    if session.clock.is_over() {
        return None;
    }
    let meta = session.task.model.meta();
    let reach = |start: &f64| width * start.abs().max(1.0);
    let lower = meta.lower.iter().zip(&meta.start).map(|(bound, start)| bound.max(start - reach(start))).collect();
    let upper = meta.upper.iter().zip(&meta.start).map(|(bound, start)| bound.min(start + reach(start))).collect();
    let model = WithBounds::new(session.task.model, lower, upper);
    let solution = session.solve_aside(solver, &model, &model.meta().start, session.clock.share(0.3, 20.0));
    let feasible = session.judge.primal_infeasibility(&solution.x).is_some_and(|worst| worst <= session.tolerances.constraint);
    feasible.then_some(solution.x)
}

/// Follows `from + t·direction` over nine decades: feasible throughout and falling at every step, or no ray.
fn follow(session: &Session<'_>, from: &[f64], direction: &[f64]) -> Option<Ray> {
    let direction = cleaned(direction, from, session.task.model.meta())?;
    let value = |t: f64| {
        let x: Vec<f64> = from.iter().zip(&direction).map(|(x, v)| x + t * v).collect();
        feasible_value(session, &x)
    };
    let mut last = value(0.0)?;
    let mut falls = Vec::new();
    for decade in 0..DECADES {
        let Some(next) = value(10f64.powi(decade)) else { break };
        falls.push(last - next);
        last = next;
    }
    Some(Ray { fall: classify(&falls)?, direction, from: from.to_vec() })
}

/// f(x), where x meets every limit.
fn feasible_value(session: &Session<'_>, x: &[f64]) -> Option<f64> {
    let feasible = session.judge.primal_infeasibility(x)? <= session.tolerances.constraint;
    feasible.then(|| session.task.model.objective(x).ok().filter(|f| f.is_finite())).flatten()
}

/// Of at least six falls in a row, none of which is a rise: growing or level is endless, shrinking settles.
fn classify(falls: &[f64]) -> Option<Fall> {
    let first = *falls.first()?;
    if falls.len() < 6 || first <= 0.0 || falls.iter().any(|fall| *fall < 0.0) {
        return None;
    }
    let tail = &falls[falls.len() - 4..];
    let endless = tail.windows(2).all(|pair| pair[1] > 0.0 && pair[1] >= 0.9 * pair[0]);
    Some(if endless { Fall::Endless } else { Fall::Settling })
}

/// Without noise and without components towards a bound; `None` where nothing is left. Its largest entry, relative to the point
/// it sets out from, is 1: shorter steps would show the tangent only.
fn cleaned(direction: &[f64], from: &[f64], meta: &Meta) -> Option<Vec<f64>> {
    let size = |j: usize| meta.start[j].abs().max(from[j].abs()).max(f64::from(u8::from(meta.start[j] == 0.0)));
    let open = |j: usize, v: f64| if v > 0.0 { meta.upper[j] == f64::INFINITY } else { meta.lower[j] == f64::NEG_INFINITY };
    let kept: Vec<f64> = direction.iter().enumerate().map(|(j, &v)| if open(j, v) { v } else { 0.0 }).collect();
    let largest = kept.iter().enumerate().fold(0.0, |most: f64, (j, v)| most.max(v.abs() / size(j)));
    if !(largest > 0.0 && largest.is_finite()) {
        return None;
    }
    Some(kept.iter().enumerate().map(|(j, v)| if v.abs() / size(j) >= NOISE * largest { v / largest } else { 0.0 }).collect())
}

fn difference(a: &[f64], b: &[f64]) -> Vec<f64> {
    a.iter().zip(b).map(|(a, b)| a - b).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn falls(f: impl Fn(f64) -> f64) -> Vec<f64> {
        let values: Vec<f64> = std::iter::once(0.0).chain((0..DECADES).map(|k| 10f64.powi(k))).map(f).collect();
        values.windows(2).map(|pair| pair[0] - pair[1]).collect()
    }

    #[test]
    fn endless_and_settling_falls_are_told_apart() {
        assert_eq!(classify(&falls(|t| -t)), Some(Fall::Endless));
        assert_eq!(classify(&falls(|t| -(1.0 + t).ln())), Some(Fall::Endless));
        assert_eq!(classify(&falls(|t| 1.0 / (1.0 + t))), Some(Fall::Settling));
        assert_eq!(classify(&falls(|t| (-t).exp())), Some(Fall::Settling));
        assert_eq!(classify(&falls(|t| (t - 50.0).powi(2))), None);
        assert_eq!(classify(&falls(|_| 1.0)), None);
    }
}
