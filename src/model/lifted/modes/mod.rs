//! Eigenvalues as rows of a model over design and displacements.
//!
//! With φᵀKφ = 1 and D_z = B_z − μK_z, a simple μ of B φ = μ K φ has μ_z = φᵀD_zφ and
//! μ_zz' = φᵀ(B_zz' − μK_zz')φ − μ_z·φᵀK_z'φ − μ_z'·φᵀK_zφ + 2·Σ_j (φ_jᵀD_zφ)(φ_jᵀD_z'φ)/(μ − μ_j)
//! (Nelson 1976; Haug, Choi and Komkov, *Design Sensitivity Analysis of Structural Systems*, 1986). Displacements are among the z: through
//! them the prestress changes with the design.

mod cuts;
mod directions;
mod energies;
mod smooth;
mod with_modes;

pub(super) use with_modes::WithModes;

use super::Numbering;
use crate::linear_algebra::FactorizationError;
use crate::linear_algebra::pencil::{Complement, Matrix, Spectrum, spectrum};
use crate::model::{AssemblyError, EvaluationError};
use crate::problem::Problem;
use crate::problem::modes::{Cut, Eigenvalue, NEVER, Pencil};
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use cuts::System;
use energies::{Derivatives, Energies};
use smooth::{Smooth, chained, turned};
use std::sync::Arc;

/// Of two values of μ that are nearer than this, relative to the larger, it cannot be said which mode is which: what bends one of them
/// against the other is no curvature of a smooth function, and is left out. [`Cut`]s are smooth there.
const COINCIDENT: f64 = 1e-6;

/// Eigenvalues looked at beyond the last asked for, as they may coincide with it.
const BESIDE: usize = 4;

/// The eigenvalues that a problem asks for.
pub struct Modes {
    energies: Energies,
    wanted: Vec<Eigenvalue>,
    cuts: Arc<Vec<Cut>>,
}

/// The matrices at one point, and what was solved of them.
struct Solved<'m> {
    modes: &'m Modes,
    z: Vec<f64>,
    solutions: Vec<(Pencil, Arc<Solution>)>,
    /// What cuts of one cluster share, by the first of them asked about.
    systems: Vec<(usize, Arc<System>)>,
}

/// The matrices of a pencil, and their modes.
struct Solution {
    k: Matrix,
    b: Matrix,
    spectrum: Spectrum,
}

impl Modes {
    /// `None` where none is asked for.
    pub(super) fn of(
        problem: &Problem,
        structure: &Structure,
        statics: &Statics,
        numbering: &Numbering,
        wanted: Vec<Eigenvalue>,
    ) -> Result<Option<Self>, AssemblyError> {
        if wanted.is_empty() {
            return Ok(None);
        }
        let cuts = Arc::clone(&problem.cuts);
        let pencils: Vec<Pencil> = wanted.iter().map(|one| pencil(one, &cuts)).collect();
        let energies = Energies::of(problem, structure, statics, numbering, &pencils)?;
        Ok(Some(Modes { energies, wanted, cuts }))
    }

    /// Their number.
    pub(super) fn count(&self) -> usize {
        self.wanted.len()
    }

    /// How many eigenvalues of a pencil are looked at: up to the last asked for, and some that may coincide with it.
    fn needed(&self, pencil: Pencil) -> usize {
        let number = |one: &Eigenvalue| match *one {
            Eigenvalue::Number(own, number) if own == pencil => number as usize,
            _ => 0,
        };
        self.wanted.iter().map(number).max().unwrap_or(0) + BESIDE
    }

    /// The variables each value depends on.
    fn columns(&self) -> Vec<Vec<u32>> {
        self.wanted.iter().map(|one| self.energies.columns(pencil(one, &self.cuts))).collect()
    }

    fn at<'m>(&'m self, z: &[f64]) -> Solved<'m> {
        Solved { modes: self, z: z.to_vec(), solutions: Vec::new(), systems: Vec::new() }
    }

    /// The largest μ of a pencil and their φ at design and displacements, at least `count` where there are as many above zero.
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn spectrum(&self, z: &[f64], pencil: Pencil, count: usize) -> Result<Spectrum, EvaluationError> {
        self.solution(z, pencil, count).map(|solution| solution.spectrum)
    }

    /// The values asked for at design and displacements, as users know them; [`NEVER`] where so many modes do not buckle.
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn values(&self, z: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        self.at(z).values()
    }

    /// μ of a mode as the Rayleigh quotient of its energies: its vector's error goes in squared. 0 where there is none.
    fn quotient(&self, z: &[f64], pencil: Pencil, spectrum: &Spectrum, at: usize) -> Result<f64, EvaluationError> {
        let Some(phi) = spectrum.vectors.get(at) else { return Ok(0.0) };
        let [stiffness, other] = self.energies.energies(z, phi, pencil)?;
        Ok(other / stiffness)
    }

    fn solution(&self, z: &[f64], pencil: Pencil, count: usize) -> Result<Solution, EvaluationError> {
        let (k, b) = (self.energies.matrix(z, pencil, 1.0, 0.0)?, self.energies.matrix(z, pencil, 0.0, 1.0)?);
        let spectrum = spectrum(&k, &b, count).map_err(unsolved)?;
        Ok(Solution { k, b, spectrum })
    }

    /// Eigenvalues below a limit: the negative pivots of K − B/μ there (Sylvester's law of inertia).
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn below(&self, z: &[f64], pencil: Pencil, limit: f64) -> Result<usize, EvaluationError> {
        let matrix = self.energies.matrix(z, pencil, 1.0, -1.0 / pencil.inverse(limit))?;
        matrix.negative_eigenvalues().map_err(unsolved)
    }

    /// wᵀSw of S = K − B/μ at a limit: its slope by design and displacements, and its value.
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn cut(&self, z: &[f64], w: &[f64], pencil: Pencil, limit: f64) -> Result<(Vec<f64>, f64), EvaluationError> {
        let share = -1.0 / pencil.inverse(limit);
        let matrix = self.energies.matrix(z, pencil, 1.0, share)?;
        Ok((self.energies.slope(z, w, pencil, 1.0, share)?, dot(w, &matrix.times(w))))
    }

    /// K·v at design and displacements.
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn stiffness_times(&self, z: &[f64], pencil: Pencil, vectors: &[Vec<f64>]) -> Result<Vec<Vec<f64>>, EvaluationError> {
        let k = self.energies.matrix(z, pencil, 1.0, 0.0)?;
        Ok(vectors.iter().map(|vector| k.times(vector)).collect())
    }
}

fn pencil(one: &Eigenvalue, cuts: &[Cut]) -> Pencil {
    match *one {
        Eigenvalue::Number(pencil, _) => pencil,
        Eigenvalue::Cut(cut) => cuts[cut as usize].pencil,
    }
}

fn unsolved(cause: FactorizationError) -> EvaluationError {
    let cause = match cause {
        FactorizationError::Singular => "the structure is a mechanism: a motion meets no resistance".into(),
        other => other.to_string(),
    };
    EvaluationError::Invalid { term: "modes of the structure".into(), cause }
}

impl Solution {
    /// B − μK on the complement of a mode and of those that coincide with it.
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
    fn solution(&mut self, pencil: Pencil) -> Result<Arc<Solution>, EvaluationError> {
        if let Some((_, known)) = self.solutions.iter().find(|(known, _)| *known == pencil) {
            return Ok(Arc::clone(known));
        }
        let solution = Arc::new(self.modes.solution(&self.z, pencil, self.modes.needed(pencil))?);
        self.solutions.push((pencil, Arc::clone(&solution)));
        Ok(solution)
    }

    fn values(&mut self) -> Result<Vec<f64>, EvaluationError> {
        let modes = self.modes;
        let value = |one: &Eigenvalue| match *one {
            Eigenvalue::Number(pencil, number) => {
                let solution = self.solution(pencil)?;
                Ok(factor(pencil, modes.quotient(&self.z, pencil, &solution.spectrum, number as usize - 1)?))
            }
            Eigenvalue::Cut(cut) => self.value_of_cut(cut as usize),
        };
        modes.wanted.iter().map(value).collect()
    }

    /// The first derivatives of a value, and the second where they are asked for.
    fn smooth(&mut self, one: Eigenvalue, curved: bool) -> Result<Smooth, EvaluationError> {
        match one {
            Eigenvalue::Number(pencil, number) => self.of_number(pencil, number as usize - 1, curved),
            Eigenvalue::Cut(cut) => self.of_cut(cut as usize, curved),
        }
    }

    fn of_number(&mut self, pencil: Pencil, at: usize, curved: bool) -> Result<Smooth, EvaluationError> {
        let energies = &self.modes.energies;
        let solution = self.solution(pencil)?;
        let z = &self.z;
        let mu = self.modes.quotient(z, pencil, &solution.spectrum, at)?;
        if factor(pencil, mu) == NEVER {
            return Ok(Smooth { slope: vec![0.0; z.len()], curvature: Vec::new() });
        }
        let phi = &solution.spectrum.vectors[at];
        let [first, second] = pencil.slopes(mu);
        if !curved {
            let slope = energies.slope(z, phi, pencil, -mu, 1.0)?;
            return Ok(chained(slope, Vec::new(), &[], first, second));
        }
        let stiffness = energies.slope(z, phi, pencil, 1.0, 0.0)?;
        let Derivatives { slope, mut curvature, mixed } = energies.derivatives(z, phi, pencil, -mu, 1.0)?;
        let complement = solution.complement(at)?;
        let active: Vec<usize> =
            (0..slope.len()).filter(|&z| slope[z] != 0.0 || stiffness[z] != 0.0 || !mixed[z].is_empty()).collect();
        for (at, &i) in active.iter().enumerate() {
            for &j in &active[..=at] {
                curvature.push((i, j, -slope[i] * stiffness[j] - slope[j] * stiffness[i]));
            }
        }
        turned(&complement, &mixed, &mut curvature).map_err(unsolved)?;
        Ok(chained(slope, curvature, &active, first, second))
    }
}

/// The eigenvalue that users know, [`NEVER`] where there is none.
fn factor(pencil: Pencil, mu: f64) -> f64 {
    if mu > 0.0 { pencil.shown(mu).min(NEVER) } else { NEVER }
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
