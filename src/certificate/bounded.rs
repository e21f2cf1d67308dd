//! Variables that bounds and linear rows keep from going on for ever: where they keep all, feasible sets are compact.
//!
//! A way that never rises stays below the objective's value at the point, which is one more row where the objective is linear (slacks that are summed
//! up are bounded by it). A linear row closes the end of a variable that is the only one left to give way in it (propagation). What is open after that is bounded by
//! rows with limits on both sides where these determine it: where R has full column rank, no v but a bounded one leaves R·v bounded.

use super::parameters::bounded::LEAST;
use super::point::Point;
use crate::linear_algebra::entries::Symmetric;
use crate::linear_algebra::saddle_point::DEPENDENT;
use crate::linear_algebra::{Effort, FactorizationError};
use crate::model::Meta;

/// The variables that nothing is known to bound on both sides, ascending.
pub(super) fn open(point: &Point<'_>) -> Vec<usize> {
    let meta = point.meta();
    let mut ends = Ends::of(meta);
    if ends.open().is_empty() {
        return Vec::new();
    }
    let rows = Rows::linear(point);
    ends.propagate(&rows);
    let open = ends.open();
    match are_determined(point, &rows, &open).unwrap_or(false) {
        true => Vec::new(),
        false => open,
    }
}

/// A linear row lower ≤ Σ coefficient·x ≤ upper.
struct Row {
    entries: Vec<(usize, f64)>,
    has_lower: bool,
    has_upper: bool,
}

/// The linear rows, and by variable those it is in, with its coefficients.
struct Rows {
    rows: Vec<Row>,
    of_variable: Vec<Vec<(usize, f64)>>,
}

impl Rows {
    fn linear(point: &Point<'_>) -> Rows {
        let meta = point.meta();
        let row = |i: usize| Row {
            entries: entries(point, i),
            has_lower: meta.row_lower[i].is_finite(),
            has_upper: meta.row_upper[i].is_finite(),
        };
        let gradient = || significant(point.gradient.iter().copied().enumerate());
        let level = meta.objective_is_linear.then(|| Row { entries: gradient(), has_lower: false, has_upper: true });
        let rows: Vec<Row> = (0..meta.rows()).filter(|&i| meta.is_row_linear(i)).map(row).chain(level).collect();
        let mut of_variable = vec![Vec::new(); meta.variables()];
        for (k, row) in rows.iter().enumerate() {
            row.entries.iter().for_each(|&(j, a)| of_variable[j].push((k, a)));
        }
        Rows { rows, of_variable }
    }
}

/// The coefficients of a linear row.
fn entries(point: &Point<'_>, i: usize) -> Vec<(usize, f64)> {
    let jacobian = &point.meta().jacobian;
    significant(jacobian.range(i).map(|at| (jacobian.columns[at] as usize, point.jacobian[at])))
}

/// Coefficients that are more than what rounding may have left of 0.
fn significant(coefficients: impl Iterator<Item = (usize, f64)> + Clone) -> Vec<(usize, f64)> {
    let largest = coefficients.clone().fold(0.0, |most: f64, entry| most.max(entry.1.abs()));
    coefficients.filter(|entry| entry.1.abs() > LEAST * largest).collect()
}

/// Which ends of the variables are known to be finite: [below, above].
struct Ends {
    are_closed: Vec<[bool; 2]>,
}

/// The end of a variable at which a term is as large as it can be, or as small.
fn end(coefficient: f64, largest: bool) -> usize {
    usize::from((coefficient > 0.0) == largest)
}

impl Ends {
    fn of(meta: &Meta) -> Ends {
        let is_bounded = |j: usize| meta.states.is_some_and(|states| states.are_bounded && states.has(j));
        let ends = |j: usize| [meta.lower[j].is_finite() || is_bounded(j), meta.upper[j].is_finite() || is_bounded(j)];
        Ends { are_closed: (0..meta.variables()).map(ends).collect() }
    }

    fn open(&self) -> Vec<usize> {
        (0..self.are_closed.len()).filter(|&j| self.are_closed[j] != [true; 2]).collect()
    }

    /// Closes ends until no row closes another. A row is looked at when so many of its terms are bounded that it may close one: the work grows
    /// with the entries alone.
    fn propagate(&mut self, rows: &Rows) {
        let mut giving: Vec<[usize; 2]> =
            rows.rows.iter().map(|row| [true, false].map(|is_upper| self.giving(row, is_upper).count())).collect();
        let may_close = |counts: &[usize; 2]| counts.iter().any(|&count| count <= 1);
        let mut waiting: Vec<usize> = (0..rows.rows.len()).filter(|&k| may_close(&giving[k])).collect();
        while let Some(k) = waiting.pop() {
            for (j, closed) in self.close(&rows.rows[k], giving[k]) {
                for &(other, a) in &rows.of_variable[j] {
                    // Of the counts, [towards an upper limit, towards a lower one], that which has this end.
                    let count = &mut giving[other][usize::from(end(a, true) == closed)];
                    *count -= 1;
                    if *count <= 1 {
                        waiting.push(other);
                    }
                }
            }
        }
    }

    /// The terms of a sum that may go on for ever away from its limit.
    fn giving<'a>(&'a self, row: &'a Row, is_upper: bool) -> impl Iterator<Item = &'a (usize, f64)> + 'a {
        row.entries.iter().filter(move |&&(j, a)| !self.are_closed[j][end(a, !is_upper)])
    }

    /// Closes what one row does: where a sum has an upper limit and all terms but one a least value, that one has a largest. The variables, and
    /// which end of each.
    fn close(&mut self, row: &Row, giving: [usize; 2]) -> Vec<(usize, usize)> {
        let mut closed = Vec::new();
        for (has_limit, is_upper, count) in [(row.has_upper, true, giving[0]), (row.has_lower, false, giving[1])] {
            if !has_limit || count > 1 {
                continue;
            }
            let only = self.giving(row, is_upper).next().map(|first| first.0);
            for &(j, a) in row.entries.iter().filter(|&&(j, _)| only.is_none_or(|only| only == j)) {
                let side = end(a, is_upper);
                if !std::mem::replace(&mut self.are_closed[j][side], true) {
                    closed.push((j, side));
                }
            }
        }
        closed
    }
}

/// Whether linear rows with limits on both sides determine these variables when all others are known: [I R; Rᵀ εI] has a negative eigenvalue for every
/// singular value of R beyond √ε.
fn are_determined(point: &Point<'_>, rows: &Rows, open: &[usize]) -> Result<bool, FactorizationError> {
    let mut positions = Vec::new();
    let mut values = Vec::new();
    let mut count = 0u32;
    for row in rows.rows.iter().filter(|row| row.has_lower && row.has_upper) {
        let own = row.entries.iter().filter_map(|&(j, a)| open.binary_search(&j).ok().map(|place| (place as u32, a)));
        let own: Vec<(u32, f64)> = own.collect();
        let largest = own.iter().fold(0.0, |most: f64, entry| most.max(entry.1.abs()));
        if largest > 0.0 {
            positions.extend(own.iter().map(|entry| (count, entry.0)));
            values.extend(own.iter().map(|entry| entry.1 / largest));
            count += 1;
        }
    }
    if (count as usize) < open.len() {
        return Ok(false);
    }
    let mut length = vec![0.0f64; open.len()];
    positions.iter().zip(&values).for_each(|(&(_, j), value)| length[j as usize] += value * value);
    let order = count + open.len() as u32;
    let diagonal: Vec<(u32, u32)> = (0..order).map(|at| (at, at)).collect();
    let beside: Vec<(u32, u32)> = positions.iter().map(|&(i, j)| (count + j, i)).collect();
    let mut matrix = Symmetric::new(order as usize, &[diagonal, beside].concat())?;
    let share = |(&(_, j), value): (&(u32, u32), &f64)| value / length[j as usize].sqrt();
    let ones = std::iter::repeat_n(1.0, count as usize).chain(std::iter::repeat_n(DEPENDENT, open.len()));
    point.in_time()?;
    let inertia = matrix.inertia(ones.chain(positions.iter().zip(&values).map(share)), Effort::Any)?;
    Ok(inertia.negative == open.len())
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::certificate::point::Origin;
    use crate::model::Model;
    use crate::model::sample::Sample;

    const OPEN: f64 = f64::INFINITY;

    fn open_of(model: &Sample) -> Vec<usize> {
        let origin = Origin::new(model);
        let x = model.meta().start.clone();
        open(&Point::new(&origin, &x).unwrap())
    }

    #[test]
    fn bounds_close_and_their_lack_does_not() {
        let model = Sample::new(&[0.5, 0.5, 0.5], |x| x[0] + x[1] + x[2]).bounds(&[0.0, 0.0, -OPEN], &[1.0, OPEN, 1.0]);
        assert_eq!(open_of(&model), [1, 2]);
    }

    #[test]
    fn a_row_closes_what_alone_can_give_way_and_so_on_along_a_chain() {
        // |N| ≤ 10·A with A in a box, and M next to N.
        let model = Sample::new(&[1.0, 0.0, 0.0], |x| x[0]).bounds(&[0.1, -OPEN, -OPEN], &[2.0, OPEN, OPEN]);
        let model = model.row(-OPEN, 0.0, |x| x[1] - x[0] * 10.0).row(0.0, OPEN, |x| x[1] + x[0] * 10.0);
        let model = model.row(-1.0, 1.0, |x| x[2] - x[1]).linear();
        assert!(open_of(&model).is_empty());
        // One side alone leaves the other.
        let model = Sample::new(&[1.0, 0.0], |x| x[0]).bounds(&[0.1, -OPEN], &[2.0, OPEN]);
        let model = model.row(-OPEN, 0.0, |x| x[1] - x[0] * 10.0).linear();
        assert_eq!(open_of(&model), [1]);
    }

    #[test]
    fn rows_of_full_rank_determine_what_none_closes_alone() {
        let two = || Sample::new(&[0.0, 0.0], |x| x[0] * x[0] + x[1]);
        assert!(open_of(&two().row(-1.0, 1.0, |x| x[0] + x[1]).row(-1.0, 1.0, |x| x[0] - x[1]).linear()).is_empty());
        // Of rank one; without one of the limits; bent.
        assert_eq!(open_of(&two().row(-1.0, 1.0, |x| x[0] + x[1]).row(-1.0, 1.0, |x| (x[0] + x[1]) * 2.0).linear()), [0, 1]);
        assert_eq!(open_of(&two().row(-1.0, 1.0, |x| x[0] + x[1]).row(-OPEN, 1.0, |x| x[0] - x[1]).linear()), [0, 1]);
        assert_eq!(open_of(&two().row(-1.0, 1.0, |x| x[0] + x[1]).row(-1.0, 1.0, |x| x[0] - x[1])), [0, 1]);
    }

    #[test]
    fn slacks_are_bounded_by_the_sum_that_is_minimised_and_so_are_the_rows_they_give_way_to() {
        // −1 − s ≤ u ≤ 1 + s, s ≥ 0.
        let elastic = |maximised: f64| {
            let mut model = Sample::new(&[0.0, 1.0], move |x| x[1] * maximised).bounds(&[-OPEN, 0.0], &[OPEN, OPEN]);
            model = model.row(-OPEN, 1.0, |x| x[0] - x[1]).row(-1.0, OPEN, |x| x[0] + x[1]).linear();
            model.meta.objective_is_linear = true;
            model
        };
        assert!(open_of(&elastic(1.0)).is_empty());
        assert_eq!(open_of(&elastic(-1.0)), [0, 1]);
    }

    #[test]
    fn what_rounding_leaves_of_a_coefficient_closes_nothing() {
        let model = Sample::new(&[0.0, 0.0], |x| x[0] + x[1]).bounds(&[0.0, 0.0], &[1.0, OPEN]);
        assert_eq!(open_of(&model.row(-1.0, 1.0, |x| x[0] + x[1] * (0.1 + 0.2 - 0.3)).linear()), [1]);
    }
}
