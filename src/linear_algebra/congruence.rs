//! Sparse symmetric matrices in a basis in which they are sparser still.
//!
//! Where two unknowns i, j are coupled to most others by proportional columns, a_ik = r·a_jk, the direction e_i − r·e_j is coupled to
//! hardly anything: TᵀAT with that direction in the place of e_i has fewer entries, the same inertia, and factors that cost a fraction.
//! Sizing problems in logarithms are full of such pairs (a volume feels width and height through their product alone). Pairs are
//! found in the numbers; at every factorisation the entries left out are computed again, and the plain matrix is taken from the
//! first time on that one of them is not zero.

mod pairs;
mod transformed;

use super::symmetric::Pivoting;
use super::{Effort, FactorizationError, Inertia, SymmetricSolver};
use transformed::Transformed;

/// A solver like [`SymmetricSolver`] that changes the basis where that pays.
pub struct CongruentSolver {
    pivoting: Pivoting,
    offsets: Vec<usize>,
    columns: Vec<u32>,
    basis: Basis,
}

enum Basis {
    /// No values telling enough were seen yet.
    Unknown(SymmetricSolver),
    Plain(SymmetricSolver),
    Changed {
        transformed: Box<Transformed>,
        solver: SymmetricSolver,
    },
}

impl CongruentSolver {
    /// A solver for a lower triangle by rows, as [`SymmetricSolver::new`] takes it.
    pub fn new(offsets: Vec<usize>, columns: Vec<u32>) -> Result<Self, FactorizationError> {
        Self::with_pivoting(offsets, columns, Pivoting::ThresholdByPattern)
    }

    /// The same for quasi-definite matrices: [`SymmetricSolver::for_quasi_definite`].
    pub fn for_quasi_definite(offsets: Vec<usize>, columns: Vec<u32>) -> Result<Self, FactorizationError> {
        Self::with_pivoting(offsets, columns, Pivoting::Static)
    }

    /// The same as [`CongruentSolver::new`] for many matrices [W, Aᵀ; A, 0] of one pattern that has small separators; callers refine.
    pub fn for_saddle_points(offsets: Vec<usize>, columns: Vec<u32>) -> Result<Self, FactorizationError> {
        Self::with_pivoting(offsets, columns, Pivoting::WithinSupernodes)
    }

    fn with_pivoting(offsets: Vec<usize>, columns: Vec<u32>, pivoting: Pivoting) -> Result<Self, FactorizationError> {
        let plain = SymmetricSolver::with_pivoting(&offsets, &columns, pivoting)?;
        Ok(CongruentSolver { pivoting, offsets, columns, basis: Basis::Unknown(plain) })
    }

    /// Factorises the matrix with these values along the pattern.
    pub fn factor(&mut self, values: &[f64]) -> Result<Inertia, FactorizationError> {
        self.factor_by(values, Effort::Any)
    }

    /// The same with no more effort than this.
    pub fn factor_by(&mut self, values: &[f64], effort: Effort) -> Result<Inertia, FactorizationError> {
        self.factor_with(values, |solver, values| solver.factor_by(values, effort))
    }

    /// The same where the inertia proves something: [`SymmetricSolver::certain_inertia`].
    pub fn certain_inertia(&mut self, values: &[f64], effort: Effort) -> Result<Inertia, FactorizationError> {
        self.factor_with(values, |solver, values| solver.certain_inertia(values, effort))
    }

    fn factor_with(
        &mut self,
        values: &[f64],
        factor: impl Fn(&mut SymmetricSolver, &[f64]) -> Result<Inertia, FactorizationError>,
    ) -> Result<Inertia, FactorizationError> {
        if let Basis::Unknown(_) = &self.basis
            && pairs::is_telling(&self.offsets, &self.columns, values)
        {
            self.choose(values)?;
        }
        match &mut self.basis {
            Basis::Unknown(solver) | Basis::Plain(solver) => return factor(solver, values),
            Basis::Changed { transformed, solver } => {
                if let Some(values) = transformed.values(values) {
                    return factor(solver, values);
                }
            }
        }
        let mut plain = self.solver(&self.offsets, &self.columns)?;
        let inertia = factor(&mut plain, values);
        self.basis = Basis::Plain(plain);
        inertia
    }

    fn solver(&self, offsets: &[usize], columns: &[u32]) -> Result<SymmetricSolver, FactorizationError> {
        SymmetricSolver::with_pivoting(offsets, columns, self.pivoting)
    }

    /// Finds the basis for these values and all that follow.
    fn choose(&mut self, values: &[f64]) -> Result<(), FactorizationError> {
        let partners = pairs::find(&self.offsets, &self.columns, values);
        let basis = match Transformed::new(&self.offsets, &self.columns, values, partners) {
            Some(transformed) => {
                let (offsets, columns) = transformed.pattern();
                Basis::Changed { solver: self.solver(offsets, columns)?, transformed: Box::new(transformed) }
            }
            None => Basis::Plain(self.solver(&self.offsets, &self.columns)?),
        };
        self.basis = basis;
        Ok(())
    }

    /// x = A⁻¹·right for the matrix factorised last, refined.
    pub fn solve(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        self.solve_by(right, x, SymmetricSolver::solve)
    }

    /// The same without refinement, for callers who refine themselves.
    pub fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        self.solve_by(right, x, SymmetricSolver::solve_once)
    }

    fn solve_by(
        &self,
        right: &[f64],
        x: &mut [f64],
        solve: impl Fn(&SymmetricSolver, &[f64], &mut [f64]) -> Result<(), FactorizationError>,
    ) -> Result<(), FactorizationError> {
        match &self.basis {
            Basis::Unknown(solver) | Basis::Plain(solver) => solve(solver, right, x),
            Basis::Changed { transformed, solver } => {
                solve(solver, &transformed.inward(right), x)?;
                transformed.outward(x);
                Ok(())
            }
        }
    }
}

#[cfg(test)]
mod tests;
