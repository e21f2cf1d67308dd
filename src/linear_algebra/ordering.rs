//! A fill-reducing order of the unknowns: approximate minimum degree (Amestoy, Davis & Duff, SIAM J. Matrix Anal. Appl. 17, 1996), and
//! for factors that cost more than it does nested dissection (George, SIAM J. Numer. Anal. 10, 1973): whichever takes fewer
//! operations.
//!
//! Both work on the graph without its longest rows, each of which follows the last of its neighbours. A row over hundreds of unknowns (a
//! limit of a whole line of ribs) costs minimum degree more time than all others together and tells it little: whichever neighbour goes
//! first, the others become one clique.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::cholesky::simplicial::{prefactorize_symbolic_cholesky, prefactorize_symbolic_cholesky_scratch};
use feral::CscMatrix;
use feral_amd::{CscPattern, amd_order};
use feral_scotch::scotch_order;

/// A row is long that has more neighbours than this, and than this multiple of the mean.
const LONG: usize = 64;
const TIMES_THE_MEAN: usize = 10;
/// Operations of factors that take about as long as dissecting the graph takes for each unknown (25 µs, at 1 GFlop/s).
const DISSECTION: f64 = 2.5e4;

/// The order, `order[k]` being the unknown that is eliminated k-th; `None` where the library refuses the pattern.
pub(super) fn fill_reducing(matrix: &CscMatrix) -> Option<Vec<usize>> {
    let order = ordered(matrix, |graph| amd_order(graph).ok())?;
    let operations = operations(matrix, &order)?;
    if operations <= DISSECTION * matrix.n as f64 {
        return Some(order);
    }
    let dissected = ordered(matrix, |graph| scotch_order(graph).ok()).filter(|other| {
        let of_other = self::operations(matrix, other);
        of_other.is_some_and(|of_other| of_other < operations)
    });
    Some(dissected.unwrap_or(order))
}

/// An order by a library, the long rows put in afterwards.
fn ordered(matrix: &CscMatrix, library: impl FnOnce(&CscPattern<'_>) -> Option<Vec<i32>>) -> Option<Vec<usize>> {
    let degrees = degrees(matrix);
    let longest = LONG.max(TIMES_THE_MEAN * degrees.iter().sum::<usize>() / matrix.n.max(1));
    let short: Vec<usize> = (0..matrix.n).filter(|&j| degrees[j] <= longest).collect();
    let order = of_short(matrix, &short, library)?;
    let mut turn = vec![None; matrix.n];
    for (k, &j) in order.iter().enumerate() {
        turn[j] = Some(k);
    }
    Some(with_long(order, &last_neighbours(matrix, &turn)))
}

/// Multiplications of factors in this order: the squares of the columns' lengths.
fn operations(matrix: &CscMatrix, order: &[usize]) -> Option<f64> {
    let turn = turns(order);
    // The upper triangle by columns.
    let mut starts = vec![0; matrix.n + 1];
    couplings(matrix).for_each(|(i, j)| starts[turn[i].max(turn[j]) + 1] += 1);
    (0..matrix.n).for_each(|k| starts[k + 1] += starts[k]);
    let (mut next, mut rows) = (starts.clone(), vec![0; starts[matrix.n]]);
    for (i, j) in couplings(matrix) {
        let place = &mut next[turn[i].max(turn[j])];
        rows[*place] = turn[i].min(turn[j]);
        *place += 1;
    }
    starts.windows(2).for_each(|range| rows[range[0]..range[1]].sort_unstable());
    let room = prefactorize_symbolic_cholesky_scratch::<usize>(matrix.n, rows.len());
    let mut memory = MemBuffer::try_new(room).ok()?;
    let (mut tree, mut lengths) = (vec![0; matrix.n], vec![0; matrix.n]);
    let upper = SymbolicSparseColMatRef::new_checked(matrix.n, matrix.n, &starts, None, &rows);
    prefactorize_symbolic_cholesky(&mut tree, &mut lengths, upper, MemStack::new(&mut memory));
    Some(lengths.iter().map(|&length: &usize| (length as f64).powi(2)).sum())
}

/// The place of each unknown in an order.
pub(super) fn turns(order: &[usize]) -> Vec<usize> {
    let mut turns = vec![0; order.len()];
    order.iter().enumerate().for_each(|(k, &j)| turns[j] = k);
    turns
}

/// (row, column) of every entry.
pub(super) fn positions(matrix: &CscMatrix) -> impl Iterator<Item = (usize, usize)> {
    (0..matrix.n).flat_map(|j| matrix.row_idx[matrix.col_ptr[j]..matrix.col_ptr[j + 1]].iter().map(move |&i| (i, j)))
}

/// The entries off the diagonal: (row, column), row > column.
fn couplings(matrix: &CscMatrix) -> impl Iterator<Item = (usize, usize)> {
    positions(matrix).filter(|(i, j)| i != j)
}

/// Neighbours of each unknown.
fn degrees(matrix: &CscMatrix) -> Vec<usize> {
    let mut degrees = vec![0; matrix.n];
    for (i, j) in couplings(matrix) {
        degrees[i] += 1;
        degrees[j] += 1;
    }
    degrees
}

/// The order of some unknowns, given ascending, with couplings among themselves alone.
fn of_short(
    matrix: &CscMatrix,
    short: &[usize],
    library: impl FnOnce(&CscPattern<'_>) -> Option<Vec<i32>>,
) -> Option<Vec<usize>> {
    let mut place = vec![None; matrix.n];
    for (k, &j) in short.iter().enumerate() {
        place[j] = Some(k);
    }
    let pairs = || couplings(matrix).filter_map(|(i, j)| Some((place[i]?, place[j]?)));
    let mut starts = vec![0_i32; short.len() + 1];
    for (i, j) in pairs() {
        starts[i + 1] = starts[i + 1].checked_add(1)?;
        starts[j + 1] = starts[j + 1].checked_add(1)?;
    }
    for k in 0..short.len() {
        starts[k + 1] = starts[k + 1].checked_add(starts[k])?;
    }
    let mut neighbours = vec![0_i32; *starts.last()? as usize];
    let mut next = starts.clone();
    let mut put = |of: usize, neighbour: usize| {
        neighbours[next[of] as usize] = neighbour as i32;
        next[of] += 1;
    };
    // Smaller neighbours first, so that each list ascends.
    pairs().for_each(|(i, j)| put(i, j));
    pairs().for_each(|(i, j)| put(j, i));
    let order = library(&CscPattern::new(short.len(), &starts, &neighbours)?)?;
    order.into_iter().map(|k| short.get(usize::try_from(k).ok()?).copied()).collect()
}

/// Of each unknown without a turn: after how many others comes the last of its neighbours that have one.
fn last_neighbours(matrix: &CscMatrix, turn: &[Option<usize>]) -> Vec<(usize, usize)> {
    let mut last = vec![0; matrix.n];
    for (i, j) in couplings(matrix) {
        for (long, neighbour) in [(i, j), (j, i)] {
            if let (None, Some(turn)) = (turn[long], turn[neighbour]) {
                last[long] = last[long].max(turn + 1);
            }
        }
    }
    let mut long: Vec<(usize, usize)> = (0..matrix.n).filter(|&j| turn[j].is_none()).map(|j| (last[j], j)).collect();
    long.sort_unstable();
    long
}

/// Puts the long rows, (place, unknown) ascending, among the others.
fn with_long(order: Vec<usize>, long: &[(usize, usize)]) -> Vec<usize> {
    let mut all = Vec::with_capacity(order.len() + long.len());
    let mut long = long.iter().peekable();
    for (k, j) in order.into_iter().enumerate() {
        while let Some(&(_, row)) = long.next_if(|(place, _)| *place <= k) {
            all.push(row);
        }
        all.push(j);
    }
    all.extend(long.map(|&(_, row)| row));
    all
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A chain of n unknowns with one row over the first half and one over all.
    fn chain(n: usize) -> CscMatrix {
        let (mut col_ptr, mut row_idx) = (vec![0], Vec::new());
        for j in 0..n + 2 {
            row_idx.push(j);
            row_idx.extend((j + 1 < n).then_some(j + 1));
            row_idx.extend((j < n / 2).then_some(n));
            row_idx.extend((j < n).then_some(n + 1));
            col_ptr.push(row_idx.len());
        }
        CscMatrix { n: n + 2, values: vec![0.0; row_idx.len()], col_ptr, row_idx }
    }

    #[test]
    fn long_rows_follow_the_last_of_their_neighbours() {
        let n = 1000;
        let order = fill_reducing(&chain(n)).unwrap();
        let turn = |j: usize| order.iter().position(|&k| k == j).unwrap();
        let last = (0..n / 2).map(turn).max().unwrap();
        assert_eq!(turn(n), last + 1);
        assert_eq!(order[n + 1], n + 1);
        let mut sorted = order.clone();
        sorted.sort_unstable();
        assert!(sorted.into_iter().eq(0..n + 2), "every unknown once");
    }

    #[test]
    fn factors_of_a_grid_cost_a_fraction_of_the_band() {
        let side = 120;
        let (mut col_ptr, mut row_idx) = (vec![0], Vec::new());
        for j in 0..side * side {
            row_idx.push(j);
            row_idx.extend((j % side + 1 < side).then_some(j + 1));
            row_idx.extend((j / side + 1 < side).then_some(j + side));
            col_ptr.push(row_idx.len());
        }
        let grid = CscMatrix { n: side * side, values: vec![0.0; row_idx.len()], col_ptr, row_idx };
        let by_rows: Vec<usize> = (0..grid.n).collect();
        // A band of width s: s³ operations on each of s lines.
        let banded = operations(&grid, &by_rows).unwrap();
        assert!(banded > 0.9 * (side as f64).powi(4), "{banded}");
        let least = operations(&grid, &fill_reducing(&grid).unwrap()).unwrap();
        let by_degree = operations(&grid, &ordered(&grid, |graph| amd_order(graph).ok()).unwrap()).unwrap();
        assert!(least <= by_degree && least < 0.2 * banded, "{least} {by_degree} {banded}");
    }

    #[test]
    fn nothing_to_order_is_in_order() {
        let empty = CscMatrix { n: 0, col_ptr: vec![0], row_idx: vec![], values: vec![] };
        assert_eq!(fill_reducing(&empty), Some(vec![]));
        let diagonal = CscMatrix { n: 3, col_ptr: vec![0, 1, 2, 3], row_idx: vec![0, 1, 2], values: vec![1.0; 3] };
        assert_eq!(fill_reducing(&diagonal).unwrap().len(), 3);
    }
}
