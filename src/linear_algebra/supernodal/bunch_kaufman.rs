//! LDLᵀ with pivots of order one and two sought by size within each supernode (Bunch & Kaufman, Math. Comp. 31, 1977), for indefinite
//! matrices whose unknowns without a pivot of their own stand beside one that they make a pivot with: see [`super::compressed`].

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::perm::PermRef;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::cholesky::supernodal::SupernodalIntranodeLbltRef;
use faer::sparse::linalg::cholesky::{
    IntranodeLbltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, factorize_symbolic_cholesky,
};
use faer::{Conj, MatMut, MatRef, Par, Side};
use feral::CscMatrix;

use super::super::guarded::Factors;
use super::super::ordering::{fill_reducing, positions, turns};
use super::compressed::Compressed;
use super::{FactorizationError, Inertia, count, failed, parameters, pattern};

/// Sweeps of scaling: each halves the logarithms of the rows' largest entries (Ruiz, RAL-TR-2001-034), 10¹⁶ comes to within 3.
const SWEEPS: usize = 5;

/// A pivot d below an entry a of the scaled matrix, |a| ≤ 1, leaves rounding of ε·a²/d ≤ ε·|a/d| in what is eliminated next: no more than
/// 1e−4 of the matrix, which refinement takes away.
const LARGEST: f64 = 1e-4 / f64::EPSILON;

/// Analysis, factors and room to work in.
pub struct BunchKaufmanSolver {
    symbolic: SymbolicCholesky<usize>,
    /// The scaled matrix along the pattern that was analysed.
    scaled: CscMatrix,
    /// Where each value of the caller's matrix stands there.
    places: Vec<usize>,
    scales: Vec<f64>,
    factors: Vec<f64>,
    /// Below the diagonal of D; zero but in pivots of order two.
    subdiagonal: Vec<f64>,
    /// The order of the pivots within supernodes, and its inverse.
    pivots: (Vec<usize>, Vec<usize>),
    memory: MemBuffer,
}

impl BunchKaufmanSolver {
    /// Pairs unknowns by the values of this matrix and analyses its pattern (lower triangle by columns, rows ascending).
    pub fn new(matrix: &CscMatrix) -> Result<Self, FactorizationError> {
        let groups = Compressed::new(matrix)?;
        let order = fill_reducing(&groups.graph(matrix)).ok_or(FactorizationError::Singular)?;
        let order = groups.expanded(&order);
        let turns = turns(&order);
        let scaled = groups.united(matrix);
        let order = SymmetricOrdering::Custom(PermRef::new_checked(&order, &turns, matrix.n));
        let pattern = pattern(&scaled.col_ptr, &scaled.row_idx);
        let symbolic = factorize_symbolic_cholesky(pattern, Side::Lower, order, parameters()).map_err(failed)?;
        let room = symbolic.factorize_numeric_intranode_lblt_scratch::<f64>(Par::Seq, Default::default());
        Ok(BunchKaufmanSolver {
            memory: MemBuffer::try_new(room).map_err(failed)?,
            places: places(matrix, &scaled),
            scaled,
            scales: Vec::new(),
            factors: vec![0.0; symbolic.len_val()],
            subdiagonal: vec![0.0; matrix.n],
            pivots: (vec![0; matrix.n], vec![0; matrix.n]),
            symbolic,
        })
    }

    fn permutation(&self) -> PermRef<'_, usize> {
        PermRef::new_checked(&self.pivots.0, &self.pivots.1, self.scaled.n)
    }

    /// The signs of D, if it is more than rounding, of the scaled matrix, whose entries are 1 at the most, and L no larger than it may be.
    fn inertia(&self) -> Result<Inertia, FactorizationError> {
        let SymbolicCholeskyRaw::Supernodal(symbolic) = self.symbolic.raw() else { return Err(FactorizationError::Singular) };
        let factors = SupernodalIntranodeLbltRef::new(symbolic, &self.factors, &self.subdiagonal, self.permutation());
        let mut inertia = Inertia { positive: 0, negative: 0, zero: 0 };
        for s in 0..symbolic.n_supernodes() {
            let supernode = factors.supernode(s);
            let first = supernode.start();
            self.count_pivots(supernode.val(), &self.subdiagonal[first..], &mut inertia)?;
        }
        Ok(inertia)
    }

    fn count_pivots(&self, block: MatRef<'_, f64>, beside: &[f64], inertia: &mut Inertia) -> Result<(), FactorizationError> {
        let rounding = self.scaled.n as f64 * f64::EPSILON;
        let below = |k: usize, from: usize| block.col(k).subrows(from, block.nrows() - from).iter().copied();
        let mut k = 0;
        while k < block.ncols() {
            let (pivot, off) = (block[(k, k)], beside[k]);
            if off == 0.0 || k + 1 == block.ncols() {
                if pivot.abs() <= rounding {
                    return Err(FactorizationError::Singular);
                }
                count(inertia, pivot, below(k, k + 1), LARGEST)?;
                k += 1;
            } else {
                // Of two eigenvalues with a negative product one is negative; with a positive one both have the diagonal's sign.
                let determinant = pivot * block[(k + 1, k + 1)] - off * off;
                let first = if determinant < 0.0 { 1.0 } else { pivot };
                count(inertia, first, below(k, k + 2), LARGEST)?;
                count(inertia, first * determinant, below(k + 1, k + 2), LARGEST)?;
                k += 2;
            }
        }
        Ok(())
    }
}

impl Factors for BunchKaufmanSolver {
    fn factor(&mut self, matrix: &CscMatrix) -> Result<Inertia, FactorizationError> {
        self.scales = equilibrated(matrix);
        for ((&place, value), (i, j)) in self.places.iter().zip(&matrix.values).zip(positions(matrix)) {
            self.scaled.values[place] = value * self.scales[i] * self.scales[j];
        }
        let values = SparseColMatRef::new(pattern(&self.scaled.col_ptr, &self.scaled.row_idx), &self.scaled.values);
        let stack = MemStack::new(&mut self.memory);
        self.symbolic.factorize_numeric_intranode_lblt(
            &mut self.factors,
            &mut self.subdiagonal,
            &mut self.pivots.0,
            &mut self.pivots.1,
            values,
            Side::Lower,
            Par::Seq,
            stack,
            Default::default(),
        );
        self.inertia()
    }

    fn solve_once(&self, right: &[f64], x: &mut [f64]) -> Result<(), FactorizationError> {
        x.iter_mut().zip(right).zip(&self.scales).for_each(|((x, right), scale)| *x = right * scale);
        let room: StackReq = self.symbolic.solve_in_place_scratch::<f64>(1, Par::Seq);
        let mut memory = MemBuffer::try_new(room).map_err(failed)?;
        let factors = IntranodeLbltRef::new(&self.symbolic, &self.factors, &self.subdiagonal, self.permutation());
        let solution = MatMut::from_column_major_slice_mut(&mut *x, right.len(), 1);
        factors.solve_in_place_with_conj(Conj::No, solution, Par::Seq, MemStack::new(&mut memory));
        x.iter_mut().zip(&self.scales).for_each(|(x, scale)| *x *= scale);
        Ok(())
    }
}

/// Where the entries of a matrix stand in another that has them all.
fn places(matrix: &CscMatrix, all: &CscMatrix) -> Vec<usize> {
    let place = |(i, j): (usize, usize)| {
        let range = all.col_ptr[j]..all.col_ptr[j + 1];
        range.start + all.row_idx[range].binary_search(&i).unwrap_or_default()
    };
    positions(matrix).map(place).collect()
}

/// Factors s with s_i·|a_ij|·s_j ≤ 1, and about 1 at the largest of each row.
fn equilibrated(matrix: &CscMatrix) -> Vec<f64> {
    let mut scales = vec![1.0; matrix.n];
    let mut largest = vec![0.0_f64; matrix.n];
    for _ in 0..SWEEPS {
        largest.fill(0.0);
        for ((i, j), value) in positions(matrix).zip(&matrix.values) {
            let scaled = (value * scales[i] * scales[j]).abs();
            largest[i] = largest[i].max(scaled);
            largest[j] = largest[j].max(scaled);
        }
        for (scale, largest) in scales.iter_mut().zip(&largest).filter(|(_, largest)| **largest > 0.0) {
            *scale /= largest.sqrt();
        }
    }
    scales
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain's KKT matrix: unknowns with a diagonal of this size, an equation over each and the next, in units of their own.
    fn chain(n: usize, diagonal: f64) -> CscMatrix {
        let units: Vec<f64> = (0..2 * n).map(|k| 10f64.powf(2.0 * (12.9898 * k as f64).sin())).collect();
        let (mut col_ptr, mut row_idx, mut values) = (vec![0], Vec::new(), Vec::new());
        for j in 0..2 * n {
            let mut put = |i: usize, value: f64| {
                row_idx.push(i);
                values.push(value * units[i] * units[j]);
            };
            if j < n {
                put(j, diagonal * if j % 3 == 0 { -1.0 } else { 1.0 });
                if j > 0 {
                    put(n + j - 1, -0.5);
                }
                put(n + j, 1.0);
            } else {
                put(j, 0.0);
            }
            col_ptr.push(row_idx.len());
        }
        CscMatrix { n: 2 * n, col_ptr, row_idx, values }
    }

    #[test]
    fn equations_without_a_diagonal_are_eliminated_beside_their_unknowns() {
        // Regular equations leave no freedom: as many negative eigenvalues as equations, whatever the diagonal.
        for diagonal in [0.0, 1e-9, 1.0, 1e9] {
            let matrix = chain(200, diagonal);
            let mut solver = BunchKaufmanSolver::new(&matrix).unwrap();
            assert_eq!(solver.factor(&matrix), Ok(Inertia { positive: 200, negative: 200, zero: 0 }), "{diagonal}");
            let right: Vec<f64> = (0..matrix.n).map(|k| (k as f64).sin()).collect();
            let mut x = vec![0.0; matrix.n];
            solver.solve_once(&right, &mut x).unwrap();
            let (mut residual, mut terms) = (right.clone(), right.iter().map(|right| right.abs()).collect::<Vec<f64>>());
            for ((i, j), value) in positions(&matrix).zip(&matrix.values) {
                let mut take = |row: usize, column: usize| {
                    residual[row] -= value * x[column];
                    terms[row] += (value * x[column]).abs();
                };
                take(i, j);
                if i != j {
                    take(j, i);
                }
            }
            // Within the scaled rows, whose terms are of one size.
            let largest = |values: &[f64]| {
                values.iter().zip(&solver.scales).fold(0.0_f64, |most, (value, scale)| most.max((value * scale).abs()))
            };
            assert!(largest(&residual) <= 1e-9 * largest(&terms), "{diagonal}");
        }
    }

    #[test]
    fn a_singular_matrix_has_no_factors() {
        let mut matrix = chain(50, 1.0);
        // The last equation is no equation.
        for ((i, _), value) in positions(&chain(50, 1.0)).zip(&mut matrix.values) {
            *value = if i == 99 { 0.0 } else { *value };
        }
        let mut solver = BunchKaufmanSolver::new(&matrix).unwrap();
        assert_eq!(solver.factor(&matrix), Err(FactorizationError::Singular));
    }
}
