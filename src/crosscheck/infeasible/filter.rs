//! The deletion filter of Chinneck and Dravnieks (1991) over rows and bounds, begun from those with multipliers at the elastic
//! minimum.

use super::Work;
use super::relaxed::{Asked, Relaxed};
use crate::model::WithBounds;

/// Limits tried at the most.
const TRIED: usize = 60;

/// A row, or a bound (variable, upper side).
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Member {
    Row(usize),
    Bound(usize, bool),
}

impl Member {
    pub(super) fn row(self) -> Option<usize> {
        if let Member::Row(row) = self { Some(row) } else { None }
    }

    pub(super) fn bound(self) -> Option<(usize, bool)> {
        if let Member::Bound(variable, upper) = self { Some((variable, upper)) } else { None }
    }
}

/// A small set of limits that conflicts.
pub(super) struct Core {
    pub(super) members: Vec<Member>,
    /// Nothing else is needed for the conflict, and every deletion was decided.
    pub(super) complete: bool,
}

/// Leaves away each limit in turn, and for good where the others conflict without it. Bounds outside the set are lifted, so that
/// the conflict is the set's alone; where that cannot be decided they stay, and the set is not complete.
pub(super) fn filter(work: &Work<'_>, best: &Relaxed) -> Core {
    let members = work.members(best);
    let first = members.clone();
    let lifted = Trial { work, start: &best.x, first: &first, only_members: true };
    let trial = match lifted.conflicts(&members) {
        Some(_) => lifted,
        None => Trial { only_members: false, ..lifted },
    };
    let (mut members, mut kept, mut complete) = (members, Vec::new(), trial.only_members);
    while let Some(&next) = members.iter().find(|member| !kept.contains(*member)) {
        if work.is_over() || kept.len() >= TRIED {
            return Core { members, complete: false };
        }
        let fewer: Vec<Member> = members.iter().copied().filter(|&member| member != next).collect();
        match trial.decide(&fewer) {
            Decision::Conflict(carriers) => {
                // What carries no multiplier in the smaller problem can go with it.
                members = fewer.into_iter().filter(|member| kept.contains(member) || carriers.contains(member)).collect();
            }
            Decision::Compatible => kept.push(next),
            Decision::Open => {
                complete = false;
                kept.push(next);
            }
        }
    }
    Core { members, complete }
}

enum Decision {
    /// These conflict; the members with multipliers.
    Conflict(Vec<Member>),
    Compatible,
    Open,
}

#[derive(Clone, Copy)]
struct Trial<'t, 'a> {
    work: &'t Work<'a>,
    start: &'t [f64],
    /// The members to begin with.
    first: &'t [Member],
    /// Bounds that never were members are lifted too.
    only_members: bool,
}

impl Trial<'_, '_> {
    fn conflicts(&self, members: &[Member]) -> Option<Vec<Member>> {
        if let Decision::Conflict(carriers) = self.decide(members) { Some(carriers) } else { None }
    }

    fn decide(&self, members: &[Member]) -> Decision {
        let rows: Vec<usize> = members.iter().filter_map(|member| member.row()).collect();
        if rows.is_empty() {
            // Bounds alone are compatible: the reader has seen to that.
            return Decision::Compatible;
        }
        let meta = self.work.model.meta();
        let keeps = |j: usize, upper: bool| {
            let bound = Member::Bound(j, upper);
            members.contains(&bound) || !(self.only_members || self.first.contains(&bound))
        };
        let lower = (0..meta.variables()).map(|j| if keeps(j, false) { meta.lower[j] } else { f64::NEG_INFINITY });
        let upper = (0..meta.variables()).map(|j| if keeps(j, true) { meta.upper[j] } else { f64::INFINITY });
        let model = WithBounds::new(self.work.model, lower.collect(), upper.collect());
        match self.work.relax_model(&model, &rows, self.start, Asked::WhetherAny).filter(|relaxed| relaxed.certificate.certified)
        {
            Some(relaxed) if relaxed.violation > self.work.least() => Decision::Conflict(self.work.members(&relaxed)),
            Some(_) => Decision::Compatible,
            None => Decision::Open,
        }
    }
}
