//! The way from a start where a term has no value (log of a negative number, 0/0, zero area) into the domain.

use super::{EvaluationError, Model};
use crate::math::split_mix::SplitMix;

/// Distances searched, in units of each variable's size.
const RADII: [f64; 9] = [1e-6, 1e-3, 1e-2, 0.1, 0.3, 1.0, 3.0, 10.0, 100.0];
/// Points tried at each distance at the most.
const TRIES: usize = 96;
/// Values computed in all, in numbers of variables: larger problems try fewer points.
const WORK: usize = 20_000_000;
/// Points tried anywhere between the bounds, where none of these has values.
const SCANNED: usize = 4_000;
/// Decades from the start towards 0.
const DECADES: i32 = 9;
/// Halvings of the way back towards the start.
const HALVINGS: usize = 8;

/// `start` where objective, rows and first derivatives have values there; else a point inside the bounds where they have, not
/// much farther away than needed.
///
/// # Errors
/// The error at `start`, where none is found.
pub fn valid_near(model: &dyn Model, start: &[f64]) -> Result<Vec<f64>, EvaluationError> {
    let first = match values(model, start) {
        Ok(()) => return Ok(start.to_vec()),
        Err(error) => error,
    };
    let tries = TRIES.min(WORK / (start.len() + 1) / RADII.len()).max(2);
    let mut random = SplitMix::new(11);
    // Where units are large a step of 1 is beyond everything: then starts tell the sizes.
    let candidates = [1.0, 0.0]
        .into_iter()
        .flat_map(|least| RADII.into_iter().flat_map(move |radius| (0..tries).map(move |k| (least, radius, k))));
    for (least, radius, k) in candidates {
        let x = moved(model, (start, least), radius, &mut direction(k, &mut random));
        if values(model, &x).is_ok() {
            return Ok(nearer(model, start, x));
        }
    }
    // Where units are small a start may be far outside: then 0, or the bounds nearest to it, tells where the domain may be.
    let nearer_zero =
        (1..=DECADES).map(|decade| towards_zero(model, start, 10f64.powi(-decade))).chain([towards_zero(model, start, 0.0)]);
    if let Some(x) = nearer_zero.into_iter().find(|x| values(model, x).is_ok()) {
        return Ok(nearer(model, start, x));
    }
    let scanned = (0..SCANNED.min(WORK / (start.len() + 1))).map(|k| scattered(model, start, k, &mut random));
    scanned.into_iter().find(|x| values(model, x).is_ok()).map(|x| nearer(model, start, x)).ok_or(first)
}

/// The start times a factor, inside the bounds.
fn towards_zero(model: &dyn Model, start: &[f64], factor: f64) -> Vec<f64> {
    let mut x: Vec<f64> = start.iter().map(|start| start * factor).collect();
    model.meta().clamp(&mut x);
    x
}

/// A point anywhere between the bounds; where they are open, up to a hundred sizes away. Every other one differs from the start in
/// one variable alone.
fn scattered(model: &dyn Model, start: &[f64], k: usize, random: &mut SplitMix) -> Vec<f64> {
    let meta = model.meta();
    let mut one = |j: usize| {
        let reach = 100.0 * start[j].abs().max(1.0);
        let end = |bound: f64, other: f64| if bound.is_finite() { bound } else { other };
        let (lower, upper) = (end(meta.lower[j], start[j] - reach), end(meta.upper[j], start[j] + reach));
        let share = random.uniform();
        // Bounds may be so far apart that their difference overflows.
        lower * (1.0 - share) + upper * share
    };
    if k.is_multiple_of(2) && !start.is_empty() {
        let (j, mut x) = (k / 2 % start.len(), start.to_vec());
        x[j] = one(j);
        return x;
    }
    (0..start.len()).map(one).collect()
}

/// Computes objective, rows and their first derivatives at x.
///
/// # Errors
/// One of them has no value there.
pub fn values(model: &dyn Model, x: &[f64]) -> Result<(), EvaluationError> {
    let meta = model.meta();
    let finite = |all: &[f64]| all.iter().all(|value| value.is_finite());
    let (mut gradient, mut rows, mut jacobian) = (vec![0.0; x.len()], vec![0.0; meta.rows()], vec![0.0; meta.jacobian.len()]);
    let objective = model.gradient(x, &mut gradient)?;
    model.constraints(x, &mut rows)?;
    model.jacobian(x, &mut jacobian)?;
    if objective.is_finite() && finite(&gradient) && finite(&rows) && finite(&jacobian) {
        return Ok(());
    }
    Err(EvaluationError::Invalid { term: "a derivative".into(), cause: "it is no number".into() })
}

/// A place of variable j well inside its bounds; where one is open, off the start by an amount that differs from variable to
/// variable.
pub fn middle(start: f64, lower: f64, upper: f64, j: usize) -> f64 {
    let distance = (1.0 + start.abs()) * (1.0 + 0.1 * (j % 7) as f64);
    match (lower.is_finite(), upper.is_finite()) {
        (true, true) => 0.5 * (lower + upper),
        (true, false) => start.max(lower + distance),
        (false, true) => start.min(upper - distance),
        (false, false) => start + distance,
    }
}

/// The k-th direction: all upwards, all downwards, then single variables and random ones in turn.
fn direction(k: usize, random: &mut SplitMix) -> impl FnMut(usize, usize) -> f64 {
    let mut own = SplitMix::new((random.uniform() * 1e15) as u64);
    move |j, n| match k {
        0 => 1.0,
        1 => -1.0,
        _ if k.is_multiple_of(2) && k / 2 <= 2 * n => {
            let (place, up) = ((k / 2 - 1) / 2, (k / 2) % 2 == 1);
            if j != place {
                0.0
            } else if up {
                1.0
            } else {
                -1.0
            }
        }
        _ => 2.0 * own.uniform() - 1.0,
    }
}

/// The start moved by `radius` along a direction, kept inside the bounds. A variable whose start is not 0 has at least the size
/// `least`, where its bounds leave that much room.
fn moved(
    model: &dyn Model,
    (start, least): (&[f64], f64),
    radius: f64,
    direction: &mut impl FnMut(usize, usize) -> f64,
) -> Vec<f64> {
    let meta = model.meta();
    let one = |(j, &x): (usize, &f64)| {
        let (lower, upper) = (meta.lower[j], meta.upper[j]);
        let room = if (upper - lower).is_finite() { upper - lower } else { f64::INFINITY };
        let size = if x == 0.0 { room.min(1.0) } else { x.abs().max(room.min(least)) };
        (x + radius * size * direction(j, start.len())).max(lower).min(upper)
    };
    start.iter().enumerate().map(one).collect()
}

/// Back towards the start while values exist, and then half of the last way out again: not on the very rim of the domain.
fn nearer(model: &dyn Model, start: &[f64], found: Vec<f64>) -> Vec<f64> {
    let between = |share: f64| start.iter().zip(&found).map(|(s, x)| s + share * (x - s)).collect::<Vec<_>>();
    let (mut outside, mut inside) = (0.0, 1.0);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (outside + inside);
        if values(model, &between(middle)).is_ok() { inside = middle } else { outside = middle }
    }
    let share = 0.5 * (inside + 1.0);
    let x = between(share);
    if values(model, &x).is_ok() { x } else { found }
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use super::*;
    use crate::model::sample::Sample;

    /// Has values where x > y + 2 only.
    fn logarithm(lower: f64, start: [f64; 2], upper: f64) -> Sample {
        Sample::new(&start, |x| (x[0] - x[1] - 2.0).ln()).bounds(&[lower; 2], &[upper; 2])
    }

    #[test]
    fn a_start_outside_the_domain_is_moved_inside_and_one_inside_stays() {
        let model = logarithm(-10.0, [-1.0, 3.0], 10.0);
        let x = valid_near(&model, &[-1.0, 3.0]).unwrap();
        assert!(x[0] > x[1] + 2.0 && x.iter().all(|x| x.abs() <= 10.0), "{x:?}");
        assert_eq!(valid_near(&model, &[5.0, 1.0]).unwrap(), [5.0, 1.0]);
    }

    #[test]
    fn a_start_far_outside_a_domain_about_zero_is_moved_inside() {
        let sphere = Sample::new(&[-400.0, 0.1], |x| -(-(x[0] * 1e3).powi(2) - (x[1] * 1e6).powi(2) + 4.0).sqrt());
        let x = valid_near(&sphere, &[-400.0, 0.1]).unwrap();
        assert!((x[0] * 1e3).hypot(x[1] * 1e6) < 2.0, "{x:?}");
    }

    #[test]
    fn where_no_point_has_values_the_error_of_the_start_is_told() {
        let model = logarithm(0.0, [0.5, 0.5], 1.0);
        assert!(valid_near(&model, &[0.5, 0.5]).is_err());
    }
}
