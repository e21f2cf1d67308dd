//! The second-order test: how the Lagrangian bends on the null space of the active rows and bounds.
//!
//! By the inertia of the KKT matrix [S Aᵀ; A −δI] in scaled variables, S = D∇²L D/σ and A the active rows over the free
//! variables: it has exactly as many negative eigenvalues as A has rows where S is positive definite on the null space of A
//! (Gould 1985, "On practical conditions for the existence and uniqueness of solutions to the general equality quadratic
//! programming problem"). S is shifted by a small multiple of the row sums of its terms' magnitudes, so that what rounding
//! makes of a flat direction does not count.

use super::kkt::Kkt;
use super::narrow;
use super::pieces;
use super::point::Point;
use super::{Side, multipliers::Multipliers};
use crate::linear_algebra::FactorizationError;
use crate::model::{EvaluationError, Model};

/// Shift of the test, relative to the magnitudes S is summed from: curvature less than this is rounding.
pub(super) const ROUNDING: f64 = 1e-7;
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

/// The active set at the point.
pub(super) struct Active<'a> {
    pub(super) rows: &'a [Side],
    pub(super) bounds: &'a [Side],
    pub(super) multipliers: &'a Multipliers,
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
    let judged = match pieces::apart(point.meta()) {
        Some(partition) => pieces::judge(point, active, hessian, &partition),
        None => judge(point, active, hessian, &Choice::all(point, active)),
    };
    judged.unwrap_or(Curvature { escape: None, singular: true, dependent: true })
}

/// Which variables and rows are looked at.
#[derive(Default)]
pub(super) struct Choice {
    /// Free variables.
    pub(super) free: Vec<usize>,
    /// Active rows.
    pub(super) held: Vec<usize>,
    /// Variables on bounds with hardly a multiplier.
    pub(super) weak_bounds: Vec<usize>,
    /// Active rows with hardly a multiplier.
    pub(super) weak_rows: Vec<usize>,
}

impl Choice {
    pub(super) fn all(point: &Point<'_>, active: &Active<'_>) -> Choice {
        let mut choice = Choice::default();
        choice.choose(point, active, 0..active.bounds.len(), 0..active.rows.len());
        choice
    }

    /// Free variables and those on bounds that hardly push, ascending.
    pub(super) fn loose_variables(&self) -> Vec<usize> {
        let mut loose = [&self.free[..], &self.weak_bounds].concat();
        loose.sort_unstable();
        loose
    }

    /// Equalities and active rows that push.
    pub(super) fn strict_rows(&self) -> Vec<usize> {
        self.held.iter().copied().filter(|i| self.weak_rows.binary_search(i).is_err()).collect()
    }

    /// Sorts some variables and rows, given ascending.
    pub(super) fn choose(
        &mut self,
        point: &Point<'_>,
        active: &Active<'_>,
        variables: impl Iterator<Item = usize>,
        rows: impl Iterator<Item = usize>,
    ) {
        [&mut self.free, &mut self.held, &mut self.weak_bounds, &mut self.weak_rows].into_iter().for_each(Vec::clear);
        let weak = 1e-6 * point.scale();
        for j in variables {
            match active.bounds[j] {
                Side::None => self.free.push(j),
                Side::Lower | Side::Upper if (active.multipliers.bounds[j] * point.sizes[j]).abs() <= weak => {
                    self.weak_bounds.push(j);
                }
                _ => {}
            }
        }
        for i in rows.filter(|&i| active.rows[i] != Side::None && point.slopes[i] > 0.0) {
            self.held.push(i);
            if active.rows[i] != Side::Equal && (active.multipliers.rows[i] * point.slopes[i]).abs() <= weak {
                self.weak_rows.push(i);
            }
        }
    }
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
    let bends_up = matches!(narrow::bends_up(point, hessian, (free, held), -ROUNDING), Some(Ok(true)));
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

/// S = D∇²L D/σ along the model's pattern, and row by row the sum of the magnitudes it is made of.
pub(super) struct Hessian {
    pub(super) values: Vec<f64>,
    pub(super) size: Vec<f64>,
}

impl Hessian {
    /// The same, its largest row of magnitudes being 1.
    pub(super) fn normalised(&self) -> Hessian {
        let largest = self.size.iter().fold(0.0, |most: f64, size| most.max(*size));
        let unit = if largest > 0.0 { largest } else { 1.0 };
        let share = |all: &[f64]| all.iter().map(|value| value / unit).collect();
        Hessian { values: share(&self.values), size: share(&self.size) }
    }

    pub(super) fn of(point: &Point<'_>, multipliers: &Multipliers) -> Result<Hessian, EvaluationError> {
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
            for (at, (row, column)) in pattern.iter().enumerate() {
                let entry = part[at] * (point.sizes[row] * point.sizes[column] / point.scale());
                hessian.values[at] += entry;
                hessian.size[row] += entry.abs();
                if row != column {
                    hessian.size[column] += entry.abs();
                }
            }
        }
        Ok(hessian)
    }
}
