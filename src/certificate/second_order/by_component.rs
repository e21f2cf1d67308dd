//! The second-order test of a model that decomposes: each component by itself, on small dense matrices, side by side.

use rayon::prelude::*;

use super::cone::Build;
use super::small_kkt;
use super::system::{Active, Choice, Hessian};
use super::weak_limits::{self, OnCone};
use super::whole::{self, Curvature};
use crate::certificate::parameters::second_order::ROUNDING;
use crate::certificate::point::Point;
use crate::linear_algebra::saddle_point::SaddlePoint;
use crate::linear_algebra::{FactorizationError, Partition};
use crate::model::Meta;
use crate::model::components::{BATCH, FEWEST_VARIABLES, SMALL};

/// The pieces, where the patterns make many small ones.
pub(super) fn apart(meta: &Meta) -> Option<Partition> {
    if meta.variables() < FEWEST_VARIABLES {
        return None;
    }
    let partition = Partition::of_patterns(&meta.jacobian, &meta.hessian)?;
    let small = (0..partition.len()).all(|k| partition.variables(k).len().max(partition.rows(k).len()) <= SMALL);
    small.then_some(partition)
}

/// The whole test.
pub(super) fn judge(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    partition: &Partition,
    cone: Option<Build>,
) -> Result<Curvature, FactorizationError> {
    let examine = |piece: &mut Piece, k: usize| {
        choose(&mut piece.choice, point, active, hessian, (partition, k));
        piece.examine(point, active, hessian, cone).map(|found| (k, found))
    };
    let is_noted = |found: &Result<(usize, Found), _>| found.as_ref().map_or(true, |(_, found)| found.is_worth_noting());
    let noted: Result<Vec<(usize, Found)>, FactorizationError> =
        (0..partition.len()).into_par_iter().with_min_len(BATCH).map_init(Piece::default, examine).filter(is_noted).collect();
    let mut curvature = Curvature::default();
    for (k, found) in noted? {
        curvature.dependent |= found.dependent;
        curvature.singular |= found.singular;
        curvature.add(found.on_cone);
        if found.has_negative_curvature && curvature.escape.is_none() {
            let mut choice = Choice::default();
            choose(&mut choice, point, active, hessian, (partition, k));
            curvature.escape = whole::judge(point, active, hessian, &choice, None)?.escape;
            // The dense test saw it, the other lost the direction.
            if curvature.escape.is_none() {
                curvature.leave_undecided(0);
            }
        }
    }
    Ok(curvature)
}

fn choose(choice: &mut Choice, point: &Point<'_>, active: &Active<'_>, hessian: &Hessian, (partition, k): (&Partition, usize)) {
    let (variables, rows) = (partition.variables(k).iter(), partition.rows(k).iter());
    choice.choose(point, active, Some(hessian), (variables.map(|&j| j as usize), rows.map(|&i| i as usize)));
}

/// What one piece's matrices say.
struct Found {
    dependent: bool,
    singular: bool,
    /// Where all active limits hold.
    has_negative_curvature: bool,
    on_cone: OnCone,
}

impl Found {
    fn is_worth_noting(&self) -> bool {
        self.dependent || self.singular || self.has_negative_curvature || self.on_cone != OnCone::PROVED
    }
}

/// A thread's room.
#[derive(Default)]
struct Piece {
    choice: Choice,
    matrices: SaddlePoint,
}

impl Piece {
    fn examine(
        &mut self,
        point: &Point<'_>,
        active: &Active<'_>,
        hessian: &Hessian,
        cone: Option<Build>,
    ) -> Result<Found, FactorizationError> {
        let Piece { choice, matrices } = self;
        small_kkt::fill(matrices, point, hessian, &choice.free, &choice.held);
        let dependent = matrices.has_dependent_rows();
        let singular = matrices.has_negative_curvature(-ROUNDING);
        // Positive beyond rounding is not negative beyond rounding.
        let has_negative_curvature = singular && matrices.has_negative_curvature(ROUNDING);
        let on_cone = match cone {
            Some(build) if !has_negative_curvature && !self.is_positive_without_weak_limits(point, hessian) => {
                match weak_limits::judge(point, active, hessian, &self.choice, build)? {
                    // The null space of all active limits: the dense test is the more exact one.
                    OnCone::Undecided(0) => OnCone::PROVED,
                    judged => judged,
                }
            }
            _ => OnCone::PROVED,
        };
        Ok(Found { dependent, singular, has_negative_curvature, on_cone })
    }

    /// The sufficient test, cheaper than the cone's.
    fn is_positive_without_weak_limits(&mut self, point: &Point<'_>, hessian: &Hessian) -> bool {
        let relaxed = self.choice.relaxed();
        let choice = relaxed.as_ref().unwrap_or(&self.choice);
        if choice.weak() == 0 {
            return true;
        }
        small_kkt::fill(&mut self.matrices, point, hessian, &choice.loose_variables(), &choice.strict_rows());
        !self.matrices.has_negative_curvature(-ROUNDING)
    }
}
