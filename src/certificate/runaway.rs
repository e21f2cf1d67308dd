//! Variables that have run away: the point passes only because the objective flattens out far from the start, and would go on
//! falling for ever (exp(x) towards −∞). Such an infimum is not attained.

use super::Tolerances;
use super::higher_order::Trial;
use super::outward;
use super::point::Point;
use super::second_order::Active;
use crate::model::{EvaluationError, Model};

/// Single variables tried at the most, and their number times that of all variables.
const TRIED: usize = 32;
const WORK: usize = 1_000_000;

/// Nothing of a size of one belongs this far away.
const BEYOND: f64 = 1e30;

/// How far on the point is followed, in ways from the start.
const ONWARDS: [f64; 4] = [0.1, 1.0, 10.0, 100.0];
/// And where everything is level there: what is only flat rises in the end.
const FAR_ON: [f64; 4] = [1e4, 1e8, 1e16, 1e32];
/// Half-way back, an asymptote has risen by this share at the most of all it rises on the way to the start.
const ASYMPTOTE: f64 = 1e-2;

/// The variables along whose way from the start the objective still falls, however far one goes; empty at a true minimum.
pub(super) fn variables(point: &Point<'_>, active: &Active<'_>, tolerances: &Tolerances) -> Vec<usize> {
    let ray = Ray { point, active, tolerance: tolerances.constraint };
    let mut far: Vec<(f64, usize)> = (0..point.x.len()).filter_map(|j| travelled(point, j).map(|way| (way, j))).collect();
    far.sort_by(|a, b| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1)));
    let tried = TRIED.min(WORK / (point.x.len() + 1)).max(1);
    let all: Vec<usize> = far.iter().map(|&(_, j)| j).collect();
    let mut found: Vec<usize> =
        far.iter().take(tried).filter(|&&(way, j)| is_beyond(point, way, j) || ray.runs_off(&[j])).map(|f| f.1).collect();
    if found.is_empty() && all.len() > 1 && ray.runs_off(&all) {
        found = all;
    }
    if found.is_empty() {
        found = outward::variables(point, active, &far, tolerances);
    }
    if found.is_empty() {
        found = towards_bounds(point, tolerances.constraint);
    }
    found.sort_unstable();
    found
}

/// The variables on their way to bounds where a term has no value: nothing rises as they come nearer, and the bound itself is out
/// of reach.
fn towards_bounds(point: &Point<'_>, tolerance: f64) -> Vec<usize> {
    let meta = point.meta();
    let near = |j: usize| {
        let x = point.x[j];
        let bound = if x - meta.lower[j] <= meta.upper[j] - x { meta.lower[j] } else { meta.upper[j] };
        let size = bound.abs().max(meta.start[j].abs());
        let size = if size > 0.0 { size } else { 1.0 };
        (x != bound && (x - bound).abs() <= 1e-8 * size).then_some((j, bound))
    };
    let near: Vec<(usize, f64)> = (0..point.x.len()).filter_map(near).collect();
    let value = |share: f64| {
        let mut x = point.x.to_vec();
        near.iter().for_each(|&(j, bound)| x[j] = bound + share * (x[j] - bound));
        Trial::at(point, &x).filter(|trial| trial.is_feasible(point, tolerance)).map(|trial| trial.objective)
    };
    let on_bounds = || {
        let mut x = point.x.to_vec();
        near.iter().for_each(|&(j, bound)| x[j] = bound);
        point.origin.model.objective(&x).and_then(|_| point.origin.model.constraints(&x, &mut vec![0.0; meta.rows()]))
    };
    if near.is_empty() || !matches!(on_bounds(), Err(EvaluationError::Invalid { .. })) {
        return Vec::new();
    }
    let level = 64.0 * f64::EPSILON * point.objective.abs();
    let never_rises = [0.1, 0.01, 1e-3].into_iter().all(|share| value(share).is_some_and(|f| f <= point.objective + level));
    if never_rises { near.into_iter().map(|(j, _)| j).collect() } else { Vec::new() }
}

/// So far out, and far from where anything is of a size of one, that what lies further on overflows.
fn is_beyond(point: &Point<'_>, way: f64, j: usize) -> bool {
    way > BEYOND && point.x[j].abs() > BEYOND
}

/// How many times its own size variable j has moved towards an open bound; `None` where it has not gone far.
fn travelled(point: &Point<'_>, j: usize) -> Option<f64> {
    let (meta, x) = (point.meta(), point.x[j]);
    let moved = x - meta.start[j];
    let open = if moved > 0.0 { meta.upper[j] == f64::INFINITY } else { meta.lower[j] == f64::NEG_INFINITY };
    let size = if meta.start[j] == 0.0 { 1.0 } else { meta.start[j].abs() };
    (open && moved.abs() > 2.0 * size).then_some(moved.abs() / size)
}

/// The line some variables have come along from the start, the others held.
struct Ray<'r, 'p> {
    point: &'r Point<'p>,
    active: &'r Active<'r>,
    tolerance: f64,
}

impl Ray<'_, '_> {
    fn place(&self, variables: &[usize], factor: f64) -> Vec<f64> {
        let mut x = self.point.x.to_vec();
        for &j in variables {
            x[j] += factor * (self.point.x[j] - self.point.meta().start[j]);
        }
        x
    }

    /// f and its noise, where the point further on meets every row as well as the judged point may.
    fn onwards(&self, variables: &[usize], factor: f64) -> Option<(f64, f64)> {
        let x = self.place(variables, factor);
        let trial = Trial::at(self.point, &x)?;
        trial.is_feasible(self.point, self.tolerance).then(|| (trial.objective, self.noise(variables, &x, trial.objective)))
    }

    /// What the last digits of x make of f: sums that cancel hide more than the last digits of f.
    fn noise(&self, variables: &[usize], x: &[f64], objective: f64) -> f64 {
        let beside = |digits: f64| {
            let mut x = x.to_vec();
            variables.iter().for_each(|&j| x[j] *= 1.0 + digits * f64::EPSILON);
            self.point.origin.model.objective(&x).map_or(0.0, |value| (value - objective).abs())
        };
        [-5.0, -2.0, 2.0, 3.0, 7.0].into_iter().map(beside).fold(0.0, f64::max)
    }

    /// Moves the variables on, away from the start, 10 % to 100 times as far again: the objective must never rise and fall on the
    /// whole, beyond rounding; or be level to the last digit as far as one can see, after a way that levels out.
    fn runs_off(&self, variables: &[usize]) -> bool {
        let here = self.point.objective;
        let (mut last, mut blurred) = (here, self.noise(variables, self.point.x, here));
        for factor in ONWARDS {
            match self.onwards(variables, factor) {
                Some((next, noise)) if next <= last + noise + blurred => (last, blurred) = (next.min(last), noise),
                _ => return false,
            }
        }
        let level = 64.0 * f64::EPSILON * here.abs();
        here - last > level + blurred || (self.stays_level(variables, here + level) && self.has_levelled_out(variables))
    }

    fn stays_level(&self, variables: &[usize], most: f64) -> bool {
        FAR_ON.into_iter().map_while(|factor| self.onwards(variables, factor)).all(|(value, noise)| value <= most + noise)
    }

    /// Whether the Lagrangian, going back to the start, never falls and rises in the end, nearly all of it far back: a function
    /// that is level and not piecewise is level throughout, so this one nears an asymptote.
    fn has_levelled_out(&self, variables: &[usize]) -> bool {
        let (point, multipliers) = (self.point, self.active.multipliers);
        let value = |factor: f64| {
            let x = self.place(variables, factor);
            Trial::at(point, &x).map(|trial| (trial.lagrangian(point, multipliers), trial.rounding(point, multipliers)))
        };
        let Some((here, level)) = value(0.0) else { return false };
        let Some((half, _)) = value(-0.5) else { return false };
        let (mut last, mut remaining) = (half, 0.1);
        for _ in 0..BEYOND.log10() as i32 {
            let Some((next, rounding)) = value(remaining - 1.0) else { break };
            if next < last - rounding.max(level) {
                return false;
            }
            last = last.max(next);
            remaining *= 0.1;
        }
        last - here > level && half - here <= ASYMPTOTE * (last - here)
    }
}
