//! Supernodal factors with pivots where the order puts them (faer): several times as fast as pivots sought by size, and only as good as
//! they turn out to be, which is looked at every time.

mod bunch_kaufman;
mod compressed;
mod quasi_definite;

pub(super) use bunch_kaufman::BunchKaufmanSolver;
pub(super) use quasi_definite::QuasiDefiniteSolver;

use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::CholeskySymbolicParams;

use super::{FactorizationError, Inertia};

fn parameters<'a>() -> CholeskySymbolicParams<'a> {
    CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..CholeskySymbolicParams::default()
    }
}

/// A lower triangle by columns, rows ascending, as the library takes it.
fn pattern<'a>(starts: &'a [usize], rows: &'a [usize]) -> SymbolicSparseColMatRef<'a, usize> {
    SymbolicSparseColMatRef::new_checked(starts.len() - 1, starts.len() - 1, starts, None, rows)
}

/// Counts a pivot; an error where it is lost in rounding: one of the entries of L below it is larger than this.
fn count(
    inertia: &mut Inertia,
    pivot: f64,
    mut below: impl Iterator<Item = f64>,
    largest: f64,
) -> Result<(), FactorizationError> {
    if !pivot.is_finite() || pivot == 0.0 || !below.all(|l| l.abs() <= largest) {
        return Err(FactorizationError::Singular);
    }
    *(if pivot > 0.0 { &mut inertia.positive } else { &mut inertia.negative }) += 1;
    Ok(())
}

fn failed(error: impl std::fmt::Debug) -> FactorizationError {
    FactorizationError::Library(format!("{error:?}"))
}
