//! The second-order test: how the Lagrangian bends on the null space of the active rows and bounds.
//!
//! By the inertia of the KKT matrix [S Aᵀ; A −δI] in scaled variables, S = D∇²L D/σ and A the active rows over the free
//! variables: it has exactly as many negative eigenvalues as A has rows where S is positive definite on the null space of A
//! (Gould 1985, "On practical conditions for the existence and uniqueness of solutions to the general equality quadratic
//! programming problem"). S is shifted by a small multiple of the row sums of its terms' magnitudes, so that what rounding
//! makes of a flat direction does not count.

mod by_component;
mod kkt;
mod null_space;
mod small_kkt;
mod system;

pub(super) use kkt::Kkt;
pub(super) use system::{Active, Choice, Hessian};

use super::Side;
use super::multipliers::Multipliers;
use super::point::Point;
use crate::linear_algebra::FactorizationError;
use crate::model::EvaluationError;
use system::ROUNDING;

/// Weakly active limits tested one by one at the most, and what all these factorisations together may cost (sum of orders).
const WEAK_LIMITS: usize = 64;
const WEAK_WORK: usize = 400_000;

/// What the second derivatives say.
#[derive(Default)]
pub(super) struct Curvature {
    /// A direction of negative curvature, in the user's variables.
    pub(super) escape: Option<Vec<f64>>,
    /// The reduced Hessian is singular, or bends down.
    pub(super) singular: bool,
    /// The active rows are dependent over the free variables.
    pub(super) dependent: bool,
}

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

/// The whole test.
pub(super) fn examine(point: &Point<'_>, active: &Active<'_>, hessian: &Hessian) -> Curvature {
    let judged = match by_component::apart(point.meta()) {
        Some(partition) => by_component::judge(point, active, hessian, &partition),
        None => judge(point, active, hessian, &Choice::all(point, active)),
    };
    judged.unwrap_or(Curvature { escape: None, singular: true, dependent: true })
}

/// The test over some variables and rows, which nothing outside them touches.
pub(super) fn judge(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    choice: &Choice,
) -> Result<Curvature, FactorizationError> {
    let (free, held) = (&choice.free, &choice.held);
    // The rows alone make a far sparser matrix.
    let dependent = Kkt::without_hessian(point, free, held)?.dependent_rows()?;
    // What bends up beyond rounding does not bend down.
    let bends_up = matches!(null_space::bends_up(point, hessian, (free, held), -ROUNDING), Some(Ok(true)));
    let (mut singular, mut escape) = if bends_up { (false, None) } else { whole(point, hessian, free, held)? };
    if escape.is_none() && !dependent {
        escape = one_sided(point, active, hessian, choice)?;
    }
    singular |= escape.is_some();
    Ok(Curvature { singular, escape, dependent })
}

/// Whether S is singular or worse on the null space of the rows, and a direction in which it bends down.
fn whole(
    point: &Point<'_>,
    hessian: &Hessian,
    free: &[usize],
    held: &[usize],
) -> Result<(bool, Option<Vec<f64>>), FactorizationError> {
    let mut kkt = Kkt::new(point, hessian, free, held)?;
    let singular = kkt.bends_down(-ROUNDING)?;
    let escape = if singular && kkt.bends_down(ROUNDING)? { kkt.lowest_direction(ROUNDING)? } else { None };
    Ok((singular, escape))
}

/// Weakly active limits hold on one side only: a direction that leaves one of them inwards must not bend down either (or a
/// maximum on a bound with zero multiplier would pass). Each is let go by itself; more than one at once, and all of them in very large
/// problems, are left to the test on the null space.
fn one_sided(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    choice: &Choice,
) -> Result<Option<Vec<f64>>, FactorizationError> {
    let (free, held) = (&choice.free, &choice.held);
    let bounds = choice.weak_bounds.iter().filter(|&&j| hessian.size[j] > 0.0);
    let tried = WEAK_LIMITS.min(WEAK_WORK / (free.len() + held.len() + 1));
    for &j in bounds.take(tried) {
        let mut more = free.clone();
        more.insert(more.partition_point(|&k| k < j), j);
        if let Some(direction) = bending(point, hessian, &more, held)? {
            let inward = if active.bounds[j] == Side::Lower { direction[j] } else { -direction[j] };
            return Ok(Some(turned(direction, inward)));
        }
    }
    for &i in choice.weak_rows.iter().take(tried) {
        let fewer: Vec<usize> = held.iter().copied().filter(|&k| k != i).collect();
        if let Some(direction) = bending(point, hessian, free, &fewer)? {
            let pattern = &point.meta().jacobian;
            let change: f64 = pattern.range(i).map(|at| point.jacobian[at] * direction[pattern.columns[at] as usize]).sum();
            return Ok(Some(turned(direction, if active.rows[i] == Side::Lower { change } else { -change })));
        }
    }
    Ok(None)
}

fn bending(point: &Point<'_>, hessian: &Hessian, free: &[usize], held: &[usize]) -> Result<Option<Vec<f64>>, FactorizationError> {
    let mut kkt = Kkt::new(point, hessian, free, held)?;
    if kkt.bends_down(ROUNDING)? { kkt.lowest_direction(ROUNDING) } else { Ok(None) }
}

fn turned(mut direction: Vec<f64>, inward: f64) -> Vec<f64> {
    if inward < 0.0 {
        direction.iter_mut().for_each(|v| *v = -*v);
    }
    direction
}
