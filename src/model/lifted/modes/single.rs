//! A single eigenvalue and its derivatives.
//!
//! With φᵀKφ = 1 and D_z = B_z − μK_z, a simple μ of B φ = μ K φ has μ_z = φᵀD_zφ and
//! μ_zz' = φᵀ(B_zz' − μK_zz')φ − μ_z·φᵀK_z'φ − μ_z'·φᵀK_zφ + 2·Σ_j (φ_jᵀD_zφ)(φ_jᵀD_z'φ)/(μ − μ_j)
//! (Nelson 1976; Haug, Choi and Komkov, *Design Sensitivity Analysis of Structural Systems*, 1986). Displacements are among the z: through
//! them the prestress changes with the design.

use std::sync::Arc;

use super::energies::Derivatives;
use super::smooth::{Smooth, chained, turned};
use super::{Solution, Solved, factor, unsolved};
use crate::linear_algebra::pencil::{Complement, Spectrum};
use crate::model::EvaluationError;
use crate::problem::modes::{NEVER, Pencil};

/// Of two values of μ that are nearer than this, relative to the larger, it cannot be said which mode is which: what bends one of them
/// against the other is no curvature of a smooth function, and is left out. [`crate::problem::modes::Cut`]s are smooth there.
const COINCIDENT: f64 = 1e-6;

/// A mode to a few roundings, as first derivatives take its error as it is.
pub(super) struct Single {
    mu: f64,
    phi: Vec<f64>,
    /// B − μK on the complement of the mode and of those that coincide with it.
    complement: Complement,
}

impl Solution {
    fn complement(&self, at: usize) -> Result<Complement, EvaluationError> {
        let Spectrum { values, vectors } = &self.spectrum;
        let mu = values[at];
        let coincides = |other: f64| (mu - other).abs() <= COINCIDENT * mu.max(other);
        let beside = values.iter().zip(vectors).filter(|(other, _)| coincides(**other));
        let columns: Vec<Vec<f64>> = beside.map(|(_, vector)| self.k.times(vector)).collect();
        Complement::new(&self.b.plus(-mu, &self.k), &columns, &self.k).map_err(unsolved)
    }
}

impl Solved<'_> {
    /// As the Rayleigh quotient of the mode's energies: its vector's error goes in squared.
    pub(super) fn value_of_number(&mut self, pencil: Pencil, at: usize) -> Result<f64, EvaluationError> {
        let solution = self.solution(pencil)?;
        let Some(phi) = solution.spectrum.vectors.get(at) else { return Ok(NEVER) };
        let [stiffness, other] = self.modes.energies.energies(&self.z, phi, pencil)?;
        Ok(factor(pencil, other / stiffness))
    }

    /// Newton's correction of the mode for what the pieces' forces leave of (B − μK)φ = 0: the matrices' own products with φ nearly cancel.
    fn single(&mut self, pencil: Pencil, at: usize) -> Result<Arc<Single>, EvaluationError> {
        if let Some((.., known)) = self.singles.iter().find(|(own, place, _)| (*own, *place) == (pencil, at)) {
            return Ok(Arc::clone(known));
        }
        let solution = self.solution(pencil)?;
        let (energies, complement) = (&self.modes.energies, solution.complement(at)?);
        let mut phi = solution.spectrum.vectors[at].clone();
        let [stiffness, other] = energies.energies(&self.z, &phi, pencil)?;
        let left = energies.times(&self.z, &phi, pencil, -other / stiffness, 1.0)?;
        let correction = complement.project(&left).map_err(unsolved)?;
        phi.iter_mut().zip(correction).for_each(|(value, by)| *value -= by);
        let [stiffness, other] = energies.energies(&self.z, &phi, pencil)?;
        phi.iter_mut().for_each(|value| *value /= stiffness.sqrt());
        let single = Arc::new(Single { mu: other / stiffness, phi, complement });
        self.singles.push((pencil, at, Arc::clone(&single)));
        Ok(single)
    }

    pub(super) fn of_number(&mut self, pencil: Pencil, at: usize, curved: bool) -> Result<Smooth, EvaluationError> {
        let solution = self.solution(pencil)?;
        let buckles = solution.spectrum.values.get(at).is_some_and(|&mu| factor(pencil, mu) < NEVER);
        if !buckles {
            return Ok(Smooth { slope: vec![0.0; self.z.len()], curvature: Vec::new() });
        }
        let single = self.single(pencil, at)?;
        let (energies, z) = (&self.modes.energies, &self.z);
        let Single { mu, phi, complement } = single.as_ref();
        let [first, second] = pencil.slopes(*mu);
        if !curved {
            let slope = energies.slope(z, phi, pencil, -mu, 1.0)?;
            return Ok(chained(slope, Vec::new(), &[], first, second));
        }
        let stiffness = energies.slope(z, phi, pencil, 1.0, 0.0)?;
        let Derivatives { slope, mut curvature, mixed } = energies.derivatives(z, phi, pencil, -mu, 1.0)?;
        let active: Vec<usize> =
            (0..slope.len()).filter(|&z| slope[z] != 0.0 || stiffness[z] != 0.0 || !mixed[z].is_empty()).collect();
        for (at, &i) in active.iter().enumerate() {
            for &j in &active[..=at] {
                curvature.push((i, j, -slope[i] * stiffness[j] - slope[j] * stiffness[i]));
            }
        }
        turned(complement, &mixed, &mut curvature).map_err(unsolved)?;
        Ok(chained(slope, curvature, &active, first, second))
    }
}
