//! What the optimum gains by each varied name: the envelope theorem (Fiacco 1983, ch. 3). Along minima with unchanged active limits
//! dF*/dp = ∂L/∂p at the fixed point and multipliers, L the Lagrangian with the active limits in it.

use std::sync::Arc;

use super::row::finite;
use super::{Point, Study};
use crate::certificate::Side;
use crate::input;
use crate::model::{Model, assemble_any};
use crate::report::Findings;
use crate::run::Subject;

/// A share of the value: the square root of the rounding unit, where the errors of a difference by cutting off (step) and by rounding
/// (unit/step) are equal (Nocedal and Wright 2006, section 8.1): about seven digits are right.
const STEP: f64 = 1.490_116_119_384_765_6e-8;

/// The sensitivity of the reported objective to every varied name; `None` where there is none.
pub(super) fn all(study: &Study, point: &Point, subject: &Subject, findings: &Findings<'_>) -> Vec<Option<f64>> {
    let names = study.names();
    names.iter().enumerate().map(|(axis, name)| of_name(study, point, (axis, name), subject, findings)).collect()
}

fn of_name(study: &Study, point: &Point, (axis, name): (usize, &str), subject: &Subject, findings: &Findings<'_>) -> Option<f64> {
    if study.objectives().is_some() {
        return by_limit(point, findings);
    }
    by_bound(name, findings)
        .or_else(|| by_difference(study, point, (axis, name), subject, findings))
        .and_then(|value| finite(Some(value)))
}

/// Of a front: its limit is the last row.
fn by_limit(point: &Point, findings: &Findings<'_>) -> Option<f64> {
    point.values.first().copied().flatten()?;
    let rows = findings.model.meta().rows();
    finite(Some(findings.row(rows.checked_sub(1)?).sensitivity))
}

/// Where the name is a bound, a start or a variable: the multipliers of its bounds.
fn by_bound(name: &str, findings: &Findings<'_>) -> Option<f64> {
    let parts = [(".lower", Some(Side::Lower)), (".upper", Some(Side::Upper)), (".start", None)];
    let found = parts.into_iter().find_map(|(suffix, side)| Some((name.strip_suffix(suffix)?, side)));
    let (base, wanted, is_fixed) = match found {
        Some((_, None)) => return Some(0.0),
        Some((base, Some(side))) => (base, Some(side), false),
        None => (name, None, true),
    };
    let of_array = format!("{base}[");
    let mine = (0..findings.model.meta().variables()).filter(|&j| {
        let variable = findings.model.variable_name(j);
        variable == base || variable.starts_with(&of_array)
    });
    let held = mine.map(|j| findings.bound(j)).map(|held| match wanted {
        // A fixed variable rests on both of its bounds.
        Some(side) if held.side != side && held.side != Side::Equal => 0.0,
        _ => held.sensitivity,
    });
    let held: Vec<f64> = held.collect();
    (!held.is_empty() && (is_fixed || found.is_some())).then(|| held.iter().sum())
}

/// A difference of the Lagrangian at the fixed point.
fn by_difference(
    study: &Study,
    point: &Point,
    (axis, name): (usize, &str),
    subject: &Subject,
    findings: &Findings<'_>,
) -> Option<f64> {
    let value = match point.values[axis] {
        Some(value) => value,
        None => own_value(study, name)?,
    };
    let size = if value == 0.0 { study.size(axis) } else { value.abs() };
    let mut moved = point.clone();
    let beside = value + STEP * size;
    moved.values[axis] = Some(beside);
    let additions = study.additions(&moved);
    let there = if is_plain(subject) {
        let problem = input::read_with(&study.problem, &additions, &|_| {}).ok()?.problem;
        lagrangian(assemble_any(&Arc::new(problem)).ok()?.model(), findings)
    } else {
        lagrangian(Subject::read_with(&study.problem, &additions, &|_| {}).ok()?.shown(), findings)
    };
    let difference = there? - lagrangian(findings.model, findings)?;
    Some(findings.in_users_sense(difference / (beside - value)))
}

/// Whether the problem as it is read is the one that is shown: it was restated neither for kinks nor for a structure. Then it need not be
/// classified anew, which takes as long as reading it.
fn is_plain(subject: &Subject) -> bool {
    subject.problem().structure.is_none() && subject.model().own().variables == subject.model().meta().variables()
}

/// The number the file itself has, of a parameter.
fn own_value(study: &Study, name: &str) -> Option<f64> {
    super::problem::computed(&study.problem, vec![name.to_owned()]).ok()?.first().copied()
}

/// f + Σ yᵢ·(cᵢ − limit) + Σ zⱼ·(xⱼ − bound) of the minimised form, over what is active in `findings`.
fn lagrangian(model: &dyn Model, findings: &Findings<'_>) -> Option<f64> {
    let (meta, x) = (model.meta(), &findings.outcome.x);
    let certificate = findings.outcome.certificate.as_ref()?;
    if meta.variables() != x.len() || meta.rows() != certificate.row_sides.len() {
        return None;
    }
    let mut rows = vec![0.0; meta.rows()];
    model.constraints(x, &mut rows).ok()?;
    let mut sum = model.objective(x).ok()?;
    for (i, (&side, &multiplier)) in certificate.row_sides.iter().zip(&certificate.row_multipliers).enumerate() {
        sum += multiplier * beyond(side, rows[i], meta.row_lower[i], meta.row_upper[i]);
    }
    for (j, (&side, &multiplier)) in certificate.bound_sides.iter().zip(&certificate.bound_multipliers).enumerate() {
        sum += multiplier * beyond(side, x[j], meta.lower[j], meta.upper[j]);
    }
    Some(sum)
}

/// How far a value is beyond the limit it rests on.
fn beyond(side: Side, value: f64, lower: f64, upper: f64) -> f64 {
    match side {
        Side::None => 0.0,
        Side::Lower | Side::Equal => value - lower,
        Side::Upper => value - upper,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn distances_are_from_the_limit_that_is_met() {
        assert_eq!(beyond(Side::Upper, 3.0, 1.0, 2.0), 1.0);
        assert_eq!(beyond(Side::Lower, 3.0, 1.0, 2.0), 2.0);
        assert_eq!(beyond(Side::Equal, 3.0, 2.0, 2.0), 1.0);
        assert_eq!(beyond(Side::None, 3.0, f64::NEG_INFINITY, f64::INFINITY), 0.0);
    }
}
