//! Single limits whose move makes the problem feasible: what an engineer asks for. Each is found by a solve of the problem with
//! that one limit released, and shown by the point it ends at, which is judged anew in the user's model.

use super::Work;
use super::filter::Member;
use super::relaxed::Relaxed;
use crate::certificate::Certifier;
use crate::crosscheck::LimitMove;
use crate::model::{Freed, Limit, Model};

/// Limits tried at the most.
const TRIED: usize = 12;
/// Digits of the limit proposed; rounded away from the conflict.
const DIGITS: i32 = 6;

/// The moves that are enough, the least relative one first; and a point that meets all limits, should one turn up where it is not
/// `proved` that there is none.
pub(super) fn enough(work: &Work<'_>, best: &Relaxed, members: &[Member], proved: bool) -> (Vec<LimitMove>, Option<Vec<f64>>) {
    let mut found = Vec::new();
    for limit in members.iter().take(TRIED).filter_map(|&member| limit(work, best, member)) {
        if work.is_over() {
            break;
        }
        match alone(work, best, limit, proved) {
            Some(Alone::Enough(found_move)) => found.push(found_move),
            Some(Alone::Feasible(x)) => return (found, Some(x)),
            None => {}
        }
    }
    found.sort_by(|a, b| a.relative().total_cmp(&b.relative()));
    (found, None)
}

/// The user's limit behind a member of the conflict.
fn limit(work: &Work<'_>, best: &Relaxed, member: Member) -> Option<Limit> {
    match member {
        Member::Bound(j, upper) => Some(Limit::Bound(j, upper)),
        Member::Row(i) if i < work.session.task.model.meta().rows() => {
            let meta = work.model.meta();
            let known = best.carriers.iter().find(|carrier| carrier.0 == i).map(|carrier| carrier.1);
            Some(Limit::Row(i, known.unwrap_or(meta.row_upper[i].is_finite())))
        }
        Member::Row(_) => None,
    }
}

enum Alone {
    Enough(LimitMove),
    Feasible(Vec<f64>),
}

/// How far this limit has to move while all others stay.
fn alone(work: &Work<'_>, best: &Relaxed, limit: Limit, proved: bool) -> Option<Alone> {
    let (user, class) = (work.session.task.model, work.session.task.class);
    let from = limit.value(user.meta());
    let inner = Freed::new(work.model, limit);
    let outer = Freed::new(user, limit);
    let judge = Certifier::new(&outer, class, work.session.tolerances);
    // The way back from substituted variables ends at the user's bounds: a bound is released in the user's variables.
    let substitution = work.other.filter(|_| matches!(limit, Limit::Row(..)));
    let model: &dyn Model = if substitution.is_some() { &inner } else { &outer };
    let mut start = if substitution.is_some() { best.x.clone() } else { work.outward(&best.x) };
    model.meta().clamp(&mut start);
    work.solvers.iter().find_map(|&solver| {
        let solution = work.solve(solver, model, &start);
        let mut x = substitution.map_or_else(|| solution.x.clone(), |other| other.outward(&solution.x));
        outer.meta().clamp(&mut x);
        let meets = |judge: &Certifier<'_>| {
            judge.primal_infeasibility(&x).is_some_and(|worst| worst <= work.session.tolerances.constraint)
        };
        if !proved && meets(&work.session.judge) {
            return Some(Alone::Feasible(x.clone()));
        }
        let meets_others = meets(&judge);
        let needed = outer.needed(&x).ok().filter(|needed| meets_others && (*needed > from) == limit.is_upper())?;
        let least = class.is_global() && judge.certify(&x, None).is_ok_and(|certificate| certificate.certified);
        Some(Alone::Enough(LimitMove { limit, from, to: rounded(needed, limit.is_upper()), least }))
    })
}

/// To six digits, up or down.
fn rounded(value: f64, up: bool) -> f64 {
    if value == 0.0 || !value.is_finite() {
        return value;
    }
    let digits = DIGITS - 1 - value.abs().log10().floor() as i32;
    // A hair of the value is rounding, no reason for the next digit.
    let hair = if up { -1e-12 } else { 1e-12 } * value.abs();
    let factor = 10f64.powi(digits.abs());
    // The power of ten itself, not its reciprocal, which is rounded.
    let scaled = if digits >= 0 { (value + hair) * factor } else { (value + hair) / factor };
    let whole = if up { scaled.ceil() } else { scaled.floor() };
    let result = if digits >= 0 { whole / factor } else { whole * factor };
    if result.is_finite() { result } else { value }
}

#[cfg(test)]
mod tests {
    use super::rounded;

    #[test]
    fn proposals_are_rounded_away_from_the_conflict() {
        assert_eq!(rounded(178.571_428, true), 178.572);
        assert_eq!(rounded(178.571_428, false), 178.571);
        assert_eq!(rounded(-0.012_345_67, true), -0.012_345_6);
        assert_eq!(rounded(750.0 + 1e-11, true), 750.0);
        assert_eq!(rounded(1_234_567_890.0, true), 1_234_570_000.0);
        assert_eq!(rounded(0.0, true), 0.0);
    }
}
