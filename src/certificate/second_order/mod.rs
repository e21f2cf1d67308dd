//! The second-order test: the Lagrangian's curvature on the critical cone of the active rows and bounds.
//!
//! On the largest subspace of the cone, the null space of all active limits, by the inertia of the KKT matrix [S Aᵀ; A −δI] in scaled variables, S = D∇²L D/σ and A the active rows over the free
//! variables: it has exactly as many negative eigenvalues as A has rows where S is positive definite on the null space of A
//! (Gould 1985, "On practical conditions for the existence and uniqueness of solutions to the general equality quadratic
//! programming problem"). S is shifted by a small multiple of the row sums of its terms' magnitudes, so that what rounding
//! makes of a flat direction does not count.

mod by_component;
mod cone;
mod kkt;
mod null_space;
mod regular;
mod small_kkt;
mod spans;
mod system;
#[cfg(test)]
mod tests;
mod weak_limits;
mod whole;

pub(super) use kkt::Kkt;
pub(super) use regular::has_minimum_beside;
pub(super) use system::{Active, Choice, Hessian};
pub(super) use whole::Curvature;

use super::multipliers::Multipliers;
use super::point::Point;
use crate::linear_algebra::Partition;
use crate::linear_algebra::entries::Symmetric;
use crate::model::EvaluationError;
use cone::Build;

/// Whether the gradients of the active limits are linearly dependent.
pub(super) fn is_dependent(point: &Point<'_>, active: &Active<'_>) -> bool {
    let choice = Choice::all(point, active);
    match Kkt::without_hessian(point, &choice.free, &choice.held) {
        Ok(mut kkt) => kkt.dependent_rows().unwrap_or(true),
        Err(_) => true,
    }
}

/// Row by row, the magnitudes D∇²L D/σ is summed from.
pub(super) fn magnitudes(point: &Point<'_>, multipliers: &Multipliers) -> Result<Vec<f64>, EvaluationError> {
    Hessian::of(point, multipliers).map(|hessian| hessian.size)
}

/// The whole test. Of convex problems only whether the minimiser is unique is asked, on the null space of all active limits.
pub(super) fn examine(point: &Point<'_>, active: &Active<'_>, hessian: &Hessian, is_convex: bool) -> Curvature {
    let cone = |build: Build| (!is_convex).then_some(build);
    let judged = match by_component::apart(point.meta()) {
        Some(partition) => by_component::judge(point, active, hessian, &partition, cone(Symmetric::one_of_many)),
        None => {
            let choice = Choice::noting_nearly_weak(point, active, hessian);
            whole::judge(point, active, hessian, &choice, cone(Symmetric::curved))
        }
    };
    // Where a factorisation fails nothing is proved.
    let weak = || Some(Choice::all(point, active).weak());
    judged.unwrap_or_else(|_| Curvature { singular: true, dependent: true, undecided: weak(), ..Curvature::default() })
}

/// What a second-order test says.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SecondOrder {
    /// The Lagrangian has positive curvature on the critical cone, beyond rounding.
    BendsUp,
    /// It has no negative curvature beyond rounding, and somewhere no positive one either.
    Flat,
    /// It has negative curvature along some direction.
    BendsDown,
    /// None of these is shown.
    Undecided,
}

impl SecondOrder {
    fn of(curvature: &Curvature) -> SecondOrder {
        match curvature {
            Curvature { escape: Some(_), .. } => SecondOrder::BendsDown,
            Curvature { undecided: Some(_), .. } => SecondOrder::Undecided,
            Curvature { singular: true, .. } => SecondOrder::Flat,
            _ => SecondOrder::BendsUp,
        }
    }
}

/// The dense, the sparse and the component-wise test.
pub(super) fn by_every_test(point: &Point<'_>, active: &Active<'_>, hessian: &Hessian) -> [SecondOrder; 3] {
    let choice = Choice::noting_nearly_weak(point, active, hessian);
    let whole = |build: Build| whole::judge(point, active, hessian, &choice, Some(build));
    let apart = Partition::of_patterns(&point.meta().jacobian, &point.meta().hessian).map_or_else(
        || whole(Symmetric::curved),
        |partition| by_component::judge(point, active, hessian, &partition, Some(Symmetric::one_of_many)),
    );
    [whole(Symmetric::one_of_many), whole(Symmetric::sparse), apart]
        .map(|judged| judged.map_or(SecondOrder::Undecided, |curvature| SecondOrder::of(&curvature)))
}
