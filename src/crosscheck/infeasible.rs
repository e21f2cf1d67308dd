//! No feasible point was found: the elastic phase, and which limits conflict.

mod filter;

use std::time::Instant;

use super::Conflict;
use super::attempt::{Contestant, Referee};
use super::seeds::Seeds;
use crate::certificate::{Certificate, Certifier};
use crate::model::{Elastic, Model};
use filter::Core;

/// Less than this share of a variable's size is rounding.
const NEGLIGIBLE: f64 = 1e-6;
/// Further starts of the elastic phase where violations may have local minima.
const STARTS: usize = 16;
/// Seconds after which no further start is tried.
const STARTS_SECONDS: f64 = 3.0;
/// Seconds for one elastic solve at the most.
const SOLVE_SECONDS: f64 = 60.0;

/// What the elastic phase found.
pub(super) enum Elasticity {
    /// A feasible point, in the user's variables.
    Feasible(Vec<f64>),
    /// The least violation, proved stationary.
    Infeasible { x: Vec<f64>, conflict: Conflict },
    /// A point of little violation, not proved least.
    Unproved(Vec<f64>),
}

/// Minimises the violation of all rows, from the point given and, unless the class makes one start enough, from seeded ones.
pub(super) fn examine(referee: &Referee<'_>, contestants: &[Contestant<'_>], near: &[f64]) -> Option<Elasticity> {
    let work = Work::new(referee, contestants);
    let all: Vec<usize> = (0..work.model.meta().rows()).collect();
    if all.is_empty() {
        return None;
    }
    let mut seeds = Seeds::new(2);
    let more = if referee.task.class.is_global() { 0 } else { STARTS };
    let starts = std::iter::once(work.inward(near)).chain((0..more).map(|_| seeds.point(work.model.meta())));
    let (begun, mut best) = (Instant::now(), None::<Relaxed>);
    for start in starts {
        if referee.clock.is_over() || (best.is_some() && begun.elapsed().as_secs_f64() > STARTS_SECONDS) {
            break;
        }
        let Some(relaxed) = work.relax(&all, &start) else { continue };
        if work.is_feasible(&relaxed.x) {
            return Some(Elasticity::Feasible(work.outward(&relaxed.x)));
        }
        if best.as_ref().is_none_or(|best| relaxed.is_better(best)) {
            best = Some(relaxed);
        }
    }
    let best = best?;
    let x = work.outward(&best.x);
    if !best.certificate.certified {
        return Some(Elasticity::Unproved(x));
    }
    let conflict = work.conflict(&best, &x);
    Some(Elasticity::Infeasible { x, conflict })
}

/// The model backends work on: the substituted one, where there is one (there, geometric programs are convex).
struct Work<'a> {
    referee: &'a Referee<'a>,
    contestants: &'a [Contestant<'a>],
    model: &'a dyn Model,
}

/// An elastic minimum.
struct Relaxed {
    x: Vec<f64>,
    violation: f64,
    certificate: Certificate,
    /// Rows with multipliers: without them the violation could shrink.
    carriers: Vec<usize>,
}

impl Relaxed {
    fn is_better(&self, other: &Relaxed) -> bool {
        (other.certificate.certified, self.violation) < (self.certificate.certified, other.violation)
    }
}

impl<'a> Work<'a> {
    fn new(referee: &'a Referee<'a>, contestants: &'a [Contestant<'a>]) -> Self {
        let task = referee.task;
        Work { referee, contestants, model: task.substitution.map_or(task.model, |other| other.model()) }
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        self.referee.task.substitution.map_or_else(|| x.to_vec(), |other| other.inward(x))
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        self.referee.task.substitution.map_or_else(|| z.to_vec(), |other| other.outward(z))
    }

    fn is_feasible(&self, z: &[f64]) -> bool {
        let worst = self.referee.judge.primal_infeasibility(&self.outward(z));
        worst.is_some_and(|worst| worst <= self.referee.tolerances.constraint)
    }

    /// The elastic minimum over these rows by the first backend that proves it, else the lowest.
    fn relax(&self, rows: &[usize], start: &[f64]) -> Option<Relaxed> {
        self.relax_model(self.model, rows, start)
    }

    /// The same with the bounds of `model`.
    fn relax_model(&self, model: &dyn Model, rows: &[usize], start: &[f64]) -> Option<Relaxed> {
        let elastic = Elastic::new(model, rows.to_vec(), &sized(model, start)).ok()?;
        let judge = Certifier::new(&elastic, self.referee.task.class, self.referee.tolerances);
        let mut best: Option<Relaxed> = None;
        for &contestant in self.contestants {
            let budget = self.referee.clock.share(0.3, SOLVE_SECONDS);
            let solution = self.referee.solve_aside(contestant, &elastic, &elastic.meta().start, budget);
            let Ok(certificate) = judge.certify(&solution.x, solution.multipliers.as_deref()) else { continue };
            let violation = elastic.violation(&solution.x);
            let carriers = carriers(&elastic, &certificate);
            let relaxed = Relaxed { x: elastic.original(&solution.x).to_vec(), violation, certificate, carriers };
            let proved = relaxed.certificate.certified || self.is_feasible(&relaxed.x);
            if best.as_ref().is_none_or(|best| relaxed.is_better(best)) {
                best = Some(relaxed);
            }
            if proved {
                break;
            }
        }
        best
    }

    /// The violated rows, and a small set that conflicts.
    fn conflict(&self, best: &Relaxed, x: &[f64]) -> Conflict {
        let relaxations = self.violations(x);
        let Core { members, complete } = filter::filter(self, best);
        // Rows beyond the user's own belong to the substitution.
        let own = self.referee.task.model.meta().rows();
        let rows = members.iter().filter_map(|member| member.row()).filter(|&row| row < own).collect();
        let bounds = members.iter().filter_map(|member| member.bound()).collect();
        let minimal = complete && self.referee.task.class.is_global();
        Conflict { violated_rows: relaxations.clone(), rows, bounds, relaxations, minimal }
    }

    /// Violation in all below which a set of rows counts as compatible.
    fn least(&self) -> f64 {
        self.referee.tolerances.constraint
    }

    /// Bounds that push against the violation at an elastic minimum: (variable, upper side).
    fn bounds(&self, relaxed: &Relaxed) -> Vec<(usize, bool)> {
        let certificate = &relaxed.certificate;
        let weight = |j: usize| certificate.bound_multipliers[j] * certificate.variable_scales[j];
        (0..relaxed.x.len()).filter(|&j| weight(j).abs() > 1e-6 * certificate.sigma).map(|j| (j, weight(j) > 0.0)).collect()
    }

    /// Rows of the user's model not met at x, with the amount their limit would have to move.
    fn violations(&self, x: &[f64]) -> Vec<(usize, f64)> {
        let Ok(judged) = self.referee.judge.certify(x, None) else { return Vec::new() };
        let meta = self.referee.task.model.meta();
        let amount = |i: usize| {
            let value = judged.row_values[i];
            if value > meta.row_upper[i] { value - meta.row_upper[i] } else { (value - meta.row_lower[i]).min(0.0) }
        };
        let mut jacobian = vec![0.0; meta.jacobian.len()];
        if self.referee.task.model.jacobian(x, &mut jacobian).is_err() {
            return Vec::new();
        }
        let slope = |at: usize| (jacobian[at] * judged.variable_scales[meta.jacobian.columns[at] as usize]).abs();
        let scale =
            |i: usize| meta.jacobian.range(i).map(slope).fold(meta.row_upper[i].abs().min(meta.row_lower[i].abs()), f64::max);
        let slack = |i: usize| 1e-9 * scale(i);
        (0..meta.rows()).map(|i| (i, amount(i))).filter(|&(i, amount)| amount.abs() > slack(i)).collect()
    }
}

/// `x` where variables that are zero but for rounding stand at the model's start: what rounding has left of them would be taken
/// for their size.
fn sized(model: &dyn Model, x: &[f64]) -> Vec<f64> {
    let size = |start: f64| if start == 0.0 { 1.0 } else { start.abs() };
    x.iter().zip(&model.meta().start).map(|(&x, &start)| if x.abs() < NEGLIGIBLE * size(start) { start } else { x }).collect()
}

/// Multipliers of the elastic problem lie between −1/S and 1/S; noise is far below.
fn carriers(elastic: &Elastic<'_>, certificate: &Certificate) -> Vec<usize> {
    let y = certificate.row_multipliers.iter().enumerate();
    y.filter(|&(k, y)| (y * elastic.scale(k)).abs() > 1e-6).map(|(k, _)| elastic.row(k)).collect()
}
