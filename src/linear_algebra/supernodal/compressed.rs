//! Unknowns that make no pivot by themselves in pairs with one that they are coupled to, and the graph with each pair as one vertex.
//!
//! In a matrix [W, Aᵀ; A, 0] an equation's diagonal is zero: eliminated after one of its unknowns it is a pivot, before it is none. Side by
//! side in one supernode the two make a pivot of order two. The pairs are those of a matching of rows to columns whose entries have the
//! largest product (Duff & Pralet, Strategies for scaling and pivoting for sparse symmetric indefinite problems, SIAM J. Matrix Anal.
//! Appl. 27, 2005, §3; Schenk & Gärtner, On fast factorization pivoting methods for sparse symmetric indefinite systems, ETNA 23, 2006, §3).

use feral::CscMatrix;
use feral::scaling::mc64_matching;
use feral::symbolic::ldlt_compress::{SuperMap, build_supermap, expand_permutation};

use super::super::ordering::positions;
use super::{FactorizationError, failed};

/// Unknowns alone and in pairs.
pub(super) struct Compressed {
    map: SuperMap,
}

impl Compressed {
    /// Pairs for a matrix by its values.
    pub fn new(matrix: &CscMatrix) -> Result<Self, FactorizationError> {
        let (rows_of_columns, _) = mc64_matching(matrix).map_err(failed)?;
        Ok(Compressed { map: build_supermap(&rows_of_columns) })
    }

    /// The graph of unknowns alone and in pairs as a matrix without values.
    pub fn graph(&self, matrix: &CscMatrix) -> CscMatrix {
        let group = |k: usize| self.map.icmp[k];
        let between = |(i, j): (usize, usize)| (group(i).min(group(j)), group(i).max(group(j)));
        lower_triangle(self.map.ncmp(), positions(matrix).map(between).collect())
    }

    /// The pattern in which both of a pair have the same columns, so that they stay together in a supernode.
    pub fn united(&self, matrix: &CscMatrix) -> CscMatrix {
        let both = |k: usize| {
            let (first, second) =
                self.map.pairs.get(self.map.icmp[k]).map_or((k, None), |&(first, second)| (first, Some(second)));
            std::iter::once(first).chain(second)
        };
        let all = positions(matrix).flat_map(|(i, j)| both(i).flat_map(move |a| both(j).map(move |b| (a.min(b), a.max(b)))));
        lower_triangle(matrix.n, all.collect())
    }

    /// An order of the graph as one of the unknowns.
    pub fn expanded(&self, order: &[usize]) -> Vec<usize> {
        expand_permutation(order, &self.map)
    }
}

/// The pattern of these (column, row).
fn lower_triangle(order: usize, mut positions: Vec<(usize, usize)>) -> CscMatrix {
    positions.sort_unstable();
    positions.dedup();
    let mut starts = vec![0; order + 1];
    positions.iter().for_each(|&(column, _)| starts[column + 1] += 1);
    (0..order).for_each(|k| starts[k + 1] += starts[k]);
    let rows: Vec<usize> = positions.into_iter().map(|(_, row)| row).collect();
    CscMatrix { n: order, values: vec![0.0; rows.len()], col_ptr: starts, row_idx: rows }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Unknowns 0 and 1, equations 2 and 3 over them, of which the last has no diagonal.
    fn saddle(diagonal: f64) -> CscMatrix {
        let mut matrix = lower_triangle(4, vec![(0, 0), (1, 1), (0, 2), (1, 2), (0, 3), (1, 3), (2, 2)]);
        // By columns: (0,0), (2,0), (3,0); (1,1), (2,1), (3,1); (2,2).
        matrix.values = vec![1.0, 1.0, 0.2, 1.0, 0.1, 0.9, diagonal];
        matrix
    }

    #[test]
    fn equations_go_with_what_they_are_coupled_to_most() {
        let matrix = saddle(0.0);
        let groups = Compressed::new(&matrix).unwrap();
        assert_eq!(groups.map.pairs, [(0, 2), (1, 3)]);
        assert_eq!(groups.expanded(&[1, 0]), [1, 3, 0, 2]);
        let graph = groups.graph(&matrix);
        assert_eq!((graph.col_ptr, graph.row_idx), (vec![0, 2, 3], vec![0, 1, 1]));
    }

    #[test]
    fn both_of_a_pair_have_the_same_columns() {
        let matrix = saddle(0.0);
        let united = Compressed::new(&matrix).unwrap().united(&matrix);
        assert_eq!((united.n, united.row_idx.len()), (4, 10), "everything is coupled to everything");
    }

    #[test]
    fn who_has_a_diagonal_stays_alone() {
        let groups = Compressed::new(&saddle(-5.0)).unwrap();
        assert_eq!((groups.map.pairs, groups.map.singletons), (vec![(1, 3)], vec![0, 2]));
    }
}
