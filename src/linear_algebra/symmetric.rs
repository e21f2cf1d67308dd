//! LDLᵀ of a sparse symmetric indefinite matrix: analyse once, factorise often, solve with refinement.

use feral::CscMatrix;

use super::certainty::is_certain;
use super::dense::{self, DenseSolver};
use super::guarded::GuardedSolver;
use super::ordering::positions;
use super::sparse::SparseSolver;
use super::supernodal::{BunchKaufmanSolver, QuasiDefiniteSolver};
use super::{Effort, FactorizationError, Inertia};

/// A factorisation that keeps its symbolic analysis from one set of values to the next.
///
/// ```
/// use ribopt::linear_algebra::{Inertia, SymmetricSolver};
/// // [ 2 1 ]
/// // [ 1 0 ]  lower triangle by rows: (0,0), (1,0), (1,1)
/// let mut solver = SymmetricSolver::new(&[0, 1, 3], &[0, 0, 1]).unwrap();
/// let inertia = solver.factor(&[2.0, 1.0, 0.0]).unwrap();
/// assert_eq!(inertia, Inertia { positive: 1, negative: 1, zero: 0 });
/// let mut x = [0.0; 2];
/// solver.solve(&[3.0, 1.0], &mut x).unwrap();
/// assert!((x[0] - 1.0).abs() < 1e-15 && (x[1] - 1.0).abs() < 1e-15);
/// ```
pub struct SymmetricSolver {
    /// The library's layout: lower triangle by columns.
    matrix: CscMatrix,
    /// Where each position of the caller's pattern stands there.
    places: Vec<usize>,
    method: Method,
}

/// How pivots are chosen.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) enum Pivoting {
    /// By size.
    Threshold,
    /// The same in an order by the pattern alone: analysed in half the time, for few factors, which are looked at.
    ThresholdByPattern,
    /// By size within supernodes, as long as that goes well.
    WithinSupernodes,
    /// Not at all, as long as that goes well.
    Static,
}

/// Which factorisation is used.
enum Method {
    Sparse(SparseSolver),
    Guarded(Box<GuardedSolver>),
    /// For orders up to [`dense::LARGEST_ORDER`]: faster, for want of anything to organise.
    Dense(Box<DenseSolver>),
}

impl SymmetricSolver {
    /// A solver for matrices whose lower triangle has, in row i, the columns `columns[offsets[i]..offsets[i + 1]]`
    /// (ascending, at most i). Diagonal positions may be left out.
    pub fn new(offsets: &[usize], columns: &[u32]) -> Result<Self, FactorizationError> {
        Self::with_pivoting(offsets, columns, Pivoting::Threshold)
    }

    /// The same for matrices that are quasi-definite most of the time, [E, Bᵀ; B, −F] with E and F positive definite: pivots are
    /// taken as they come, which is faster and less accurate, but where one is too small.
    pub fn for_quasi_definite(offsets: &[usize], columns: &[u32]) -> Result<Self, FactorizationError> {
        Self::with_pivoting(offsets, columns, Pivoting::Static)
    }

    /// The same as [`SymmetricSolver::new`] for few matrices of one pattern, analysed in half the time.
    pub fn for_few(offsets: &[usize], columns: &[u32]) -> Result<Self, FactorizationError> {
        Self::with_pivoting(offsets, columns, Pivoting::ThresholdByPattern)
    }

    pub(super) fn with_pivoting(offsets: &[usize], columns: &[u32], pivoting: Pivoting) -> Result<Self, FactorizationError> {
        check(offsets, columns)?;
        let n = offsets.len() - 1;
        let mut starts = vec![0; n + 1];
        for &column in columns {
            starts[column as usize + 1] += 1;
        }
        for j in 0..n {
            starts[j + 1] += starts[j];
        }
        let mut next = starts.clone();
        let mut rows = vec![0; columns.len()];
        let mut places = vec![0; columns.len()];
        for row in 0..n {
            for at in offsets[row]..offsets[row + 1] {
                let place = &mut next[columns[at] as usize];
                rows[*place] = row;
                places[at] = *place;
                *place += 1;
            }
        }
        let matrix = CscMatrix { n, col_ptr: starts, row_idx: rows, values: vec![0.0; columns.len()] };
        let method = if n <= dense::LARGEST_ORDER {
            Method::Dense(Box::new(DenseSolver::new(n)))
        } else {
            match pivoting {
                Pivoting::Threshold => Method::Sparse(SparseSolver::default()),
                Pivoting::ThresholdByPattern => Method::Sparse(SparseSolver::by_pattern()),
                Pivoting::WithinSupernodes => {
                    Method::Guarded(Box::new(GuardedSolver::new(|matrix| Ok(Box::new(BunchKaufmanSolver::new(matrix)?)))))
                }
                Pivoting::Static => {
                    Method::Guarded(Box::new(GuardedSolver::new(|matrix| Ok(Box::new(QuasiDefiniteSolver::new(matrix)?)))))
                }
            }
        };
        Ok(SymmetricSolver { matrix, places, method })
    }

    /// The order n of the matrix.
    pub fn order(&self) -> usize {
        self.matrix.n
    }

    /// Factorises the matrix with these values along the pattern. The analysis is done at the first call and kept.
    pub fn factor(&mut self, values: &[f64]) -> Result<Inertia, FactorizationError> {
        self.factor_by(values, Effort::Any)
    }

    /// The same with no more effort than this.
    pub(super) fn factor_by(&mut self, values: &[f64], effort: Effort) -> Result<Inertia, FactorizationError> {
        if values.len() != self.places.len() {
            let sizes = format!("{} values for {} positions", values.len(), self.places.len());
            return Err(FactorizationError::Pattern(sizes));
        }
        if self.order() == 0 {
            return Ok(Inertia { positive: 0, negative: 0, zero: 0 });
        }
        for (&place, &value) in self.places.iter().zip(values) {
            self.matrix.values[place] = value;
        }
        match &mut self.method {
            Method::Dense(solver) => solver.factor(&self.matrix),
            Method::Sparse(solver) => solver.factor(&self.matrix),
            Method::Guarded(solver) => solver.factor(&self.matrix, effort),
        }
    }

    /// The same where the inertia proves something.
    ///
    /// # Errors
    /// [`FactorizationError::Uncertain`] where rounding may have changed it, even with large pivots unless these are more than the effort.
    pub fn certain_inertia(&mut self, values: &[f64], effort: Effort) -> Result<Inertia, FactorizationError> {
        let found = self.factor(values)?;
        if self.is_certain() {
            return Ok(found);
        }
        let can_be_firmer = match &mut self.method {
            Method::Sparse(solver) => effort == Effort::Any && solver.make_firm(),
            _ => false,
        };
        if !can_be_firmer {
            return Err(FactorizationError::Uncertain);
        }
        let found = self.factor(values)?;
        if self.is_certain() { Ok(found) } else { Err(FactorizationError::Uncertain) }
    }

    /// Whether rounding has no part in the inertia found last.
    fn is_certain(&self) -> bool {
        if let Method::Dense(_) = self.method {
            return true;
        }
        let entries = || positions(&self.matrix).zip(&self.matrix.values).map(|((i, j), &value)| (i, j, value));
        is_certain(self.order(), entries, |right| {
            let mut x = vec![0.0; right.len()];
            self.solve_once(right, &mut x).ok().map(|()| x)
        })
    }

    /// x = A⁻¹·right for the matrix factorised last, refined until its residual is down to rounding (not without pivoting: there
    /// the caller refines).
    pub fn solve(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        if self.order() == 0 {
            return Ok(());
        }
        match &self.method {
            Method::Dense(solver) => solver.solve(right, x),
            Method::Sparse(solver) => solver.solve(&self.matrix, right, x),
            Method::Guarded(_) => self.solve_once(right, x),
        }
    }

    /// x = A⁻¹·right without refinement, for callers who refine themselves.
    pub fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        match &self.method {
            Method::Sparse(solver) if self.order() > 0 => solver.solve_once(right, x),
            Method::Guarded(solver) => solver.solve_once(right, x),
            _ => self.solve(right, x),
        }
    }
}

fn check(offsets: &[usize], columns: &[u32]) -> Result<(), FactorizationError> {
    let wrong = |what: String| Err(FactorizationError::Pattern(what));
    if offsets.first() != Some(&0) || offsets.last() != Some(&columns.len()) {
        return wrong(format!("offsets must run from 0 to {}", columns.len()));
    }
    for (row, bounds) in offsets.windows(2).enumerate() {
        let Some(own) = columns.get(bounds[0]..bounds[1]) else {
            return wrong(format!("the offsets of row {row} do not ascend"));
        };
        if own.windows(2).any(|pair| pair[0] >= pair[1]) || own.last().is_some_and(|&last| last as usize > row) {
            return wrong(format!("row {row} must have ascending columns up to {row}"));
        }
    }
    Ok(())
}

#[cfg(test)]
mod tests;
