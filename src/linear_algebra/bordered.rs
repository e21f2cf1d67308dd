//! Symmetric matrices that fall into small blocks but for a border of few rows that reach far, such as limits on whole lines of
//! ribs: the blocks are eliminated one by one, and what they leave of the border is one dense matrix.

mod blocks;

use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use super::bunch_kaufman::{self, Pivot};
use super::certainty::is_certain;
use super::{Inertia, Partition, Pattern};
use blocks::{Block, couplings, largest, product};

/// Unknowns coupled to more others than this belong to the border.
const WIDE: u32 = 32;
/// Borders of more unknowns are no work for a dense matrix.
const LARGEST_BORDER: usize = 2048;
/// Blocks of more unknowns are not small, and fewer blocks not worth it.
const LARGEST_BLOCK: usize = 64;
const FEWEST_BLOCKS: usize = 64;
/// Refinement goes on while it helps; a solution whose residual stays above this share of its own and the right-hand side's size is
/// none.
const REFINEMENTS: usize = 4;
const ACCURATE: f64 = 1e-10;

/// [K C^T; C E] with K block diagonal. Factorised only where the border's Schur complement E − C K⁻¹ C^T is negative definite, as in
/// the augmented systems of least squares.
pub struct Bordered {
    pattern: Pattern,
    blocks: Vec<Block>,
    /// Unknowns, block by block.
    unknowns: Vec<u32>,
    border: Vec<u32>,
    /// Places in the border, block by block.
    touched: Vec<u32>,
    /// Where each position of the pattern stands among the entries.
    places: Vec<usize>,
    /// Blocks and their parts of C row by row, then the lower triangle of E.
    entries: Vec<f64>,
    /// Factors of the blocks, and C K⁻¹, at the same places.
    factors: Vec<f64>,
    pivots: Vec<Pivot>,
    schur: Option<Cholesky<f64, Dyn>>,
}

impl Bordered {
    /// The blocks and the border of a lower triangle; the pattern back where it has none such.
    pub fn new(pattern: Pattern) -> Result<Self, Pattern> {
        match Bordered::split(&pattern) {
            Some((border, partition)) => Ok(Bordered::laid_out(pattern, border, &partition)),
            None => Err(pattern),
        }
    }

    /// The pattern, for another solver.
    pub fn pattern(&self) -> &Pattern {
        &self.pattern
    }

    /// Border, and blocks with each of the border's unknowns as one more.
    fn split(pattern: &Pattern) -> Option<(Vec<u32>, Partition)> {
        let n = pattern.rows();
        let mut degrees = vec![0u32; n];
        pattern.iter().filter(|(i, j)| i != j).for_each(|(i, j)| {
            degrees[i] += 1;
            degrees[j] += 1;
        });
        let border: Vec<u32> = (0..n as u32).filter(|&k| degrees[k as usize] > WIDE).collect();
        if border.is_empty() || border.len() > LARGEST_BORDER {
            return None;
        }
        let is_inner = |k: usize| degrees[k] <= WIDE;
        let inner = pattern.iter().filter(|&(i, j)| i != j && is_inner(i) && is_inner(j));
        let couplings: Vec<[u32; 2]> = inner.map(|(i, j)| [i as u32, j as u32]).collect();
        let partition = Partition::new(n, std::iter::empty(), couplings.iter().map(|pair| &pair[..]))?;
        let fits = partition.largest() <= LARGEST_BLOCK && partition.len() >= FEWEST_BLOCKS + border.len();
        fits.then_some((border, partition))
    }

    fn laid_out(pattern: Pattern, border: Vec<u32>, partition: &Partition) -> Self {
        let in_border = |k: usize| border.binary_search(&(k as u32)).ok();
        let pairs = couplings(&pattern, partition, in_border);
        let (mut blocks, mut unknowns, mut entries) = (Vec::new(), Vec::new(), 0);
        let (mut number, mut first_pair) = (vec![usize::MAX; partition.len()], 0);
        for (k, number) in number.iter_mut().enumerate() {
            let own = partition.variables(k);
            if own.iter().any(|&j| in_border(j as usize).is_some()) {
                continue;
            }
            *number = blocks.len();
            let first = unknowns.len();
            unknowns.extend_from_slice(own);
            let last_pair = first_pair + pairs[first_pair..].iter().take_while(|pair| pair.0 as usize == k).count();
            let (matrix, coupling) = (entries, entries + own.len() * own.len());
            entries = coupling + own.len() * (last_pair - first_pair);
            blocks.push(Block { unknowns: first..unknowns.len(), touched: first_pair..last_pair, matrix, coupling });
            first_pair = last_pair;
        }
        let touched: Vec<u32> = pairs.iter().map(|pair| pair.1).collect();
        let place = |(i, j): (usize, usize)| match (in_border(i), in_border(j)) {
            (Some(a), Some(b)) => entries + a.max(b) * border.len() + a.min(b),
            (None, None) => {
                let block = &blocks[number[partition.component(i as u32) as usize]];
                let (a, b) = (partition.place(i as u32) as usize, partition.place(j as u32) as usize);
                block.matrix + a.max(b) * block.size() + a.min(b)
            }
            (a, b) => {
                let (row, inner) = (a.or(b).unwrap_or_default() as u32, if a.is_some() { j } else { i });
                let block = &blocks[number[partition.component(inner as u32) as usize]];
                let row = touched[block.touched.clone()].binary_search(&row).unwrap_or_default();
                block.coupling(row).start + partition.place(inner as u32) as usize
            }
        };
        let places = pattern.iter().map(place).collect();
        let (pivots, schur) = (vec![Pivot::default(); unknowns.len()], None);
        let (all, inner) = (entries + border.len() * border.len(), entries);
        let (entries, factors) = (vec![0.0; all], vec![0.0; inner]);
        Bordered { pattern, blocks, unknowns, border, touched, places, entries, factors, pivots, schur }
    }

    /// Factorises with these values along the pattern; `None` where the border's Schur complement is not negative definite.
    pub fn factor(&mut self, values: &[f64]) -> Option<Inertia> {
        self.entries.fill(0.0);
        for (&place, &value) in self.places.iter().zip(values) {
            self.entries[place] = value;
        }
        let (inner, count) = (self.factors.len(), self.border.len());
        self.factors.copy_from_slice(&self.entries[..inner]);
        let mut negative = DMatrix::from_fn(count, count, |i, j| if j <= i { -self.entries[inner + i * count + j] } else { 0.0 });
        let mut inertia = Inertia { positive: 0, negative: count, zero: 0 };
        for block in &self.blocks {
            let pivots = &mut self.pivots[block.unknowns.clone()];
            let own = bunch_kaufman::factor(&mut self.factors[block.entries()], pivots);
            inertia.positive += own.positive;
            inertia.negative += own.negative;
            inertia.zero += own.zero;
            let touched = &self.touched[block.touched.clone()];
            for (a, &row) in touched.iter().enumerate() {
                let (matrix, rest) = self.factors.split_at_mut(block.coupling);
                let solved = &mut rest[a * block.size()..(a + 1) * block.size()];
                bunch_kaufman::solve(&matrix[block.matrix..], pivots, solved);
                for (b, &column) in touched[..=a].iter().enumerate() {
                    negative[(row as usize, column as usize)] += product(solved, &self.entries[block.coupling(b)]);
                }
            }
        }
        self.schur = Cholesky::new(negative);
        (self.schur.is_some() && inertia.zero == 0).then_some(inertia)
    }

    /// Whether rounding has no part in the inertia for the values factorised last.
    pub fn is_certain(&self, values: &[f64]) -> bool {
        let entries = || self.pattern.iter().zip(values).map(|((i, j), &value)| (i, j, value));
        is_certain(self.pattern.rows(), entries, |right| self.solved(right))
    }

    /// The solution for the values factorised last, refined; `None` where it cannot be had to some digits.
    pub fn solve(&self, values: &[f64], right: &[f64]) -> Option<Vec<f64>> {
        let mut x = self.solved(right)?;
        let mut residual = self.residual(values, right, &x);
        for _ in 0..REFINEMENTS {
            let step = self.solved(&residual)?;
            let next: Vec<f64> = x.iter().zip(&step).map(|(x, step)| x + step).collect();
            let rest = self.residual(values, right, &next);
            // A comparison with NaN is false: what is no number is no improvement.
            let improves = largest(&rest) < largest(&residual);
            if improves {
                (x, residual) = (next, rest);
            }
            if !improves || largest(&residual) <= f64::EPSILON * largest(right) {
                break;
            }
        }
        (largest(&residual) <= ACCURATE * (largest(right) + largest(&x))).then_some(x)
    }

    fn solved(&self, right: &[f64]) -> Option<Vec<f64>> {
        let mut rest = DVector::from_iterator(self.border.len(), self.border.iter().map(|&k| right[k as usize]));
        let mut x = vec![0.0; right.len()];
        let mut own = Vec::new();
        for block in &self.blocks {
            let unknowns = &self.unknowns[block.unknowns.clone()];
            own.clear();
            own.extend(unknowns.iter().map(|&k| right[k as usize]));
            bunch_kaufman::solve(&self.factors[block.entries()], &self.pivots[block.unknowns.clone()], &mut own);
            for (a, &row) in self.touched[block.touched.clone()].iter().enumerate() {
                rest[row as usize] -= product(&own, &self.entries[block.coupling(a)]);
            }
            unknowns.iter().zip(&own).for_each(|(&k, &value)| x[k as usize] = value);
        }
        let border = -self.schur.as_ref()?.solve(&rest);
        for block in &self.blocks {
            for (a, &row) in self.touched[block.touched.clone()].iter().enumerate() {
                let solved = &self.factors[block.coupling(a)];
                let unknowns = &self.unknowns[block.unknowns.clone()];
                unknowns.iter().zip(solved).for_each(|(&k, c)| x[k as usize] -= c * border[row as usize]);
            }
        }
        self.border.iter().zip(border.iter()).for_each(|(&k, &value)| x[k as usize] = value);
        Some(x)
    }

    fn residual(&self, values: &[f64], right: &[f64], x: &[f64]) -> Vec<f64> {
        let mut residual = right.to_vec();
        for ((i, j), value) in self.pattern.iter().zip(values) {
            residual[i] -= value * x[j];
            if i != j {
                residual[j] -= value * x[i];
            }
        }
        residual
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::linear_algebra::SymmetricSolver;

    /// [I B; Bᵀ −D]: per block two variables and two columns, and two columns over all variables.
    fn augmented(blocks: u32) -> (Pattern, Vec<f64>) {
        let (p, mut entries) = (2 * blocks, Vec::new());
        for k in 0..p {
            entries.push((k, k, 1.0));
            entries.push((p + k, p + k, -1e-13));
            entries.push((p + k, k, 1.0 + f64::from(k % 5)));
            entries.push((p + k, k ^ 1, -0.5));
        }
        for wide in 0..2 {
            entries.push((2 * p + wide, 2 * p + wide, -1e-6));
            entries.extend((0..p).map(|k| (2 * p + wide, k, 1.0 + f64::from((k * (wide + 3)) % 7))));
        }
        let mut positions = entries.iter().map(|&(i, j, _)| (i, j)).collect();
        let pattern = Pattern::from_positions(2 * p as usize + 2, &mut positions);
        let mut values = vec![0.0; pattern.len()];
        entries.iter().for_each(|&(i, j, value)| values[pattern.position(i as usize, j).unwrap()] = value);
        (pattern, values)
    }

    #[test]
    fn it_agrees_with_the_sparse_solver() {
        let (pattern, values) = augmented(100);
        let mut sparse = SymmetricSolver::new(&pattern.offsets, &pattern.columns).unwrap();
        let Ok(mut bordered) = Bordered::new(pattern) else { panic!("there is a border") };
        assert_eq!((bordered.border.len(), bordered.blocks.len()), (2, 100));
        assert_eq!(bordered.factor(&values).unwrap(), sparse.factor(&values).unwrap());
        let right: Vec<f64> = (0..402).map(|k| f64::from(k % 11) - 5.0).collect();
        let x = bordered.solve(&values, &right).unwrap();
        let residual = bordered.residual(&values, &right, &x);
        assert!(largest(&residual) < 1e-13 * largest(&x), "{} {}", largest(&residual), largest(&x));
    }

    #[test]
    fn what_has_no_border_or_a_large_block_is_given_back() {
        let (pattern, _) = augmented(20);
        assert!(Bordered::new(pattern).is_err());
        let mut diagonal = (0..500).map(|k| (k, k)).collect();
        assert!(Bordered::new(Pattern::from_positions(500, &mut diagonal)).is_err());
    }

    #[test]
    fn another_inertia_is_left_to_others() {
        let (pattern, mut values) = augmented(100);
        let at = pattern.position(401, 401).unwrap();
        let Ok(mut bordered) = Bordered::new(pattern) else { panic!("there is a border") };
        values[at] = 1e9;
        assert!(bordered.factor(&values).is_none());
    }
}
