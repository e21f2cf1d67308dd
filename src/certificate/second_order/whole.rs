//! The second-order test of variables and rows as one system.

use super::cone::Build;
use super::kkt::Kkt;
use super::null_space;
use super::system::{Active, Choice, Hessian};
use super::weak_limits::{self, OnCone};
use crate::certificate::parameters::second_order::ROUNDING;
use crate::certificate::point::Point;
use crate::linear_algebra::entries::Symmetric;
use crate::linear_algebra::{Effort, FactorizationError};

/// What the second derivatives say.
#[derive(Default)]
pub(in crate::certificate) struct Curvature {
    /// A direction of the critical cone of negative curvature, in the user's variables.
    pub(in crate::certificate) escape: Option<Vec<f64>>,
    /// The reduced Hessian is singular, or has negative eigenvalues.
    pub(in crate::certificate) singular: bool,
    /// The active rows are dependent over the free variables.
    pub(in crate::certificate) dependent: bool,
    /// Neither is shown; at so many weakly active limits.
    pub(in crate::certificate) undecided: Option<usize>,
    /// Directions that leave weakly active limits and hardly bend, in the user's variables.
    pub(in crate::certificate) flat: Vec<Vec<f64>>,
}

impl Curvature {
    pub(super) fn leave_undecided(&mut self, limits: usize) {
        self.undecided = Some(self.undecided.unwrap_or(0) + limits);
    }

    fn of(on_cone: OnCone) -> Self {
        let mut curvature = Curvature::default();
        curvature.add(on_cone);
        curvature
    }

    pub(super) fn add(&mut self, on_cone: OnCone) {
        match on_cone {
            OnCone::Holds { is_strict, flat } => {
                self.singular |= !is_strict;
                self.flat.extend(flat);
            }
            OnCone::Falls(direction) => {
                self.singular = true;
                self.escape.get_or_insert(direction);
            }
            OnCone::Undecided(limits) => self.leave_undecided(limits),
        }
    }
}

/// The test over some variables and rows, which nothing outside them touches; on the cone of weakly active limits only where its
/// matrix is to be built.
pub(super) fn judge(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    choice: &Choice,
    cone: Option<Build>,
) -> Result<Curvature, FactorizationError> {
    let (free, held) = (&choice.free, &choice.held);
    // The rows alone make a far sparser matrix.
    let dependent = Kkt::without_hessian(point, free, held)?.dependent_rows()?;
    let has_no_cone = cone.is_none() || (choice.weak() == 0 && choice.relaxed().is_none());
    // Positive beyond rounding is not negative beyond rounding.
    let is_positive = || matches!(null_space::is_positive(point, hessian, (free, held), -ROUNDING), Some(Ok(true)));
    if has_no_cone && is_positive() {
        return Ok(Curvature { dependent, ..Curvature::default() });
    }
    // What holds on the cone holds on its largest subspace.
    let on_cone = match cone {
        Some(build) => weak_limits::judge(point, active, hessian, choice, build)?,
        None => weak_limits::examine(point, active, hessian, &choice.on_null_space(), Symmetric::curved)?,
    };
    let mut curvature = match on_cone {
        OnCone::Undecided(limits) => on_null_space(point, hessian, choice, limits)?,
        decided => Curvature::of(decided),
    };
    curvature.dependent = dependent;
    Ok(curvature)
}

/// How S bends on the null space of all active limits, where the cone's matrix, less exact beside limits that nearly depend on one another,
/// cannot tell; so many weakly active limits stay undecided.
fn on_null_space(point: &Point<'_>, hessian: &Hessian, choice: &Choice, limits: usize) -> Result<Curvature, FactorizationError> {
    let mut kkt = Kkt::new(point, hessian, &choice.free, &choice.held)?;
    let singular = kkt.has_negative_curvature(-ROUNDING, Effort::Any)?;
    let mut curvature = Curvature { singular, ..Curvature::default() };
    let bends_down = singular && kkt.has_negative_curvature(ROUNDING, Effort::Any)?;
    if bends_down {
        curvature.escape = kkt.lowest_direction(ROUNDING)?;
    }
    if curvature.escape.is_none() && (bends_down || limits > 0) {
        curvature.leave_undecided(limits);
    }
    Ok(curvature)
}
