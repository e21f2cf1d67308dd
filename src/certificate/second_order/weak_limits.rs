//! The sufficient condition where limits are weakly active: the Lagrangian has positive curvature along every direction of the critical cone.

use super::cone::{Build, Cone};
use super::system::{Active, Choice, Hessian};
use crate::certificate::parameters::higher_order::FLAT;
use crate::certificate::parameters::second_order::{FACES, LOW, LOW_FACES, MOST, NEAREST, ROUNDING, WORK};
use crate::certificate::point::Point;
use crate::linear_algebra::FactorizationError;
use crate::linear_algebra::copositive::{self, Verdict};

/// What the critical cone says.
#[derive(Debug, PartialEq)]
pub(super) enum OnCone {
    /// Curvature is negative along no direction, and positive along every one beyond rounding if it is strict. These directions, which leave weakly
    /// active limits, have hardly any curvature.
    Holds { is_strict: bool, flat: Vec<Vec<f64>> },
    /// Curvature is negative along this direction of the cone, in the user's variables.
    Falls(Vec<f64>),
    /// Neither is shown at so many weakly active limits.
    Undecided(usize),
}

impl OnCone {
    /// Nothing to be said of the cone.
    pub(super) const PROVED: OnCone = OnCone::Holds { is_strict: true, flat: Vec::new() };
}

/// Judges the cone of the weakly active limits and, where that makes a difference this near, of those that nearly are.
/// On the null space of all active limits the Lagrangian must have no negative curvature.
pub(super) fn judge(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    choice: &Choice,
    build: Build,
) -> Result<OnCone, FactorizationError> {
    if let Some(relaxed) = choice.relaxed() {
        match examine(point, active, hessian, &relaxed, build)? {
            OnCone::Falls(direction) if is_near(point, hessian, &relaxed.loose_variables(), &direction) => {
                return Ok(OnCone::Falls(direction));
            }
            OnCone::Falls(_) | OnCone::Undecided(_) => {}
            proved => return Ok(proved),
        }
    }
    examine(point, active, hessian, choice, build)
}

/// Whether the objective falls below the point's within a very small step along a direction of these variables.
fn is_near(point: &Point<'_>, hessian: &Hessian, loose: &[usize], direction: &[f64]) -> bool {
    let square: f64 = loose.iter().map(|&j| (direction[j] / point.sizes[j]).powi(2)).sum();
    let slope: f64 = loose.iter().map(|&j| direction[j] * point.gradient[j]).sum::<f64>() / point.scale();
    2.0 * slope <= -NEAREST * hessian.bend_of(point, loose, direction) * square
}

/// The same of the weakly active limits alone.
pub(super) fn examine(
    point: &Point<'_>,
    active: &Active<'_>,
    hessian: &Hessian,
    choice: &Choice,
    build: Build,
) -> Result<OnCone, FactorizationError> {
    let mut cone = Cone::new(point, active, hessian, choice, build)?;
    let judged = judge_cone(point, hessian, choice, &mut cone)?;
    if !matches!(judged, OnCone::Undecided(_)) || !cone.has_strict_rows() {
        return Ok(judged);
    }
    match cone.within_strict_rows()? {
        Some(mut within) => judge_cone(point, hessian, choice, &mut within),
        None => Ok(judged),
    }
}

fn judge_cone(point: &Point<'_>, hessian: &Hessian, choice: &Choice, cone: &mut Cone<'_>) -> Result<OnCone, FactorizationError> {
    let k = cone.weak();
    if cone.is_positive_without_weak_limits(-ROUNDING)? {
        return Ok(OnCone::PROVED);
    }
    if cone.is_positive_without_weak_limits(ROUNDING)? {
        return Ok(OnCone::Holds { is_strict: false, flat: Vec::new() });
    }
    if k == 0 || k > MOST || k * cone.order() > WORK || !cone.is_positive_on_subspace(ROUNDING)? {
        return Ok(OnCone::Undecided(k));
    }
    let reduced = cone.reduced()?;
    match copositive::test(&reduced, k, FACES) {
        Verdict::Undecided => Ok(OnCone::Undecided(k)),
        Verdict::Falls(s) => {
            let falls = |direction: &Vec<f64>| hessian.bend_of(point, &choice.loose_variables(), direction) < 0.0;
            Ok(cone.direction(&s)?.filter(falls).map_or(OnCone::Undecided(k), OnCone::Falls))
        }
        Verdict::Copositive => {
            let flat = flat_directions((point, &choice.loose_variables()), hessian, cone, &reduced, k)?;
            let is_strict =
                cone.is_positive_on_subspace(-ROUNDING)? && copositive::test(&cone.reduced()?, k, FACES) == Verdict::Copositive;
            Ok(OnCone::Holds { is_strict, flat })
        }
    }
}

/// Directions that leave weakly active limits and hardly bend: of single limits, of faces, of two and of all at once.
fn flat_directions(
    (point, loose): (&Point<'_>, &[usize]),
    hessian: &Hessian,
    cone: &Cone<'_>,
    reduced: &[f64],
    k: usize,
) -> Result<Vec<Vec<f64>>, FactorizationError> {
    let unit = |i: usize| (0..k).map(|j| if i == j { 1.0 } else { 0.0 }).collect::<Vec<f64>>();
    let faces = copositive::low_vectors(reduced, k, LOW, LOW_FACES);
    let mut flat = Vec::<Vec<f64>>::new();
    for s in faces.into_iter().chain((0..k).take(LOW_FACES).map(unit)) {
        let direction = cone.direction(&s)?.filter(|direction| hessian.bend_of(point, loose, direction).abs() <= FLAT);
        flat.extend(direction.filter(|direction| !flat.contains(direction)));
    }
    let sum = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a + b).collect::<Vec<f64>>();
    let single = flat.clone();
    for (i, a) in single.iter().enumerate() {
        flat.extend(single[..i].iter().map(|b| sum(a, b)).filter(|both| hessian.bend_of(point, loose, both).abs() <= FLAT));
    }
    if single.len() > 2 {
        flat.push(single[1..].iter().fold(single[0].clone(), |all, next| sum(&all, next)));
    }
    Ok(flat)
}
