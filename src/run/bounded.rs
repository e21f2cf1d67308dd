//! A bound below every design of a truss, beside a minimum that is only known to be a local one.

use std::sync::atomic::AtomicBool;

use super::remaining::Remaining;
use super::unobserved::{by_interior_point, unobserved};
use super::{Subject, matrix_bound};
use crate::certificate::Extent;
use crate::crosscheck::{Outcome, Status, Task};
use crate::model::relaxation::relaxation;

/// A minimum no further above the bound than this, relative, is the global one: what backends may differ by and still agree.
const AGREEMENT: f64 = 1e-6;

/// Puts the bound beside a certified minimum, and says so where it reaches it; proves a contradiction where even free forces cannot meet the limits.
pub(super) fn bound_below(subject: &Subject, outcome: &mut Outcome, remaining: &Remaining, interrupt: Option<&AtomicBool>) {
    if outcome.scope == Extent::Global || !matches!(outcome.status, Status::Certified | Status::Infeasible) {
        return;
    }
    let by_modes = || matrix_bound::relaxed(subject, (&outcome.x, outcome.objective?), AGREEMENT, remaining, interrupt);
    let Some(relaxed) = by_modes().or_else(|| relaxed(subject, remaining, interrupt)) else { return };
    match outcome.status {
        Status::Infeasible if (relaxed.status, relaxed.scope) == (Status::Infeasible, Extent::Global) => {
            outcome.scope = Extent::Global;
            outcome.message += " No forces that are in equilibrium with the loads meet the limits: this is proved.";
        }
        Status::Certified => above(outcome, &relaxed),
        _ => {}
    }
}

/// The bound in numbers where it is rigorous; where the relaxed minimum is the global one, as convex ones are, it is as good to compare with.
fn above(outcome: &mut Outcome, relaxed: &Outcome) {
    let Some(objective) = outcome.objective else { return };
    outcome.lower_bound = relaxed.lower_bound.map(|bound| bound.min(objective));
    let is_global = relaxed.status == Status::Certified && relaxed.scope == Extent::Global;
    let least = if is_global { relaxed.objective } else { relaxed.lower_bound };
    if least.is_some_and(|least| objective - least <= AGREEMENT * objective.abs().max(least.abs())) {
        outcome.scope = Extent::Global;
        outcome.message +=
            " No design of this layout is below it: a convex problem whose minimum lies below every design needs as much.";
        outcome.remedy = None;
        outcome.better_point_elsewhere = false;
    }
}

/// A rigorous bound below every design of a truss, whatever its sizes; `None` where there is none.
pub(super) fn below_every_design(subject: &Subject, remaining: &Remaining, interrupt: Option<&AtomicBool>) -> Option<f64> {
    relaxed(subject, remaining, interrupt)?.lower_bound
}

/// The run with free forces; `None` where it would say nothing of the structure, or no time is left.
fn relaxed(subject: &Subject, remaining: &Remaining, interrupt: Option<&AtomicBool>) -> Option<Outcome> {
    remaining.settings(&subject.settings)?;
    let relaxed = relaxation(subject.problem()).ok()??;
    let model = relaxed.model.model();
    let settings = remaining.settings(&subject.settings)?;
    let task = Task {
        model,
        substitution: relaxed.substitution.as_deref().map(|other| other as _),
        class: relaxed.class,
        settings: &settings,
        start: &model.meta().start,
        start_multipliers: None,
        starts: 1,
        interrupt,
    };
    Some(unobserved(&task, &[by_interior_point()]))
}
