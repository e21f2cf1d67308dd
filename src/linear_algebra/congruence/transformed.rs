//! TᵀAT: its pattern without what cancels, and its values.

use super::pairs::{Partner, SAME};

/// The matrix in the new basis: for a pair (i, j) the unknowns are x_i = u and x_j = v − r·u.
pub(super) struct Transformed {
    /// By j: (i, −r).
    shares: Vec<Option<(u32, f64)>>,
    partners: Vec<Option<Partner>>,
    /// Of A, whose values are given.
    source_offsets: Vec<usize>,
    source_columns: Vec<u32>,
    offsets: Vec<usize>,
    columns: Vec<u32>,
    /// Where the terms of every entry of A go, in the order of [`terms`]: a place in `all`.
    targets: Vec<u32>,
    /// Sums and magnitudes of every entry, those that cancel behind those that are kept.
    all: Vec<f64>,
    magnitudes: Vec<f64>,
}

/// One term of TᵀAT: row, column (lower triangle), coefficient of the entry of A it comes from.
type Term = (u32, u32, f64);

impl Transformed {
    /// `None` where there are no pairs.
    pub fn new(offsets: &[usize], columns: &[u32], values: &[f64], partners: Vec<Option<Partner>>) -> Option<Self> {
        let mut shares = vec![None; partners.len()];
        for (i, partner) in partners.iter().enumerate() {
            if let Some(Partner { place, ratio }) = *partner {
                shares[place as usize] = Some((i as u32, -ratio));
            }
        }
        if shares.iter().all(Option::is_none) {
            return None;
        }
        let (source_offsets, source_columns) = (offsets.to_vec(), columns.to_vec());
        let mut transformed = Transformed {
            shares,
            partners,
            source_offsets,
            source_columns,
            offsets: Vec::new(),
            columns: Vec::new(),
            targets: Vec::new(),
            all: Vec::new(),
            magnitudes: Vec::new(),
        };
        transformed.lay_out(values);
        Some(transformed)
    }

    /// The lower triangle by rows.
    pub fn pattern(&self) -> (&[usize], &[u32]) {
        (&self.offsets, &self.columns)
    }

    /// Values along the pattern for values of A; `None` where an entry left out is not zero.
    pub fn values(&mut self, values: &[f64]) -> Option<&[f64]> {
        let (mut all, mut magnitudes) = (std::mem::take(&mut self.all), std::mem::take(&mut self.magnitudes));
        all.fill(0.0);
        magnitudes.fill(0.0);
        let kept = self.columns.len();
        let mut targets = self.targets.iter();
        self.each_term(|at, (_, _, coefficient)| {
            if let Some(&target) = targets.next() {
                let term = coefficient * values[at];
                all[target as usize] += term;
                if target as usize >= kept {
                    magnitudes[target as usize - kept] += term.abs();
                }
            }
        });
        let cancels = all[kept..].iter().zip(&magnitudes).all(|(sum, magnitude)| sum.abs() <= SAME * magnitude);
        (self.all, self.magnitudes) = (all, magnitudes);
        cancels.then(|| &self.all[..kept])
    }

    /// Tᵀ·right
    pub fn inward(&self, right: &[f64]) -> Vec<f64> {
        let mut transformed = right.to_vec();
        for (i, partner) in self.partners.iter().enumerate() {
            if let Some(Partner { place, ratio }) = *partner {
                transformed[i] -= ratio * right[place as usize];
            }
        }
        transformed
    }

    /// x = T·x
    pub fn outward(&self, x: &mut [f64]) {
        for (i, partner) in self.partners.iter().enumerate() {
            if let Some(Partner { place, ratio }) = *partner {
                x[place as usize] -= ratio * x[i];
            }
        }
    }

    /// Calls `visit` with the place of each entry of A and each of its terms.
    fn each_term(&self, mut visit: impl FnMut(usize, Term)) {
        for row in 0..self.shares.len() {
            for at in self.source_offsets[row]..self.source_offsets[row + 1] {
                let column = self.source_columns[at];
                terms(&self.shares, row as u32, column, |term| visit(at, term));
            }
        }
    }

    /// Finds the entries that do not cancel for these values, and where every term goes.
    fn lay_out(&mut self, values: &[f64]) {
        let mut positions: Vec<(u32, u32)> = Vec::new();
        self.each_term(|_, (row, column, _)| positions.push((row, column)));
        let (offsets, columns) = compressed(self.shares.len(), &positions);
        let place = |(row, column): (u32, u32)| {
            let range = offsets[row as usize]..offsets[row as usize + 1];
            range.start + columns[range].binary_search(&column).unwrap_or_default()
        };
        let places: Vec<usize> = positions.into_iter().map(place).collect();
        let (mut sums, mut magnitudes) = (vec![0.0; columns.len()], vec![0.0; columns.len()]);
        let mut next = places.iter();
        self.each_term(|at, (_, _, coefficient)| {
            if let Some(&place) = next.next() {
                sums[place] += coefficient * values[at];
                magnitudes[place] += (coefficient * values[at]).abs();
            }
        });
        let is_kept = |place: usize| magnitudes[place] == 0.0 || f64::abs(sums[place]) > SAME * magnitudes[place];
        let kept = (0..columns.len()).filter(|&place| is_kept(place)).count();
        let mut target = vec![0; columns.len()];
        let mut dropped = kept;
        self.offsets.push(0);
        for row in 0..self.shares.len() {
            for place in offsets[row]..offsets[row + 1] {
                if is_kept(place) {
                    target[place] = self.columns.len() as u32;
                    self.columns.push(columns[place]);
                } else {
                    target[place] = dropped as u32;
                    dropped += 1;
                }
            }
            self.offsets.push(self.columns.len());
        }
        self.targets = places.into_iter().map(|place| target[place]).collect();
        self.all = vec![0.0; columns.len()];
        self.magnitudes = vec![0.0; columns.len() - kept];
    }
}

/// What the entry (row, column) of A and its mirror image add to the lower triangle of TᵀAT.
fn terms(shares: &[Option<(u32, f64)>], row: u32, column: u32, mut visit: impl FnMut(Term)) {
    let mut add = |a: u32, b: u32, coefficient: f64| {
        // Off the diagonal of A, both of the pair of entries end in one place on the diagonal.
        let times = if a == b && row != column { 2.0 } else { 1.0 };
        visit((a.max(b), a.min(b), times * coefficient));
    };
    add(row, column, 1.0);
    let (of_row, of_column) = (shares[row as usize], shares[column as usize]);
    if let Some((i, share)) = of_row {
        add(i, column, share);
    }
    if let Some((i, share)) = of_column.filter(|_| row != column) {
        add(row, i, share);
    }
    if let (Some((i, share)), Some((k, other))) = (of_row, of_column) {
        add(i, k, share * other);
    }
}

/// Positions by rows, sorted, repeats dropped.
fn compressed(order: usize, positions: &[(u32, u32)]) -> (Vec<usize>, Vec<u32>) {
    let mut starts = vec![0usize; order + 1];
    positions.iter().for_each(|&(row, _)| starts[row as usize + 1] += 1);
    for row in 0..order {
        starts[row + 1] += starts[row];
    }
    let (mut next, mut all) = (starts.clone(), vec![0u32; positions.len()]);
    for &(row, column) in positions {
        all[next[row as usize]] = column;
        next[row as usize] += 1;
    }
    let (mut offsets, mut columns) = (vec![0], Vec::new());
    for row in 0..order {
        let own = &mut all[starts[row]..starts[row + 1]];
        own.sort_unstable();
        let first = columns.len();
        for &column in own.iter() {
            if columns[first..].last() != Some(&column) {
                columns.push(column);
            }
        }
        offsets.push(columns.len());
    }
    (offsets, columns)
}
