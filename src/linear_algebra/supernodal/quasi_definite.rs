//! LDLᵀ without pivoting, for quasi-definite matrices: every symmetric order of [E, Bᵀ; B, −F] with E and F positive definite has such
//! factors (Vanderbei, SIAM J. Optim. 5, 1995). D then tells the inertia (Sylvester).

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::perm::PermRef;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, Par, Side};
use feral::CscMatrix;

use super::super::guarded::Factors;
use super::super::ordering::{fill_reducing, turns};
use super::{FactorizationError, Inertia, count, failed, parameters, pattern};

/// Entries of L beyond 1/√ε tell of a pivot that is lost in rounding (Gill, Saunders & Shinnerl, SIAM J. Matrix Anal. Appl. 17, 1996).
const LARGEST: f64 = 6.7e7;

/// Analysis, factors and room to work in.
pub struct QuasiDefiniteSolver {
    symbolic: SymbolicCholesky<usize>,
    factors: Vec<f64>,
    memory: MemBuffer,
}

impl QuasiDefiniteSolver {
    /// Analyses a pattern (lower triangle by columns, rows ascending).
    pub fn new(matrix: &CscMatrix) -> Result<Self, FactorizationError> {
        let order = fill_reducing(matrix).ok_or(FactorizationError::Singular)?;
        let turns = turns(&order);
        let order = SymmetricOrdering::Custom(PermRef::new_checked(&order, &turns, matrix.n));
        let pattern = pattern(&matrix.col_ptr, &matrix.row_idx);
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, order, parameters()).map_err(failed)?;
        let room = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        let memory = MemBuffer::try_new(room).map_err(failed)?;
        Ok(QuasiDefiniteSolver { factors: vec![0.0; symbolic.len_val()], symbolic, memory })
    }

    /// The signs of D, if L is no larger than it may be.
    fn inertia(&self) -> Result<Inertia, FactorizationError> {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else { return Err(FactorizationError::Singular) };
        let factors = SupernodalLdltRef::new(symbolic, &self.factors);
        let mut inertia = Inertia { positive: 0, negative: 0, zero: 0 };
        for s in 0..symbolic.n_supernodes() {
            let block = factors.supernode(s).val();
            // Column by column D, and below it L.
            for k in 0..block.ncols() {
                let below = block.col(k).subrows(k + 1, block.nrows() - k - 1);
                count(&mut inertia, block[(k, k)], below.iter().copied(), LARGEST)?;
            }
        }
        Ok(inertia)
    }
}

impl Factors for QuasiDefiniteSolver {
    fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        let values = SparseColMatRef::new(pattern(&matrix.col_ptr, &matrix.row_idx), &matrix.values);
        let stack = MemStack::new(&mut self.memory);
        self.symbolic
            .factorize_numeric_ldlt(
                &mut self.factors,
                values,
                Side::Lower,
                LdltRegularization::default(),
                Par::Seq,
                stack,
                Default::default(),
            )
            .map_err(|_| FactorizationError::Singular)?;
        self.inertia()
    }

    fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        x.copy_from_slice(right);
        let room: StackReq = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::try_new(room).map_err(failed)?;
        let x = MatMut::from_column_major_slice_mut(x, right.len(), 1);
        LdltRef::new(&self.symbolic, &self.factors).solve_in_place_with_conj(Conj::No, x, Par::Seq, MemStack::new(&mut memory));
        Ok(())
    }
}
