//! Eigenvalues as rows of a model over design and displacements.

mod cuts;
mod directions;
mod energies;
mod single;
mod smooth;
mod with_modes;

pub(super) use with_modes::WithModes;

use super::Numbering;
use crate::linear_algebra::FactorizationError;
use crate::linear_algebra::pencil::{Matrix, Spectrum, spectrum};
use crate::math::dot;
use crate::model::{AssemblyError, EvaluationError};
use crate::problem::Problem;
use crate::problem::modes::{Cut, Eigenvalue, NEVER, Pencil};
use crate::problem::statics::Statics;
use crate::problem::structure::Structure;
use cuts::System;
use energies::Energies;
use single::Single;
use smooth::Smooth;
use std::sync::Arc;

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
    stiffness: Option<Arc<Matrix>>,
    solutions: Vec<(Pencil, Arc<Solution>)>,
    /// Single modes with their derivatives, by pencil and place.
    singles: Vec<(Pencil, usize, Arc<Single>)>,
    /// What cuts of one cluster share, by the first of them asked about.
    systems: Vec<(usize, Arc<System>)>,
}

/// The matrices of a pencil, and their modes.
struct Solution {
    k: Arc<Matrix>,
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
        Solved { modes: self, z: z.to_vec(), stiffness: None, solutions: Vec::new(), singles: Vec::new(), systems: Vec::new() }
    }

    /// The largest μ of a pencil and their φ at design and displacements, at least `count` where there are as many above zero.
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn spectrum(&self, z: &[f64], pencil: Pencil, count: usize) -> Result<Spectrum, EvaluationError> {
        let k = Arc::new(self.energies.matrix(z, pencil, 1.0, 0.0)?);
        self.solution(z, pencil, count, k).map(|solution| solution.spectrum)
    }

    /// The values asked for at design and displacements, as users know them; [`NEVER`] where so many modes do not buckle.
    ///
    /// # Errors
    /// The structure is a mechanism, or a matrix has no value.
    pub fn values(&self, z: &[f64]) -> Result<Vec<f64>, EvaluationError> {
        self.at(z).values()
    }

    fn solution(&self, z: &[f64], pencil: Pencil, count: usize, k: Arc<Matrix>) -> Result<Solution, EvaluationError> {
        let b = self.energies.matrix(z, pencil, 0.0, 1.0)?;
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

impl Solved<'_> {
    fn solution(&mut self, pencil: Pencil) -> Result<Arc<Solution>, EvaluationError> {
        if let Some((_, known)) = self.solutions.iter().find(|(known, _)| *known == pencil) {
            return Ok(Arc::clone(known));
        }
        let k = self.stiffness(pencil)?;
        let solution = Arc::new(self.modes.solution(&self.z, pencil, self.modes.needed(pencil), k)?);
        self.solutions.push((pencil, Arc::clone(&solution)));
        Ok(solution)
    }

    /// K: every pencil's is the same.
    fn stiffness(&mut self, pencil: Pencil) -> Result<Arc<Matrix>, EvaluationError> {
        if let Some(known) = &self.stiffness {
            return Ok(Arc::clone(known));
        }
        let k = Arc::new(self.modes.energies.matrix(&self.z, pencil, 1.0, 0.0)?);
        Ok(Arc::clone(self.stiffness.insert(k)))
    }

    fn values(&mut self) -> Result<Vec<f64>, EvaluationError> {
        let modes = self.modes;
        let value = |one: &Eigenvalue| match *one {
            Eigenvalue::Number(pencil, number) => self.value_of_number(pencil, number as usize - 1),
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
}

/// The eigenvalue that users know, [`NEVER`] where there is none.
fn factor(pencil: Pencil, mu: f64) -> f64 {
    if mu > 0.0 { pencil.shown(mu).min(NEVER) } else { NEVER }
}
