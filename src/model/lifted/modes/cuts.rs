//! Coinciding eigenvalues seen in one direction ([`Cut`]).
//!
//! r(z, μ) = min wᵀ(K − B/μ)w over Cᵀw = v has r_z = wᵀS_zw and r_zz' = wᵀS_zz'w − 2·(S_z w)ᵀ·P·(S_z' w), where P is the upper left block of
//! [S C; Cᵀ 0]⁻¹; with μ as one more of the z, S_μ = B/μ². At a limit r is the value; a cut at itself is the μ with r = 0, whose derivatives are
//! those of an implicit function.

use std::sync::Arc;

use super::energies::Derivatives;
use super::smooth::{Curvature, Smooth, chained, turned};
use super::{Solved, unsolved};
use crate::linear_algebra::pencil::{Complement, Matrix};
use crate::math::dot;
use crate::model::EvaluationError;
use crate::problem::modes::{Cut, Level, Pencil};

/// Newton steps for the μ of a cut: it converges as Rayleigh quotients of nearly coinciding modes do, quadratically, from a reference nearby.
const STEPS: usize = 40;

/// Relative change at which μ is found: two roundings.
const FOUND: f64 = 2.0 * f64::EPSILON;

/// B, μ, and the system over S at it that says what cuts through one basis see.
pub(super) struct System {
    b: Matrix,
    mu: f64,
    complement: Complement,
}

impl System {
    fn new(cut: &Cut, (k, b): (&Matrix, Matrix), mu: f64) -> Result<Self, EvaluationError> {
        let complement = Complement::new(&k.plus(-1.0 / mu, &b), &cut.basis, k).map_err(unsolved)?;
        Ok(System { b, mu, complement })
    }
}

/// μ as a function of z where r(z, μ) = 0, to be put together from derivatives of r.
struct Implicit {
    /// r_μ.
    rise: f64,
    /// r_zμ.
    mixed: Vec<f64>,
    /// r_μμ.
    bend: f64,
}

impl Solved<'_> {
    pub(super) fn value_of_cut(&mut self, at: usize) -> Result<f64, EvaluationError> {
        let system = self.system(at)?;
        let cut = &self.modes.cuts[at];
        Ok(match cut.level {
            Level::Limit(_) => {
                let w = system.complement.stationary(&cut.direction).map_err(unsolved)?;
                shown(cut.pencil, system.mu, self.remaining(cut, system.mu, &w)?)
            }
            Level::Itself(_) => cut.pencil.shown(system.mu),
        })
    }

    /// What a cut is seen through: those at one limit share it.
    fn system(&mut self, at: usize) -> Result<Arc<System>, EvaluationError> {
        let cuts = &self.modes.cuts;
        let cut = &cuts[at];
        let shares = |other: &Cut| matches!(cut.level, Level::Limit(_)) && Arc::ptr_eq(&other.basis, &cut.basis);
        let alike = |other: &Cut| (other.pencil, other.level) == (cut.pencil, cut.level) && shares(other);
        if let Some((_, system)) = self.systems.iter().find(|(other, _)| *other == at || alike(&cuts[*other])) {
            return Ok(Arc::clone(system));
        }
        let k = self.stiffness(cut.pencil)?;
        let b = self.modes.energies.matrix(&self.z, cut.pencil, 0.0, 1.0)?;
        let system = match cut.level {
            Level::Limit(limit) => System::new(cut, (&k, b), cut.pencil.inverse(limit))?,
            Level::Itself(near) => self.sought(cut, &k, &b, near)?,
        };
        let system = Arc::new(system);
        self.systems.push((at, Arc::clone(&system)));
        Ok(system)
    }

    /// w, with a Newton correction for what the pieces' forces leave of S·w beside the columns: S's own product with it nearly cancels. Energies
    /// take the error of the first w squared, and need no correction; derivatives take it as it is.
    fn stationary(&self, cut: &Cut, system: &System) -> Result<Vec<f64>, EvaluationError> {
        let mut w = system.complement.stationary(&cut.direction).map_err(unsolved)?;
        let left = self.modes.energies.times(&self.z, &w, cut.pencil, 1.0, -1.0 / system.mu)?;
        let correction = system.complement.project(&left).map_err(unsolved)?;
        w.iter_mut().zip(correction).for_each(|(value, by)| *value -= by);
        Ok(w)
    }

    /// wᵀSw at a level.
    fn remaining(&self, cut: &Cut, mu: f64, w: &[f64]) -> Result<f64, EvaluationError> {
        let [stiffness, other] = self.modes.energies.energies(&self.z, w, cut.pencil)?;
        Ok(stiffness - other / mu)
    }

    /// The system at the μ at which nothing is left of S in the cut's direction. r is concave in 1/μ, and Newton's next 1/μ is the Rayleigh
    /// quotient of w.
    fn sought(&self, cut: &Cut, k: &Matrix, b: &Matrix, near: f64) -> Result<System, EvaluationError> {
        let mut mu = cut.pencil.inverse(near);
        let mut last = f64::INFINITY;
        for _ in 0..STEPS {
            let system = System::new(cut, (k, b.clone()), mu)?;
            let w = system.complement.stationary(&cut.direction).map_err(unsolved)?;
            let [stiffness, other] = self.modes.energies.energies(&self.z, &w, cut.pencil)?;
            let next = other / stiffness;
            let change = (next / mu - 1.0).abs();
            // At rounding, steps no longer shrink.
            if change <= FOUND || change >= last && last <= f64::EPSILON.sqrt() {
                return Ok(system);
            }
            if !(next > 0.0 && next.is_finite()) {
                break;
            }
            (mu, last) = (next, change);
        }
        let cause = "so far from the design they were taken at, modes have no value in this combination".into();
        Err(EvaluationError::Invalid { term: "coinciding modes of the structure".into(), cause })
    }

    pub(super) fn of_cut(&mut self, at: usize, curved: bool) -> Result<Smooth, EvaluationError> {
        let system = self.system(at)?;
        let (energies, cut, mu) = (&self.modes.energies, &self.modes.cuts[at], system.mu);
        let w = self.stationary(cut, &system)?;
        let (pencil, share) = (cut.pencil, -1.0 / mu);
        let implicit = matches!(cut.level, Level::Itself(_));
        let rise = dot(&w, &system.b.times(&w)) / (mu * mu);
        if !curved {
            let mut slope = energies.slope(&self.z, &w, pencil, 1.0, share)?;
            if implicit {
                slope.iter_mut().for_each(|value| *value /= -rise);
                return Ok(chained(slope, Vec::new(), &[], pencil.slopes(mu)[0], 0.0));
            }
            let [first, _] = slopes(pencil, mu, self.remaining(cut, mu, &w)?);
            return Ok(chained(slope, Vec::new(), &[], first, 0.0));
        }
        let Derivatives { slope, mut curvature, mixed } = energies.derivatives(&self.z, &w, pencil, 1.0, share)?;
        turned(&system.complement, &mixed, &mut curvature).map_err(unsolved)?;
        if implicit {
            let of_b = energies.slope(&self.z, &w, pencil, 0.0, 1.0)?;
            let implicit = Implicit::of(&system, &w, &mixed, &of_b)?;
            let (slope, curvature, active) = implicit.put_together(slope, curvature);
            let [first, second] = pencil.slopes(mu);
            return Ok(chained(slope, curvature, &active, first, second));
        }
        let active: Vec<usize> = (0..slope.len()).filter(|&z| slope[z] != 0.0 || !mixed[z].is_empty()).collect();
        let [first, second] = slopes(pencil, mu, self.remaining(cut, mu, &w)?);
        Ok(chained(slope, curvature, &active, first, second))
    }
}

impl Implicit {
    fn of(system: &System, w: &[f64], mixed: &[Vec<(usize, f64)>], of_b: &[f64]) -> Result<Self, EvaluationError> {
        let mu = system.mu;
        let squared = mu * mu;
        let mut turning = system.b.times(w);
        let rise = dot(w, &turning) / squared;
        turning.iter_mut().for_each(|value| *value /= squared);
        let turned = system.complement.project(&turning).map_err(unsolved)?;
        let through = |column: &[(usize, f64)]| column.iter().map(|&(row, value)| value * turned[row]).sum::<f64>();
        Ok(Implicit {
            rise,
            mixed: of_b.iter().zip(mixed).map(|(own, column)| own / squared - 2.0 * through(column)).collect(),
            bend: -2.0 * rise / mu - 2.0 * dot(&turning, &turned),
        })
    }

    /// μ_z = −r_z/r_μ and μ_zz' = −(r_zz' + r_zμ·μ_z' + r_z'μ·μ_z + r_μμ·μ_z·μ_z')/r_μ, and the z that μ depends on.
    fn put_together(&self, slope: Vec<f64>, mut curvature: Curvature) -> (Vec<f64>, Curvature, Vec<usize>) {
        let slope: Vec<f64> = slope.into_iter().map(|value| -value / self.rise).collect();
        let active: Vec<usize> = (0..slope.len()).filter(|&z| slope[z] != 0.0 || self.mixed[z] != 0.0).collect();
        for (at, &i) in active.iter().enumerate() {
            for &j in &active[..=at] {
                let through = self.mixed[i] * slope[j] + self.mixed[j] * slope[i] + self.bend * slope[i] * slope[j];
                curvature.push((i, j, through));
            }
        }
        curvature.iter_mut().for_each(|(.., value)| *value /= -self.rise);
        (slope, curvature, active)
    }
}

/// What a cut at the μ of its limit shows where this is left of S: m = μ·(1 − r) is its eigenvalue to first order.
fn shown(pencil: Pencil, mu: f64, remaining: f64) -> f64 {
    pencil.shown(mu * (1.0 - remaining))
}

/// Its first and second derivative by r.
fn slopes(pencil: Pencil, mu: f64, remaining: f64) -> [f64; 2] {
    let [first, second] = pencil.slopes(mu * (1.0 - remaining));
    [-mu * first, mu * mu * second]
}
