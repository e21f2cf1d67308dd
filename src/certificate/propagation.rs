//! What the linear rows say of one another and of the box: bounds tightened row by row until one row cannot be met (feasibility-based bound
//! tightening). A contradiction found so is a theorem, wherever solvers end.

use super::known_sizes::known_sizes;
use super::linear_rows::{self, Line};
use super::parallel_rows;
use super::point::Origin;
use super::row_range::{End, range};
use crate::certificate::parameters::infeasibility::{EASE, SWEEPS};
use crate::model::Model;

/// A row that no point of the box meets once the other linear rows have tightened it, or that contradicts one it is a multiple of, by more than
/// the tolerance; `None` where that is not found.
pub fn impossible_row(model: &dyn Model, tolerance: f64) -> Option<usize> {
    let meta = model.meta();
    let (lines, jacobian) = linear_rows::of(model)?;
    let sizes = || known_sizes(&Origin::new(model), &meta.start, &jacobian);
    if let Some(row) = parallel_rows::contradiction(&lines, sizes, EASE * tolerance) {
        return Some(row);
    }
    let ease = |bound: f64, sign: f64| bound + sign * EASE * tolerance * bound.abs();
    let mut lower: Vec<f64> = meta.lower.iter().map(|&bound| ease(bound, -1.0)).collect();
    let mut upper: Vec<f64> = meta.upper.iter().map(|&bound| ease(bound, 1.0)).collect();
    for _ in 0..SWEEPS {
        let mut changed = false;
        for (i, line) in lines.iter().enumerate() {
            let Some(line) = line else { continue };
            match tighten(line, &mut lower, &mut upper, EASE * tolerance) {
                Tightened::Impossible => return Some(i),
                Tightened::Yes => changed = true,
                Tightened::No => {}
            }
        }
        if !changed {
            break;
        }
    }
    None
}

enum Tightened {
    Yes,
    No,
    Impossible,
}

fn tighten(line: &Line, lower: &mut [f64], upper: &mut [f64], ease: f64) -> Tightened {
    let (mut least, mut most) = (End::default(), End::default());
    for &(j, a) in &line.entries {
        let (low, high) = range(a, lower[j], upper[j]);
        least.add(low);
        most.add(high);
    }
    let slack = |end: End, limit: f64| ease * (limit.abs() + end.magnitude + line.fixed);
    let at_most = line.upper + slack(least, line.upper);
    let at_least = line.lower - slack(most, line.lower);
    if (least.open == 0 && least.sum > at_most) || (most.open == 0 && most.sum < at_least) {
        return Tightened::Impossible;
    }
    let mut changed = false;
    for &(j, a) in &line.entries {
        let (low, high) = range(a, lower[j], upper[j]);
        let up = least.without(low).map(|rest| (at_most - rest) / a).filter(|end| end.is_finite());
        let down = most.without(high).map(|rest| (at_least - rest) / a).filter(|end| end.is_finite());
        let (new_lower, new_upper) = if a > 0.0 { (down, up) } else { (up, down) };
        // Tiny gains would go on for ever.
        let worth = |gain: f64, size: f64| gain > 1e-3 * size;
        if let Some(end) = new_upper.filter(|&end| upper[j] == f64::INFINITY || worth(upper[j] - end, upper[j].abs())) {
            (upper[j], changed) = (end, true);
        }
        if let Some(end) = new_lower.filter(|&end| lower[j] == f64::NEG_INFINITY || worth(end - lower[j], lower[j].abs())) {
            (lower[j], changed) = (end, true);
        }
        if changed {
            // The sums have changed: the next sweep goes on.
            return Tightened::Yes;
        }
    }
    Tightened::No
}

#[cfg(test)]
mod tests {
    use super::*;

    const INF: f64 = f64::INFINITY;

    fn line(entries: &[(usize, f64)], lower: f64, upper: f64) -> Line {
        Line { entries: entries.to_vec(), lower, upper, fixed: 0.0 }
    }

    #[test]
    fn a_chain_of_rows_runs_out_of_room() {
        let lines = [line(&[(0, 1.0), (1, 1.0)], 3e-3, 3e-3), line(&[(0, 1.0)], 3.01e-3, INF)];
        let (mut lower, mut upper) = (vec![0.0, 0.0], vec![1.0, INF]);
        assert!(matches!(tighten(&lines[0], &mut lower, &mut upper, 4e-8), Tightened::Yes));
        assert!(upper[0] <= 3.001e-3, "{upper:?}");
        assert!(matches!(tighten(&lines[1], &mut lower, &mut upper, 4e-8), Tightened::Impossible));
    }

    #[test]
    fn what_is_within_the_tolerance_stands() {
        let (mut lower, mut upper) = (vec![0.0], vec![1.0]);
        let row = line(&[(0, 2.0)], 2.0 * (1.0 + 1e-8), INF);
        assert!(!matches!(tighten(&row, &mut lower, &mut upper, 4e-8), Tightened::Impossible));
        let open = line(&[(0, 2.0)], 5.0, INF);
        assert!(!matches!(tighten(&open, &mut [0.0], &mut [INF], 4e-8), Tightened::Impossible));
    }
}
