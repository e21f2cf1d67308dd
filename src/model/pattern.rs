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
    /// The pattern of `rows` rows with these positions, in any order, repeats allowed.
    pub fn from_positions(rows: usize, positions: &mut Vec<(u32, u32)>) -> Pattern {
        positions.sort_unstable();
        positions.dedup();
        let mut offsets = vec![0; rows + 1];
        for &(row, _) in positions.iter() {
            offsets[row as usize + 1] += 1;
        }
        for row in 0..rows {
            offsets[row + 1] += offsets[row];
        }
        Pattern { offsets, columns: positions.iter().map(|&(_, column)| column).collect() }
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

    /// y = A·x for the values of A along this pattern.
    pub fn multiply(&self, values: &[f64], x: &[f64], y: &mut [f64]) {
        for (row, y) in y.iter_mut().enumerate() {
            *y = self.range(row).map(|at| values[at] * x[self.columns[at] as usize]).sum();
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
