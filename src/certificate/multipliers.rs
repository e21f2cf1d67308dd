//! Multipliers of the right sign that make the Lagrangian as stationary as the point allows.

use rayon::prelude::*;

use super::candidates::{self, Candidate, Owner};
use super::least_squares::{self, Column};
use super::point::Point;
use crate::model::components::Partition;

/// Groups of rows a thread takes at a time, at the least.
const BATCH: usize = 64;

/// Row multipliers y and bound multipliers z, in the user's units.
pub(super) struct Multipliers {
    pub(super) rows: Vec<f64>,
    pub(super) bounds: Vec<f64>,
}

/// Minimises ‖D(∇f + Jᵀy + z)/σ‖² plus the squared complementarity terms. A `guess` only says which limits to try first.
///
/// Rows that share no variable with others are solved for by themselves, side by side: the work grows with their number alone.
pub(super) fn find(point: &Point<'_>, guess: Option<&[f64]>) -> Multipliers {
    let meta = point.meta();
    let mut rows = vec![0.0; meta.rows()];
    let near = if point.sigma > 0.0 { candidates::near_rows(point) } else { Vec::new() };
    let patterns = near.iter().map(|&i| meta.jacobian.row(i));
    // Rows with a slope have variables, so there always is a partition.
    if let Some(partition) = Partition::new(meta.variables(), patterns, std::iter::empty()) {
        let solved: Vec<Vec<(usize, f64)>> = (0..partition.len())
            .into_par_iter()
            .with_min_len(BATCH)
            .filter(|&group| !partition.rows(group).is_empty())
            .map(|group| System::new(point, guess, &partition, group, &near).row_multipliers())
            .collect();
        for (i, y) in solved.into_iter().flatten() {
            rows[i] += y;
        }
    }
    let bounds = bound_multipliers(point, &point.row_gradient(&rows));
    Multipliers { rows, bounds }
}

/// The best z for a given ∇f + Jᵀy, variable by variable: −q/(1 + t²) where a bound of the right side is near.
fn bound_multipliers(point: &Point<'_>, rest: &[f64]) -> Vec<f64> {
    let one = |j: usize| {
        let wanted = -rest[j];
        let fits = |c: &Candidate| c.sign * wanted > 0.0 || (c.sign == 0.0 && wanted != 0.0);
        candidates::bounds(point, j)
            .find(fits)
            .map_or(0.0, |c| if c.sign == 0.0 { wanted } else { wanted / (1.0 + c.distance * c.distance) })
    };
    (0..rest.len()).map(one).collect()
}

struct System<'a> {
    candidates: Vec<Candidate>,
    gradient: Vec<f64>,
    columns: Vec<Column>,
    point: &'a Point<'a>,
}

impl<'a> System<'a> {
    /// One group of the rows within reach, and the bounds of the variables they touch; other variables need no solving.
    fn new(point: &'a Point<'a>, guess: Option<&[f64]>, partition: &Partition, group: usize, near: &[usize]) -> Self {
        let (variables, rows) = (partition.variables(group), partition.rows(group));
        let mut candidates: Vec<Candidate> = rows.iter().flat_map(|&k| candidates::row(point, near[k as usize])).collect();
        variables.iter().for_each(|&j| candidates.extend(candidates::bounds(point, j as usize)));
        let gradient = variables.iter().map(|&j| point.gradient[j as usize] * point.sizes[j as usize] / point.sigma).collect();
        let mut system = System { candidates, gradient, columns: Vec::new(), point };
        system.columns = system.candidates.iter().map(|candidate| system.column(candidate, partition, guess)).collect();
        system
    }

    /// Row by row what its multiplier gains.
    fn row_multipliers(&mut self) -> Vec<(usize, f64)> {
        let (scaled, point) = (self.solve().unwrap_or_default(), self.point);
        let gain = |(candidate, value): (&Candidate, f64)| match candidate.owner {
            Owner::Row(i) => Some((i, value * point.sigma / point.slopes[i])),
            Owner::Bound(_) => None,
        };
        self.candidates.iter().zip(scaled).filter_map(gain).collect()
    }

    fn column(&self, candidate: &Candidate, partition: &Partition, guess: Option<&[f64]>) -> Column {
        let (entries, basic) = match candidate.owner {
            Owner::Bound(j) => (vec![(partition.place(j as u32), 1.0)], true),
            Owner::Row(i) => {
                let pattern = &self.point.meta().jacobian;
                let scaled = |at: usize| {
                    let j = pattern.columns[at] as usize;
                    (partition.place(j as u32), self.point.jacobian[at] * self.point.sizes[j] / self.point.slopes[i])
                };
                let hinted = guess.and_then(|guess| guess.get(i)).is_none_or(|y| y * candidate.sign > 0.0);
                (pattern.range(i).map(scaled).filter(|entry| entry.1 != 0.0).collect(), hinted)
            }
        };
        let weight = if candidate.sign == 0.0 { 0.0 } else { candidate.distance };
        Column { entries, sign: candidate.sign, weight, basic }
    }

    fn solve(&mut self) -> Result<Vec<f64>, crate::linear_algebra::FactorizationError> {
        if self.columns.is_empty() { Ok(Vec::new()) } else { least_squares::solve(&self.gradient, &self.columns) }
    }
}
