//! What the optimum gains by each varied name: the envelope theorem (Fiacco 1983, ch. 3). Along minima with unchanged active limits
//! dF*/dp = ∂L/∂p at the fixed point and multipliers, L the Lagrangian with the active limits in it.

use super::row::finite;
use super::{Point, Study};
use crate::certificate::Side;
use crate::model::Model;
use crate::report::Findings;
use crate::run::Subject;

/// A share of the value: the cube root of the rounding unit, where the errors of a central difference by cutting off (step²) and by rounding
/// (unit/step) are equal (Nocedal and Wright 2006, section 8.1).
const STEP: f64 = 6.055_454_452_393_343e-6;

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

/// A central difference of the Lagrangian at the fixed point.
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
    let (below, above) = (value - STEP * size, value + STEP * size);
    let at = |value: f64| {
        let mut moved = point.clone();
        moved.values[axis] = Some(value);
        let other = Subject::read_with(&study.problem, &study.additions(&moved), &|_| {}).ok()?;
        let alike = other.shown().meta().variables() == subject.shown().meta().variables()
            && other.shown().meta().rows() == subject.shown().meta().rows();
        if alike { lagrangian(other.shown(), findings) } else { None }
    };
    let difference = at(above)? - at(below)?;
    Some(findings.in_users_sense(difference / (above - below)))
}

/// The number the file itself has, of a parameter.
fn own_value(study: &Study, name: &str) -> Option<f64> {
    super::problem::computed(&study.problem, vec![name.to_owned()]).ok()?.first().copied()
}

/// f + Σ yᵢ·(cᵢ − limit) + Σ zⱼ·(xⱼ − bound) of the minimised form, over what is active in `findings`.
fn lagrangian(model: &dyn Model, findings: &Findings<'_>) -> Option<f64> {
    let (meta, x) = (model.meta(), &findings.outcome.x);
    let certificate = findings.outcome.certificate.as_ref()?;
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
