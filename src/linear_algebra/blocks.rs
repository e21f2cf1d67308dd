//! Symmetric matrices that are block diagonal up to a permutation: every block is factorised densely, side by side.

use rayon::prelude::*;

use super::bunch_kaufman::{self, Pivot};
use super::{FactorizationError, Inertia};

/// Blocks of a higher order are left to the sparse solver.
const LARGEST_ORDER: usize = 64;
/// Blocks a thread takes at a time.
const BATCH: usize = 256;

/// Where one block is.
#[derive(Debug, Clone, Copy)]
struct Block {
    /// First of its unknowns in `order`.
    first: usize,
    size: usize,
}

/// A factorisation of many small blocks.
pub struct BlockSolver {
    blocks: Vec<Block>,
    /// The unknowns, block by block.
    order: Vec<u32>,
    /// Where each position of the caller's pattern stands among all blocks' entries.
    places: Vec<usize>,
    matrix: Vec<f64>,
    factors: Vec<f64>,
    pivots: Vec<Pivot>,
}

impl BlockSolver {
    /// A solver for the lower triangle `columns[offsets[i]..offsets[i + 1]]`; `None` where it is one block, or one is large.
    pub fn new(offsets: &[usize], columns: &[u32]) -> Option<Self> {
        let n = offsets.len() - 1;
        let block_of = connected(offsets, columns);
        let mut sizes: Vec<u32> = Vec::new();
        let mut number = vec![u32::MAX; n];
        let place: Vec<u32> = (0..n)
            .map(|k| {
                let root = block_of[k] as usize;
                if number[root] == u32::MAX {
                    number[root] = sizes.len() as u32;
                    sizes.push(0);
                }
                let size = &mut sizes[number[root] as usize];
                *size += 1;
                *size - 1
            })
            .collect();
        if sizes.len() < 2 || sizes.iter().any(|&size| size as usize > LARGEST_ORDER) {
            return None;
        }
        let mut blocks = Vec::with_capacity(sizes.len());
        let (mut first, mut entry, mut entries) = (0, 0, Vec::with_capacity(sizes.len()));
        for &size in &sizes {
            blocks.push(Block { first, size: size as usize });
            entries.push(entry);
            first += size as usize;
            entry += (size * size) as usize;
        }
        let mut order = vec![0; n];
        let mut places = Vec::with_capacity(columns.len());
        for i in 0..n {
            let block = number[block_of[i] as usize] as usize;
            order[blocks[block].first + place[i] as usize] = i as u32;
            let row = entries[block] + place[i] as usize * blocks[block].size;
            places.extend(columns[offsets[i]..offsets[i + 1]].iter().map(|&j| row + place[j as usize] as usize));
        }
        Some(BlockSolver {
            blocks,
            order,
            places,
            matrix: vec![0.0; entry],
            factors: vec![0.0; entry],
            pivots: vec![Pivot::default(); n],
        })
    }

    /// Factorises with these values along the pattern.
    ///
    /// # Errors
    /// A value is no number.
    pub fn factor(&mut self, values: &[f64]) -> Result<Inertia, FactorizationError> {
        self.matrix.fill(0.0);
        for (&place, &value) in self.places.iter().zip(values) {
            self.matrix[place] = value;
        }
        if !values.iter().all(|value| value.is_finite()) {
            return Err(FactorizationError::Library("a value is no number".into()));
        }
        self.factors.copy_from_slice(&self.matrix);
        let mut work = Vec::with_capacity(self.blocks.len());
        let (mut factors, mut pivots) = (self.factors.as_mut_slice(), self.pivots.as_mut_slice());
        for block in &self.blocks {
            let (own, rest) = factors.split_at_mut(block.size * block.size);
            let (own_pivots, rest_pivots) = pivots.split_at_mut(block.size);
            work.push((own, own_pivots));
            (factors, pivots) = (rest, rest_pivots);
        }
        let none = Inertia { positive: 0, negative: 0, zero: 0 };
        let add = |a: Inertia, b: Inertia| Inertia {
            positive: a.positive + b.positive,
            negative: a.negative + b.negative,
            zero: a.zero + b.zero,
        };
        let batch = |batch: &mut [(&mut [f64], &mut [Pivot])]| {
            batch.iter_mut().map(|(factors, pivots)| bunch_kaufman::factor(factors, pivots)).fold(none, add)
        };
        Ok(work.par_chunks_mut(BATCH).map(batch).reduce(|| none, add))
    }

    /// x = A⁻¹·right for the matrix factorised last, refined once.
    pub fn solve(&self, right: &[f64], x: &mut [f64]) {
        let (mut wanted, mut own, mut residual) = (Vec::new(), Vec::new(), Vec::new());
        let mut entry = 0;
        for block in &self.blocks {
            let (n, unknowns) = (block.size, &self.order[block.first..block.first + block.size]);
            let entries = entry..entry + n * n;
            entry = entries.end;
            let (matrix, factors) = (&self.matrix[entries.clone()], &self.factors[entries]);
            let pivots = &self.pivots[block.first..block.first + n];
            wanted.clear();
            wanted.extend(unknowns.iter().map(|&k| right[k as usize]));
            bunch_kaufman::solve_refined(matrix, factors, pivots, &wanted, &mut own, &mut residual);
            for (&k, &value) in unknowns.iter().zip(&own) {
                x[k as usize] = value;
            }
        }
    }
}

/// The smallest unknown each one is connected with.
fn connected(offsets: &[usize], columns: &[u32]) -> Vec<u32> {
    let n = offsets.len() - 1;
    let mut parent: Vec<u32> = (0..n as u32).collect();
    for i in 0..n {
        for &j in &columns[offsets[i]..offsets[i + 1]] {
            let (a, b) = (root(&mut parent, i as u32), root(&mut parent, j));
            parent[a.max(b) as usize] = a.min(b);
        }
    }
    (0..n as u32).map(|k| root(&mut parent, k)).collect()
}

fn root(parent: &mut [u32], mut k: u32) -> u32 {
    while parent[k as usize] != k {
        parent[k as usize] = parent[parent[k as usize] as usize];
        k = parent[k as usize];
    }
    k
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::SymmetricSolver;

    #[test]
    fn it_agrees_with_the_sparse_solver() {
        // Blocks {0, 2}, {1}, {3, 4}: lower triangle by rows.
        let (offsets, columns) = ([0, 1, 2, 4, 5, 7], [0, 1, 0, 2, 3, 3, 4]);
        let values = [2.0, -3.0, 1.0, 0.0, 0.0, 4.0, 1.0];
        let (mut blocks, mut sparse) =
            (BlockSolver::new(&offsets, &columns).unwrap(), SymmetricSolver::new(&offsets, &columns).unwrap());
        assert_eq!(blocks.factor(&values).unwrap(), sparse.factor(&values).unwrap());
        let (right, mut x, mut y) = ([1.0, 2.0, 3.0, 4.0, 5.0], [0.0; 5], [0.0; 5]);
        blocks.solve(&right, &mut x);
        sparse.solve(&right, &mut y).unwrap();
        assert!(x.iter().zip(&y).all(|(a, b)| (a - b).abs() < 1e-14), "{x:?} {y:?}");
        assert!(blocks.factor(&[f64::NAN; 7]).is_err());
    }

    #[test]
    fn one_block_is_left_to_others() {
        assert!(BlockSolver::new(&[0, 1, 3], &[0, 0, 1]).is_none());
        assert!(BlockSolver::new(&[0], &[]).is_none());
    }
}
