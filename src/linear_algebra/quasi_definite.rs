//! LDLᵀ without pivoting (supernodal), for quasi-definite matrices: every symmetric order of [E, Bᵀ; B, −F] with E and F positive
//! definite has such factors (Vanderbei, SIAM J. Optim. 5, 1995). D then tells the inertia (Sylvester).

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::ldlt::factor::LdltRegularization;
use faer::perm::PermRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::supernodal::SupernodalLdltRef;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side};
use feral::CscMatrix;

use super::ordering::fill_reducing;
use super::{FactorizationError, Inertia};

/// Entries of L beyond 1/√ε tell of a pivot that is lost in rounding (Gill, Saunders & Shinnerl, SIAM J. Matrix Anal. Appl. 17, 1996).
const LARGEST_FACTOR: f64 = 6.7e7;

/// Analysis, factors and room to work in.
pub(super) struct QuasiDefiniteSolver {
    symbolic: SymbolicCholesky<usize>,
    factors: Vec<f64>,
    memory: MemBuffer,
}

impl QuasiDefiniteSolver {
    /// Analyses a pattern (lower triangle by columns, rows ascending).
    pub fn new(matrix: &CscMatrix) -> Result<Self, FactorizationError> {
        let order = fill_reducing(matrix).ok_or(FactorizationError::Singular)?;
        let mut turn = vec![0; matrix.n];
        for (k, &j) in order.iter().enumerate() {
            turn[j] = k;
        }
        let parameters = CholeskySymbolicParams {
            supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
            ..CholeskySymbolicParams::default()
        };
        let order = SymmetricOrdering::Custom(PermRef::new_checked(&order, &turn, matrix.n));
        let symbolic = factorize_symbolic_cholesky(pattern(matrix), Side::Lower, order, parameters).map_err(failed)?;
        let room = symbolic.factorize_numeric_ldlt_scratch::<f64>(Par::Seq, Default::default());
        let memory = MemBuffer::try_new(room).map_err(failed)?;
        Ok(QuasiDefiniteSolver { factors: vec![0.0; symbolic.len_val()], symbolic, memory })
    }

    /// Factorises. [`FactorizationError::Singular`] where a pivot is lost in rounding.
    pub fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        if !matrix.values.iter().all(|value| value.is_finite()) {
            return Err(FactorizationError::Library("a value is no number".into()));
        }
        let values = SparseColMatRef::new(pattern(matrix), &matrix.values);
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

    /// The signs of D, if L is no larger than it may be.
    fn inertia(&self) -> Result<Inertia, FactorizationError> {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else { return Err(FactorizationError::Singular) };
        let factors = SupernodalLdltRef::new(symbolic, &self.factors);
        let mut inertia = Inertia { positive: 0, negative: 0, zero: 0 };
        for s in 0..symbolic.n_supernodes() {
            let block = factors.supernode(s).val();
            // Column by column D, and below it L.
            for k in 0..block.ncols() {
                let (pivot, below) = (block[(k, k)], block.col(k).subrows(k + 1, block.nrows() - k - 1));
                let fits = below.iter().all(|l| l.abs() <= LARGEST_FACTOR);
                if !pivot.is_finite() || pivot == 0.0 || !fits {
                    return Err(FactorizationError::Singular);
                }
                *(if pivot > 0.0 { &mut inertia.positive } else { &mut inertia.negative }) += 1;
            }
        }
        Ok(inertia)
    }

    /// x = A⁻¹·right, without refinement.
    pub fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        x.copy_from_slice(right);
        let room: StackReq = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::try_new(room).map_err(failed)?;
        let x = MatMut::from_column_major_slice_mut(x, right.len(), 1);
        LdltRef::new(&self.symbolic, &self.factors).solve_in_place_with_conj(Conj::No, x, Par::Seq, MemStack::new(&mut memory));
        Ok(())
    }
}

fn pattern(matrix: &CscMatrix) -> SymbolicSparseColMatRef<'_, usize> {
    SymbolicSparseColMatRef::new_checked(matrix.n, matrix.n, &matrix.col_ptr, None, &matrix.row_idx)
}

fn failed(error: impl std::fmt::Debug) -> FactorizationError {
    FactorizationError::Library(format!("{error:?}"))
}
