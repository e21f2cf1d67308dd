//! No feasible point was found: the elastic phase, what proves that there is none, which limits conflict, and which single moves
//! are enough.

mod explanation;
mod filter;
mod moves;
mod relaxed;

use std::cell::RefCell;

use super::Conflict;
use super::diverging;
use super::ledger::Ledger;
use super::seeds::Seeds;
use super::session::{Session, Solver};
use super::work::{self, Allowance};
use crate::certificate::{Certifier, contradicting, contradiction, sizes_at_start};
use crate::model::{Elastic, Model, Substitution, WithBounds};
use relaxed::{Asked, Relaxed, carriers, nothing_violated, sized};

/// Further starts of the elastic phase where violations may have local minima.
const STARTS: usize = 16;

/// What the elastic phase found.
pub(super) enum Elasticity {
    /// A feasible point, in the user's variables.
    Feasible(Vec<f64>),
    /// The least violation, stationary.
    Infeasible { x: Vec<f64>, conflict: Conflict, proof: Proof },
    /// A point of little violation, not proved least, or one where some limit has no value.
    Unproved(Vec<f64>),
}

/// What a least violation proves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Proof {
    /// No point nearby meets the limits.
    Nearby,
    /// None at all does: the class makes the minimum the least, as far as its certificate's tolerances tell. A point that meets the
    /// limits tells more.
    Least,
    /// The rows contradict one another, whatever a point far away seems to tell.
    Contradiction,
}

impl Proof {
    /// Whether it speaks of all points.
    pub(super) fn is_global(self) -> bool {
        self != Proof::Nearby
    }
}

/// Minimises the violation: of the linear rows alone, whose contradiction would be a proof, then of all rows, from the point given
/// and, unless the class makes one start enough, from seeded ones.
pub(super) fn examine(ledger: &Ledger<'_, '_>, near: &[f64]) -> Option<Elasticity> {
    look(ledger, near, false)
}

/// The same where linear rows are known to contradict one another.
pub(super) fn explain(ledger: &Ledger<'_, '_>, near: &[f64]) -> Option<Elasticity> {
    look(ledger, near, true)
}

fn look(ledger: &Ledger<'_, '_>, near: &[f64], known: bool) -> Option<Elasticity> {
    let work = Work::new(ledger);
    let meta = work.model.meta();
    let all: Vec<usize> = (0..meta.rows()).collect();
    if all.is_empty() || work.session.clock.is_over() {
        return None;
    }
    let start = work.inward(near);
    let linear: Vec<usize> = all.iter().copied().filter(|&i| meta.is_row_linear(i)).collect();
    if !work.is_global() && !linear.is_empty() && linear.len() < all.len() {
        let relaxed = work.relax(&linear, &start).map(|relaxed| work.in_own_scales(&linear, relaxed));
        let relaxed = relaxed.filter(|relaxed| known || work.is_contradiction(relaxed));
        if let Some(relaxed) = relaxed {
            return Some(work.infeasible(&relaxed, Proof::Contradiction));
        }
    }
    let best = match work.least_violation(&all, start)? {
        Least::Feasible(z) if known => work.relax(&all, &z)?,
        Least::Feasible(z) => match work.contradiction_nearby(&all, &z) {
            Some(best) => best,
            None => return Some(Elasticity::Feasible(work.outward(&z))),
        },
        Least::Violation(best) => {
            let best = work.in_own_scales(&all, *best);
            if work.is_contradiction(&best) { best } else { work.contradiction_nearby(&all, &best.x).unwrap_or(best) }
        }
    };
    let is_least = best.certificate.certified;
    let proof = match known || work.is_contradiction(&best) {
        true => Proof::Contradiction,
        false if is_least && work.is_global() => Proof::Least,
        false if is_least && work.is_violated(&best) => Proof::Nearby,
        false => return Some(Elasticity::Unproved(work.outward(&best.x))),
    };
    Some(work.infeasible(&best, proof))
}

/// The model backends work on, and what may be spent on it.
struct Work<'a> {
    session: &'a Session<'a>,
    /// The cheapest first.
    solvers: Vec<Solver<'a>>,
    model: &'a dyn Model,
    other: Option<&'a dyn Substitution>,
    allowance: RefCell<Allowance>,
    /// What explains the minimum may spend, each of its phases.
    explanation: f64,
}

/// Where the elastic phase ended.
enum Least {
    Feasible(Vec<f64>),
    Violation(Box<Relaxed>),
}

impl<'a> Work<'a> {
    fn new(ledger: &Ledger<'a, '_>) -> Self {
        let session = ledger.session;
        // Helper solves are many: the cheapest backend first, whatever the order of the others.
        let mut solvers = ledger.solvers.to_vec();
        solvers.sort_by(|&a, &b| session.cost(a).total_cmp(&session.cost(b)));
        let cost = solvers.iter().map(|&solver| session.cost(solver)).fold(f64::INFINITY, f64::min);
        let first = ledger.least_first_work();
        let allowance = RefCell::new(Allowance::new(work::elastic_phase(first, cost)));
        // States and their equations are sparse: who takes them decides.
        let takes_states = |solver: &&Solver<'_>| solver.backend.takes_states();
        let decides = solvers.iter().find(takes_states).or(solvers.first());
        let other = decides.and_then(|solver| session.task.substitution_for(solver.backend));
        let model = other.map_or(session.task.model, |other| other.model());
        Work { session, solvers, model, other, allowance, explanation: work::explanation(first, cost) }
    }

    /// Whether the class makes every stationary point of the elastic problem its least.
    fn is_global(&self) -> bool {
        self.session.task.class.is_global()
    }

    fn inward(&self, x: &[f64]) -> Vec<f64> {
        self.other.map_or_else(|| x.to_vec(), |other| other.inward(x))
    }

    fn outward(&self, z: &[f64]) -> Vec<f64> {
        let mut x = self.other.map_or_else(|| z.to_vec(), |other| other.outward(z));
        self.session.task.model.meta().clamp(&mut x);
        x
    }

    fn is_feasible(&self, z: &[f64]) -> bool {
        let worst = self.session.judge.primal_infeasibility(&self.outward(z));
        worst.is_some_and(|worst| worst <= self.session.tolerances.constraint)
    }

    /// Whether the user's limits have a value at an elastic minimum and are not met there. A point without a value says nothing of them.
    fn is_violated(&self, relaxed: &Relaxed) -> bool {
        let worst = self.session.judge.primal_infeasibility(&self.outward(&relaxed.x));
        relaxed.violation > self.least() && worst.is_some_and(|worst| worst > self.session.tolerances.constraint)
    }

    /// Whether a point meets the rows of an elastic model, which it is judged by.
    fn meets(&self, judge: &Certifier<'_>, x: &[f64]) -> bool {
        judge.primal_infeasibility(x).is_some_and(|worst| worst <= self.session.tolerances.constraint)
    }

    /// Begins a phase with work of its own.
    fn refill(&self) {
        *self.allowance.borrow_mut() = Allowance::new(self.explanation);
    }

    fn is_over(&self) -> bool {
        self.session.clock.is_over() || self.allowance.borrow().is_spent()
    }

    /// Solves a helper model with what is left of the phase's work.
    fn solve(&self, solver: Solver<'_>, model: &dyn Model, start: &[f64]) -> crate::backends::Solution {
        let left = self.allowance.borrow().single();
        let budget = self.session.budget(solver, model, left);
        let solution = self.session.solve_aside(solver, model, start, budget);
        self.allowance.borrow_mut().spend(solution.evaluations as f64 * solver.backend.work_per_evaluation(model));
        solution
    }

    /// The least violation found from `start` and, where violations may have local minima, from seeded points, by the cheapest
    /// backend; where it proves nothing, by the others from there.
    fn least_violation(&self, rows: &[usize], start: Vec<f64>) -> Option<Least> {
        let mut best = None::<Relaxed>;
        let mut seeds = Seeds::new(2);
        let more = if self.is_global() { 0 } else { STARTS };
        let (&cheapest, others) = self.solvers.split_first()?;
        let first = start.clone();
        let starts = std::iter::once(start).chain((0..more).map(|_| seeds.point(self.model.meta())));
        for start in starts {
            if self.session.clock.is_over() || (best.is_some() && self.is_over()) {
                break;
            }
            let Some(relaxed) = self.relax_by(cheapest, self.model, rows, &start, Asked::Multipliers) else { continue };
            if self.is_feasible(&relaxed.x) {
                return Some(Least::Feasible(relaxed.x));
            }
            if best.as_ref().is_none_or(|best| relaxed.is_better(best)) {
                best = Some(relaxed);
            }
        }
        for &solver in others {
            if self.session.clock.is_over() || best.as_ref().is_some_and(|best| best.certificate.certified) {
                break;
            }
            self.refill();
            let near = best.as_ref().map_or_else(|| first.clone(), |best| best.x.clone());
            let Some(relaxed) = self.relax_by(solver, self.model, rows, &near, Asked::Multipliers) else { continue };
            if self.is_feasible(&relaxed.x) {
                return Some(Least::Feasible(relaxed.x));
            }
            if best.as_ref().is_none_or(|best| relaxed.is_better(best)) {
                best = Some(relaxed);
            }
        }
        best.map(|best| Least::Violation(Box::new(best)))
    }

    /// The elastic minimum over these rows by the first backend that proves it, else the lowest.
    fn relax(&self, rows: &[usize], start: &[f64]) -> Option<Relaxed> {
        self.relax_model(self.model, rows, start, Asked::Multipliers)
    }

    /// The same with the bounds of `model`.
    fn relax_model(&self, model: &dyn Model, rows: &[usize], start: &[f64], asked: Asked) -> Option<Relaxed> {
        let mut best: Option<Relaxed> = None;
        for &solver in &self.solvers {
            if best.is_some() && self.is_over() {
                break;
            }
            let Some(relaxed) = self.relax_by(solver, model, rows, start, asked) else { continue };
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

    /// Where rows are missed by little, or seem to be met only far from the start: the elastic minimum beside it, if its multipliers, or others that the linear
    /// rows have, prove that nothing meets them anywhere. What rounding leaves of rows so far out is no violation.
    fn contradiction_nearby(&self, rows: &[usize], z: &[f64]) -> Option<Relaxed> {
        let sought = contradicting(self.model, self.session.tolerances.constraint, self.session.clock.judging_ends());
        if sought.is_none() && !diverging::is_too_far(self.session, &self.outward(z)) {
            return None;
        }
        self.refill();
        let sizes = sizes_at_start(self.model)?;
        // A start far from 0 says little of what rows tell: 0 is looked at, too.
        let start = &self.model.meta().start;
        let boxed = WithBounds::about_start(self.model, |j| start[j].abs() + diverging::TOO_FAR * sizes[j]);
        let relaxed = self.relax_model(&boxed, rows, start, Asked::Multipliers)?;
        if self.is_contradiction(&relaxed) {
            return Some(relaxed);
        }
        sought.map(|sought| relaxed.with_multipliers(sought.multipliers))
    }

    /// The elastic minimum over these rows by one backend.
    fn relax_by(&self, solver: Solver<'_>, model: &dyn Model, rows: &[usize], start: &[f64], asked: Asked) -> Option<Relaxed> {
        let elastic = Elastic::new(model, rows.to_vec(), &sized(model, start), start).ok()?;
        let judge = Certifier::new(&elastic, self.session.task.class, self.session.tolerances);
        let solution = self.solve(solver, &elastic, &elastic.meta().start);
        let violation = elastic.violation(&solution.x);
        let certificate = match asked {
            Asked::WhetherAny if violation <= self.least() && self.meets(&judge, &solution.x) => nothing_violated(&elastic),
            _ => judge.certify(&solution.x, solution.multipliers.as_deref()).ok()?,
        };
        let mut multipliers = vec![0.0; self.model.meta().rows()];
        for (k, &y) in certificate.row_multipliers.iter().enumerate() {
            multipliers[elastic.row(k)] = y;
        }
        let carriers = carriers(&elastic, &certificate);
        Some(Relaxed { x: elastic.original(&solution.x).to_vec(), violation, certificate, multipliers, carriers })
    }

    /// The elastic minimum anew, its rows in units of their terms where it lies: those of the start may be far off.
    fn in_own_scales(&self, rows: &[usize], found: Relaxed) -> Relaxed {
        self.refill();
        let again = self.relax(rows, &found.x).filter(|again| again.certificate.certified || !found.certificate.certified);
        again.unwrap_or(found)
    }

    /// Whether the multipliers at an elastic minimum prove that no point meets the rows.
    fn is_contradiction(&self, relaxed: &Relaxed) -> bool {
        let accepted = self.session.tolerances.constraint;
        let found = contradiction(self.model, &relaxed.x, &relaxed.multipliers, self.is_global(), accepted);
        found.is_ok_and(|found| found.is_some())
    }
}
