//! LDLᵀ of a sparse symmetric indefinite matrix: analyse once, factorise often, solve with refinement.

use feral::CscMatrix;

use super::dense::{self, DenseSolver};
use super::guarded::GuardedSolver;
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
mod tests {
    use super::*;

    /// The lower triangle of a dense symmetric matrix, zeros left out.
    fn sparse(rows: &[&[f64]]) -> (Vec<usize>, Vec<u32>, Vec<f64>) {
        let (mut offsets, mut columns, mut values) = (vec![0], Vec::new(), Vec::new());
        for (i, row) in rows.iter().enumerate() {
            for (j, &value) in row.iter().enumerate().take(i + 1).filter(|(_, value)| **value != 0.0) {
                columns.push(j as u32);
                values.push(value);
            }
            offsets.push(columns.len());
        }
        (offsets, columns, values)
    }

    #[test]
    fn a_kkt_matrix_has_the_inertia_of_its_blocks() {
        let (offsets, columns, values) = sparse(&[&[4.0], &[1.0, 3.0], &[0.0, 0.0, 5.0], &[1.0, 1.0, 1.0, 0.0]]);
        let mut solver = SymmetricSolver::new(&offsets, &columns).unwrap();
        assert_eq!(solver.factor(&values).unwrap(), Inertia { positive: 3, negative: 1, zero: 0 });
        let mut x = vec![0.0; 4];
        solver.solve(&[1.0, 2.0, 3.0, 4.0], &mut x).unwrap();
        let residual = [4.0 * x[0] + x[1] + x[3] - 1.0, x[0] + 3.0 * x[1] + x[3] - 2.0, 5.0 * x[2] + x[3] - 3.0];
        assert!(residual.iter().all(|r| r.abs() < 1e-14), "{residual:?}");
        assert!((x[0] + x[1] + x[2] - 4.0).abs() < 1e-14);
    }

    #[test]
    fn dependent_rows_are_seen_as_zero_eigenvalues_or_singular() {
        let (offsets, columns, values) = sparse(&[&[1.0], &[0.0, 1.0], &[1.0, 1.0, 0.0], &[1.0, 1.0, 0.0, 0.0]]);
        let mut solver = SymmetricSolver::new(&offsets, &columns).unwrap();
        match solver.factor(&values) {
            Ok(inertia) => assert!(inertia.zero >= 1, "{inertia:?}"),
            Err(error) => assert_eq!(error, FactorizationError::Singular),
        }
    }

    #[test]
    fn new_values_replace_the_old_ones() {
        let mut solver = SymmetricSolver::new(&[0, 1, 3], &[0, 0, 1]).unwrap();
        for scale in [1.0, -2.0, 1e-9] {
            solver.factor(&[2.0 * scale, scale, 3.0 * scale]).unwrap();
            let mut x = [0.0; 2];
            solver.solve(&[3.0 * scale, 4.0 * scale], &mut x).unwrap();
            assert!((x[0] - 1.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14, "{x:?}");
        }
    }

    #[test]
    fn larger_matrices_are_analysed_once() {
        let n = dense::LARGEST_ORDER + 5;
        // An arrow: diagonal and last row.
        let mut offsets: Vec<usize> = (0..n).collect();
        offsets.push(2 * n - 1);
        let columns: Vec<u32> = (0..n as u32 - 1).chain(0..n as u32).collect();
        let mut solver = SymmetricSolver::new(&offsets, &columns).unwrap();
        for scale in [1.0, -3.0, 1e-7] {
            let values: Vec<f64> = (0..2 * n - 1).map(|at| scale * if at < n - 1 { 2.0 } else { 1.0 }).collect();
            let inertia = solver.factor(&values).unwrap();
            let (more, fewer) = (n - 1, 1);
            let expected = if scale > 0.0 { (more, fewer) } else { (fewer, more) };
            assert_eq!((inertia.positive, inertia.negative), expected);
            let right: Vec<f64> = (0..n).map(|i| scale * if i < n - 1 { 3.0 } else { n as f64 }).collect();
            let mut x = vec![0.0; n];
            solver.solve(&right, &mut x).unwrap();
            assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-13), "{x:?}");
        }
        match &solver.method {
            Method::Sparse(sparse) => assert_eq!(sparse.analyses(), 1),
            _ => panic!("order {n} is for the sparse method"),
        }
    }

    #[test]
    fn pivots_as_they_come_serve_quasi_definite_matrices_and_give_way_to_others() {
        let n = dense::LARGEST_ORDER + 1;
        // A chain, every second unknown with the other sign on the diagonal.
        let offsets: Vec<usize> = (0..=n).map(|row| if row == 0 { 0 } else { 2 * row - 1 }).collect();
        let columns: Vec<u32> = (0..n as u32).flat_map(|row| row.saturating_sub(1)..=row).collect();
        let mut solver = SymmetricSolver::for_quasi_definite(&offsets, &columns).unwrap();
        let values = |size: f64| -> Vec<f64> {
            let diagonal = |row: usize| if row.is_multiple_of(2) { size } else { -size };
            (0..2 * n - 1).map(|at| if at % 2 == 0 { diagonal(at / 2) } else { 1.0 }).collect()
        };
        // Without a diagonal the first pivot is missing.
        for size in [2.0, 0.0, 3.0] {
            let mut values = values(size);
            values[2 * n - 2] = 1.0;
            let inertia = solver.factor(&values).unwrap();
            assert_eq!((inertia.positive, inertia.negative), (n - n / 2, n / 2), "{size}");
            let mut x = vec![0.0; n];
            let right: Vec<f64> = (0..n)
                .map(|row| {
                    let beside = f64::from(u8::from(row > 0)) + f64::from(u8::from(row + 1 < n));
                    beside + values[2 * row]
                })
                .collect();
            solver.solve(&right, &mut x).unwrap();
            assert!(x.iter().all(|x| (x - 1.0).abs() < 1e-12), "{x:?}");
        }
    }

    #[test]
    fn no_number_and_wrong_shapes_are_errors() {
        assert!(matches!(SymmetricSolver::new(&[0, 1], &[1]), Err(FactorizationError::Pattern(_))));
        assert!(matches!(SymmetricSolver::new(&[0, 2, 1], &[0]), Err(FactorizationError::Pattern(_))));
        assert!(matches!(SymmetricSolver::new(&[], &[]), Err(FactorizationError::Pattern(_))));
        let mut solver = SymmetricSolver::new(&[0, 1], &[0]).unwrap();
        assert!(matches!(solver.factor(&[f64::NAN]), Err(FactorizationError::Library(_))));
        assert!(matches!(solver.factor(&[]), Err(FactorizationError::Pattern(_))));
    }

    #[test]
    fn the_empty_matrix_is_fine() {
        let mut solver = SymmetricSolver::new(&[0], &[]).unwrap();
        assert_eq!(solver.factor(&[]).unwrap(), Inertia { positive: 0, negative: 0, zero: 0 });
        solver.solve(&[], &mut []).unwrap();
    }
}
