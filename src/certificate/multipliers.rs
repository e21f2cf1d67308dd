//! Multipliers of the right sign that make the Lagrangian as stationary as the point allows.

use super::candidates::{self, Candidate, Owner};
use super::least_squares::{self, Column};
use super::point::Point;

/// Row multipliers y and bound multipliers z, in the user's units.
pub(super) struct Multipliers {
    pub(super) rows: Vec<f64>,
    pub(super) bounds: Vec<f64>,
}

/// Minimises ‖D(∇f + Jᵀy + z)/σ‖² plus the squared complementarity terms. A `guess` only says which limits to try first.
pub(super) fn find(point: &Point<'_>, guess: Option<&[f64]>) -> Multipliers {
    let meta = point.meta();
    let mut rows = vec![0.0; meta.rows()];
    if point.sigma > 0.0 {
        let mut system = System::new(point, guess);
        if let Ok(scaled) = system.solve() {
            for (candidate, value) in system.candidates.iter().zip(scaled) {
                if let Owner::Row(i) = candidate.owner {
                    rows[i] += value * point.sigma / point.slopes[i];
                }
            }
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
    /// Rows within reach, and the bounds of the variables they touch; other variables need no solving.
    fn new(point: &'a Point<'a>, guess: Option<&[f64]>) -> Self {
        let meta = point.meta();
        let mut candidates = candidates::rows(point);
        let mut index = vec![u32::MAX; meta.variables()];
        let mut touched = Vec::new();
        for candidate in &candidates {
            let Owner::Row(i) = candidate.owner else { continue };
            for &j in meta.jacobian.row(i) {
                if index[j as usize] == u32::MAX {
                    index[j as usize] = touched.len() as u32;
                    touched.push(j as usize);
                }
            }
        }
        touched.iter().for_each(|&j| candidates.extend(candidates::bounds(point, j)));
        let gradient = touched.iter().map(|&j| point.gradient[j] * point.d[j] / point.sigma).collect();
        let mut system = System { candidates, gradient, columns: Vec::new(), point };
        system.columns = system.candidates.iter().map(|candidate| system.column(candidate, &index, guess)).collect();
        system
    }

    fn column(&self, candidate: &Candidate, index: &[u32], guess: Option<&[f64]>) -> Column {
        let (entries, basic) = match candidate.owner {
            Owner::Bound(j) => (vec![(index[j], 1.0)], true),
            Owner::Row(i) => {
                let pattern = &self.point.meta().jacobian;
                let scaled = |at: usize| {
                    let j = pattern.columns[at] as usize;
                    (index[j], self.point.jacobian[at] * self.point.d[j] / self.point.slopes[i])
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
