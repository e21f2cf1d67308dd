//! The second-order test of a model that falls apart: each piece by itself, on small dense matrices, side by side.

use rayon::prelude::*;

use super::curvature::{Active, Choice, Curvature, Hessian, ROUNDING, judge as judge_choice};
use super::kkt::{DEPENDENT, DUAL, weight};
use super::point::Point;
use crate::linear_algebra::bunch_kaufman::{self, Pivot};
use crate::linear_algebra::{FactorizationError, Inertia};
use crate::model::Meta;
use crate::model::components::Partition;

/// Models of fewer variables are left in one piece.
const FEWEST_VARIABLES: usize = 200;
/// Pieces of more variables or rows than this are no work for dense matrices.
const LARGEST: usize = 64;
/// Pieces a thread takes at a time, at the least.
const BATCH: usize = 128;

/// The pieces, where the patterns make many small ones.
pub(super) fn apart(meta: &Meta) -> Option<Partition> {
    if meta.variables() < FEWEST_VARIABLES {
        return None;
    }
    let partition = Partition::of_patterns(&meta.jacobian, &meta.hessian)?;
    let small = (0..partition.len()).all(|k| partition.variables(k).len().max(partition.rows(k).len()) <= LARGEST);
    small.then_some(partition)
}

/// The whole test.
pub(super) fn judge(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    partition: &Partition,
) -> Result<Curvature, FactorizationError> {
    let examine = |piece: &mut Piece, k: usize| {
        choose(&mut piece.choice, point, active, partition, k);
        (k, piece.examine(point, hessian))
    };
    let noted: Vec<(usize, Found)> = (0..partition.len())
        .into_par_iter()
        .with_min_len(BATCH)
        .map_init(Piece::default, examine)
        .filter(|(_, found)| *found != Found::default())
        .collect();
    let mut curvature = Curvature::default();
    for (k, found) in noted {
        curvature.dependent |= found.dependent;
        curvature.singular |= found.singular;
        if found.bends_down && curvature.escape.is_none() {
            let mut choice = Choice::default();
            choose(&mut choice, point, active, partition, k);
            curvature.escape = judge_choice(point, active, hessian, &choice)?.escape;
        }
    }
    curvature.singular |= curvature.escape.is_some();
    Ok(curvature)
}

fn choose(choice: &mut Choice, point: &Point<'_>, active: &Active<'_>, partition: &Partition, k: usize) {
    let (variables, rows) = (partition.variables(k).iter(), partition.rows(k).iter());
    choice.choose(point, active, variables.map(|&j| j as usize), rows.map(|&i| i as usize));
}

/// What one piece's matrices say.
#[derive(Default, PartialEq)]
struct Found {
    dependent: bool,
    singular: bool,
    bends_down: bool,
}

/// A thread's room.
#[derive(Default)]
struct Piece {
    choice: Choice,
    matrix: Vec<f64>,
    pivots: Vec<Pivot>,
}

impl Piece {
    fn examine(&mut self, point: &Point<'_>, hessian: &Hessian) -> Found {
        let (free, held) = (self.choice.free.clone(), self.choice.held.clone());
        let dependent = self.dependent(point, &free, &held);
        let mut bends_down = self.bends_down(point, hessian, ROUNDING, &free, &held);
        if !bends_down && !dependent {
            bends_down = self.bends_down_inwards(point, hessian, &free, &held);
        }
        Found { dependent, singular: self.bends_down(point, hessian, -ROUNDING, &free, &held), bends_down }
    }

    /// The same with one weakly active limit let go.
    fn bends_down_inwards(&mut self, point: &Point<'_>, hessian: &Hessian, free: &[usize], held: &[usize]) -> bool {
        let (bounds, rows) = (std::mem::take(&mut self.choice.weak_bounds), std::mem::take(&mut self.choice.weak_rows));
        let by_bound = bounds.iter().filter(|&&j| hessian.size[j] > 0.0).any(|&j| {
            let mut more = free.to_vec();
            more.insert(more.partition_point(|&k| k < j), j);
            self.bends_down(point, hessian, ROUNDING, &more, held)
        });
        let by_row = rows.iter().any(|&i| {
            let fewer: Vec<usize> = held.iter().copied().filter(|&k| k != i).collect();
            self.bends_down(point, hessian, ROUNDING, free, &fewer)
        });
        (self.choice.weak_bounds, self.choice.weak_rows) = (bounds, rows);
        by_bound || by_row
    }

    /// As [`Kkt::dependent_rows`](super::kkt::Kkt::dependent_rows).
    fn dependent(&mut self, point: &Point<'_>, free: &[usize], held: &[usize]) -> bool {
        if held.is_empty() || held.len() > free.len() {
            return !held.is_empty();
        }
        self.begin(free.len() + held.len());
        self.add_rows(point, free, held);
        self.inertia(|at| if at < free.len() { 1.0 } else { DEPENDENT }).negative < held.len()
    }

    /// As [`Kkt::bends_down`](super::kkt::Kkt::bends_down).
    fn bends_down(&mut self, point: &Point<'_>, hessian: &Hessian, shift: f64, free: &[usize], held: &[usize]) -> bool {
        let (order, pattern) = (free.len() + held.len(), &point.meta().hessian);
        self.begin(order);
        self.add_rows(point, free, held);
        for (row, &i) in free.iter().enumerate() {
            for at in pattern.range(i) {
                if let Ok(column) = free.binary_search(&(pattern.columns[at] as usize)) {
                    self.matrix[row * order + column] += hessian.values[at];
                }
            }
        }
        let diagonal = |at: usize| free.get(at).map_or(-DUAL, |&j| shift * weight(hessian.size[j]));
        self.inertia(diagonal).negative > held.len()
    }

    fn begin(&mut self, order: usize) {
        self.matrix.clear();
        self.matrix.resize(order * order, 0.0);
        self.pivots.clear();
        self.pivots.resize(order, Pivot::default());
    }

    /// The active rows over the free variables, each divided by its slope.
    fn add_rows(&mut self, point: &Point<'_>, free: &[usize], held: &[usize]) {
        let (order, pattern) = (self.pivots.len(), &point.meta().jacobian);
        for (k, &i) in held.iter().enumerate() {
            let slope = point.slope_in_sizes(i);
            for at in pattern.range(i) {
                let j = pattern.columns[at] as usize;
                if let Ok(column) = free.binary_search(&j) {
                    self.matrix[(free.len() + k) * order + column] = point.jacobian[at] * point.sizes[j] / slope;
                }
            }
        }
    }

    fn inertia(&mut self, diagonal: impl Fn(usize) -> f64) -> Inertia {
        let order = self.pivots.len();
        for at in 0..order {
            self.matrix[at * order + at] += diagonal(at);
        }
        bunch_kaufman::factor(&mut self.matrix, &mut self.pivots)
    }
}
