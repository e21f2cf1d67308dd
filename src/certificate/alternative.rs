//! Multipliers that contradict the linear rows, sought without a solver: Gale's theorem of the alternative as a least-squares problem with signs
//! (D. Gale, *The Theory of Linear Economic Models*, 1960, theorem 2.7; C. L. Lawson and R. J. Hanson, *Solving Least Squares Problems*, 1974,
//! chapter 23).
//!
//! Either some x meets lower ≤ A·x ≤ upper, or some y with the signs of the limits has Aᵀy = 0 and yᵀ(A·x₀ − limit) = 1: the least
//! |Aᵀy|² + (yᵀ(A·x₀ − limit) − 1)² is 0 exactly then. In rows over their slopes and variables over what is known of their sizes it is the same
//! problem in all units, wherever solvers run off to.

use std::time::Instant;

use super::farkas::{Contradiction, contradiction};
use super::known_sizes::known_sizes;
use super::linear_rows::{self, Line};
use super::parameters::infeasibility::LARGEST;
use super::point::Origin;
use crate::linear_algebra::signed_least_squares::{self, Column};
use crate::model::Model;

/// A limit as a column: entries, sign, and the row it is of; bounds have none.
struct Limit {
    entries: Vec<(u32, f64)>,
    sign: f64,
    row: Option<(usize, f64)>,
}

impl Limit {
    fn column(&self) -> Column<'_> {
        Column { entries: &self.entries, sign: self.sign, weight: 0.0, basic: false }
    }
}

/// Multipliers that prove that no point of the box meets the linear rows, by more than `tolerance`; `None` where none are found.
pub fn contradicting(model: &dyn Model, tolerance: f64, until: Option<Instant>) -> Option<Contradiction> {
    let meta = model.meta();
    let (lines, jacobian) = linear_rows::of(model)?;
    if lines.len() + meta.variables() > LARGEST {
        return None;
    }
    let sizes = known_sizes(&Origin::new(model), &meta.start, &jacobian);
    let mut limits = Vec::new();
    for (i, line) in lines.iter().enumerate() {
        if let Some(line) = line {
            row(line, i, &meta.start, &sizes, &mut limits);
        }
    }
    let last = meta.variables() as u32;
    for (j, size) in sizes.iter().enumerate().filter(|&(j, _)| !meta.is_fixed(j)) {
        for (bound, sign) in [(meta.upper[j], 1.0), (meta.lower[j], -1.0)] {
            if bound.is_finite() {
                limits.push(Limit { entries: vec![(j as u32, 1.0), (last, (meta.start[j] - bound) / size)], sign, row: None });
            }
        }
    }
    let mut wanted = vec![0.0; meta.variables() + 1];
    wanted[last as usize] = -1.0;
    let columns: Vec<Column<'_>> = limits.iter().map(Limit::column).collect();
    let found = signed_least_squares::solve(&wanted, &columns, until).ok()?;
    let mut multipliers = vec![0.0; meta.rows()];
    for (limit, y) in limits.iter().zip(found) {
        if let Some((row, slope)) = limit.row {
            multipliers[row] += y / slope;
        }
    }
    contradiction(model, &meta.start, &multipliers, false, tolerance).ok()?
}

/// The limits of a row.
fn row(line: &Line, i: usize, start: &[f64], sizes: &[f64], limits: &mut Vec<Limit>) {
    let slope = line.entries.iter().map(|&(j, a)| (a * sizes[j]).abs()).fold(0.0, f64::max);
    if slope == 0.0 || !slope.is_finite() {
        return;
    }
    let value: f64 = line.entries.iter().map(|&(j, a)| a * start[j]).sum();
    let mut push = |limit: f64, sign: f64| {
        let own = line.entries.iter().map(|&(j, a)| (j as u32, a * sizes[j] / slope));
        let entries = own.chain([(start.len() as u32, (value - limit) / slope)]).collect();
        limits.push(Limit { entries, sign, row: Some((i, slope)) });
    };
    // An equality's limits differ by what rounding makes of its constant.
    let is_equality = line.upper - line.lower <= f64::EPSILON.sqrt() * slope;
    match (is_equality, line.lower.is_finite(), line.upper.is_finite()) {
        (true, ..) => push(0.5 * (line.lower + line.upper), 0.0),
        (false, lower, upper) => {
            if upper {
                push(line.upper, 1.0);
            }
            if lower {
                push(line.lower, -1.0);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::sample::Sample;

    #[test]
    fn cycles_contradict_themselves_in_any_units() {
        let infinite = f64::INFINITY;
        for units in [[1.0, 1.0, 1.0], [1e9, 1e12, 1e3], [1e-9, 1e6, 1e-3]] {
            let mut model = Sample::new(&[0.0; 3], |x| x[0]).bounds(&[-infinite; 3], &[infinite; 3]);
            for i in 0..3 {
                let (one, other) = (units[i], units[(i + 1) % 3]);
                model = model.row(-infinite, -1.0, move |x| x[i] * one - x[(i + 1) % 3] * other);
            }
            let found = contradicting(&model.linear(), 1e-8, None).expect("contradiction");
            let [a, b, c] = [found.multipliers[0], found.multipliers[1], found.multipliers[2]];
            assert!(a > 0.0 && (b / a - 1.0).abs() < 1e-9 && (c / a - 1.0).abs() < 1e-9, "{:?}", found.multipliers);
        }
    }

    #[test]
    fn bounds_take_part_and_what_can_be_met_is_not_contradicted() {
        let infinite = f64::INFINITY;
        let sum = |limit: f64| {
            let model = Sample::new(&[1.0, 1.0], |x| x[0]).bounds(&[0.0, 0.0], &[infinite, 2.0]);
            model.row(limit, limit, |x| x[0] + x[1]).row(-infinite, 3.0, |x| x[0]).linear()
        };
        assert!(contradicting(&sum(5.0), 1e-8, None).is_none());
        assert!(contradicting(&sum(5.1), 1e-8, None).is_some());
        assert!(contradicting(&sum(-0.1), 1e-8, None).is_some());
    }
}
