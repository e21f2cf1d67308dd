//! A front between two objectives: the first is minimised under limits on the second, which are chosen round by round where the tangents
//! known so far disagree most.

use super::layout::{Front, LIMIT};
use super::{Point, Row};
use crate::input::Additions;
use crate::model::Class;

/// The points that minimise one objective each.
const ENDS: usize = 2;

/// Limits chosen at once: as many may be worked on side by side. The same on every machine, for the limits must not depend on it.
const BATCH: usize = 4;

/// Where a new limit lies in its interval at the least, a share of it: a tangent's crossing next to an end would teach little.
const INSIDE: f64 = 0.1;

/// What an interval's width counts beside the disagreement of its tangents: where they agree everywhere, points are spread evenly.
const WIDTH: f64 = 1e-3;

impl Front {
    /// What one point of the front makes of the problem.
    pub(super) fn additions(&self, point: &Point) -> Additions {
        let objective = &self.objectives[usize::from(point.number == 1)];
        let limit = point.values.first().copied().flatten();
        let rows = limit.map(|limit| (LIMIT.to_owned(), format!("({}) <= {limit:?}", self.objectives[1])));
        Additions { minimize: Some(objective.clone()), rows: rows.into_iter().collect(), ..Additions::default() }
    }

    /// The points that follow from what is known; none at the end.
    pub(super) fn next(&self, rows: &[Row]) -> Vec<Point> {
        let point = |number: usize, limit: Option<f64>| Point { number, values: vec![limit] };
        if rows.is_empty() {
            return (0..ENDS).map(|number| point(number, None)).collect();
        }
        let left = self.points.saturating_sub(rows.len());
        let limits = self.limits(rows, left.min(BATCH));
        limits.into_iter().enumerate().map(|(at, limit)| point(rows.len() + at, Some(limit))).collect()
    }

    /// New limits, at most so many.
    fn limits(&self, rows: &[Row], most: usize) -> Vec<f64> {
        let known = tangents(rows);
        let [Some(first), Some(last)] = [known.first(), known.last()] else { return Vec::new() };
        let ranges = [last.at[0] - first.at[0], first.at[1] - last.at[1]].map(f64::abs);
        if ranges.contains(&0.0) {
            return Vec::new();
        }
        if rows.len() == ENDS {
            let share = |at: usize| first.at[0] + ranges[0] * at as f64 / (most + 1) as f64;
            return (1..=most).map(share).collect();
        }
        let failed: Vec<f64> = rows.iter().filter(|row| !row.is_certified()).filter_map(|row| row.varied[0]).collect();
        let mut intervals: Vec<(f64, f64)> = known
            .windows(2)
            .filter(|pair| !failed.iter().any(|limit| (pair[0].at[0]..=pair[1].at[0]).contains(limit)))
            .map(|pair| (doubt(&pair[0], &pair[1], ranges), between(&pair[0], &pair[1])))
            .collect();
        intervals.sort_by(|a, b| b.0.total_cmp(&a.0));
        intervals.into_iter().take(most).map(|(_, limit)| limit).collect()
    }
}

/// A certified point of a front and the slope there.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Tangent {
    /// The second objective, and the first.
    pub at: [f64; 2],
    /// d(first)/d(limit on the second); `None` at the end where the second is least.
    pub slope: Option<f64>,
    /// What the first objective is never below under that limit, where that is proved.
    pub bound: Option<f64>,
}

impl Tangent {
    /// The tangent's value at another limit.
    fn value(&self, limit: f64) -> Option<f64> {
        Some(self.at[1] + self.slope? * (limit - self.at[0]))
    }
}

/// The certified points of a front, by the second objective.
pub fn tangents(rows: &[Row]) -> Vec<Tangent> {
    let of = |row: &Row| {
        let (first, second) = (row.quantities.first().copied().flatten()?, row.quantities.get(1).copied().flatten()?);
        let slope = match (row.point, row.varied.first().copied().flatten()) {
            (0, _) => Some(0.0),
            (_, Some(_)) => row.sensitivities.first().copied().flatten(),
            _ => None,
        };
        let bound = if row.point == 1 { None } else { row.lower_bound };
        Some(Tangent { at: [second, first], slope, bound })
    };
    let mut list: Vec<Tangent> = rows.iter().filter(|row| row.is_certified()).filter_map(of).collect();
    list.sort_by(|a, b| a.at[0].total_cmp(&b.at[0]).then(a.at[1].total_cmp(&b.at[1])));
    list.dedup_by_key(|tangent| tangent.at[0]);
    list
}

/// How far the chord of two neighbours is from what their tangents allow, in shares of both ranges.
fn doubt(left: &Tangent, right: &Tangent, ranges: [f64; 2]) -> f64 {
    let limit = crossing(left, right);
    let share = (limit - left.at[0]) / (right.at[0] - left.at[0]);
    let chord = left.at[1] + share * (right.at[1] - left.at[1]);
    let below = [left, right].into_iter().filter_map(|tangent| tangent.value(limit)).fold(right.at[1], f64::max);
    let width = (right.at[0] - left.at[0]) / ranges[0];
    ((chord - below).abs() / ranges[1]).max(WIDTH * width)
}

/// Where the tangents of two neighbours cross; the middle where they do not.
fn crossing(left: &Tangent, right: &Tangent) -> f64 {
    let middle = (left.at[0] + right.at[0]) / 2.0;
    let (Some(a), Some(b)) = (left.slope, right.slope) else { return middle };
    let limit = (right.at[1] - left.at[1] + a * left.at[0] - b * right.at[0]) / (a - b);
    if (left.at[0]..=right.at[0]).contains(&limit) { limit } else { middle }
}

/// The new limit between two neighbours.
fn between(left: &Tangent, right: &Tangent) -> f64 {
    let margin = INSIDE * (right.at[0] - left.at[0]);
    crossing(left, right).clamp(left.at[0] + margin, right.at[0] - margin)
}

/// What the first objective is never below under a limit on the second: the highest of the tangents, whose multipliers prove them where the
/// least value is a convex function of the limit (of a geometric program: its logarithm of the limit's; Boyd and Vandenberghe 2004, section 5.6).
/// `None` where nothing is proved.
pub fn lower_bound(tangents: &[Tangent], class: Class, limit: f64) -> Option<f64> {
    let of = |tangent: &Tangent| {
        let (bound, slope) = (tangent.bound?, tangent.slope?);
        match class {
            Class::Linear | Class::Convex => Some(bound + slope * (limit - tangent.at[0])),
            Class::GeometricProgram => Some(bound * (limit / tangent.at[0]).powf(slope * tangent.at[0] / tangent.at[1])),
            Class::Nonlinear => None,
        }
    };
    tangents.iter().filter_map(of).reduce(f64::max)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(point: usize, [first, second]: [f64; 2], slope: Option<f64>) -> Row {
        Row {
            point,
            varied: vec![(point > 1).then_some(second)],
            exit: Some(0),
            quantities: vec![Some(first), Some(second)],
            sensitivities: vec![slope],
            lower_bound: Some(first),
            ..Row::default()
        }
    }

    fn front() -> Front {
        Front { objectives: ["a".into(), "b".into()], points: 10 }
    }

    /// The front first = 1/second, between ½ and 2.
    fn hyperbola(point: usize, second: f64) -> Row {
        row(point, [1.0 / second, second], Some(-1.0 / (second * second)))
    }

    #[test]
    fn the_ends_come_first_and_then_limits_between_them() {
        assert_eq!(front().next(&[]).len(), 2);
        let ends = [hyperbola(0, 2.0), hyperbola(1, 0.5)];
        let limits: Vec<f64> = front().next(&ends).iter().map(|point| point.values[0].unwrap()).collect();
        assert_eq!(limits.len(), 4);
        assert!(limits.iter().all(|limit| (0.5..2.0).contains(limit)));
        assert_eq!(front().next(&ends)[0].number, 2);
    }

    #[test]
    fn new_limits_lie_where_the_chord_is_farthest_from_the_tangents() {
        let rows = [hyperbola(0, 2.0), hyperbola(1, 0.5), hyperbola(2, 1.9), hyperbola(3, 1.8)];
        let next = front().next(&rows);
        assert!((0.5..1.8).contains(&next[0].values[0].unwrap()), "{next:?}");
    }

    #[test]
    fn no_point_of_a_convex_front_is_below_its_bound() {
        let rows = [hyperbola(0, 2.0), hyperbola(1, 0.5), hyperbola(2, 1.2), hyperbola(3, 0.8)];
        for step in 0..=30 {
            let limit = 0.5 + 1.5 * f64::from(step) / 30.0;
            let known = tangents(&rows);
            for class in [Class::Convex, Class::GeometricProgram] {
                assert!(lower_bound(&known, class, limit).unwrap() <= 1.0 / limit + 1e-12);
            }
            assert_eq!(lower_bound(&known, Class::Nonlinear, limit), None);
        }
        // In logarithms this front is straight: its bound is the front.
        assert!((lower_bound(&tangents(&rows), Class::GeometricProgram, 1.0).unwrap() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn a_front_that_is_one_point_ends() {
        let rows = [row(0, [1.0, 1.0], Some(0.0)), row(1, [1.0, 1.0], None)];
        assert!(front().next(&rows).is_empty());
    }

    #[test]
    fn what_failed_is_not_tried_again() {
        let failed = Row { exit: Some(1), varied: vec![Some(1.0)], point: 2, ..Row::default() };
        assert!(front().next(&[hyperbola(0, 2.0), hyperbola(1, 0.5), failed]).is_empty());
    }
}
