//! What the tests of this folder work on: the scaled Hessian, the active set, and which variables and rows are looked at.

use crate::certificate::Side;
use crate::certificate::multipliers::Multipliers;
use crate::certificate::parameters::second_order::{FLOOR, NEARLY_FLAT, WEAK};
use crate::certificate::point::Point;
use crate::model::{EvaluationError, Model};

/// The active set at the point.
pub(in crate::certificate) struct Active<'a> {
    pub(in crate::certificate) rows: &'a [Side],
    pub(in crate::certificate) bounds: &'a [Side],
    pub(in crate::certificate) multipliers: &'a Multipliers,
    /// Scaled multipliers up to which a limit is nearly weakly active.
    pub(in crate::certificate) nearly_weak: f64,
}

/// Which variables and rows are looked at; all lists ascend.
#[derive(Default, Clone, PartialEq)]
pub(in crate::certificate) struct Choice {
    /// Free variables.
    pub(in crate::certificate) free: Vec<usize>,
    /// Active rows.
    pub(in crate::certificate) held: Vec<usize>,
    /// Variables on weakly active bounds.
    pub(in crate::certificate) weak_bounds: Vec<usize>,
    /// Weakly active rows, among those held.
    pub(in crate::certificate) weak_rows: Vec<usize>,
    /// Variables on bounds that are nearly weakly active, and such rows.
    nearly_weak_bounds: Vec<usize>,
    nearly_weak_rows: Vec<usize>,
}

impl Choice {
    pub(in crate::certificate) fn all(point: &Point<'_>, active: &Active<'_>) -> Choice {
        let mut choice = Choice::default();
        choice.choose(point, active, None, (0..active.bounds.len(), 0..active.rows.len()));
        choice
    }

    /// The same, with nearly weakly active limits among the weakly active ones.
    pub(in crate::certificate) fn relaxed_all(point: &Point<'_>, active: &Active<'_>, hessian: &Hessian) -> Choice {
        let choice = Choice::noting_nearly_weak(point, active, hessian);
        choice.relaxed().unwrap_or(choice)
    }

    /// The same, with nearly weakly active limits noted.
    pub(super) fn noting_nearly_weak(point: &Point<'_>, active: &Active<'_>, hessian: &Hessian) -> Choice {
        let mut choice = Choice::default();
        choice.choose(point, active, Some(hessian), (0..active.bounds.len(), 0..active.rows.len()));
        choice
    }

    /// Free variables and those on weakly active bounds.
    pub(in crate::certificate) fn loose_variables(&self) -> Vec<usize> {
        merged(&self.free, &self.weak_bounds)
    }

    /// Equalities and active rows that are not weakly active.
    pub(in crate::certificate) fn strict_rows(&self) -> Vec<usize> {
        self.held.iter().copied().filter(|i| self.weak_rows.binary_search(i).is_err()).collect()
    }

    /// Number of weakly active limits.
    pub(in crate::certificate) fn weak(&self) -> usize {
        self.weak_bounds.len() + self.weak_rows.len()
    }

    /// The same with nearly weakly active limits as weakly active ones; `None` where there are no such.
    pub(super) fn relaxed(&self) -> Option<Choice> {
        let more = !self.nearly_weak_bounds.is_empty() || !self.nearly_weak_rows.is_empty();
        more.then(|| Choice {
            weak_bounds: merged(&self.weak_bounds, &self.nearly_weak_bounds),
            weak_rows: merged(&self.weak_rows, &self.nearly_weak_rows),
            free: self.free.clone(),
            held: self.held.clone(),
            ..Choice::default()
        })
    }

    /// The same with weakly active limits as equalities: the null space of all active limits.
    pub(super) fn on_null_space(&self) -> Choice {
        Choice { free: self.free.clone(), held: self.held.clone(), ..Choice::default() }
    }

    fn clear(&mut self) {
        let bounds = [&mut self.free, &mut self.weak_bounds, &mut self.nearly_weak_bounds];
        let rows = [&mut self.held, &mut self.weak_rows, &mut self.nearly_weak_rows];
        bounds.into_iter().chain(rows).for_each(Vec::clear);
    }

    /// Sorts some variables and rows, given ascending; nearly weakly active limits are noted where the curvature is known.
    pub(super) fn choose(
        &mut self,
        point: &Point<'_>,
        active: &Active<'_>,
        hessian: Option<&Hessian>,
        (variables, rows): (impl Iterator<Item = usize>, impl Iterator<Item = usize>),
    ) {
        self.clear();
        let curvature = |j: usize| hessian.map_or(0.0, |hessian| hessian.size[j]);
        for j in variables {
            let share = (active.multipliers.bounds[j] * point.sizes[j]).abs() / point.scale();
            match active.bounds[j] {
                Side::None => self.free.push(j),
                Side::Equal => {}
                _ if share <= WEAK => self.weak_bounds.push(j),
                _ if share <= active.nearly_weak.min(NEARLY_FLAT * curvature(j)) => self.nearly_weak_bounds.push(j),
                _ => {}
            }
        }
        for i in rows.filter(|&i| active.rows[i] != Side::None && point.slopes[i] > 0.0) {
            self.held.push(i);
            let share = (active.multipliers.rows[i] * point.slopes[i]).abs() / point.scale();
            let sharpest = || point.meta().jacobian.row(i).iter().fold(0.0, |most: f64, &j| most.max(curvature(j as usize)));
            match active.rows[i] {
                Side::Equal => {}
                _ if share <= WEAK => self.weak_rows.push(i),
                _ if share <= active.nearly_weak && share <= NEARLY_FLAT * sharpest() => self.nearly_weak_rows.push(i),
                _ => {}
            }
        }
    }
}

fn merged(a: &[usize], b: &[usize]) -> Vec<usize> {
    let mut both = [a, b].concat();
    both.sort_unstable();
    both
}

/// S = D∇²L D/σ along the model's pattern (0 where a variable cannot move), and row by row the sum of the magnitudes it is made of.
pub(in crate::certificate) struct Hessian {
    pub(in crate::certificate) values: Vec<f64>,
    pub(in crate::certificate) size: Vec<f64>,
}

impl Hessian {
    /// The diagonal of S, length n.
    pub(in crate::certificate) fn diagonal(&self, point: &Point<'_>) -> Vec<f64> {
        let mut diagonal = vec![0.0; self.size.len()];
        let entries = point.meta().hessian.iter().zip(&self.values);
        entries.filter(|((row, column), _)| row == column).for_each(|((row, _), value)| diagonal[row] += value);
        diagonal
    }

    pub(in crate::certificate) fn of(point: &Point<'_>, multipliers: &Multipliers) -> Result<Hessian, EvaluationError> {
        let (pattern, y) = (&point.meta().hessian, &multipliers.rows);
        let mut hessian = Hessian { values: vec![0.0; pattern.len()], size: vec![0.0; pattern.rows()] };
        let mut part = vec![0.0; pattern.len()];
        let is_linear = &point.meta().row_is_linear;
        // The objective, rows at their upper and rows at their lower limits.
        for (weight, sign) in [(1.0, 0.0), (0.0, 1.0), (0.0, -1.0)] {
            let chosen: Vec<f64> = y.iter().map(|&y| if y * sign > 0.0 { y } else { 0.0 }).collect();
            // All entries would be zero where no row bends.
            if weight == 0.0 && chosen.iter().zip(is_linear).all(|(&y, &is_linear)| is_linear || y == 0.0) {
                continue;
            }
            point.origin.model.hessian(point.x, weight, &chosen, &mut part)?;
            let meta = point.meta();
            let moves = |&(_, (row, column)): &(usize, (usize, usize))| !meta.is_fixed(row) && !meta.is_fixed(column);
            for (at, (row, column)) in pattern.iter().enumerate().filter(moves) {
                // In this order: the square of a very large size overflows by itself.
                let entry = part[at] * point.sizes[row] / point.scale() * point.sizes[column];
                hessian.values[at] += entry;
                hessian.size[row] += entry.abs();
                if row != column {
                    hessian.size[column] += entry.abs();
                }
            }
        }
        Ok(hessian)
    }

    /// The same as [`Hessian::bend`] for a direction in which no other variables move than these: of one of many components.
    pub(in crate::certificate) fn bend_of(&self, point: &Point<'_>, variables: &[usize], direction: &[f64]) -> f64 {
        let v = |j: usize| direction[j] / point.sizes[j];
        let square: f64 = variables.iter().map(|&j| v(j) * v(j)).sum();
        let pattern = &point.meta().hessian;
        let of_row = |&row: &usize| {
            let term = |at: usize| {
                let column = pattern.columns[at] as usize;
                let product = self.values[at] * v(row) * v(column);
                if row == column { product } else { 2.0 * product }
            };
            pattern.range(row).map(term).sum::<f64>()
        };
        variables.iter().map(of_row).sum::<f64>() / square
    }

    /// vᵀSv/|v|² over relative changes v of the variables, from a direction in the user's.
    pub(in crate::certificate) fn bend(&self, point: &Point<'_>, direction: &[f64]) -> f64 {
        let moving: Vec<usize> = (0..direction.len()).filter(|&j| direction[j] != 0.0).collect();
        self.bend_of(point, &moving, direction)
    }
}

/// The scale of a row of S.
pub(in crate::certificate) fn weight(size: f64) -> f64 {
    size + FLOOR
}

/// Where each variable stands among the free ones; `u32::MAX` for the others.
pub(in crate::certificate) fn places(variables: usize, free: &[usize]) -> Vec<u32> {
    let mut place = vec![u32::MAX; variables];
    for (k, &j) in free.iter().enumerate() {
        place[j] = k as u32;
    }
    place
}
