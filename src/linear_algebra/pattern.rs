//! Sparsity patterns, compressed by rows.

/// Positions of a sparse matrix: row i has the columns `columns[offsets[i]..offsets[i + 1]]`, ascending and distinct.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Pattern {
    /// Where each row begins; one more than rows, first 0.
    pub offsets: Vec<usize>,
    /// Column indices of all rows.
    pub columns: Vec<u32>,
}

impl Default for Pattern {
    fn default() -> Self {
        Pattern { offsets: vec![0], columns: Vec::new() }
    }
}

impl Pattern {
    /// The pattern of `rows` rows with these positions, in any order, repeats allowed; the list is emptied.
    pub fn from_positions(rows: usize, positions: &mut Vec<(u32, u32)>) -> Pattern {
        let mut offsets = vec![0; rows + 1];
        for &(row, _) in positions.iter() {
            offsets[row as usize + 1] += 1;
        }
        for row in 0..rows {
            offsets[row + 1] += offsets[row];
        }
        let mut next = offsets.clone();
        let mut columns = vec![0; positions.len()];
        for (row, column) in positions.drain(..) {
            columns[next[row as usize]] = column;
            next[row as usize] += 1;
        }
        Pattern { offsets, columns }.sorted()
    }

    /// Sorts each row and drops repeats.
    fn sorted(mut self) -> Pattern {
        let (mut kept, mut begin) = (0, 0);
        for row in 0..self.rows() {
            let end = self.offsets[row + 1];
            self.columns[begin..end].sort_unstable();
            let first = kept;
            for at in begin..end {
                if kept == first || self.columns[kept - 1] != self.columns[at] {
                    self.columns[kept] = self.columns[at];
                    kept += 1;
                }
            }
            begin = end;
            self.offsets[row + 1] = kept;
        }
        self.columns.truncate(kept);
        self.columns.shrink_to_fit();
        self
    }

    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.offsets.len() - 1
    }

    /// Number of positions.
    pub fn len(&self) -> usize {
        self.columns.len()
    }

    /// True without positions.
    pub fn is_empty(&self) -> bool {
        self.columns.is_empty()
    }

    /// The range of positions of row i.
    pub fn range(&self, row: usize) -> std::ops::Range<usize> {
        self.offsets[row]..self.offsets[row + 1]
    }

    /// The columns of row i.
    pub fn row(&self, row: usize) -> &[u32] {
        &self.columns[self.range(row)]
    }

    /// Where (row, column) stands among all positions.
    pub fn position(&self, row: usize, column: u32) -> Option<usize> {
        self.row(row).binary_search(&column).ok().map(|at| self.offsets[row] + at)
    }

    /// All positions (row, column), in order.
    pub fn iter(&self) -> impl Iterator<Item = (usize, usize)> + '_ {
        (0..self.rows()).flat_map(move |row| self.row(row).iter().map(move |&column| (row, column as usize)))
    }

    /// Some rows, their columns renumbered by `place` (which keeps their order) or left out, and which of all positions are kept.
    pub fn selected(&self, rows: &[u32], place: impl Fn(u32) -> Option<u32>) -> (Pattern, Vec<usize>) {
        let (mut own, mut kept) = (Pattern::default(), Vec::new());
        for &row in rows {
            for at in self.range(row as usize) {
                if let Some(column) = place(self.columns[at]) {
                    own.columns.push(column);
                    kept.push(at);
                }
            }
            own.offsets.push(own.columns.len());
        }
        (own, kept)
    }

    /// y = A·x for the values of A along this pattern.
    pub fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (row, y) in y.iter_mut().enumerate() {
            *y = self.range(row).map(|at| values[at] * x[self.columns[at] as usize]).sum();
        }
    }

    /// y = H·x for the symmetric matrix of whose lower triangle these are the values; y is overwritten.
    pub fn multiply_symmetric(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        y.fill(0.0);
        for ((row, column), value) in self.iter().zip(values) {
            y[row] += value * x[column];
            if row != column {
                y[column] += value * x[row];
            }
        }
    }

    /// y += Aᵀ·x for the values of A along this pattern.
    pub fn add_transposed(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (row, &factor) in x.iter().enumerate() {
            if factor != 0.0 {
                for at in self.range(row) {
                    y[self.columns[at] as usize] += values[at] * factor;
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn positions_are_sorted_and_repeats_dropped() {
        let pattern = Pattern::from_positions(3, &mut vec![(2, 1), (0, 4), (2, 0), (0, 4), (2, 1)]);
        assert_eq!(pattern.iter().collect::<Vec<_>>(), [(0, 4), (2, 0), (2, 1)]);
        assert_eq!((pattern.rows(), pattern.len(), pattern.position(2, 1), pattern.position(1, 1)), (3, 3, Some(2), None));
    }

    #[test]
    fn products_with_the_matrix_and_its_transpose() {
        let pattern = Pattern::from_positions(2, &mut vec![(0, 0), (0, 2), (1, 1)]);
        let (values, mut y, mut x) = ([1.0, 2.0, 3.0], [0.0; 2], [0.0; 3]);
        pattern.multiply(&values, &[1.0, 10.0, 100.0], &mut y);
        pattern.add_transposed(&values, &[1.0, 10.0], &mut x);
        assert_eq!((y, x), ([201.0, 30.0], [1.0, 30.0, 2.0]));
    }
}
