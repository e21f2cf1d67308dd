//! Bent ways to infinity and ways to the domain's edge, which no straight ray shows.

use super::{Fall, Ray, classify, size};
use crate::crosscheck::session::Session;

/// Decades of a curve, and of the way towards an edge.
const DECADES: i32 = 9;
const EDGE_DECADES: i32 = 14;
/// A variable that has changed by less than this factor has no power.
const CHANGED: f64 = 10.0;

/// The power curve x_j·g^p_j through a far point, p_j from how far each variable has come from its own size: outwards, or, where
/// the point is as far from the start as numbers go, along the last decades before it. A minimum that is not attained because x·y ≥ 1 leads
/// away, or a fall along y = x², lies on such a curve.
pub(super) fn power_curve(session: &Session<'_>, x: &[f64]) -> Option<Ray> {
    let meta = session.task.model.meta();
    let magnitude = |j: usize| (x[j].abs() / size(meta.start[j])).ln();
    let powers: Vec<f64> =
        (0..x.len()).map(|j| if x[j] != 0.0 && magnitude(j).abs() > CHANGED.ln() { magnitude(j) } else { 0.0 }).collect();
    let largest = powers.iter().fold(0.0, |most: f64, power| most.max(*power));
    if largest < (1e3f64).ln() {
        return None;
    }
    let place = |decade: i32| -> Vec<f64> {
        x.iter().zip(&powers).map(|(x, power)| x * 10f64.powf(f64::from(decade) * power / largest)).collect()
    };
    let fall = [0, -DECADES].into_iter().find_map(|first| classify(&falls(session, (first..=first + DECADES).map(place))))?;
    let growing = |j: usize| if powers[j] > 0.0 { powers[j] / largest * x[j] } else { 0.0 };
    let longest = (0..x.len()).map(growing).fold(0.0, |most: f64, v| most.max(v.abs()));
    let direction = (0..x.len()).map(|j| growing(j) / longest).collect();
    Some(Ray { fall, direction, from: x.to_vec() })
}

/// Falls towards a place where the model has no value, no slower the nearer it comes: log(x) or −1/x at 0. The way is that from
/// the start to the point found, lengthened until the values end.
pub(super) fn towards_edge(session: &Session<'_>, x: &[f64]) -> Option<Ray> {
    let start = session.task.start;
    let at = |share: f64| -> Vec<f64> { start.iter().zip(x).map(|(s, x)| s + share * (x - s)).collect() };
    let meta = session.task.model.meta();
    let has_value = |share: f64| {
        let x = at(share);
        let inside = x.iter().zip(meta.lower.iter().zip(&meta.upper)).all(|(x, (lower, upper))| x >= lower && x <= upper);
        inside && super::feasible_value(session, &x).is_some()
    };
    let (mut inside, mut outside) = (1.0, 1.0 + 1e-3);
    if x == start || has_value(outside) {
        return None;
    }
    for _ in 0..60 {
        let middle = 0.5 * (inside + outside);
        if has_value(middle) { inside = middle } else { outside = middle }
    }
    let way = (0..EDGE_DECADES).map(|decade| at(inside * (1.0 - 10f64.powi(-decade))));
    match classify(&falls(session, way))? {
        Fall::Endless => {
            let direction = start.iter().zip(x).map(|(s, x)| if x == s { 0.0 } else { x - s }).collect();
            Some(Ray { fall: Fall::Endless, direction, from: x.to_vec() })
        }
        // What settles towards an edge may just as well be attained there.
        Fall::Settling => None,
    }
}

/// By how much the objective falls from point to point, up to the first that is not feasible or has no value.
fn falls(session: &Session<'_>, points: impl Iterator<Item = Vec<f64>>) -> Vec<f64> {
    let values: Vec<f64> = points.map_while(|x| super::feasible_value(session, &x)).collect();
    values.windows(2).map(|pair| pair[0] - pair[1]).collect()
}
