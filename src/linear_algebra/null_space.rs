//! Orthonormal bases of null spaces, block by block.

use super::Partition;

/// Blocks of more variables are left to the whole test.
const LARGEST_BLOCK: usize = 32;
/// A row of which less than this (of its length) is its own among those of its block is left to the whole test.
const OWN_SHARE: f64 = 1e-3;

/// Null-space bases of the blocks, and where they stand.
pub struct Basis {
    partition: Partition,
    /// Block by block: its variables' rows of Z, each as long as the block has columns.
    rows: Vec<f64>,
    first_row: Vec<usize>,
    /// Columns of Z before each block; the last entry counts all.
    first_column: Vec<usize>,
}

impl Basis {
    /// `None` where a block is large or its rows are nearly dependent.
    pub fn of(variables: usize, narrow: &[Vec<(u32, f64)>]) -> Option<Basis> {
        let members: Vec<Vec<u32>> = narrow.iter().map(|row| row.iter().map(|entry| entry.0).collect()).collect();
        let partition = Partition::new(variables, members.iter().map(Vec::as_slice), std::iter::empty())?;
        if partition.largest() > LARGEST_BLOCK {
            return None;
        }
        let (mut rows, mut first_row, mut first_column) = (Vec::with_capacity(variables), Vec::new(), vec![0]);
        for k in 0..partition.len() {
            let size = partition.variables(k).len();
            let own = partition.rows(k).iter().map(|&i| {
                let mut dense = vec![0.0; size];
                narrow[i as usize].iter().for_each(|&(j, value)| dense[partition.place(j) as usize] += value);
                dense
            });
            let columns = null_space(size, own.collect())?;
            first_row.push(rows.len());
            rows.extend((0..size).flat_map(|j| columns.iter().map(move |column| column[j])));
            first_column.push(first_column[k] + columns.len());
        }
        Some(Basis { partition, rows, first_row, first_column })
    }

    /// Columns of Z.
    pub fn columns(&self) -> usize {
        self.first_column.last().copied().unwrap_or_default()
    }

    /// Variable j's row of Z: columns and entries.
    pub fn row(&self, j: u32) -> impl Iterator<Item = (u32, f64)> {
        let block = self.partition.component(j) as usize;
        let (first, last) = (self.first_column[block], self.first_column[block + 1]);
        let start = self.first_row[block] + self.partition.place(j) as usize * (last - first);
        (first..last).map(|column| column as u32).zip(self.rows[start..start + last - first].iter().copied())
    }
}

/// An orthonormal basis of the vectors of this length that are orthogonal to all rows; `None` where the rows are nearly dependent.
pub fn null_space(size: usize, rows: Vec<Vec<f64>>) -> Option<Vec<Vec<f64>>> {
    if rows.len() > size {
        return None;
    }
    let mut known: Vec<Vec<f64>> = Vec::with_capacity(size);
    for mut row in rows {
        let length = norm(&row);
        if remainder(&mut row, &known) < OWN_SHARE * length {
            return None;
        }
        normalise(&mut row);
        known.push(row);
    }
    let held = known.len();
    while known.len() < size {
        let rest = |j: usize| {
            let mut unit: Vec<f64> = (0..size).map(|k| if k == j { 1.0 } else { 0.0 }).collect();
            (remainder(&mut unit, &known), unit)
        };
        let (_, mut longest) = (0..size).map(rest).max_by(|a, b| a.0.total_cmp(&b.0))?;
        normalise(&mut longest);
        known.push(longest);
    }
    Some(known.split_off(held))
}

/// Takes away what lies along the known vectors, twice, for the last digits; the length of what is left.
fn remainder(vector: &mut [f64], known: &[Vec<f64>]) -> f64 {
    for other in known.iter().chain(known) {
        let along: f64 = vector.iter().zip(other).map(|(a, b)| a * b).sum();
        vector.iter_mut().zip(other).for_each(|(a, b)| *a -= along * b);
    }
    norm(vector)
}

fn norm(vector: &[f64]) -> f64 {
    vector.iter().map(|a| a * a).sum::<f64>().sqrt()
}

fn normalise(vector: &mut [f64]) {
    let length = norm(vector);
    vector.iter_mut().for_each(|a| *a /= length);
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_null_space_is_orthonormal_and_orthogonal_to_the_rows() {
        let rows = vec![vec![1.0, -8.0, 0.0], vec![1.0, 3.0, 1e-3]];
        let basis = null_space(3, rows.clone()).unwrap();
        assert_eq!(basis.len(), 1);
        let product = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>();
        assert!((norm(&basis[0]) - 1.0).abs() < 1e-15 && rows.iter().all(|row| product(row, &basis[0]).abs() < 1e-15));
        assert_eq!(
            null_space(2, Vec::new()).unwrap(),
            [[1.0, 0.0], [0.0, 1.0]].map(Vec::from).into_iter().rev().collect::<Vec<_>>()
        );
    }

    #[test]
    fn nearly_dependent_rows_are_left_to_the_whole_test() {
        assert!(null_space(3, vec![vec![1.0, 1.0, 0.0], vec![1.0, 1.0 + 1e-5, 0.0]]).is_none());
        assert!(null_space(1, vec![vec![1.0], vec![2.0]]).is_none());
    }
}
