//! The second-order test of a model that falls apart: each piece by itself, on small dense matrices, side by side.

use rayon::prelude::*;

use super::small_kkt;
use super::system::{Active, Choice, Hessian, ROUNDING};
use super::{Curvature, judge as judge_choice};
use crate::certificate::point::Point;
use crate::linear_algebra::saddle_point::SaddlePoint;
use crate::linear_algebra::{FactorizationError, Partition};
use crate::model::Meta;

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
    matrices: SaddlePoint,
}

impl Piece {
    fn examine(&mut self, point: &Point<'_>, hessian: &Hessian) -> Found {
        let (choice, matrices) = (&self.choice, &mut self.matrices);
        small_kkt::fill(matrices, point, hessian, &choice.free, &choice.held);
        let dependent = matrices.has_dependent_rows();
        let singular = matrices.bends_down(-ROUNDING);
        // What bends up beyond rounding does not bend down.
        let mut bends_down = singular && matrices.bends_down(ROUNDING);
        if !bends_down && !dependent {
            bends_down = self.bends_down_inwards(point, hessian);
        }
        Found { dependent, singular, bends_down }
    }

    /// The same with one weakly active limit let go.
    fn bends_down_inwards(&mut self, point: &Point<'_>, hessian: &Hessian) -> bool {
        let (Choice { free, held, weak_bounds, weak_rows }, matrices) = (&self.choice, &mut self.matrices);
        let mut bends_down = |free: &[usize], held: &[usize]| {
            small_kkt::fill(matrices, point, hessian, free, held);
            matrices.bends_down(ROUNDING)
        };
        let by_bound = weak_bounds.iter().filter(|&&j| hessian.size[j] > 0.0).any(|&j| {
            let mut more = free.clone();
            more.insert(more.partition_point(|&k| k < j), j);
            bends_down(&more, held)
        });
        by_bound
            || weak_rows.iter().any(|&i| {
                let fewer: Vec<usize> = held.iter().copied().filter(|&k| k != i).collect();
                bends_down(free, &fewer)
            })
    }
}
