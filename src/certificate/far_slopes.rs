//! Slopes that are small beside the variables' sizes, and lead far: x − 1e−7·y is nearly stationary at y = 1, and 100 lower at y = 1e9. Of a
//! local minimum that says nothing. A global one is disproved by one feasible point that is lower.

use super::feasibility::worst_violation;
use super::lower_bound::slope_errors;
use super::multipliers::Multipliers;
use super::point::Point;
use super::types::Tolerances;
use crate::certificate::parameters::far_slopes::SHORTER;
use crate::certificate::parameters::higher_order::STRETCH;

/// The way to a feasible point whose objective is lower by more than what is accepted of slopes, (optimality)·σ, down the slopes that are
/// left; as all directions told, [`STRETCH`] times as long.
///
/// What least squares leave of ∇L in the variables' sizes, r_j·d_j, is orthogonal to the gradients of the limits that have multipliers:
/// −r_j·d_j² leads along them.
pub(super) fn way_down(point: &Point<'_>, multipliers: &Multipliers, tolerances: &Tolerances) -> Option<Vec<f64>> {
    let accepted = tolerances.optimality * point.scale();
    let Way { direction, slope, mut length } = downwards(point, multipliers)?;
    // What the tangent promises of a convex objective is the most there is to gain.
    while length * slope > accepted && !point.is_over() {
        let mut x: Vec<f64> = point.x.iter().zip(&direction).map(|(x, v)| x + length * v).collect();
        point.meta().clamp(&mut x);
        if is_lower(point, multipliers, &x, accepted, tolerances.constraint) {
            return Some(x.iter().zip(point.x).map(|(to, from)| STRETCH * (to - from)).collect());
        }
        length *= SHORTER;
    }
    None
}

/// A direction, what its slope promises per length, and after how long the last variable is on its bound.
struct Way {
    direction: Vec<f64>,
    slope: f64,
    length: f64,
}

/// Down every slope that is more than rounding.
fn downwards(point: &Point<'_>, multipliers: &Multipliers) -> Option<Way> {
    let (meta, errors) = (point.meta(), slope_errors(point, &multipliers.rows));
    let mut way = Way { direction: vec![0.0; point.x.len()], slope: 0.0, length: 0.0 };
    for (j, slope) in point.row_gradient(&multipliers.rows).into_iter().enumerate() {
        let (slope, size) = (slope + multipliers.bounds[j], point.plain_sizes()[j]);
        let bound = if slope > 0.0 { meta.lower[j] } else { meta.upper[j] };
        let length = (bound - point.x[j]).abs() / (slope.abs() * size * size);
        if slope.abs() > errors[j] && length > 0.0 && length.is_finite() {
            way.direction[j] = -slope * size * size;
            way.slope += (slope * size).powi(2);
            way.length = way.length.max(length);
        }
    }
    (way.slope > 0.0).then_some(way)
}

/// Whether x is feasible, and lower once what it misses its limits by is paid for.
fn is_lower(point: &Point<'_>, multipliers: &Multipliers, x: &[f64], accepted: f64, tolerance: f64) -> bool {
    let Ok(there) = Point::new(point.origin, x) else { return false };
    let price: f64 = multipliers.rows.iter().enumerate().map(|(i, y)| y.abs() * there.row_excess(i).0.max(0.0)).sum();
    there.objective + price < point.objective - accepted && worst_violation(&there).1 <= tolerance
}

#[cfg(test)]
mod tests {
    use num_dual::DualNum;

    use crate::certificate::{Certificate, Tolerances, certify};
    use crate::model::Class;
    use crate::model::sample::Sample;

    fn judged(model: &Sample, class: Class, x: &[f64]) -> Certificate {
        certify(model, class, x, None, Tolerances::default()).unwrap()
    }

    /// min x + (x − 1)² − 1e-7·y, 1 ≤ x ≤ 2, 0 ≤ y ≤ 1e9, y ≥ 0.5 by a row.
    fn far() -> Sample {
        let model = Sample::new(&[1.0, 1.0], |x| x[0] + (x[0] - 1.0).powi(2) - x[1] * 1e-7);
        model.bounds(&[1.0, 0.0], &[2.0, 1e9]).row(0.5, f64::INFINITY, |x| x[1] * 1.0)
    }

    #[test]
    fn a_small_slope_is_followed_to_where_it_leads() {
        let near = judged(&far(), Class::Convex, &[1.0, 1.0]);
        assert!(near.falls_far_away && !near.certified, "{near:?}");
        assert!((near.escape.unwrap()[1] - 1e10).abs() < 20.0);
        assert!(judged(&far(), Class::Convex, &[1.0, 1e9]).certified);
    }

    #[test]
    fn slopes_lead_along_rows() {
        // y = z, each with half of the slope, their bounds at different distances.
        let model = Sample::new(&[1.0; 3], |x| x[0] + (x[0] - 1.0).powi(2) - x[1] * 1e-7);
        let model = model.bounds(&[1.0, 0.0, 0.0], &[2.0, 1e9, 3e9]).row(0.0, 0.0, |x| x[1] - x[2]);
        let near = judged(&model, Class::Convex, &[1.0; 3]);
        assert!(near.falls_far_away && !near.certified, "{near:?}");
    }

    #[test]
    fn what_is_left_of_a_slope_at_a_minimum_leads_nowhere() {
        // 1e-9 beside the minimum, and the bounds far away.
        let model = Sample::new(&[1.0], |x| (x[0] - 1.0).powi(2)).bound(0, -1e12, 1e12);
        assert!(judged(&model, Class::Convex, &[1.0 + 1e-9]).certified);
    }
}
